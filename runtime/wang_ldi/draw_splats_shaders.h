// The shaders of draw_splats.cpp, put together from kSplatHead, a kind of samples and a pass; numbers are rounded in the order
// that the processor's warpers have.
#pragma once

namespace overlook::wang_ldi::shaders {

inline constexpr char kSplatHead[] = R"(
layout(local_size_x = 128) in;
uniform ivec2 size_px;
uniform vec2 middle_px;
uniform float near_m;
uniform int most_splat_px;
)";

// What a pixel keeps: how deep, as the bits of a number that is not negative, and of what is as deep the lowest colour. In two
// rounds: first every depth, then the colours of those samples that are as deep as their pixel.
inline constexpr char kDepthRound[] = R"(
layout(std430, binding = 0) buffer Depths { uint depths[]; };
void put(int pixel, float depth_m, uint own) { atomicMin(depths[pixel], floatBitsToUint(depth_m)); }
)";
inline constexpr char kColourRound[] = R"(
layout(std430, binding = 0) readonly buffer Depths { uint depths[]; };
layout(std430, binding = 1) buffer Colours { uint colours[]; };
void put(int pixel, float depth_m, uint own) {
    if (depths[pixel] == floatBitsToUint(depth_m)) atomicMin(colours[pixel], own);
}
)";
// In one round, where pixels of 64 bits can be changed at once.
inline constexpr char kOneRoundExtensions[] = R"(
#extension GL_ARB_gpu_shader_int64 : require
#extension GL_NV_shader_atomic_int64 : require
)";
inline constexpr char kOneRound[] = R"(
layout(std430, binding = 0) buffer Keys { uint64_t keys[]; };
void put(int pixel, float depth_m, uint own) { atomicMin(keys[pixel], packUint2x32(uvec2(own, floatBitsToUint(depth_m)))); }
)";

// As Brush::splat.
inline constexpr char kSplat[] = R"(
void splat(precise vec3 at, precise float wide, uint own) {
    if (!(at.z >= near_m)) return;
    precise float nearness = 1.0 / at.z;
    precise float x = middle_px.x + at.x * nearness, y = middle_px.y - at.y * nearness;
    int side = clamp(int(min(wide * nearness, 1e4) + 0.5), 1, most_splat_px);
    float reach = 0.5 * float(side - 1);
    if (!(abs(x) < 1e6 && abs(y) < 1e6)) return;
    ivec2 low = ivec2(floor(vec2(x - reach, y - reach))), high = min(low + side, size_px);
    low = max(low, ivec2(0));
    for (int row = low.y; row < high.y; ++row)
        for (int column = low.x; column < high.x; ++column) put(row * size_px.x + column, at.z, own);
}
)";

// Points that are already brought before the eye: three numbers, how wide, colour.
inline constexpr char kPoints[] = R"(
layout(std430, binding = 2) readonly buffer Points { uint points[]; };
uniform uint point_count;
void main() {
    uint n = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * 65535u * gl_WorkGroupSize.x;
    if (n >= point_count) return;
    vec3 at = uintBitsToFloat(uvec3(points[5u * n], points[5u * n + 1u], points[5u * n + 2u]));
    splat(at, uintBitsToFloat(points[5u * n + 3u]), points[5u * n + 4u]);
}
)";

// Samples of an image. Numbers of 64 bits that decide fades are two of 32, the lower first.
inline constexpr char kImage[] = R"(
layout(std430, binding = 2) readonly buffer Image { uint image[]; };  // two words a sample, then the palette
struct Plane {
    vec4 corner, east, north;  // as ImageFrame; then the splat's width, and 1 if the diagonal falls
};
struct Draw {
    uint first_plane, sample_count, side_px, pieces;
    uint rung_from, rung_to, direction_from, direction_to;
    uint number_low, number_high, coarser_px, has_splats;
    vec4 up;  // then metres a step
    vec4 pixel;  // metres, three unused
};
layout(std430, binding = 3) readonly buffer Draws { Draw draws[]; };
layout(std430, binding = 4) readonly buffer Planes { Plane planes[]; };
uniform uint draw_index;

uint stirred(uint v) {
    v = (v ^ v >> 16) * 0x85ebca6bu;
    v = (v ^ v >> 13) * 0xc2b2ae35u;
    return v ^ v >> 16;
}
// As FadeRow.
uint threshold(uvec2 number, uint decides, uint column, uint row) {
    const uint apart = 0x9e3779b1u;
    uint of_row = stirred(stirred(stirred(number.y ^ decides) ^ number.x) ^ row * apart);
    return stirred(of_row ^ column * apart) >> 24;
}

