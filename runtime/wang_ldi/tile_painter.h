// A tile painted back to front from one or several images that share its places.
//
// Based on: L. McMillan, Computing Visibility Without Depth, 1995; J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth
// Images, 2000, sections 5.2 and 5.4. Ours: images that give way to each other are drawn in one pass, place by place, so that the
// order holds between them too.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "runtime/wang_ldi/brush.h"
#include "runtime/wang_ldi/fade.h"
#include "runtime/wang_ldi/pixel_grid.h"

namespace overlook::wang_ldi {

// What a tile can be painted from: columns of something over the pixels of a grid.
class Columns {
  public:
    virtual ~Columns() = default;
    // That what is drawn from now on stands on this plane, given from the tile's south-west corner on.
    virtual void stand_on(const Plane& plane) = 0;
    virtual void draw(uint32_t column, uint32_t row) = 0;

    uint32_t side_px = 0;
    Thresholds by_rung, by_direction;  // which pixels are shown
};

// The columns of a layered depth image.
template <Hiding hiding>
class ImageColumns final : public Columns {
  public:
    // south_west_m: x and y of the tile's corner. All must outlive this.
    ImageColumns(const Eye& eye, const ImageSet& set, const Ldi& ldi, uint32_t level_index, float splat_scale,
                 const glm::dvec2& south_west_m, Brush<hiding>& brush)
        : eye_(eye), ldi_(ldi), brush_(brush), south_west_m_(south_west_m), low_m_(set.low_m) {
        const Level& level = set.levels[level_index];
        side_px = ldi.side_px;
        pixel_m_ = set.tile_m / level.side_px, step_m_ = level.height_step_m;
        splat_ = float(eye.focal_px * pixel_m_) * splat_scale * (ldi.splats.empty() ? level.splat_px : 1.0f / 16);
        up_ = eye.seen({0, 0, 1});
        palette_.reserve(ldi.palette.size());
        for (const auto& colour : ldi.palette)
            palette_.push_back(uint32_t(colour[0]) | uint32_t(colour[1]) << 8 | uint32_t(colour[2]) << 16 | 0xff000000u);
    }

    void stand_on(const Plane& plane) override {
        glm::dvec3 corner(south_west_m_, plane.height_m + low_m_);
        corner_ = eye_.seen(corner - eye_.position_m);
        east_ = eye_.seen({1, 0, plane.slope.x}), north_ = eye_.seen({0, 1, plane.slope.y});
        eye_height_m_ = eye_.position_m.z - plane.height_m - low_m_, slope_ = plane.slope;
    }

    void draw(uint32_t column, uint32_t row) override {
        size_t pixel = size_t(row) * ldi_.side_px + column;
        uint32_t first = ldi_.first[pixel], end = ldi_.first[pixel + 1];
        if (first == end) return;
        double x = (column + 0.5) * pixel_m_, y = (row + 0.5) * pixel_m_;
        glm::vec3 foot = corner_ + float(x) * east_ + float(y) * north_;
        double eye_step = (eye_height_m_ - slope_.x * x - slope_.y * y) / double(step_m_);
        uint32_t s = first;
        for (; s < end && double(ldi_.heights[s]) < eye_step; ++s) draw_sample(s, foot);
        for (uint32_t above = end; above > s; --above) draw_sample(above - 1, foot);
    }

  private:
    void draw_sample(uint32_t s, const glm::vec3& foot) {
        float wide = splat_ * (ldi_.splats.empty() ? 1.0f : float(ldi_.splats[s]));
        brush_.splat(foot + (float(ldi_.heights[s]) * step_m_) * up_, wide, palette_[ldi_.colours[s]]);
    }

    const Eye& eye_;
    const Ldi& ldi_;
    Brush<hiding>& brush_;
    glm::dvec2 south_west_m_;
    double low_m_ = 0, pixel_m_ = 0, eye_height_m_ = 0;
    float step_m_ = 0, splat_ = 0;
    glm::vec3 corner_{0}, east_{0}, north_{0}, up_{0};  // of the tile's frame, as Eye::seen
    glm::dvec2 slope_{0};
    std::vector<uint32_t> palette_;
};

// What decides at the places of a tile, and where the eye is.
struct TilePlaces {
    uint64_t fade_number = 0;
    uint32_t coarser_px = 1;  // as rung_threshold
    glm::dvec2 eye_share{0};  // of the tile's sides, from the south-west corner
};

// Paints a piece of a tile from all columns, each where its thresholds say so.
void paint_piece(const TilePlaces& places, const Piece& piece, std::span<Columns* const> all);

}  // namespace overlook::wang_ldi
