// Flat ground covered with tiles row by row, and pictures of it by the exact warper: sections 2 and 5.2 of the paper.
#pragma once

#include <map>

#include "formats/wang_scene.h"
#include "runtime/wang_ldi/tiling.h"
#include "runtime/wang_ldi/warp.h"
#include "tools/measure/paper/wang_ldi/subject.h"

namespace overlook::measure::paper::wang {

constexpr double kRadius_tiles = 40;  // nothing is drawn beyond, as in the paper

// What was drawn for a picture.
struct WoodCounts {
    uint64_t kept = 0;                            // of the samples, those that are warped
    uint64_t tiles = 0, samples = 0, pixels = 0;  // of the picture, that show a plant
    double warp_ms = 0;                           // one thread; images at hand
};

class Wood {
  public:
    // As many tiles as a picture from the middle needs. bake must outlive it. Fails as tile_row_by_row.
    static Result<Wood> make(const Bake& bake, uint64_t seed);

    // The scene's own ground, all of which is drawn however far. Both must outlive it.
    Wood(const Bake& bake, const wang_ldi::Scene& scene);

    // In the middle of the ground, an eye of the cell's mean height; pixels as asked.
    view::Camera camera(uint32_t width_px, uint32_t height_px) const;

    // From the next picture on: of images with normals, samples that face away from the eye are left out.
    void skip_what_faces_away(bool skips) { skips_ = skips; }

    // Tiles within kRadius_tiles (of a scene: all) and in sight, back to front, each at its level and direction. Images that are
    // read stay in memory. Fails as ImageReader::read.
    Result<WoodCounts> draw(const view::Camera& camera, wang_ldi::Warped& picture,
                            wang_ldi::Hiding hiding = wang_ldi::Hiding::by_order);

    // The level and direction of every tile within `tiles` of the camera's, level by brightness, direction by hue (figure 7).
    ImageRgb8 rings(const view::Camera& camera, uint32_t tiles, uint32_t tile_px) const;

    const wang_ldi::ImageSet& set() const { return bake_->set(); }

  private:
    explicit Wood(const Bake& bake) : bake_(&bake), radius_m_(kRadius_tiles * bake.set().tile_m) {}
    glm::dvec2 middle_m(uint32_t column, uint32_t row) const { return (glm::dvec2(column, row) + 0.5) * set().tile_m; }

    const Bake* bake_;
    bool skips_ = false;
    double radius_m_;
    wang_ldi::Tiling tiling_;
    std::map<uint64_t, wang_ldi::Ldi> images_;
};

// Bare ground and sky behind what is drawn.
ImageRgb8 with_ground(const view::Camera& camera, const wang_ldi::Warped& picture);

}  // namespace overlook::measure::paper::wang
