// Deciding which triangles of a terrain to draw: no OpenGL here.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "formats/terrain.h"
#include "runtime/view/camera.h"

namespace overlook::terrain {

// Triangles over raster samples: indices are row * width + column, three a triangle, counter-clockwise seen from above.
// Crack-free: an edge belongs to two triangles, or lies on the raster's border, on the rim of a void or outside the view.
struct Cut {
    std::vector<uint32_t> indices;         // [3n]
    uint64_t void_rim_triangle_count = 0;  // of them, those whose parent was split only because it covers a void
    uint64_t tested_count = 0;             // split vertices looked at
    double predicted_error_px = 0;         // the greatest bound over the triangles drawn (0 for a cut in metres)

    uint64_t triangle_count() const { return indices.size() / 3; }

    struct Part {
        std::vector<uint32_t> indices;
        uint64_t void_rim_triangle_count = 0, tested_count = 0;
        double predicted_squared = 0;
    };
    std::vector<Part> parts;  // scratch, kept from frame to frame
};

// Refines one terrain, which must outlive it, for any number of cameras. Making it costs O(samples) and keeps about 2.7 bytes a
// sample: the heights round every split vertex. The cuts are the same for every thread count.
class Refiner {
  public:
    explicit Refiner(const Terrain& terrain);
    ~Refiner();
    Refiner(Refiner&&) noexcept;

    // Splits every diamond whose stored error is above tolerance_m: the cut is within tolerance_m (or finest_error_m, if that is
    // more) of every source sample that it covers, at the same column and row. Cost O(triangles).
    void cut_by_metres(double tolerance_m, Cut& out) const;

    // Splits every diamond in view whose error bound on the screen (view/pixel_error.h) over all that it can bring up is above
    // error_px > 0; what lies outside the view is left out. Cost O(triangles). Lindstrom and Pascucci 2001, with boxes for their
    // spheres: interval arithmetic on nested boxes is monotone in floating point as well, so no rounding can open a crack.
    void cut_by_pixels(const view::Camera& camera, double error_px, Cut& out) const;

    // Heights of the terrain's lowest and highest valid sample, metres.
    double lowest_m() const;
    double highest_m() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace overlook::terrain
