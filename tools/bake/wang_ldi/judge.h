// How an image, warped, differs from what rays say, over views of its cell.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/wang_ldi.h"
#include "runtime/view/camera.h"
#include "runtime/wang_ldi/warp.h"
#include "tools/bake/wang_ldi/shade.h"

namespace overlook::wang_ldi {

struct Judging {
    uint64_t seed = 1;
    uint32_t views = 4;
    uint32_t size_px = 128;  // of the pictures' sides, at the set's focal length, about a place in the tile's box
    float splat_scale = 1;   // of the warper
};

// Values of 0..1 counted in 256 steps.
class Shares {
  public:
    static constexpr uint32_t kSteps = 256;
    void add(double value);
    void add(const Shares& other);
    // The middle of the step that holds the value which a share `share` of all do not exceed; 0 of none.
    double percentile(double share) const;

    std::array<uint64_t, kSteps> counts{};
};

// Counts are over all views.
struct Judgement {
    // Pixels whose ray meets the tile first, away from the tile's outline (all eight around meet it too).
    uint64_t pixels = 0;
    uint64_t holes = 0;       // nothing is drawn
    uint64_t holes_left = 0;  // nor after small holes were filled (fill_holes)
    uint64_t deeper = 0;      // what is drawn is more than 2 % and two pixels of the level deeper
    uint64_t nearer = 0;      // or so much nearer
    // Pixels that show the tile: by rays, as drawn, and filled; not where something else hides it.
    uint64_t covered = 0, covered_drawn = 0, covered_filled = 0;
    // E: LDR-FLIP of what is drawn and filled, at view::kPixelsPerDegree, the tile alone before grey, where something else hides
    // it that too; of the pixels in which rays or the image show the tile.
    uint64_t error_pixels = 0;
    double error_sum = 0, unfilled_error_sum = 0;  // the latter: nothing filled
    Shares errors;

    void add(const Judgement& other);
    double mean_error() const { return error_pixels == 0 ? 0 : error_sum / double(error_pixels); }
    double mean_unfilled_error() const { return error_pixels == 0 ? 0 : unfilled_error_sum / double(error_pixels); }
    // Of what rays say, how much is covered; 0 if they say that nothing is.
    double covered_times() const { return covered == 0 ? 0 : double(covered_drawn) / double(covered); }
    double covered_times_filled() const { return covered == 0 ? 0 : double(covered_filled) / double(covered); }
    double p99_error() const { return errors.percentile(0.99); }
};

// What rays say of the tile: pixels as Warped, of all in its square; how far off something else hides it, infinity where nothing
// does. Lit, or the albedo where the set has normals.
struct Truth {
    Warped tile;
    std::vector<float> hidden_m;
};
Truth traced(const Models& models, const TraceStage& stage, const ImageSet& set, const view::Camera& camera, const Light& light,
             uint64_t seed);

// A view of the wedge of (level, direction): its eye anywhere in it, towards anything in the tile's box.
view::Camera view_of(const ImageSet& set, uint32_t level, uint32_t direction, const Judging& judging, uint32_t view);

// Of `all` views of the set's cell how many are of one image: as many of each level and direction, and those of tiles in turn,
// the first tile_count ones; none of images sampled alone.
uint32_t views_of(const ImageSet& set, const Which& which, uint32_t all, uint32_t tile_count);

Judgement judged(const Models& models, const TraceStage& stage, const ImageSet& set, const Which& which, const Ldi& ldi,
                 const Light& light, const Judging& judging);

}  // namespace overlook::wang_ldi
