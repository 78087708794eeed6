#include "tools/measure/numbers/temporal.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "formats/parallel.h"

namespace overlook::measure {
namespace {

constexpr uint32_t kRowsAtOnce = 16;
constexpr double kDepthsAgree = 0.01;
constexpr double kOnBorderPx = 1e-3;          // rounding of a camera that stands still
constexpr double kFullShareOfTile = 1 / 8.0;  // of a tile's pixels in V, from which on the mean is over V alone

// Carries pixel middles of one camera into another: before = depth * (corner + x * step_right + y * step_down) + shift, in the
// earlier camera's own axes (right, up, forward).
struct Carry {
    glm::dvec3 corner, step_right, step_down, shift;
    double focal_px = 1;
};

Carry carry_between(const view::Camera& before, const view::Camera& now) {
    view::Axes from = view::axes_of(now), to = view::axes_of(before);
    auto into = [&](const glm::dvec3& v) {
        return glm::dvec3(glm::dot(to.right, v), glm::dot(to.up, v), glm::dot(to.forward, v));
    };
    double focal = view::focal_px(now);
    Carry carry;
    carry.step_right = into(from.right) / focal;
    carry.step_down = into(from.up) / -focal;
    carry.corner =
        into(from.forward) - carry.step_right * ((now.width_px - 1) / 2.0) - carry.step_down * ((now.height_px - 1) / 2.0);
    carry.shift = into(now.position_m - before.position_m);
    carry.focal_px = view::focal_px(before);
    return carry;
}

// The four pixels around a place and its share of the way from left to right and from top to bottom.
struct Around {
    size_t top_left, to_right, to_below;
    float right, below;
};

Around around(float x_px, float y_px, uint32_t width, uint32_t height) {
    size_t left = std::min(size_t(x_px), size_t(width) - 1), top = std::min(size_t(y_px), size_t(height) - 1);
    return {top * width + left, left + 1 < width ? size_t(1) : 0, top + 1 < height ? size_t(width) : 0, x_px - float(left),
            y_px - float(top)};
}

float between(const float* values, const Around& at) {
    const float* top = values + at.top_left;
    const float* below = top + at.to_below;
    float upper = top[0] + at.right * (top[at.to_right] - top[0]);
    float lower = below[0] + at.right * (below[at.to_right] - below[0]);
    return upper + at.below * (lower - upper);
}

// Whether depths agree, by their inverses: |seen - expected| <= 1 % of expected; infinity with itself only.
bool agree(double expected_inverse, double seen_inverse) {
    return std::abs(expected_inverse - seen_inverse) <= kDepthsAgree * seen_inverse;
}

// Where a pixel was; false where it is not in V.
bool carry_pixel(const Carry& carry, double x, double y, float depth_m, const Frame& before,
                 const std::vector<float>& inverse_before, float& x_px, float& y_px) {
    glm::dvec3 direction = carry.corner + x * carry.step_right + y * carry.step_down;
    bool is_far = std::isinf(depth_m);
    glm::dvec3 point = is_far ? direction : double(depth_m) * direction + carry.shift;
    if (!(depth_m > 0) || !(point.z > 0)) return false;

    double x_most = before.width - 1.0, y_most = before.height - 1.0;
    double x_there = carry.focal_px * point.x / point.z + x_most / 2, y_there = y_most / 2 - carry.focal_px * point.y / point.z;
    if (!(x_there >= -kOnBorderPx && x_there <= x_most + kOnBorderPx && y_there >= -kOnBorderPx &&
          y_there <= y_most + kOnBorderPx))
        return false;
    x_px = float(std::clamp(x_there, 0.0, x_most));
    y_px = float(std::clamp(y_there, 0.0, y_most));

    double expected = is_far ? 0 : 1 / point.z;
    size_t nearest = size_t(std::lround(y_px)) * before.width + size_t(std::lround(x_px));
    return agree(expected, double(inverse_before[nearest])) ||
           agree(expected, double(between(inverse_before.data(), around(x_px, y_px, before.width, before.height))));
}

std::vector<float> difference_of_luma(const RgbView& test, const RgbView& reference) {
    std::vector<float> difference = luma_of(test), subtract = luma_of(reference);
    for (size_t i = 0; i < difference.size(); ++i) difference[i] -= subtract[i];
    return difference;
}

struct TileSum {
    double sum = 0;
    size_t valid = 0;
};

// r_I - r_R is linear in the pictures: what the luma's difference to the reference is now, less what it was at phi.
TileSum sum_over_tile(const Motion& motion, size_t column, size_t row, const std::vector<float>& before,
                      const std::vector<float>& now) {
    TileSum tile;
    size_t x_end = std::min<size_t>(motion.width, (column + 1) * kTilePx),
           y_end = std::min<size_t>(motion.height, (row + 1) * kTilePx);
    for (size_t y = row * kTilePx; y < y_end; ++y)
        for (size_t x = column * kTilePx; x < x_end; ++x) {
            size_t at = y * motion.width + x;
            if (std::isnan(motion.x_px[at])) continue;
            float was = between(before.data(), around(motion.x_px[at], motion.y_px[at], motion.width, motion.height));
            tile.sum += double(std::abs(now[at] - was));
            ++tile.valid;
        }
    return tile;
}

}  // namespace

Motion motion_between(const Frame& before, const Frame& now) {
    assert(before.width == now.width && before.height == now.height && before.depth_m.size() == now.depth_m.size());
    assert(now.camera.width_px == now.width && now.camera.height_px == now.height && before.camera.height_px == before.height);
    Motion motion;
    motion.width = now.width;
    motion.height = now.height;
    motion.x_px.assign(now.depth_m.size(), std::numeric_limits<float>::quiet_NaN());
    motion.y_px = motion.x_px;
    std::vector<float> inverse_before(before.depth_m.size());
    std::transform(before.depth_m.begin(), before.depth_m.end(), inverse_before.begin(),
                   [](float depth_m) { return 1 / depth_m; });

    Carry carry = carry_between(before.camera, now.camera);
    std::vector<size_t> valid(now.height);
    parallel_ranges(now.height, kRowsAtOnce, [&](size_t begin, size_t end) {
        for (size_t y = begin, at = begin * now.width; y < end; ++y)
            for (size_t x = 0; x < now.width; ++x, ++at) {
                float x_px = 0, y_px = 0;
                if (!carry_pixel(carry, double(x), double(y), now.depth_m[at], before, inverse_before, x_px, y_px)) continue;
                motion.x_px[at] = x_px;
                motion.y_px[at] = y_px;
                ++valid[y];
            }
    });
    for (size_t in_row : valid) motion.valid_count += in_row;
    return motion;
}

TemporalError temporal_error(const Motion& motion, const RgbView& test_before, const RgbView& test_now,
                             const RgbView& reference_before, const RgbView& reference_now) {
    for ([[maybe_unused]] const RgbView* picture : {&test_before, &test_now, &reference_before, &reference_now})
        assert(picture->width == motion.width && picture->height == motion.height);
    std::vector<float> before = difference_of_luma(test_before, reference_before),
                       now = difference_of_luma(test_now, reference_now);

    TemporalError error;
    error.columns = (motion.width + kTilePx - 1) / kTilePx;
    error.rows = (motion.height + kTilePx - 1) / kTilePx;
    std::vector<TileSum> sums(size_t(error.columns) * error.rows);
    parallel_ranges(sums.size(), 8, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) sums[i] = sum_over_tile(motion, i % error.columns, i / error.columns, before, now);
    });

    TileSum all;
    for (size_t i = 0; i < sums.size(); ++i) {
        size_t wide = std::min<size_t>(kTilePx, motion.width - i % error.columns * kTilePx);
        size_t high = std::min<size_t>(kTilePx, motion.height - i / error.columns * kTilePx);
        double over = std::max(double(sums[i].valid), kFullShareOfTile * double(wide * high));
        error.tiles.push_back(float(sums[i].sum / over));
        all.sum += sums[i].sum;
        all.valid += sums[i].valid;
    }
    error.mean = all.valid > 0 ? all.sum / double(all.valid) : 0;
    return error;
}

}  // namespace overlook::measure
