// Where rays come from, and where they go.
#include <algorithm>
#include <array>
#include <cmath>

#include "formats/steady_math.h"
#include "runtime/wang_ldi/random.h"
#include "tools/bake/wang_ldi/sample.h"

namespace overlook::wang_ldi {
namespace {

constexpr uint64_t kShiftStream = 11, kJitterStream = 12;
constexpr double kWidestTangent = 4;  // of a raster to any side, where the eye is so near that the box is all around

// Tangents that the box's corners span from the eye, in the eye's own axes.
struct Frame {
    glm::dvec3 right, up, forward;
    double left = INFINITY, far_right = -INFINITY, bottom = INFINITY, top = -INFINITY;

    Frame(const Wedge& wedge, const glm::dvec3& eye) {
        glm::dvec3 middle(wedge.tile_m / 2, wedge.tile_m / 2, (wedge.low_m + wedge.high_m) / 2);
        forward = glm::normalize(middle - eye);
        glm::dvec3 level(-forward.y, forward.x, 0);
        right = glm::length(level) > 1e-9 ? -glm::normalize(level) : glm::dvec3(1, 0, 0);
        up = glm::cross(right, forward);
        for (int corner = 0; corner < 8; ++corner) {
            glm::dvec3 at((corner & 1) ? wedge.tile_m : 0, (corner & 2) ? wedge.tile_m : 0,
                          (corner & 4) ? wedge.high_m : wedge.low_m);
            add(at - eye);
        }
    }
    void add(const glm::dvec3& at) {
        double depth = glm::dot(at, forward), x = glm::dot(at, right), y = glm::dot(at, up);
        auto tangent = [&](double side) {
            if (depth <= 1e-9) return side < 0 ? -kWidestTangent : kWidestTangent;
            return std::clamp(side / depth, -kWidestTangent, kWidestTangent);
        };
        left = std::min(left, tangent(x)), far_right = std::max(far_right, tangent(x));
        bottom = std::min(bottom, tangent(y)), top = std::max(top, tangent(y));
        if (depth > 1e-9) return;  // behind the eye the box may be on any side
        left = bottom = -kWidestTangent, far_right = top = kWidestTangent;
    }
};

constexpr uint32_t kRays = 16;  // of a block of 4 x 4

// The rays of a block before they are known to pass the box, each number in a row of its own: so they are made several at a time.
struct Block {
    std::array<double, kRays> x, y;                     // tangents
    std::array<std::array<double, kRays>, 3> along;     // of no particular length
    std::array<double, kRays> enters, leaves, lengths;  // the box, in lengths of `along`; how long that is
};

void aim(const Frame& frame, Block& block) {
    for (int axis = 0; axis < 3; ++axis) {
        double forward = frame.forward[axis], right = frame.right[axis], up = frame.up[axis];
        auto& along = block.along[size_t(axis)];
        for (uint32_t i = 0; i < kRays; ++i) along[i] = forward + block.x[i] * right + block.y[i] * up;
    }
    const auto &x = block.along[0], &y = block.along[1], &z = block.along[2];
    for (uint32_t i = 0; i < kRays; ++i) block.lengths[i] = std::sqrt(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]);
}

// Where rays from `from` are within the box; those that pass beside it leave before they enter.
void clip(const Wedge& wedge, const glm::dvec3& from, Block& block) {
    block.enters.fill(0), block.leaves.fill(INFINITY);
    glm::dvec3 low(0, 0, wedge.low_m), high(wedge.tile_m, wedge.tile_m, wedge.high_m);
    for (int axis = 0; axis < 3; ++axis) {
        const auto& along = block.along[size_t(axis)];
        double to_low = low[axis] - from[axis], to_high = high[axis] - from[axis];
        bool is_between = to_low <= 0 && to_high >= 0;
        double enters_even = is_between ? 0 : INFINITY;  // of rays that go along these two sides
        for (uint32_t i = 0; i < kRays; ++i) {
            double a = to_low / along[i], b = to_high / along[i];
            double first = std::min(a, b), last = std::max(a, b);
            bool is_even = along[i] == 0;
            first = is_even ? enters_even : first, last = is_even ? INFINITY : last;
            block.enters[i] = std::max(block.enters[i], first), block.leaves[i] = std::min(block.leaves[i], last);
        }
    }
}

}  // namespace