bool is_shown(Draw draw, uint column, uint row) {
    uvec2 number = uvec2(draw.number_low, draw.number_high);
    if (draw.rung_from > 0u || draw.rung_to < 256u) {
        uvec2 coarse = (2u * uvec2(column, row) + 1u) * draw.coarser_px / (2u * draw.side_px);
        uint value = threshold(number, 0x7275u, coarse.x, coarse.y);
        if (value < draw.rung_from || value >= draw.rung_to) return false;
    }
    if (draw.direction_from == 0u && draw.direction_to == 256u) return true;
    uint value = threshold(number, 0x6469u, column, row);
    return value >= draw.direction_from && value < draw.direction_to;
}

// Of the half of the piece that the middle of a pixel lies in.
Plane plane_of(Draw draw, uint column, uint row) {
    uint across = 2u * draw.side_px, x = (2u * column + 1u) * draw.pieces, y = (2u * row + 1u) * draw.pieces;
    uint first = draw.first_plane + 2u * (y / across * draw.pieces + x / across);
    x %= across, y %= across;
    bool is_east = planes[first].north.w > 0.5 ? x + y >= across : x >= y;
    return planes[first + (is_east ? 1u : 0u)];
}

void main() {
    Draw draw = draws[draw_index];
    uint n = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * 65535u * gl_WorkGroupSize.x;
    if (n >= draw.sample_count) return;
    uint place = image[2u * n], rest = image[2u * n + 1u];
    uint column = place & 0xffffu, row = rest & 0xffffu;
    if (!is_shown(draw, column, row)) return;
    Plane plane = plane_of(draw, column, row);
    float wide = plane.corner.w;
    if (draw.has_splats != 0u) wide *= float(rest >> 24);
    precise float x = (float(column) + 0.5) * draw.pixel.x, y = (float(row) + 0.5) * draw.pixel.x;
    precise float z = float(place >> 16) * draw.up.w;
    precise vec3 foot = plane.corner.xyz + y * plane.north.xyz;
    precise vec3 at = (foot + x * plane.east.xyz) + z * draw.up.xyz;
    splat(at, wide, image[2u * draw.sample_count + (rest >> 16 & 0xffu)]);
}
)";

// Reads all pixels out, and closes small holes as fill_holes does.
inline constexpr char kReadOut[] = R"(
layout(local_size_x = 8, local_size_y = 8) in;
uniform ivec2 size_px;
uniform int widest_px;  // of holes that are filled; 0: none are
layout(rgba8, binding = 0) writeonly uniform image2D shown;
layout(r32f, binding = 1) writeonly uniform image2D shown_depth_m;
layout(std430, binding = 5) buffer Counts { uint filled; };

bool is_empty(ivec2 p) { return depth_of(p.y * size_px.x + p.x) == 0xffffffffu; }
// How far something is from p along a step, 0 if it is not within what a hole may measure.
int reach(ivec2 p, ivec2 step_) {
    for (int n = 1; n <= widest_px; ++n) {
        ivec2 at = p + n * step_;
        if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size_px))) return 0;
        if (!is_empty(at)) return n;
    }
    return 0;
}
bool is_farther(ivec2 a, ivec2 b) {
    int p = a.y * size_px.x + a.x, q = b.y * size_px.x + b.x;
    if (depth_of(p) != depth_of(q)) return depth_of(p) > depth_of(q);
    return colour_of(p) < colour_of(q);
}
bool is_closed(ivec2 p, ivec2 step_, out ivec2 by) {
    int back = reach(p, -step_), on = reach(p, step_);
    by = p - back * step_;
    if (back == 0 || on == 0 || back + on - 1 > widest_px) return false;
    ivec2 other = p + on * step_;
    if (depth_of(other.y * size_px.x + other.x) > depth_of(by.y * size_px.x + by.x)) by = other;
    return true;
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy), from = p;
    if (any(greaterThanEqual(p, size_px))) return;
    if (is_empty(p) && widest_px > 0 && p.x > 0 && p.x + 1 < size_px.x) {
        ivec2 beside, above;
        if (is_closed(p, ivec2(1, 0), beside) && is_closed(p, ivec2(0, 1), above)) {
            from = is_farther(beside, above) ? beside : above;
            atomicAdd(filled, 1u);
        }
    }
    int pixel = from.y * size_px.x + from.x;
    bool is_nothing = is_empty(from);
    imageStore(shown, p, is_nothing ? vec4(0.0) : unpackUnorm4x8(colour_of(pixel)));
    imageStore(shown_depth_m, p, vec4(is_nothing ? 0.0 : uintBitsToFloat(depth_of(pixel))));
}
)";
inline constexpr char kReadTwo[] = R"(
layout(std430, binding = 0) readonly buffer Depths { uint depths[]; };
layout(std430, binding = 1) readonly buffer Colours { uint colours[]; };
uint depth_of(int pixel) { return depths[pixel]; }
uint colour_of(int pixel) { return colours[pixel]; }
)";
inline constexpr char kReadOne[] = R"(
layout(std430, binding = 0) readonly buffer Keys { uvec2 keys[]; };
uint depth_of(int pixel) { return keys[pixel].y; }
uint colour_of(int pixel) { return keys[pixel].x; }
)";

}  // namespace overlook::wang_ldi::shaders
