// Which tiles of the plane are planted, and how densely: by height, by slope, by painted pictures. A function of a tile's place
// and nothing else, so that a world of any size is known without being kept; what was asked about is remembered for a while.
//
// Based on: J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth Images, 2000, sections 5.1 (height, gradient, a painted
// image) and 8 (fairing). Ours: corners of tiles at the planting's edge are bare, so that tiles planted in part end it.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "formats/image.h"
#include "formats/result.h"
#include "runtime/wang_ldi/ground.h"
#include "runtime/wang_ldi/place_cache.h"
#include "runtime/wang_ldi/pyramid.h"
#include "runtime/wang_ldi/tiling.h"

namespace overlook::wang_ldi {

// A grey picture spread over the ground's extent, its pixels' middles half a pixel inside; black 0, white 1, between pixels
// bilinear. Of colours their mean counts.
class PaintedMap {
  public:
    PaintedMap() = default;  // white everywhere
    PaintedMap(const ImageRgb8& picture, const Rect& extent);

    double at(const glm::dvec2& at_m) const;
    struct Range {
        uint8_t low = 255, high = 0;  // of 255; low > high: none

        void take(const Range& other) { low = std::min(low, other.low), high = std::max(high, other.high); }
    };
    // Contains every value of a rectangle. O(1).
    Range bound(const Rect& rect) const;

  private:
    glm::dvec2 pixel_of(const glm::dvec2& at_m) const;

    uint32_t width_ = 0, height_ = 0;
    std::vector<uint8_t> grey_;  // [height, width], north first
    Rect extent_;
    Pyramid<Range> pyramid_;
};

struct PlacementOptions {
    double lowest_m = -std::numeric_limits<double>::infinity();  // all of a tile's ground lies between
    double highest_m = std::numeric_limits<double>::infinity();
    double steepest = 1;  // no triangle under a tile is steeper, metres up for a metre along; more are not planted
    ImageRgb8 mask;       // planted where it is half white at least in a tile's middle; empty: everywhere
    ImageRgb8 density;    // how densely, 0..1 of white; empty: 1 everywhere
    uint32_t fairing_tiles =
        1;  // 0..8: over so many tiles the density falls to 0 at the edge of what is planted; 0: it ends abruptly
};

enum class Verdict : uint8_t { planted, no_ground, too_low, too_high, too_steep, unpainted };
constexpr uint32_t kVerdicts = 6;

// Tile (i, j) covers [i, i + 1] x [j, j + 1] times tile_m.
class Placement {
  public:
    // Exit::bad_command: "planting from 500 m up to 200 m: no height lies between". The ground must outlive this, and this what
    // is made of it.
    static Result<Placement> of(const Ground& ground, double tile_m, const PlacementOptions& options);

    const Ground& ground() const { return *ground_; }
    double tile_m() const { return tile_m_; }
    Rect rect_of(int64_t i, int64_t j, int64_t tiles = 1) const {  // of a square of tiles from (i, j) on
        return {glm::dvec2(i, j) * tile_m_, glm::dvec2(i + tiles, j + tiles) * tile_m_};
    }

    Verdict verdict(int64_t i, int64_t j) const;
    bool is_planted(int64_t i, int64_t j) const { return verdict(i, j) == Verdict::planted; }
    // Of a rectangle, without looking at its tiles: all are planted, none is, or it is not known.
    enum class Coverage : uint8_t { none, some, all };
    Coverage coverage(const Rect& rect) const { return coverage(rect, ground_->bound(rect)); }
    Coverage coverage(const Rect& rect, const GroundRange& bound) const;  // bound: Ground::bound of it

    // Whether a tile has a neighbour, at a side or a corner, that is not planted.
    bool is_at_edge(int64_t i, int64_t j) const;
    // 0..1, at the south-west corner of tile (i, j): 0 wherever a tile that meets there is not planted and the edge is faired.
    // What corners_of_density asks for.
    double corner_density(int64_t i, int64_t j) const;
    // Corner colours for RandomTiling; empty if the set has only one. Refers to this.
    CornerAt corners(const TileSet& set, uint64_t seed) const;

  private:
    Placement() = default;
    Verdict found_verdict(int64_t i, int64_t j) const;

    const Ground* ground_ = nullptr;
    double tile_m_ = 1;
    double lowest_m_ = 0, highest_m_ = 0, steepest_ = 0;
    PaintedMap mask_, density_;
    uint32_t fairing_tiles_ = 0;
    std::shared_ptr<PlaceCache> verdicts_ = std::make_shared<PlaceCache>();
};

}  // namespace overlook::wang_ldi