// Fractions of n * (1 / g, 1 / g^2, 1 / g^3), g the real root of g^4 = g + 1.
std::array<double, 3> evenly_spread(uint64_t seed, uint64_t index) {
    constexpr double kRoot = 1.2207440846057596;
    std::array<double, 3> at;
    double step = 1;
    for (size_t axis = 0; axis < 3; ++axis) {
        step /= kRoot;
        double place = Random(seed, kShiftStream + 8 * axis).next_unit() + double(index + 1) * step;
        at[axis] = place - std::floor(place);
    }
    return at;
}

glm::vec3 middle_eye_m(const Wedge& wedge) {
    double distance = std::sqrt(wedge.nearest_m * wedge.farthest_m);
    steady::SinCos to_eye = steady::sin_cos(wedge.heading_rad);
    return glm::vec3(glm::dvec3(wedge.tile_m / 2 + distance * to_eye.sin, wedge.tile_m / 2 + distance * to_eye.cos,
                                (wedge.eye_low_m + wedge.eye_high_m) / 2));
}

void set_eye(const Wedge& wedge, uint64_t seed, uint64_t index, uint32_t rays_per_eye, Eye& eye) {
    std::array<double, 3> at = evenly_spread(seed, index);
    double heading = wedge.heading_rad + (2 * at[0] - 1) * wedge.half_width_rad;
    double distance = wedge.nearest_m * steady::pow(wedge.farthest_m / wedge.nearest_m, at[1]);
    steady::SinCos to_eye = steady::sin_cos(heading);
    glm::dvec3 from(wedge.tile_m / 2 + distance * to_eye.sin, wedge.tile_m / 2 + distance * to_eye.cos,
                    wedge.eye_low_m + (wedge.eye_high_m - wedge.eye_low_m) * at[2]);
    Frame frame(wedge, from);
    double width = frame.far_right - frame.left, height = frame.top - frame.bottom;
    double step = std::sqrt(width * height / rays_per_eye);
    auto columns = uint32_t(std::ceil(width / step)) + 1, rows = uint32_t(std::ceil(height / step)) + 1;
    Random random(hash_of(seed, kJitterStream, int64_t(index), 0));
    double shift_x = random.next_unit() - 1, shift_y = random.next_unit() - 1;

    eye.at_m = glm::vec3(from), eye.rays.clear();
    Block block;
    for (uint32_t block_row = 0; block_row < rows; block_row += 4)
        for (uint32_t block_column = 0; block_column < columns; block_column += 4) {
            for (uint32_t i = 0; i < kRays; ++i) {
                uint64_t jitter = random.next();
                block.x[i] = frame.left + (block_column + i % 4 + shift_x + double(int64_t(jitter >> 32)) * 0x1p-32) * step;
                block.y[i] = frame.bottom + (block_row + i / 4 + shift_y + double(int64_t(jitter & 0xffffffff)) * 0x1p-32) * step;
            }
            aim(frame, block), clip(wedge, from, block);
            const auto& [x, y, z] = block.along;
            for (uint32_t i = 0; i < kRays; ++i) {
                if (!(block.enters[i] < block.leaves[i])) continue;
                double length = block.lengths[i];
                eye.rays.push_back({eye.at_m, glm::vec3(glm::dvec3(x[i] / length, y[i] / length, z[i] / length)), 0,
                                    float(block.leaves[i] * length)});
            }
        }
}

}  // namespace overlook::wang_ldi
