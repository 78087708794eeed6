// Where rays come from, and where they go.
#include <algorithm>
#include <cmath>

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

// Where a ray is within the box, in its own lengths; false if it passes beside it.
bool clip(const Wedge& wedge, const glm::dvec3& from, const glm::dvec3& along, double& leaves) {
    double enters = 0;
    leaves = INFINITY;
    glm::dvec3 low(0, 0, wedge.low_m), high(wedge.tile_m, wedge.tile_m, wedge.high_m);
    for (int axis = 0; axis < 3; ++axis) {
        if (along[axis] == 0) {
            if (from[axis] < low[axis] || from[axis] > high[axis]) return false;
            continue;
        }
        double a = (low[axis] - from[axis]) / along[axis], b = (high[axis] - from[axis]) / along[axis];
        enters = std::max(enters, std::min(a, b)), leaves = std::min(leaves, std::max(a, b));
    }
    return enters < leaves;
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
    return glm::vec3(glm::dvec3(wedge.tile_m / 2 + distance * std::sin(wedge.heading_rad),
                                wedge.tile_m / 2 + distance * std::cos(wedge.heading_rad),
                                (wedge.eye_low_m + wedge.eye_high_m) / 2));
}

void set_eye(const Wedge& wedge, uint64_t seed, uint64_t index, uint32_t rays_per_eye, Eye& eye) {
    std::array<double, 3> at = evenly_spread(seed, index);
    double heading = wedge.heading_rad + (2 * at[0] - 1) * wedge.half_width_rad;
    double distance = wedge.nearest_m * std::pow(wedge.farthest_m / wedge.nearest_m, at[1]);
    glm::dvec3 from(wedge.tile_m / 2 + distance * std::sin(heading), wedge.tile_m / 2 + distance * std::cos(heading),
                    wedge.eye_low_m + (wedge.eye_high_m - wedge.eye_low_m) * at[2]);
    Frame frame(wedge, from);
    double width = frame.far_right - frame.left, height = frame.top - frame.bottom;
    double step = std::sqrt(width * height / rays_per_eye);
    auto columns = uint32_t(std::ceil(width / step)) + 1, rows = uint32_t(std::ceil(height / step)) + 1;
    Random random(hash_of(seed, kJitterStream, int64_t(index), 0));
    double shift_x = random.next_unit() - 1, shift_y = random.next_unit() - 1;

    eye.at_m = glm::vec3(from), eye.rays.clear();
    for (uint32_t block_row = 0; block_row < rows; block_row += 4)
        for (uint32_t block_column = 0; block_column < columns; block_column += 4)
            for (uint32_t i = 0; i < 16; ++i) {
                uint64_t jitter = random.next();
                double x = frame.left + (block_column + i % 4 + shift_x + double(jitter >> 32) * 0x1p-32) * step;
                double y = frame.bottom + (block_row + i / 4 + shift_y + double(jitter & 0xffffffff) * 0x1p-32) * step;
                glm::dvec3 along = frame.forward + x * frame.right + y * frame.up;
                double leaves = 0;
                if (!clip(wedge, from, along, leaves)) continue;
                double length = glm::length(along);
                eye.rays.push_back({eye.at_m, glm::vec3(along / length), 0, float(leaves * length)});
            }
}

}  // namespace overlook::wang_ldi
