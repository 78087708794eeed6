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

// As of Warped.
inline std::vector<uint32_t> packed_palette(const Ldi& ldi) {
    std::vector<uint32_t> packed;
    packed.reserve(ldi.palette.size());
    for (const auto& colour : ldi.palette)
        packed.push_back(uint32_t(colour[0]) | uint32_t(colour[1]) << 8 | uint32_t(colour[2]) << 16 | 0xff000000u);
    return packed;
}

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

// How wide samples are drawn.
struct SplatRule {
    float scale = 1;               // times the splats of the image
    bool widens_on_slopes = true;  // by as much as they stand farther apart there
};

// How the samples of an image, level by level, come to where a camera sees them: a sample of a column at (x, y) of the tile at
// corner + y north + x east + height up, single numbers that all ways of warping round alike.
struct ImageFrame {
    // south_west_m: x and y of the tile's corner.
    ImageFrame(const Eye& eye, const ImageSet& set, const Level& level, bool has_splats, const SplatRule& rule,
               const glm::dvec2& south_west_m_)
        : south_west_m(south_west_m_),
          widens_splats(rule.widens_on_slopes),
          low_m(set.low_m),
          pixel_m(float(set.tile_m / level.side_px)),
          step_m(level.height_step_m) {
        flat_splat = float(eye.focal_px * (set.tile_m / level.side_px)) * rule.scale * (has_splats ? 1.0f / 16 : level.splat_px);
        up = eye.seen({0, 0, 1});
    }
    // On a slope samples stand farther apart, and splats are as much wider.
    void stand_on(const Eye& eye, const Plane& plane) {
        corner = eye.seen(glm::dvec3(south_west_m, plane.height_m + low_m) - eye.position_m);
        east = eye.seen({1, 0, plane.slope.x}), north = eye.seen({0, 1, plane.slope.y});
        splat = widens_splats ? flat_splat * float(std::sqrt(1 + glm::dot(plane.slope, plane.slope))) : flat_splat;
        eye_height_m = eye.position_m.z - plane.height_m - low_m, slope = plane.slope;
    }
    float middle_m(uint32_t pixel) const { return (float(pixel) + 0.5f) * pixel_m; }
    // Of the eye above a column's foot, in steps.
    double eye_steps(uint32_t column, uint32_t row) const {
        return (eye_height_m - slope.x * double(middle_m(column)) - slope.y * double(middle_m(row))) / double(step_m);
    }

    glm::dvec2 south_west_m, slope{0};
    bool widens_splats;
    double low_m, eye_height_m = 0;
    float pixel_m, step_m, flat_splat = 0, splat = 0;
    glm::vec3 corner{0}, east{0}, north{0}, up{0};  // as Eye::seen
};

// The columns of a layered depth image.
template <class Brush>
class ImageColumns final : public Columns {
  public:
    // All must outlive this.
    ImageColumns(const Eye& eye, const ImageSet& set, const Ldi& ldi, uint32_t level, const SplatRule& rule,
                 const glm::dvec2& south_west_m, Brush& brush)
        : eye_(eye),
          ldi_(ldi),
          brush_(brush),
          frame_(eye, set, set.levels[level], !ldi.splats.empty(), rule, south_west_m),
          palette_(packed_palette(ldi)) {
        side_px = ldi.side_px;
    }

    void stand_on(const Plane& plane) override { frame_.stand_on(eye_, plane); }

    void draw(uint32_t column, uint32_t row) override {
        size_t pixel = size_t(row) * ldi_.side_px + column;
        uint32_t first = ldi_.first[pixel], end = ldi_.first[pixel + 1];
        if (first == end) return;
        glm::vec3 foot = (frame_.corner + frame_.middle_m(row) * frame_.north) + frame_.middle_m(column) * frame_.east;
        double eye_steps = frame_.eye_steps(column, row);
        uint32_t s = first;
        for (; s < end && double(ldi_.heights[s]) < eye_steps; ++s) draw_sample(s, foot);
        for (uint32_t above = end; above > s; --above) draw_sample(above - 1, foot);
    }

  private:
    void draw_sample(uint32_t s, const glm::vec3& foot) {
        float wide = ldi_.splats.empty() ? frame_.splat : frame_.splat * float(ldi_.splats[s]);
        brush_.splat(foot + (float(ldi_.heights[s]) * frame_.step_m) * frame_.up, wide, palette_[ldi_.colours[s]]);
    }

    const Eye& eye_;
    const Ldi& ldi_;
    Brush& brush_;
    ImageFrame frame_;
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
