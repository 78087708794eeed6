// The shaders that put two frames together where something changes: draw_combination.cpp's, after kBuffers of
// draw_turn_shaders.h.
#pragma once

namespace overlook::discrete::shaders {

// One square of the picture, as a strip of four corners.
inline constexpr char kTileVertex[] = R"(
struct Tile {
    uint column, row, first, count;   // first, count: of the entries
};
struct Moved {
    mat4 old_from_new, new_from_old;
    uint id, from, to;
    float phase;
    float near_z, far_z, pad0, pad1;
};
layout(std430, binding = 4) readonly buffer Moveds { Moved moveds[]; };  // nearest first
layout(std430, binding = 5) readonly buffer Tiles { Tile tiles[]; };
layout(std430, binding = 6) readonly buffer Entries { uint entries[]; };
uniform vec2 picture_px;
uniform uint first_tile;
flat out uvec2 listed;
#if IS_ONE
flat out mat4 only_old_from_new, only_new_from_old;
flat out uvec3 only_ids;
flat out vec3 only_numbers;
#endif
void main() {
    Tile tile = tiles[first_tile + uint(gl_InstanceID)];
    listed = uvec2(tile.first, tile.count);
    vec2 corner = vec2(tile.column + uint(gl_VertexID & 1), tile.row + uint(gl_VertexID >> 1));
    vec2 at_px = min(corner * float(TILE_PX), picture_px);
    gl_Position = vec4(2.0 * at_px / picture_px - 1.0, 0.0, 1.0);
#if IS_ONE
    Moved only = moveds[entries[tile.first]];
    only_old_from_new = only.old_from_new;
    only_new_from_old = only.new_from_old;
    only_ids = uvec3(only.id, only.from, only.to);
    only_numbers = vec3(only.phase, only.near_z, only.far_z);
#endif
}
)";

// KEEPS_HIDDEN, SEARCHES, WEIGHS_BY_PHASE, HAS_LONG_RAMPS, HAS_WIDE_IDS, HAS_WIDE_DEPTH: the remedies. IS_ONE: each square has one
// entry, which comes with it. MOVES: things have their own matrices; else all have the camera's.
inline constexpr char kCombinationInputs[] = R"(
layout(binding = 0) uniform Picture new_colour;
layout(binding = 1) uniform Numbers new_ids;
layout(binding = 2) uniform Picture new_depth;
layout(binding = 3) uniform Picture old_colour;
layout(binding = 4) uniform Numbers old_ids;
layout(binding = 5) uniform Picture old_depth;
uniform mat4 camera_new_from_old;
uniform float softness;
flat in uvec2 listed;

// Something under way: of which levels, and how far.
struct Way {
    uint id, from, to;
    float phase, near_z, far_z;
};
#if IS_ONE
flat in mat4 only_old_from_new, only_new_from_old;
flat in uvec3 only_ids;
flat in vec3 only_numbers;
Way way_of(uint entry) {
    return Way(only_ids.x, only_ids.y, only_ids.z, only_numbers.x, only_numbers.y, only_numbers.z);
}
#define entry_at(k) 0u
#else
struct Moved {
    mat4 old_from_new, new_from_old;
    uint id, from, to;
    float phase;
    float near_z, far_z, pad0, pad1;
};
layout(std430, binding = 4) readonly buffer Moveds { Moved moveds[]; };
layout(std430, binding = 6) readonly buffer Entries { uint entries[]; };
Way way_of(uint entry) {
    return Way(moveds[entry].id, moveds[entry].from, moveds[entry].to, moveds[entry].phase, moveds[entry].near_z,
               moveds[entry].far_z);
}
#define entry_at(k) entries[listed.x + k]
#endif
#if !MOVES
#define back_of(entry) camera_old_from_new
#define forth_of(entry) camera_new_from_old
#elif IS_ONE
#define back_of(entry) only_old_from_new
#define forth_of(entry) only_new_from_old
#else
#define back_of(entry) moveds[entry].old_from_new
#define forth_of(entry) moveds[entry].new_from_old
#endif

