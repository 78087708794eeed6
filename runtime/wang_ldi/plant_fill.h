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

namespace overlook::wang_ldi {

using Four = float __attribute__((vector_size(16)));

constexpr int kCornerBits = 8, kCornerSteps = 1 << kCornerBits;  // of a pixel: where corners lie
constexpr float kFarthest_px = 16000;                            // from the picture's middle, as corners may lie

// From -most to most; -most of what is no number.
inline float held(float v, float most) {
    return std::min(std::max(-most, v), most);
}

// On the picture.
struct Corner {
    int32_t x = 0, y = 0;  // steps from the left and the top
    float nearness = 0;    // of its depth in metres
    float u = 0, v = 0;    // on its skin
    Four colour{};         // linear light, and opacity, that the skin is multiplied by
};

// Its corners clockwise on the picture.
struct Filled {
    std::array<Corner, 3> corners;
    int64_t area = 0;  // twice its own, in steps; > 0
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

    // lights(triangle): called before the first of its pixels is coloured, to give its corners their colours.
    template <class Lights>
    void draw(const Skin& skin, Filled& triangle, const PixelBox& box, const Lights& lights);

  private:
    bool lets_through(int x, int y) const;
    static const Skin::Level& skin_level(const Skin& skin, const Filled& triangle);
    static Four texel(const Skin::Level& level, float u, float v);
    static uint32_t encoded(const Four& linear);

    Canvas* canvas_ = nullptr;
    int left_ = 0, right_ = 0;
    Door door_;
    bool is_open_ = true;
};

// An edge function: at a pixel's middle at least 0 inside. Whole is exact, in steps times pixels; part is what it lacks, in steps
// times steps.
struct Edge {
    int64_t whole = 0, right = 0, down = 0;
    float part = 0;

    // From a to b, at pixel (x, y); what lies on it belongs to one of the two triangles beside it.
    static Edge of(const Corner& a, const Corner& b, int x, int y) {
        int64_t along = b.x - a.x, across = b.y - a.y;
        int64_t px = int64_t(x) * kCornerSteps + kCornerSteps / 2 - a.x, py = int64_t(y) * kCornerSteps + kCornerSteps / 2 - a.y;
        bool has_middle = across < 0 || (across == 0 && along > 0);
        int64_t exact = along * py - across * px, whole = (exact - !has_middle) >> kCornerBits;
        return {whole, -across, along, float(exact - whole * kCornerSteps)};
    }
    // Of [from, to) pixels right of its own, those that are inside.
    void narrow(int& from, int& to) const {
        if (right == 0) {
            if (whole < 0) to = from;
        } else if (right > 0) {
            if (whole < 0) from = int(std::max<int64_t>(from, (-whole + right - 1) / right));
        } else {
            to = whole < 0 ? from : int(std::min<int64_t>(to, whole / -right + 1));
        }
    }
};

template <class Lights>
void PlantFill::draw(const Skin& skin, Filled& triangle, const PixelBox& box, const Lights& lights) {
    constexpr int kNarrow_px = 6;  // fewer are tried one by one
    auto& [a, b, c] = triangle.corners;
    Edge edges[3] = {Edge::of(b, c, box.left, box.top), Edge::of(c, a, box.left, box.top), Edge::of(a, b, box.left, box.top)};
    float of_area = 1 / float(triangle.area);
    const Skin::Level* level = nullptr;
    for (int y = box.top; y < box.bottom; ++y) {
        int from = 0, to = box.right - box.left;
        if (to > kNarrow_px)
            for (const Edge& edge : edges) edge.narrow(from, to);
        int64_t e0 = edges[0].whole + from * edges[0].right, e1 = edges[1].whole + from * edges[1].right,
                e2 = edges[2].whole + from * edges[2].right;
        int64_t* row = canvas_->row(uint32_t(y)) + box.left;
        for (int x = from; x < to; ++x, e0 += edges[0].right, e1 += edges[1].right, e2 += edges[2].right) {
            if ((e0 | e1 | e2) < 0) continue;
            float w0 = (float(e0) * kCornerSteps + edges[0].part) * of_area * a.nearness;
            float w1 = (float(e1) * kCornerSteps + edges[1].part) * of_area * b.nearness;
            float w2 = (float(e2) * kCornerSteps + edges[2].part) * of_area * c.nearness;
            float depth_m = 1 / (w0 + w1 + w2);
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
