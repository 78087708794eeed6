// How plant_sift.h does it, eight at a time: lanes.h says what holds for its compilations.
//
// Based on: J. Pineda, A Parallel Algorithm for Polygon Rasterization, 1988 (edge functions).
#pragma once

#include "runtime/wang_ldi/lanes.h"
#include "runtime/wang_ldi/plant_sift.h"

namespace overlook::wang_ldi {
namespace {

inline Floats along(const float (&axis)[4], const Floats& x, const Floats& y, const Floats& z) {
    return axis[0] * x + axis[1] * y + axis[2] * z + axis[3];
}
inline Ints is_beyond(const Floats& v) {
    return ~((v <= kFarthest_px) & (v >= -kFarthest_px));
}

inline void place_lanes(const VertexFrame& frame, const float* x_m, const float* y_m, const float* z_m, uint32_t count,
                        const PlacedVertices& placed) {
    for (uint32_t v = 0; v < count; v += kLanes) {
        uint32_t left = count - v;
        Floats x, y, z, one = Floats{} + 1.0f;
        load(x, x_m + v, left), load(y, y_m + v, left), load(z, z_m + v, left);
        Floats depth = along(frame.forward, x, y, z);
        Ints is_near = ~(depth >= frame.near_m);
        Floats nearness = 1.0f / chosen(is_near, one, depth);
        Floats right = along(frame.right, x, y, z) * nearness, up = along(frame.up, x, y, z) * nearness;
        Ints is_far = is_beyond(right) | is_beyond(up);
        Floats across = frame.middle_px[0] + right, down = frame.middle_px[1] - up;
        Ints sides = ((across < 0) & kLeft) | ((across > frame.size_px[0]) & kRight) | ((down < 0) & kAbove) |
                     ((down > frame.size_px[1]) & kBelow);
        Ints behind = chosen(is_near, Ints{} + kNear, sides | (is_far & kFar)), has_place = ~(is_far | is_near);
        across = chosen(has_place, across, Floats{}), down = chosen(has_place, down, Floats{});
        store(placed.x + v, floor_of(across * kCornerSteps + 0.5f), left);
        store(placed.y + v, floor_of(down * kCornerSteps + 0.5f), left);
        store(placed.nearness + v, nearness, left), store(placed.behind + v, behind, left);
    }
}

// Eight triangles' corners.
struct Corners {
    Ints x[3], y[3], behind[3];

    Corners(const PlacedVertices& placed, const uint16_t* indices, uint32_t count) {
        for (uint32_t lane = 0; lane < kLanes; ++lane)
            for (uint32_t k = 0; k < 3; ++k) {
                uint16_t v = indices[3 * (lane < count ? lane : 0) + k];
                x[k][lane] = placed.x[v], y[k][lane] = placed.y[v], behind[k][lane] = placed.behind[v];
            }
    }
};

// Eight triangles asked about.
struct Sifted {
    Ints is_kept, is_cut, is_one;  // is_one: of one pixel, which is inside
    Ints column, row, edges[3], area;

