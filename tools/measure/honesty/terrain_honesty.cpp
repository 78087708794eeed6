#include "tools/measure/honesty/terrain_honesty.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "formats/parallel.h"
#include "runtime/terrain/predict.h"

namespace overlook::measure {
namespace {

constexpr size_t kTrianglesAtATime = 1024;

struct Corner {
    int64_t x, y;
    double z;
};

Corner corner_of(const terrain::Terrain& terrain, const terrain::Cut& cut, size_t i) {
    uint32_t width = terrain.shape.width, sample = cut.indices[i];
    double rise_m = 0;
    if (sample >= terrain.heights.size()) {
        const terrain::Cut::Morph& morph = cut.morphs[sample - terrain.heights.size()];
        sample = morph.sample, rise_m = double(morph.rise_m);
    }
    return {sample % width, sample / width, terrain.height_m(sample % width, sample / width) + rise_m};
}

struct Screen {
    double x_px, y_px, depth_m;
};

class Eye {
  public:
    explicit Eye(const view::Camera& camera)
        : camera_(camera),
          axes_(view::axes_of(camera)),
          focal_px_(view::focal_px(camera)),
          half_x_(camera.width_px / 2.0),
          half_y_(camera.height_px / 2.0) {}

    Screen project(const glm::dvec3& point_m) const {
        glm::dvec3 p = point_m - camera_.position_m;
        double depth = glm::dot(p, axes_.forward);
        return {focal_px_ * glm::dot(p, axes_.right) / depth, focal_px_ * glm::dot(p, axes_.up) / depth, depth};
    }
    bool is_in_frame(const Screen& s) const {
        return s.depth_m >= camera_.near_m && std::abs(s.x_px) <= half_x_ && std::abs(s.y_px) <= half_y_;
    }

  private:
    const view::Camera& camera_;
    view::Axes axes_;
    double focal_px_, half_x_, half_y_;
};

// Of one sample at a height that may be the source's.
double displacement_px(const Eye& eye, double east_m, double north_m, double source_z, double drawn_z) {
    Screen truth = eye.project({east_m, north_m, source_z}), drawn = eye.project({east_m, north_m, drawn_z});
    if (!eye.is_in_frame(truth) && !eye.is_in_frame(drawn)) return kNotSeen;
    if (truth.depth_m <= 0 || drawn.depth_m <= 0) return std::numeric_limits<double>::infinity();
    return std::hypot(truth.x_px - drawn.x_px, truth.y_px - drawn.y_px);
}

// Seen along a vertical, one end of the heights that may be the source's is the farthest.
double sample_px(const Eye& eye, const terrain::Terrain& terrain, uint32_t column, uint32_t row, double drawn_z,
                 double unsure_m) {
    double east_m = column * terrain.frame.metres_per_column, north_m = -(row * terrain.frame.metres_per_row);
    double stored_z = terrain.height_m(column, row);
    double lower_px = displacement_px(eye, east_m, north_m, stored_z - unsure_m, drawn_z);
    if (unsure_m == 0) return lower_px;
    return std::max(lower_px, displacement_px(eye, east_m, north_m, stored_z + unsure_m, drawn_z));
}

double triangle_px(const Eye& eye, const terrain::Terrain& terrain, const std::array<Corner, 3>& p, double unsure_m) {
    auto turn = [](const Corner& a, const Corner& b, int64_t x, int64_t y) {
        return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
    };
    int64_t area = turn(p[0], p[1], p[2].x, p[2].y), sign = area > 0 ? 1 : -1;
    double greatest = kNotSeen;
    for (int64_t row = std::min({p[0].y, p[1].y, p[2].y}); row <= std::max({p[0].y, p[1].y, p[2].y}); ++row)
        for (int64_t column = std::min({p[0].x, p[1].x, p[2].x}); column <= std::max({p[0].x, p[1].x, p[2].x}); ++column) {
            int64_t a = sign * turn(p[1], p[2], column, row), b = sign * turn(p[2], p[0], column, row),
                    c = sign * turn(p[0], p[1], column, row);
            if (a < 0 || b < 0 || c < 0) continue;
            double z = (double(a) * p[0].z + double(b) * p[1].z + double(c) * p[2].z) / double(sign * area);
            greatest = std::max(greatest, sample_px(eye, terrain, uint32_t(column), uint32_t(row), z, unsure_m));
        }
    return greatest;
}

}  // namespace

void measure_triangles(const terrain::Terrain& terrain, const terrain::Cut& cut, const view::Camera& camera,
                       std::vector<float>& measured_px, double unsure_m) {
    Eye eye(camera);
    measured_px.resize(cut.triangle_count());
    parallel_ranges(measured_px.size(), kTrianglesAtATime, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            measured_px[i] = float(triangle_px(
                eye, terrain,
                {corner_of(terrain, cut, 3 * i), corner_of(terrain, cut, 3 * i + 1), corner_of(terrain, cut, 3 * i + 2)},
                unsure_m));
    });
}

Promises promises_of(const terrain::Terrain& terrain, const terrain::Cut& cut, const view::Camera& camera, double error_px) {
    std::vector<float> predicted_px, measured_px;
    terrain::predict_triangles(terrain, cut, camera, error_px, predicted_px);
    measure_triangles(terrain, cut, camera, measured_px);
    Promises seen;
    for (size_t i = 0; i < predicted_px.size(); ++i) {
        if (double(measured_px[i]) == kNotSeen) continue;
        seen.predicted_px.push_back(predicted_px[i]);
        seen.measured_px.push_back(measured_px[i]);
    }
    return seen;
}

}  // namespace overlook::measure
