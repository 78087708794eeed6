// Deciding which triangles of a terrain to draw: no OpenGL here.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "formats/terrain.h"
#include "runtime/view/camera.h"
#include "runtime/view/pixel_detail.h"

namespace overlook::terrain {

// Triangles over raster samples: indices are row * width + column, three a triangle, counter-clockwise seen from above.
// Crack-free: an edge belongs to two triangles, or lies on the raster's border, on the rim of a void or outside the view.
struct Cut {
    // A vertex on its way between the edge that it splits and its own height.
    struct Morph {
        uint32_t sample = 0;  // row * width + column
        float rise_m = 0;     // to add to the sample's height
    };

    // [3n]. Below the count of samples: that sample. From there on: index - sample count is the place in `morphs`.
    std::vector<uint32_t> indices;
    std::vector<Morph> morphs;
    std::vector<uint8_t> codes;  // [n] the error code of each triangle, if wants_codes
    bool wants_codes = false;
    uint64_t void_rim_triangle_count = 0;  // of them, those whose parent was split only because it covers a void
    uint64_t tested_count = 0;             // split vertices looked at
    uint64_t stopped_count = 0;            // triangles left coarser than asked, because their tiles are not there (TileRefiner)
    double predicted_error_px = 0;         // the greatest bound over the triangles drawn (0 for a cut in metres)

    uint64_t triangle_count() const { return indices.size() / 3; }

    struct Part {
        std::vector<uint32_t> indices;  // with kMorphBit: the place in this part's own morphs
        std::vector<Morph> morphs;
        std::vector<uint8_t> codes;
        uint64_t void_rim_triangle_count = 0, tested_count = 0, stopped_count = 0;
        double predicted_squared = 0;
    };
    std::vector<Part> parts;  // scratch, kept from frame to frame
    static constexpr uint32_t kMorphBit = 1u << 31;
};

// How far vertices morph (Refiner::cut_by_pixels) unless someone asks otherwise.
inline constexpr double kDefaultMorph = 0.5;

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
    //
    // With morph > 0 nothing pops: a vertex enters where it lies on the edge that it splits, and comes to its own height as its
    // bound grows from error_px / (1 + morph) to error_px. The surface is then the mean of the cuts at all tolerances between
    // these, and so keeps error_px as each of them does: with a(v) the share of those tolerances at which v is split, never above
    // that of the ends l, r of its edge, the mean's height is h(v) = (h(l) + h(r)) / 2 + a(v) * (z(v) - (z(l) + z(r)) / 2), z the
    // samples' own heights. It depends on the camera alone, not on the way there. Squares that the raster's edge squeezes cannot
    // morph (their vertex is not on the edge it splits): they and what they hang from are split to the last, which costs
    // triangles along the east and south rims of rasters whose sides are not 2^k * n + 1.
    void cut_by_pixels(const view::Camera& camera, double error_px, Cut& out, double morph = 0) const;
    // The same with two tolerances, one for what is near or not seen by another camera.
    void cut_by_pixels(const view::Camera& camera, const view::PixelDetail& detail, Cut& out) const;

    // Where a vertex of a cut is drawn, metres in the terrain's frame. index: one of the cut's.
    glm::dvec3 vertex_m(const Cut& cut, uint32_t index) const;

    const Terrain& terrain() const;
    // Heights of the terrain's lowest and highest valid sample, metres.
    double lowest_m() const;
    double highest_m() const;

  private:
    friend class SlicedCut;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// One cut_by_pixels without morphing, in slices, so that a dear cut may be made and drawn over many frames. The slices together
// hold the same triangles as the whole; which slice holds which does not depend on the thread count. The refiner must outlive it.
class SlicedCut {
  public:
    SlicedCut(const Refiner& refiner, const view::Camera& camera, double error_px);
    ~SlicedCut();
    SlicedCut(SlicedCut&&) noexcept;
    SlicedCut& operator=(SlicedCut&&) noexcept;

    // The next slice: triangles_wanted of them, or what is left.
    void next(uint64_t triangles_wanted, Cut& out);
    bool is_done() const;
    // Of the parts of the terrain in view, how many have been gone through, 0..1; of the last one perhaps not all is out.
    double share_done() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace overlook::terrain
