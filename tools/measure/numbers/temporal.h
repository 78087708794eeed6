// W and the pop index: what changes from frame to frame that should not.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tools/measure/numbers/picture.h"

namespace overlook::measure {

constexpr uint32_t kTilePx = 32;

// phi: where each pixel of a frame was in the frame before. Computed once per frame pair, used for every method and the floor.
struct Motion {
    uint32_t width = 0, height = 0;
    std::vector<float> x_px, y_px;  // [height, width], 0 = middle of the first pixel; NaN where not in V
    size_t valid_count = 0;         // pixels in V
};

// Both are frames of the *reference*, same size, of a world that stands still. V: pixels whose surface point lies before the
// earlier camera, lands between the middles of its outermost pixels, and is there within 1 % of the depth drawn: at the nearest
// pixel, or between the four around it (1/depth is linear over a plane, so a slanting one agrees with itself). Background is
// infinitely far: it turns with the camera, does not shift, and agrees with background only.
Motion motion_between(const Frame& reference_before, const Frame& reference_now);

struct TemporalError {
    uint32_t frame = 0;              // number of the later frame; for the caller to set
    double mean = 0;                 // W, luma 0..1; 0 where V is empty
    uint32_t columns = 0, rows = 0;  // of tiles
    std::vector<float> tiles;        // [rows, columns], W of each tile
};

// W of a method (or of the floor): mean over V of |r_I - r_R|, r(p) = L_now(p) - L_before(phi(p)), bilinear. All four pictures
// and the motion have one size. Tiles are kTilePx square, cut off at the right and below; a tile of which less than an eighth is
// in V is divided by that eighth, so that two pixels of a silhouette do not stand for a thousand.
TemporalError temporal_error(const Motion& motion, const RgbView& test_before, const RgbView& test_now,
                             const RgbView& reference_before, const RgbView& reference_now);

struct PopIndex {
    double index = 1;                            // 1 = never less steady than the floor
    uint32_t frame = 0;                          // TemporalError::frame of the greatest excess; the first where equal
    uint32_t tile_column = 0, tile_row = 0;      // and its tile
    double excess = 0;                           // W - W_floor there, luma, not under 0
    double floor_median = 0, method_median = 0;  // of W over the frames; the method's stands beside the index
};

// 1 + max over frames and tiles of max(0, W - W_floor) / (median of the floor's W + 1e-3). Both sequences have the same frames in
// the same order, and the same tiles (asserted). Of an empty sequence: index 1.
PopIndex pop_index(std::span<const TemporalError> method, std::span<const TemporalError> floor);

}  // namespace overlook::measure
