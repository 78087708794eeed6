// The shaders that put two frames together where something changes: draw_combination.cpp's, after those of draw_turn_shaders.h.
#pragma once

namespace overlook::discrete::shaders {

// What is under way, nearest first, and which of it in which square of the picture.
inline constexpr char kUnderWay[] = R"(
struct Moved {
    mat4 old_from_new, new_from_old;
    uint id, from, to;
    float phase;
    float near_z, far_z, pad0, pad1;
};
struct Tile {
    uint column, row, first, count;  // first, count: of the entries
};
layout(std430, binding = 4) readonly buffer Moveds { Moved moveds[]; };
layout(std430, binding = 5) readonly buffer Tiles { Tile tiles[]; };
layout(std430, binding = 6) readonly buffer Entries { uint entries[]; };
)";

// One square of the picture, as a strip of four corners; after kUnderWay.
inline constexpr char kTileVertex[] = R"(
uniform vec2 picture_px;
uniform float tile_px;  // a square's side
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
    vec2 at_px = min(corner * tile_px, picture_px);
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

// Both frames' buffers; Picture and Numbers: kinds of samplers, as in kSamplers.
inline constexpr char kTwoFrames[] = R"(
layout(binding = 0) uniform Picture new_colour;
layout(binding = 1) uniform Numbers new_ids;
layout(binding = 2) uniform Picture new_depth;
layout(binding = 3) uniform Picture old_colour;
layout(binding = 4) uniform Numbers old_ids;
layout(binding = 5) uniform Picture old_depth;
)";

// KEEPS_HIDDEN, SEARCHES, WEIGHS_BY_PHASE, HAS_LONG_RAMPS, HAS_WIDE_IDS, HAS_WIDE_DEPTH: the remedies. IS_ONE: each square has
// one entry, which comes with it; else after kUnderWay. MOVES: things have their own matrices; else all have the camera's.
inline constexpr char kCombinationInputs[] = R"(
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

inline constexpr char kCombinationMain[] = R"(
#if SEARCHES
void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec2 at_px = vec2(at) + sample_at(gl_SampleID);
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
