// The shaders that put two frames together: draw_turns.cpp's. They stand alone: any renderer that has two such buffers can use
// them.
#pragma once

namespace overlook::discrete::shaders {

// SAMPLES: of the buffers and the picture, a pixel.
inline constexpr char kBuffers[] = R"(
#if SAMPLES > 1
#define Picture sampler2DMS
#define Numbers usampler2DMS
#define fetch(from, at) texelFetch(from, at, gl_SampleID)
#else
#define Picture sampler2D
#define Numbers usampler2D
#define fetch(from, at) texelFetch(from, at, 0)
#endif
uniform ivec2 size_px;
uniform mat4 camera_old_from_new;
layout(location = 0) out vec4 colour;
bool is_inside(ivec2 at) {
    return all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, size_px));
}
// Where a pixel's middle is, in clip coordinates, and back.
vec2 clip_of(vec2 at_px) {
    return 2.0 * at_px / vec2(size_px) - 1.0;
}
vec3 moved(mat4 by, vec2 clip, float z) {
    vec4 at = by * vec4(clip, z, 1.0);
    return at.w > 0.0 ? vec3((0.5 * at.xy / at.w + 0.5) * vec2(size_px), at.z / at.w) : vec3(-1.0);
}
)";

// Section 3.4, with Equation 2 and its three cases.
inline constexpr char kPaperCombination[] = R"(
layout(binding = 0) uniform Picture new_colour;
layout(binding = 1) uniform Picture new_depth_and_id;
layout(binding = 2) uniform Picture old_colour;
layout(binding = 3) uniform Picture old_depth_and_id;
void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec3 newer = fetch(new_colour, at).rgb;
    vec2 newer_at = fetch(new_depth_and_id, at).xy;
    colour = vec4(newer, 1.0);
    gl_FragDepth = 1.0 - newer_at.x;
    ivec2 old_at = ivec2(floor(moved(camera_old_from_new, clip_of(vec2(at) + 0.5), 1.0 - newer_at.x).xy));
    if (!is_inside(old_at)) return;
    vec2 older_at = fetch(old_depth_and_id, old_at).xy;
    if (newer_at.y == 0.0 && older_at.y == 0.0) return;
    vec3 older = fetch(old_colour, old_at).rgb;
    if (newer_at.y == older_at.y) {
        colour = vec4(0.5 * (newer + older), 1.0);
    } else if (older_at.x < newer_at.x) {
        colour = vec4(older, 1.0);
        gl_FragDepth = 1.0 - older_at.x;
    }
}
)";

// KEEPS_HIDDEN, SEARCHES, WEIGHS_BY_PHASE, HAS_LONG_RAMPS, HAS_WIDE_IDS, HAS_WIDE_DEPTH: the remedies. KMOST, TILE_PX:
// reprojection.h's Tiles.
inline constexpr char kCombinationInputs[] = R"(
layout(binding = 0) uniform Picture new_colour;
layout(binding = 1) uniform Numbers new_ids;
layout(binding = 2) uniform Picture new_depth;
layout(binding = 3) uniform Picture old_colour;
layout(binding = 4) uniform Numbers old_ids;
layout(binding = 5) uniform Picture old_depth;
uniform mat4 camera_new_from_old;
uniform int tile_columns;
uniform float softness;
struct Moved {
    mat4 old_from_new, new_from_old;
    uint id, from, to;
    float phase;
    float near_z, far_z, pad0, pad1;
};
layout(std430, binding = 4) readonly buffer Moveds { Moved moveds[]; };  // nearest first
layout(std430, binding = 5) readonly buffer Tiles { uint tiles[]; };

// What a buffer shows at a pixel.
struct Seen {
    vec3 colour;
    float appears;
    uint id, level;
    float z;  // in the newer frame, once it is known
};
float half_of(float value) {
    return unpackHalf2x16(packHalf2x16(vec2(value, 0.0))).x;
}
uint stored_id(uint id) {
#if HAS_WIDE_IDS
    return id;
#else
    return uint(min(half_of(float(id)), 65504.0));
#endif
}
float stored_z(float z) {
#if HAS_WIDE_DEPTH
    return z;
#else
    return 1.0 - half_of(1.0 - z);
#endif
}
Seen newer_at(ivec2 at) {
    vec4 own = fetch(new_colour, at);
    uvec2 ids = fetch(new_ids, at).xy;
    return Seen(own.rgb, own.a, stored_id(ids.x), ids.y, stored_z(fetch(new_depth, at).r));
}
Seen older_at(ivec2 at) {
    vec4 own = fetch(old_colour, at);
    uvec2 ids = fetch(old_ids, at).xy;
    return Seen(own.rgb, own.a, stored_id(ids.x), ids.y, stored_z(fetch(old_depth, at).r));
}
)";

