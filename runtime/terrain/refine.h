// Deciding which triangles of a terrain to draw: no OpenGL here.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "formats/terrain.h"
#include "runtime/view/camera.h"

namespace overlook::terrain {

// Triangles over raster samples: indices are row * width + column, three a triangle, counter-clockwise seen from above.
// Crack-free: an edge belongs to two triangles, or lies on the raster's border or on the rim of a void.
struct Cut {
    std::vector<uint32_t> indices;  // [3n]
    uint64_t triangle_count() const { return indices.size() / 3; }
    // Of them, those that stand only because a void lies in what they were split from.
    uint64_t void_rim_triangle_count = 0;
    uint64_t tested_count = 0;      // split vertices looked at
    double predicted_error_px = 0;  // the greatest bound over the triangles drawn (0 for a cut in metres)
};

// What refinement needs beside the terrain: lowest and highest height over the surroundings of every split vertex. Made once;
// the terrain must outlive it. Cost O(samples), about 2.7 bytes a sample.
class Refiner {
  public:
    explicit Refiner(const Terrain& terrain);
    ~Refiner();
    Refiner(Refiner&&) noexcept;

    // Every diamond whose stored error is above tolerance_m is split; the cut is within tolerance_m (at least finest_error_m) of every source
    // sample that it covers, at the same column and row.
    void cut_by_metres(double tolerance_m, Cut& out) const;

    // Nothing in the frame is displaced by more than error_px pixels; what lies outside the view is left out.
    // error_px > 0. `out` keeps its memory from frame to frame.
    void cut_by_pixels(const view::Camera& camera, double error_px, Cut& out) const;

    // z range of the whole terrain's valid samples, metres.
    double lowest_m() const;
    double highest_m() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace overlook::terrain
