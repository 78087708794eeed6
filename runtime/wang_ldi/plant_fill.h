// Fills triangles on a canvas, pixel by pixel, by depth.
//
// Based on: J. Pineda, A Parallel Algorithm for Polygon Rasterization, 1988.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "runtime/wang_ldi/canvas.h"
#include "runtime/wang_ldi/plant_shapes.h"
#include "runtime/wang_ldi/plant_sift.h"

namespace overlook::wang_ldi {

using Four = float __attribute__((vector_size(16)));

// From -most to most; -most of what is no number.
inline float held(float v, float most) {
    return std::min(std::max(-most, v), most);
}

// On the picture.
struct Corner {
    int32_t x, y;    // steps from the left and the top
    float nearness;  // of its depth in metres
    float u, v;      // on its skin
    Four colour;     // linear light, and opacity, that the skin is multiplied by
};

// Its corners clockwise on the picture.
struct Filled {
    std::array<Corner, 3> corners;
    int64_t area;  // twice its own, in steps; > 0
};
// Steps along x times steps along y.
inline int64_t area_of(const Corner& a, const Corner& b, const Corner& c) {
    return int64_t(b.x - a.x) * (c.y - a.y) - int64_t(c.x - a.x) * (b.y - a.y);
}

// Where a triangle is: pixels whose middles may be in it, from the first to before the last.
struct PixelBox {
    int left = 0, top = 0, right = 0, bottom = 0;
    bool is_empty() const { return left >= right || top >= bottom; }
};

// A screen door's pixels (Bayer 1973), as discrete's shaders have it, from one share up to another; of [0, 1) all.
struct Door {
    float from = 0, to = 1;

    bool is_open() const { return from <= 0 && to >= 1; }
};

class PlantFill {
  public:
    // Of the canvas columns [left, right), those pixels that the door lets through.
    void begin(Canvas& canvas, int left, int right, const Door& door) {
        canvas_ = &canvas, left_ = left, right_ = right, door_ = door, is_open_ = door.is_open();
    }

    PixelBox columns() const { return {left_, 0, right_, int(canvas_->height_px())}; }
    PixelBox box_of(int32_t x0, int32_t y0, int32_t x1, int32_t y1, int32_t x2, int32_t y2) const {
        constexpr int kHalf = kCornerSteps / 2;
        auto first = [](int32_t low) { return (low + kHalf - 1) >> kCornerBits; };
        auto last = [](int32_t high) { return ((high - kHalf) >> kCornerBits) + 1; };
        return {std::max(left_, first(std::min({x0, x1, x2}))), std::max(0, first(std::min({y0, y1, y2}))),
                std::min(right_, last(std::max({x0, x1, x2}))),
                std::min(int(canvas_->height_px()), last(std::max({y0, y1, y2})))};
    }

    // Whether something nearer than depth_m may be missing from a pixel of the box.
    bool is_open(const PixelBox& box, float depth_m) const {
        int64_t nearest = pixel_key(depth_m, 0);
        for (int y = box.top; y < box.bottom; ++y) {
            const int64_t* row = canvas_->row(uint32_t(y));
            for (int x = box.left; x < box.right; ++x)
                if (row[x] >= nearest) return true;
        }
        return false;
    }

    // lights(triangle): called before the first of its pixels is coloured, to give its corners their colours and their places on
    // the skin; until then neither is read.
    template <class Lights>
    void draw(const Skin& skin, Filled& triangle, const PixelBox& box, const Lights& lights);

  private:
    template <class Edge, class Lights>
    void fill(const Skin& skin, Filled& triangle, const PixelBox& box, const Lights& lights);
    bool lets_through(int x, int y) const;
    static const Skin::Level& skin_level(const Skin& skin, const Filled& triangle);
    static Four texel(const Skin::Level& level, float u, float v);
    static uint32_t encoded(const Four& linear);

    Canvas* canvas_ = nullptr;
    int left_ = 0, right_ = 0;
    Door door_;
    bool is_open_ = true;
};

// An edge function: at a pixel's middle at least 0 inside. Steps: times pixels whole, of 64 bits, and what that lacks; or times
// steps, of 32 bits, for triangles of few pixels, which lacks nothing.
struct WideEdge {
    int64_t whole = 0, right = 0, down = 0;
    float part = 0;