inline constexpr char kCombinationParts[] = R"(
// The orders of appearance before which places are there, and those up to `softness` before it are on their way: such that over
// evenly spread orders the mean that is there is `share`, which changes as evenly as time goes.
float front_of(float share) {
    float edge = min(softness, 1.0), edge_share = edge * edge / (2.0 * softness);
    if (share < edge_share) return sqrt(2.0 * softness * share);
    if (share > 1.0 - edge_share) return 1.0 + softness - sqrt(2.0 * softness * (1.0 - share));
    return edge + (share - edge_share) * softness / edge;
}
// How much of what is seen of an instance under way is there, 0..1.
float presence(Moved one, Seen seen) {
#if KEEPS_HIDDEN
#if HAS_LONG_RAMPS
    float share = seen.level == one.to ? one.phase : 1.0 - one.phase;
#else
    float share = seen.level == one.to ? min(2.0 * one.phase, 1.0) : min(2.0 - 2.0 * one.phase, 1.0);
#endif
    if (share >= 1.0) return 1.0;
    if (softness <= 0.0) return seen.appears <= share ? 1.0 : 0.0;
    return clamp((front_of(share) - seen.appears) / softness, 0.0, 1.0);
#else
    return 1.0;
#endif
}
// Both levels at one place; in the same order whichever of them is the newer one, so that the two frames round alike.
vec3 both(Moved one, Seen newer, Seen older) {
    if (newer.level == older.level) return newer.colour;
#if WEIGHS_BY_PHASE
    bool is_newer_to = newer.level == one.to;
    return mix(is_newer_to ? older.colour : newer.colour, is_newer_to ? newer.colour : older.colour, one.phase);
#else
    float newer_share = presence(one, newer), older_share = presence(one, older);
    vec3 whole = newer_share >= older_share ? newer.colour : older.colour;
    return mix(whole, 0.5 * (newer.colour + older.colour), min(newer_share, older_share));
#endif
}
// The older buffer's colour between pixels, of what is the same thing.
vec3 older_colour(vec2 at_px, Seen like) {
    vec2 at = at_px - 0.5, base = floor(at + 1.0 / 256.0), share = max(at - base, 0.0);
    if (share.x < 1.0 / 128.0) share.x = 0.0;
    if (share.y < 1.0 / 128.0) share.y = 0.0;
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1), from = ivec2(base) + corner;
        float weight = (corner.x == 1 ? share.x : 1.0 - share.x) * (corner.y == 1 ? share.y : 1.0 - share.y);
        if (weight <= 0.0 || !is_inside(from)) continue;
        Seen one = older_at(from);
        if (one.id != like.id || one.level != like.level) continue;
        sum += weight * one.colour;
        weights += weight;
    }
    return weights > 0.0 ? sum / weights : like.colour;
}
// Goes after a surface: from a first guess of the depth here to a pixel of the older buffer that is seen at this place now. id: the
// only thing that counts, or ~0: anything. Iterative image warping (Yang et al. 2011; Bowles et al. 2012).
bool follow(mat4 old_from_new, mat4 new_from_old, vec2 at_px, float z, uint id, out Seen seen) {
    vec2 clip = clip_of(at_px);
    for (int i = 0; i < 4; ++i) {
        vec2 there = moved(old_from_new, clip, z).xy;
        ivec2 pixel = ivec2(floor(there));
        if (!is_inside(pixel)) return false;
        seen = older_at(pixel);
        if (id != ~0u && seen.id != id) return false;
        vec3 here = moved(new_from_old, clip_of(vec2(pixel) + 0.5), seen.z);
        vec2 off = abs(here.xy - at_px);
        z = here.z;
        if (max(off.x, off.y) > 0.75) continue;
        seen.z = z;
        seen.colour = older_colour(moved(old_from_new, clip, z).xy, seen);
        return true;
    }
    return false;
}
// The same of an instance under way, wherever between its nearest and its farthest place it may be.
bool find(Moved one, vec2 at_px, float guess_z, out Seen seen) {
    if (guess_z > 0.0 && follow(one.old_from_new, one.new_from_old, at_px, guess_z, stored_id(one.id), seen)) return true;
    vec2 clip = clip_of(at_px);
    vec2 span = moved(one.old_from_new, clip, one.near_z).xy - moved(one.old_from_new, clip, one.far_z).xy;
    int steps = clamp(int(ceil(max(abs(span.x), abs(span.y)))), 1, 8);
    for (int i = 0; i < steps; ++i) {
        float z = mix(one.near_z, one.far_z, (float(i) + 0.5) / float(steps));
        if (follow(one.old_from_new, one.new_from_old, at_px, z, stored_id(one.id), seen)) return true;
    }
    return false;
}
)";

