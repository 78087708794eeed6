// The shader that finds out in which blocks of the picture something under way may be seen: draw_sieve.cpp's, after kSamplers and
// kPlaces of draw_turn_shaders.h, and kTwoFrames and kUnderWay of draw_combination_shaders.h.
#pragma once

namespace overlook::discrete::shaders {

// Eight invocations to a block, four blocks to a square. BLOCK_PX, MOST_PX: of pixels looked at for one thing.
inline constexpr char kSieve[] = R"(
layout(local_size_x = 64) in;
struct Command {
    uint count, instance_count, first, base_instance;  // of glDrawArraysIndirect
};
layout(std430, binding = 7) buffer Found {
    Command commands[2];  // of squares with one entry, and of all others
    uint taken[];         // of each square a bit a block
};
layout(std430, binding = 3) writeonly buffer Blocks { Tile blocks[]; };
uniform uint tile_count, one_count;

bool shows(Numbers from, ivec2 at, uint id) {
    bool does = false;
    for (int i = 0; i < SAMPLES; ++i) does = does || fetch_sample(from, at, i).x == id;
    return does;
}
// Does the newer frame show any of the things in a row of pixels?
bool is_newer(Tile tile, int from, int to, int y) {
    for (uint k = 0u; k < tile.count; ++k) {
        uint id = moveds[entries[tile.first + k]].id;
        for (int x = from; x < to; ++x)
            if (shows(new_ids, ivec2(x, y), id)) return true;
    }
    return false;
}
// Where in the older frame a thing is looked for that is seen in a block: wherever it may be between its nearest and its farthest
// place. False if that may be anywhere.
bool is_bounded(Moved one, vec2 low_px, vec2 high_px, out ivec2 first, out ivec2 last) {
    vec2 least = vec2(1e9), most = vec2(-1e9);
    bool is_before_eye = true;
    for (int i = 0; i < 8; ++i) {
        vec2 at_px = mix(low_px, high_px, vec2(i & 1, i >> 1 & 1));
        vec4 at = one.old_from_new * vec4(clip_of(at_px), i < 4 ? one.near_z : one.far_z, 1.0);
        is_before_eye = is_before_eye && at.w > 1e-6;
        vec2 place = place_px(at);
        least = min(least, place), most = max(most, place);
    }
    // A sample's pixel is the next one at most; and roundings.
    const float reach_px = 1.0 + 1.0 / 16.0;
    first = ivec2(max(floor(least - reach_px), vec2(0.0)));
    last = ivec2(min(floor(most + reach_px), vec2(size_px - 1)));
    return is_before_eye;
}
// The same of the older frame, in every eighth row of the pixels in which a thing is looked for.
bool is_older(Tile tile, vec2 low_px, vec2 high_px, int row) {
    for (uint k = 0u; k < tile.count; ++k) {
        Moved one = moveds[entries[tile.first + k]];
        ivec2 first, last;
        if (!is_bounded(one, low_px, high_px, first, last)) return true;
        ivec2 side = max(last - first + 1, ivec2(0));
        if (float(side.x) * float(side.y) > float(MOST_PX)) return true;
        for (int y = first.y + row; y <= last.y; y += 8)
            for (int x = first.x; x <= last.x; ++x)
                if (shows(old_ids, ivec2(x, y), one.id)) return true;
    }
    return false;
}
void main() {
    uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 2u + (gl_LocalInvocationID.x >> 5);
    if (index >= tile_count) return;
    Tile tile = tiles[index];
    uint block = gl_LocalInvocationID.x >> 3 & 3u;
    int row = int(gl_LocalInvocationID.x & 7u);
    uvec2 place = 2u * uvec2(tile.column, tile.row) + uvec2(block & 1u, block >> 1);
    ivec2 low = ivec2(place) * BLOCK_PX, high = min(low + BLOCK_PX, size_px);
    if (any(greaterThanEqual(low, high))) return;
    bool is_seen = low.y + row < high.y && is_newer(tile, low.x, high.x, low.y + row);
    if (!is_seen && !is_older(tile, vec2(low), vec2(high), row)) return;
    uint bit = 1u << block;
    if ((atomicOr(taken[index], bit) & bit) != 0u) return;
    bool is_one = index < one_count;
    uint at = (is_one ? 0u : 4u * one_count) + atomicAdd(commands[is_one ? 0 : 1].instance_count, 1u);
    blocks[at] = Tile(place.x, place.y, tile.first, tile.count);
}
)";

}  // namespace overlook::discrete::shaders