// What a buffer shows at a pixel.
struct Seen {
    vec3 colour;
    float appears;
    uint id, level;
    float z;
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
    return Seen(own.rgb, 1.0 - own.a, stored_id(ids.x), ids.y, stored_z(fetch(new_depth, at).r));
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
float presence(Way one, uint level, float appears) {
#if KEEPS_HIDDEN
#if HAS_LONG_RAMPS
    float share = level == one.to ? one.phase : 1.0 - one.phase;
#else
    float share = level == one.to ? min(2.0 * one.phase, 1.0) : min(2.0 - 2.0 * one.phase, 1.0);
#endif
    if (share >= 1.0) return 1.0;
    if (softness <= 0.0) return appears <= share ? 1.0 : 0.0;
    return clamp((front_of(share) - appears) / softness, 0.0, 1.0);
#else
    return 1.0;
#endif
}
// Both levels at one place; in the same order whichever of them is the newer one, so that the two frames round alike. older:
// colour and order of appearance.
vec3 both(Way one, Seen newer, vec4 older, uint older_level) {
    if (newer.level == older_level) return newer.colour;
#if WEIGHS_BY_PHASE
    bool is_newer_to = newer.level == one.to;
    return mix(is_newer_to ? older.rgb : newer.colour, is_newer_to ? newer.colour : older.rgb, one.phase);
#else
    float newer_share = presence(one, newer.level, newer.appears), older_share = presence(one, older_level, older.a);
    vec3 whole = newer_share >= older_share ? newer.colour : older.rgb;
    return mix(whole, 0.5 * (newer.colour + older.rgb), min(newer_share, older_share));
#endif
}

// A pixel of the older buffer, and where between pixels that what it shows lies that is seen here now, at depth z.
struct Hit {
    ivec2 pixel;
    vec2 at_px;
    uint id, level;
    float z;
};
// The older buffer's colour between pixels, of the same thing in a level; and the pixel's own order of appearance. is_there: some
// of the pixels round the place show that.
vec4 older_colour(Hit hit, uint level, out bool is_there) {
    vec2 at = hit.at_px - 0.5, base = floor(at + 1.0 / 256.0), share = max(at - base, 0.0);
    if (share.x < 1.0 / 128.0) share.x = 0.0;
    if (share.y < 1.0 / 128.0) share.y = 0.0;
    vec4 own = fetch(old_colour, hit.pixel);
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1), from = ivec2(base) + corner;
        float weight = (corner.x == 1 ? share.x : 1.0 - share.x) * (corner.y == 1 ? share.y : 1.0 - share.y);
        if (weight <= 0.0 || !is_inside(from)) continue;
        uvec2 ids = fetch(old_ids, from).xy;
        if (stored_id(ids.x) != hit.id || ids.y != level) continue;
        sum += weight * fetch(old_colour, from).rgb;
        weights += weight;
    }
    is_there = weights > 0.0;
    return vec4(is_there ? sum / weights : own.rgb, 1.0 - own.a);
}
// Goes after a surface: from a first guess of the depth here to a pixel of the older buffer that is seen at this place now. id: the
// only thing that counts, or ~0: anything. Iterative image warping (Yang et al. 2011; Bowles et al. 2012).
bool follow(mat4 old_from_new, mat4 new_from_old, vec2 at_px, float z, uint id, out Hit hit) {
    vec2 clip = clip_of(at_px);
    for (int i = 0; i < 4; ++i) {
        hit.pixel = ivec2(floor(moved(old_from_new, clip, z).xy));
        if (!is_inside(hit.pixel)) return false;
        uvec2 ids = fetch(old_ids, hit.pixel).xy;
        hit.id = stored_id(ids.x);
        hit.level = ids.y;
        if (id != ~0u && hit.id != id) return false;
        vec3 here = moved(new_from_old, clip_of(vec2(hit.pixel) + 0.5), stored_z(fetch(old_depth, hit.pixel).r));
        vec2 off = abs(here.xy - at_px);
        z = here.z;
        if (max(off.x, off.y) > 0.75) continue;
        hit.z = z;
        hit.at_px = moved(old_from_new, clip, z).xy;
        return true;
    }
    return false;
}
// The same of something under way: from a guess if that is above 0, then wherever between its nearest and its farthest place it
// may be.
bool find(uint entry, Way one, vec2 at_px, float guess_z, out Hit hit) {
    vec2 clip = clip_of(at_px);
    vec2 span = moved(back_of(entry), clip, one.near_z).xy - moved(back_of(entry), clip, one.far_z).xy;
    int steps = clamp(int(ceil(max(abs(span.x), abs(span.y)))), 1, 8);
    for (int i = guess_z > 0.0 ? -1 : 0; i < steps; ++i) {
        float z = i < 0 ? guess_z : mix(one.near_z, one.far_z, (float(i) + 0.5) / float(steps));
        if (follow(back_of(entry), forth_of(entry), at_px, z, stored_id(one.id), hit)) return true;
    }
    return false;
}
)";

