#include "runtime/terrain/predict.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "formats/parallel.h"
#include "formats/terrain_check.h"

namespace overlook::terrain {
namespace {

constexpr double kRoundingAllowance = 1 + 1e-6;  // of floats and of the camera's axes
constexpr size_t kTrianglesAtATime = 4096;

struct Eye {
    view::Axes axes;
    glm::dvec3 place_m;
    double focal_px, corner_secant, near_m, axis_rise;
};

// view::error_px_bound_vertical over the prism that a triangle fills when it moves up and down by error_m. Angles and ratios of
// horizontal distance to depth are greatest at its corners, because the points that keep below one of them are a convex cone.
double prism_bound_px(const Eye& eye, const std::array<glm::dvec3, 3>& corners_m, double error_m) {
    double depth_min = std::numeric_limits<double>::infinity(), lever = 0, secant = 0, distance_squared_min = 0;
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    bool is_before_the_eye = true;
    for (const glm::dvec3& corner : corners_m)
        for (double shift : {-error_m, error_m}) {
            glm::dvec3 p = corner + glm::dvec3{0, 0, shift} - eye.place_m;
            low = glm::min(low, p), high = glm::max(high, p);
            double depth = glm::dot(p, eye.axes.forward);
            depth_min = std::min(depth_min, depth);
            is_before_the_eye = is_before_the_eye && depth > 0;
            lever = std::max(lever, std::hypot(p.x, p.y) / depth);
            secant = std::max(secant, glm::length(p) / depth);
        }
    for (int i = 0; i < 3; ++i) {
        double outside = std::max({low[i], -high[i], 0.0});
        distance_squared_min += outside * outside;
    }
    lever = is_before_the_eye ? std::min({lever, secant, eye.corner_secant}) : eye.corner_secant;
    double seen_from = std::max(eye.near_m, std::sqrt(distance_squared_min) / eye.corner_secant);
    double depth_after = std::max(depth_min, seen_from - error_m * eye.axis_rise);
    if (depth_after <= 0) return std::numeric_limits<double>::infinity();
    return eye.focal_px * error_m * lever / depth_after;
}

}  // namespace

void predict_triangles(const Terrain& terrain, const Cut& cut, const view::Camera& camera, double error_px,
                       std::vector<float>& predicted_px) {
    view::Axes axes = view::axes_of(camera);
    Eye eye{axes,          camera.position_m,       view::focal_px(camera), view::corner_secant(camera),
            camera.near_m, std::abs(axes.forward.z)};
    uint32_t width = terrain.shape.width;
    predicted_px.resize(cut.triangle_count());
    parallel_ranges(predicted_px.size(), kTrianglesAtATime, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            std::array<glm::dvec3, 3> corners_m;
            bool morphs = false;
            for (size_t k = 0; k < 3; ++k) {
                uint32_t sample = cut.indices[3 * i + k];
                morphs = morphs || sample >= terrain.heights.size();
                if (sample >= terrain.heights.size()) continue;
                uint32_t column = sample % width, row = sample / width;
                corners_m[k] = {column * terrain.frame.metres_per_column, -(row * terrain.frame.metres_per_row),
                                terrain.height_m(column, row)};
            }
            double error_m = double(terrain.error_m[cut.codes[i]]);
            predicted_px[i] = float_at_least(morphs        ? error_px
                                             : error_m > 0 ? prism_bound_px(eye, corners_m, error_m) * kRoundingAllowance
                                                           : 0);
        }
    });
}

}  // namespace overlook::terrain