inline constexpr char kCombinationMain[] = R"(
void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec2 at_px = vec2(at) + 0.5;
    Seen newer = newer_at(at);
    colour = vec4(newer.colour, 1.0);
    gl_FragDepth = newer.z;
    uint first = uint((at.y / TILE_PX) * tile_columns + at.x / TILE_PX) * uint(KMOST);
    if (tiles[first] == 0u) return;
    int own = -1;
    for (int k = 0; k < KMOST && tiles[first + k] != 0u; ++k) {
        int i = int(tiles[first + k]) - 1;
        if (stored_id(moveds[i].id) == newer.id) { own = i; break; }
    }
#if SEARCHES
    // Of the older buffer: the same instance's other level, and the nearest of other instances under way.
    Seen same, other, one;
    bool has_same = own >= 0 && find(moveds[own], at_px, newer.z, same), has_other = false;
    int other_own = -1;
    for (int k = 0; k < KMOST && tiles[first + k] != 0u; ++k) {
        int i = int(tiles[first + k]) - 1;
        if (i == own || !find(moveds[i], at_px, 0.0, one)) continue;
        if (has_other && one.z <= other.z) continue;
        other = one;
        other_own = i;
        has_other = true;
    }
    float present = 1.0;
    if (has_same) {
        newer.colour = both(moveds[own], newer, same);
    } else if (own >= 0) {
        present = presence(moveds[own], newer);
    }
    if (present < 1.0) {
        // What lies behind: of the two buffers only the older one may know.
        bool knows = has_other && other.z < newer.z;
        Seen behind = other;
        if (!knows) knows = follow(camera_old_from_new, camera_new_from_old, at_px, newer.z, ~0u, behind) && behind.z < newer.z;
        if (knows) newer.colour = mix(behind.colour, newer.colour, present);
        if (knows && present < 0.5) newer.z = behind.z;
    }
    if (has_other && other.z > newer.z) {
        float share = presence(moveds[other_own], other);
        newer.colour = mix(newer.colour, other.colour, share);
        if (share >= 0.5) newer.z = other.z;
    }
    colour = vec4(newer.colour, 1.0);
    gl_FragDepth = newer.z;
#else
    // One lookup, by the newer buffer's own depth.
    mat4 back = camera_old_from_new;
    if (own >= 0) back = moveds[own].old_from_new;
    vec3 there = moved(back, clip_of(at_px), newer.z);
    if (!is_inside(ivec2(floor(there.xy)))) return;
    Seen older = older_at(ivec2(floor(there.xy)));
    int older_own = -1;
    for (int k = 0; k < KMOST && tiles[first + k] != 0u; ++k) {
        int i = int(tiles[first + k]) - 1;
        if (stored_id(moveds[i].id) == older.id) { older_own = i; break; }
    }
    if (own < 0 && older_own < 0) return;
    if (own == older_own) {
        colour = vec4(both(moveds[own], newer, older), 1.0);
        return;
    }
    bool is_older_nearer = older.z > there.z;
    Seen front = newer, behind = older;
    int front_own = own;
    if (is_older_nearer) front = older, behind = newer, front_own = older_own;
    float share = front_own >= 0 ? presence(moveds[front_own], front) : 1.0;
    colour = vec4(mix(behind.colour, front.colour, share), 1.0);
    if (is_older_nearer == (share > 0.5)) gl_FragDepth = older.z;
#endif
}
)";

}  // namespace overlook::discrete::shaders