inline constexpr char kCombinationMain[] = R"(
#if SEARCHES
void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec2 at_px = vec2(at) + 0.5;
    Seen newer = newer_at(at);
    // Of the older buffer: the same instance's other level, and the nearest of other instances under way.
    Hit same, other, hit;
    Way own, others;
    bool is_own = false, has_same = false, has_other = false;
    for (uint k = 0u; k < listed.y; ++k) {
        uint entry = entry_at(k);
        Way one = way_of(entry);
        bool is_it = !is_own && stored_id(one.id) == newer.id;
        if (is_it) own = one, is_own = true;
        if (!find(entry, one, at_px, is_it ? newer.z : 0.0, hit)) continue;
        if (is_it) {
            same = hit;
            has_same = true;
        } else if (!has_other || hit.z > other.z) {
            other = hit;
            others = one;
            has_other = true;
        }
    }
    // What lies behind what is not all there: of the two buffers only the older one may know.
    float present = is_own && !has_same ? presence(own, newer.level, newer.appears) : 1.0;
    bool knows = present < 1.0 && has_other && other.z < newer.z, is_before = has_other && other.z > newer.z;
    Hit behind = other;
    if (present < 1.0 && !knows)
        knows = follow(camera_old_from_new, camera_new_from_old, at_px, newer.z, ~0u, behind) && behind.z < newer.z;
    vec4 found = vec4(0.0), nearer = vec4(0.0);
    for (int i = has_same || knows ? 0 : 1; i < (is_before ? 2 : 1); ++i) {
        if (i == 1) hit = other;
        else if (has_same) hit = same;
        else hit = behind;
        // Of a thing that is divided the pixel may lie beyond the line already.
        uint level = hit.level;
        if (i == 0 && has_same && level == newer.level) level = level == own.to ? own.from : own.to;
        bool is_here;
        vec4 of_hit = older_colour(hit, level, is_here);
        if (i == 0) same.level = is_here || level == hit.level ? level : newer.level;
        if (i == 1) nearer = of_hit;
        else found = of_hit;
    }
    if (has_same) newer.colour = both(own, newer, found, same.level);
    if (knows) newer.colour = mix(found.rgb, newer.colour, present);
    if (knows && present < 0.5) newer.z = behind.z;
    if (is_before) {
        float share = presence(others, other.level, nearer.a);
        newer.colour = mix(newer.colour, nearer.rgb, share);
        if (share >= 0.5) newer.z = other.z;
    }
    colour = vec4(newer.colour, 1.0);
    gl_FragDepth = newer.z;
}
#else
// One lookup, by the newer buffer's own depth.
void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    Seen newer = newer_at(at);
    colour = vec4(newer.colour, 1.0);
    gl_FragDepth = newer.z;
    mat4 back = camera_old_from_new;
    Way own, others;
    bool is_own = false, is_others = false;
    for (uint k = 0u; k < listed.y && !is_own; ++k) {
        Way one = way_of(entry_at(k));
        if (stored_id(one.id) != newer.id) continue;
        own = one;
        is_own = true;
        back = back_of(entry_at(k));
    }
    vec3 there = moved(back, clip_of(vec2(at) + 0.5), newer.z);
    ivec2 from = ivec2(floor(there.xy));
    if (!is_inside(from)) return;
    vec4 older = fetch(old_colour, from);
    uvec2 older_ids = fetch(old_ids, from).xy;
    float older_z = stored_z(fetch(old_depth, from).r);
    older.a = 1.0 - older.a;
    for (uint k = 0u; k < listed.y && !is_others; ++k) {
        others = way_of(entry_at(k));
        is_others = stored_id(others.id) == stored_id(older_ids.x);
    }
    if (!is_own && !is_others) return;
    if (is_own && is_others && own.id == others.id) {
        colour = vec4(both(own, newer, older, older_ids.y), 1.0);
        return;
    }
    bool is_older_nearer = older_z > there.z;
    float own_share = is_own ? presence(own, newer.level, newer.appears) : 1.0;
    float others_share = is_others ? presence(others, older_ids.y, older.a) : 1.0;
    float share = is_older_nearer ? others_share : own_share;
    vec3 front = is_older_nearer ? older.rgb : newer.colour, behind = is_older_nearer ? newer.colour : older.rgb;
    colour = vec4(mix(behind, front, share), 1.0);
    if (is_older_nearer == (share > 0.5)) gl_FragDepth = older_z;
}
#endif
)";

}  // namespace overlook::discrete::shaders