    // From a to b, at pixel (x, y); what lies on it belongs to one of the two triangles beside it.
    static WideEdge of(const Corner& a, const Corner& b, int x, int y) {
        int64_t along = b.x - a.x, across = b.y - a.y;
        int64_t px = int64_t(x) * kCornerSteps + kCornerSteps / 2 - a.x, py = int64_t(y) * kCornerSteps + kCornerSteps / 2 - a.y;
        bool has_middle = across < 0 || (across == 0 && along > 0);
        int64_t exact = along * py - across * px, whole = (exact - !has_middle) >> kCornerBits;
        return {whole, -across, along, float(exact - whole * kCornerSteps)};
    }
    float exact(int64_t at) const { return float(at) * kCornerSteps + part; }
};
struct NarrowEdge {
    int32_t whole = 0, right = 0, down = 0, lacks = 0;
    static constexpr int kMost_px = 64;  // sides of the triangle's box

    static NarrowEdge of(const Corner& a, const Corner& b, int x, int y) {
        int32_t along = b.x - a.x, across = b.y - a.y;
        int32_t px = x * kCornerSteps + kCornerSteps / 2 - a.x, py = y * kCornerSteps + kCornerSteps / 2 - a.y;
        bool has_middle = across < 0 || (across == 0 && along > 0);
        return {along * py - across * px - !has_middle, -across * kCornerSteps, along * kCornerSteps, !has_middle};
    }
    float exact(int32_t at) const { return float(at + lacks); }
};

// Of [from, to) pixels right of its own, those that are inside.
template <class Edge>
void narrow(const Edge& edge, int& from, int& to) {
    if (edge.right == 0) {
        if (edge.whole < 0) to = from;
    } else if (edge.right > 0) {
        if (edge.whole < 0) from = int(std::max<int64_t>(from, (-int64_t(edge.whole) + edge.right - 1) / edge.right));
    } else {
        to = edge.whole < 0 ? from : int(std::min<int64_t>(to, int64_t(edge.whole) / -int64_t(edge.right) + 1));
    }
}

template <class Lights>
void PlantFill::draw(const Skin& skin, Filled& triangle, const PixelBox& box, const Lights& lights) {
    constexpr int32_t kMost = NarrowEdge::kMost_px * kCornerSteps;
    const auto& [a, b, c] = triangle.corners;
    auto [low_x, high_x] = std::minmax({a.x, b.x, c.x});
    auto [low_y, high_y] = std::minmax({a.y, b.y, c.y});
    if (high_x - low_x <= kMost && high_y - low_y <= kMost)
        fill<NarrowEdge>(skin, triangle, box, lights);
    else
        fill<WideEdge>(skin, triangle, box, lights);
}

template <class Edge, class Lights>
void PlantFill::fill(const Skin& skin, Filled& triangle, const PixelBox& box, const Lights& lights) {
    constexpr int kNarrow_px = 6;  // fewer are tried one by one
    auto& [a, b, c] = triangle.corners;
    Edge edges[3] = {Edge::of(b, c, box.left, box.top), Edge::of(c, a, box.left, box.top), Edge::of(a, b, box.left, box.top)};
    float of_area = 1 / float(triangle.area);
    const Skin::Level* level = nullptr;
    for (int y = box.top; y < box.bottom; ++y) {
        int from = 0, to = box.right - box.left;
        if (to > kNarrow_px)
            for (const Edge& edge : edges) narrow(edge, from, to);
        auto e0 = edges[0].whole + from * edges[0].right, e1 = edges[1].whole + from * edges[1].right,
             e2 = edges[2].whole + from * edges[2].right;
        int64_t* row = canvas_->row(uint32_t(y)) + box.left;
        for (int x = from; x < to; ++x, e0 += edges[0].right, e1 += edges[1].right, e2 += edges[2].right) {
            if ((e0 | e1 | e2) < 0) continue;
            float w0 = edges[0].exact(e0) * of_area * a.nearness, w1 = edges[1].exact(e1) * of_area * b.nearness;
            float w2 = edges[2].exact(e2) * of_area * c.nearness, depth_m = 1 / (w0 + w1 + w2);
            if (std::bit_cast<uint32_t>(depth_m) > uint32_t(uint64_t(row[x]) >> 32)) continue;
            if (!is_open_ && !lets_through(box.left + x, y)) continue;
            if (level == nullptr) lights(triangle), level = &skin_level(skin, triangle);
            w0 *= depth_m, w1 *= depth_m, w2 *= depth_m;
            Four own = w0 * a.colour + w1 * b.colour + w2 * c.colour;
            own *= texel(*level, w0 * a.u + w1 * b.u + w2 * c.u, w0 * a.v + w1 * b.v + w2 * c.v);
            if (!(own[3] >= skin.alpha_cutoff)) continue;
            row[x] = std::min(row[x], pixel_key(depth_m, encoded(own)));
        }
        for (Edge& edge : edges) edge.whole += edge.down;
    }
}

}  // namespace overlook::wang_ldi
