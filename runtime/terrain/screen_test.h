// Is a split vertex in view, and is the error of leaving it unsplit too large on the screen?
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "formats/terrain_diamond.h"
#include "runtime/terrain/height_bounds.h"
#include "runtime/terrain/refine.h"
#include "runtime/view/camera.h"

namespace overlook::terrain {

enum class Verdict { leave_out, keep, split };

// What a test says of a split vertex. `share`: how far it has come to its own height, 1 but for one that is morphing.
struct Answer {
    Verdict verdict = Verdict::leave_out;
    double share = 1;
};

struct Interval {
    double low, high;
};

// An axis-aligned box relative to the eye, metres.
struct Box {
    Interval x, y, z;
};

// One camera and one tolerance against one terrain. The box of a split vertex reaches 3s round the middle of a square and 2s
// round that of an edge (s = 2^level cells): so it holds its own diamond and the boxes of all that it splits into, and every
// figure taken from it by interval arithmetic can only get milder on the way down. Bounds: HeightBounds, or TileBounds, of which
// the terrain needs no heights.
template <class Bounds>
class BasicScreenTest {
  public:
    static constexpr uint8_t kAllPlanes = 31;  // left, right, bottom, top, near

    BasicScreenTest(const Terrain& terrain, const Bounds& bounds, const view::Camera& camera,
                    const view::PixelDetail& detail);

    // `planes`: those that cut the parent's box; what lies inside one is not tested against it again. Raises predicted_squared
    // (px^2) to the bound of what is kept.
    Answer operator()(GridPoint v, uint32_t level, bool is_square, uint8_t code, uint8_t& planes,
                      double& predicted_squared) const {
        Box box;
        if (!box_of(v, level, is_square, box)) return {Verdict::leave_out};
        if (planes != 0 && !is_in_view(box, planes)) return {Verdict::leave_out};
        bool must_split = code == kMustSplit || (morphs_ && is_squeezed(v, level, is_square));
        if (!must_split && code == 0 && finest_error_is_zero_) return {Verdict::keep};
        double share = 1;
        if (!must_split) {
            PixelBound bound = bound_of(box, error_m_[code]);
            // A box holds those of what it splits into: none of them is near or unseen where it is not.
            const Limits& limits = is_near_enough(box, bound) ? near_ : far_;
            if (bound.is_within(limits.full_squared)) {
                keep_greatest(predicted_squared, bound);
                if (bound.is_within(limits.enter_squared)) return {Verdict::keep};
                share = (std::sqrt(bound.numerator / bound.denominator) - limits.enter_px) / (limits.full_px - limits.enter_px);
            }
        }
        // What an edge of level 0 splits into is the finest there is, whatever was asked.
        if (level == 0 && !is_square && !finest_error_is_zero_) keep_greatest(predicted_squared, bound_of(box, error_m_[0]));
        return {Verdict::split, std::clamp(share, 0.0, 1.0)};
    }

    // The bound of leaving it unsplit, px^2.
    double bound_squared(GridPoint v, uint32_t level, bool is_square, uint8_t code) const {
        Box box;
        if (!box_of(v, level, is_square, box)) return 0;
        double squared = 0;
        keep_greatest(squared, bound_of(box, error_m_[code]));
        return squared;
    }

  private:
    bool box_of(GridPoint v, uint32_t level, bool is_square, Box& box) const {
        uint32_t s = 1u << level, reach = is_square ? 3 * s : 2 * s;
        HeightRange range;
        if (is_square) {
            range = bounds_.of_square(v.x, v.y, level);
        } else {
            bool is_horizontal = (v.x >> level) & 1;  // two squares share the edge; the border of the grid has one twice
            GridPoint before =
                is_horizontal ? GridPoint{v.x, v.y >= s ? v.y - s : v.y + s} : GridPoint{v.x >= s ? v.x - s : v.x + s, v.y};
            GridPoint after = is_horizontal ? GridPoint{v.x, v.y + s} : GridPoint{v.x + s, v.y};
            HeightRange a = bounds_.of_square(before.x, before.y, level), b = bounds_.of_square(after.x, after.y, level);
            range = {std::max(a.low_m, b.low_m), std::min(a.high_m, b.high_m)};
        }
        if (range.is_empty()) return false;
        auto inside = [](uint32_t at, uint32_t last) { return at < last ? at : last; };
        box.x = {column_x_[v.x >= reach ? inside(v.x - reach, last_column_) : 0], column_x_[inside(v.x + reach, last_column_)]};
        box.y = {row_y_[inside(v.y + reach, last_row_)], row_y_[v.y >= reach ? inside(v.y - reach, last_row_) : 0]};
        box.z = {double(range.low_m) - eye_z_, double(range.high_m) - eye_z_};
        return true;
    }