    Sifted(const SiftFrame& frame, const Corners& at) {
        constexpr int32_t kHalf = kCornerSteps / 2, kSmall = 32 * kCornerSteps;
        Ints all = at.behind[0] & at.behind[1] & at.behind[2] & ~kFar, any = at.behind[0] | at.behind[1] | at.behind[2];
        is_cut = (any & (kNear | kFar)) != 0;
        Ints low_x = lesser(lesser(at.x[0], at.x[1]), at.x[2]), high_x = greater(greater(at.x[0], at.x[1]), at.x[2]);
        Ints low_y = lesser(lesser(at.y[0], at.y[1]), at.y[2]), high_y = greater(greater(at.y[0], at.y[1]), at.y[2]);
        column = greater((low_x + (kHalf - 1)) >> kCornerBits, Ints{} + frame.left);
        row = greater((low_y + (kHalf - 1)) >> kCornerBits, Ints{});
        Ints right = lesser(((high_x - kHalf) >> kCornerBits) + 1, Ints{} + frame.right);
        Ints bottom = lesser(((high_y - kHalf) >> kCornerBits) + 1, Ints{} + frame.height_px);
        Ints is_small = (high_x - low_x <= kSmall) & (high_y - low_y <= kSmall);
        Ints x1 = (at.x[1] - at.x[0]) & is_small, y1 = (at.y[1] - at.y[0]) & is_small;
        Ints x2 = (at.x[2] - at.x[0]) & is_small, y2 = (at.y[2] - at.y[0]) & is_small;  // so that products of none are too large
        area = chosen(is_small, x1 * y2 - x2 * y1, Ints{} + 1);
        is_one = is_small & (right - column == 1) & (bottom - row == 1);
        Ints shows = (column < right) & (row < bottom) & (area != 0) & (~is_one | has_middle(at));
        is_kept = (all == 0) & (is_cut | shows), is_one &= is_kept & ~is_cut;
    }

  private:
    // Whether its one pixel's middle is inside; what lies on an edge belongs to one of the two triangles beside it.
    Ints has_middle(const Corners& at) {
        Ints sign = chosen(area < 0, Ints{} - 1, Ints{} + 1), inside = ~Ints{};
        Ints x = (column << kCornerBits) + kCornerSteps / 2, y = (row << kCornerBits) + kCornerSteps / 2;
        for (int k = 0; k < 3; ++k) {
            int from = (k + 1) % 3, to = (k + 2) % 3;  // the edge that faces corner k
            Ints along = ((at.x[to] - at.x[from]) & is_one) * sign, across = ((at.y[to] - at.y[from]) & is_one) * sign;
            edges[k] = along * ((y - at.y[from]) & is_one) - across * ((x - at.x[from]) & is_one);
            inside &= (edges[k] > 0) | ((edges[k] == 0) & ((across < 0) | ((across == 0) & (along > 0))));
        }
        return inside;
    }
};

// Whether a triangle of one pixel is nearer than what is there, as PlantFill finds it.
inline bool is_nearer(const SiftFrame& frame, const PlacedVertices& placed, const uint16_t* corners, const Sifted& of,
                      uint32_t lane) {
    int second = of.area[lane] < 0 ? 2 : 1, third = 3 - second;
    auto area = float(of.area[lane] < 0 ? -of.area[lane] : of.area[lane]), of_area = 1 / area;
    float depth_m = 1 / (float(of.edges[0][lane]) * of_area * placed.nearness[corners[0]] +
                         float(of.edges[second][lane]) * of_area * placed.nearness[corners[second]] +
                         float(of.edges[third][lane]) * of_area * placed.nearness[corners[third]]);
    uint32_t bits;
    __builtin_memcpy(&bits, &depth_m, sizeof bits);
    return bits <= uint32_t(uint64_t(frame.keys[of.row[lane] * frame.stride + of.column[lane]]) >> 32);
}

inline uint32_t sift_lanes(const SiftFrame& frame, const PlacedVertices& placed, const uint16_t* indices, uint32_t count,
                           uint16_t* kept) {
    uint32_t kept_count = 0;
    for (uint32_t t = 0; t < count; t += kLanes) {
        const uint16_t* first = indices + 3 * t;
        uint32_t here = count - t < kLanes ? count - t : kLanes;
        Sifted of(frame, Corners(placed, first, here));
        for (uint32_t lane = 0; lane < here; ++lane) {
            if (of.is_kept[lane] == 0) continue;
            if (of.is_one[lane] != 0 && !is_nearer(frame, placed, first + 3 * lane, of, lane)) continue;
            kept[kept_count++] = uint16_t((t + lane) | (of.is_cut[lane] != 0 ? kIsCut : 0));
        }
    }
    return kept_count;
}

}  // namespace
}  // namespace overlook::wang_ldi