    // A direction with, for each axis, which end of an interval lies further along it.
    struct Direction {
        double x = 0, y = 0, z = 0;
        double greatest(const Box& b) const {
            return (x > 0 ? b.x.high : b.x.low) * x + (y > 0 ? b.y.high : b.y.low) * y + (z > 0 ? b.z.high : b.z.low) * z;
        }
        double least(const Box& b) const {
            return (x > 0 ? b.x.low : b.x.high) * x + (y > 0 ? b.y.low : b.y.high) * y + (z > 0 ? b.z.low : b.z.high) * z;
        }
    };

    bool is_in_view(const Box& box, uint8_t& planes) const {
        for (uint32_t i = 0; i < 5; ++i) {
            if (!(planes & (1u << i))) continue;
            if (planes_[i].greatest(box) < plane_offsets_[i]) return false;
            if (planes_[i].least(box) >= plane_offsets_[i]) planes = uint8_t(planes & ~(1u << i));
        }
        return true;
    }

    bool is_wholly_seen(const Box& box) const {
        for (uint32_t i = 0; i < side_count_; ++i)
            if (sides_[i].least(box) < side_offsets_[i]) return false;
        return true;
    }

    // view::error_px_bound_vertical over the box's part in the frame, squared, as a fraction so as to need neither root nor
    // division.
    struct PixelBound {
        double numerator, denominator;
        double depth_m;  // the least
        bool is_within(double limit_squared) const { return numerator <= limit_squared * denominator; }
    };
    PixelBound bound_of(const Box& box, double error_m) const {
        double depth = std::max(forward_.least(box), near_m_);
        auto outside = [](Interval i) { return std::max(std::max(i.low, -i.high), 0.0); };
        double dx = outside(box.x), dy = outside(box.y), dz = outside(box.z), distance_squared = dx * dx + dy * dy + dz * dz;
        if (distance_squared > depth * depth * corner_squared_)
            depth = std::max(depth, std::sqrt(distance_squared) * corner_cosine_);
        double depth_after = depth - error_m * axis_rise_;
        if (depth_after <= 0) return {kNoLimit, 0, depth};

        auto widest = [&](const Direction& d) { return std::max(d.greatest(box), -d.least(box)); };
        auto furthest = [](Interval i) { return std::max(i.high, -i.low); };
        double side_x = widest(right_), side_y = widest(up_), far_x = furthest(box.x), far_y = furthest(box.y);
        double depth_squared = depth * depth;
        double lever_squared = std::min(
            {corner_squared_ * depth_squared, depth_squared + side_x * side_x + side_y * side_y, far_x * far_x + far_y * far_y});
        return {focal_squared_ * error_m * error_m * lever_squared, depth_squared * depth_after * depth_after, depth};
    }
    // Asked last what costs most, and only where it changes anything.
    bool is_near_enough(const Box& box, const PixelBound& bound) const {
        if (bound.depth_m < near_depth_m_ || !is_wholly_seen(box)) return true;
        if (finer_in_.is_empty() || bound.is_within(near_.enter_squared)) return false;
        auto extent = [&](const Direction& d) { return view::Range{d.least(box), d.greatest(box)}; };
        return finer_in_.is_touched(extent(right_), extent(up_), extent(forward_));
    }

    static void keep_greatest(double& predicted_squared, const PixelBound& bound) {
        if (bound.numerator > predicted_squared * bound.denominator) predicted_squared = bound.numerator / bound.denominator;
    }

    // Does the raster's edge cut through a square that this vertex brings up, at any depth?
    bool is_squeezed(GridPoint v, uint32_t level, bool is_square) const {
        uint32_t s = 1u << level, reach = is_square ? 3 * s : 2 * s;
        auto cuts = [&](uint32_t at, uint32_t last) { return last % (2 * s) != 0 && at < last + reach && last < at + reach; };
        return cuts(v.x, last_column_) || cuts(v.y, last_row_);
    }

    static constexpr double kNoLimit = std::numeric_limits<double>::infinity();

    const Bounds& bounds_;
    std::vector<double> column_x_, row_y_;  // of every raster column and row, relative to the eye
    uint32_t last_column_, last_row_;
    double eye_z_;
    Direction planes_[5];
    double plane_offsets_[5] = {};
    uint32_t side_count_ = 0;  // of what another camera sees
    Direction sides_[4];
    double side_offsets_[4] = {};
    Direction right_, up_, forward_;
    double near_m_, axis_rise_, corner_squared_, corner_cosine_, focal_squared_;
    // A vertex enters above the first and is at its own height from the second.
    struct Limits {
        double enter_px, full_px, enter_squared, full_squared;
        Limits(double error_px, double morph)
            : enter_px(error_px / (1 + morph)),
              full_px(error_px),
              enter_squared(enter_px * enter_px),
              full_squared(full_px * full_px) {}
    };
    Limits far_, near_;
    double near_depth_m_;
    view::MaskOnScreen finer_in_;
    bool morphs_;
    double error_m_[256];
    bool finest_error_is_zero_;
};

using ScreenTest = BasicScreenTest<HeightBounds>;

}  // namespace overlook::terrain
