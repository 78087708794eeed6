#include "tools/measure/stability/surface.h"

#include <cmath>
#include <limits>

namespace overlook::measure {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

}  // namespace

void Surface::take(const terrain::Cut& cut) {
    for (uint32_t sample : vertices_) heights_m_[sample] = kNone;
    vertices_.clear();
    uint32_t width = terrain_->shape.width;
    for (uint32_t index : cut.indices) {
        uint32_t sample = index;
        float rise_m = 0;
        if (index >= heights_m_.size()) {
            const terrain::Cut::Morph& morph = cut.morphs[index - heights_m_.size()];
            sample = morph.sample;
            rise_m = morph.rise_m;
        }
        if (is_vertex(sample)) continue;
        heights_m_[sample] = float(terrain_->height_m(sample % width, sample / width)) + rise_m;
        vertices_.push_back(sample);
    }
}

bool Surface::is_vertex(uint32_t sample) const {
    return heights_m_[sample] > kNone;
}

double Surface::height_m(uint32_t sample) const {
    if (is_vertex(sample)) return double(heights_m_[sample]);
    int64_t width = terrain_->shape.width, height = terrain_->shape.height;
    int64_t x = sample % width, y = sample / width;
    if ((x | y) == 0) return kNothing;
    // The finest level at which the sample is one: it splits a side of a square of that level, or a diagonal of the one above,
    // from the corner that is that square's parent's middle to the one across.
    int64_t step = (x | y) & -(x | y), dx = (x & step) != 0 ? step : 0, dy = (y & step) != 0 ? step : 0;
    if (dx != 0 && dy != 0) {
        bool is_odd_column = ((x - dx) & (2 * step)) != 0, is_odd_row = ((y - dy) & (2 * step)) != 0;
        if (is_odd_column != is_odd_row) dy = -dy;
    }
    int64_t ends[2][2] = {{x - dx, y - dy}, {x + dx, y + dy}};
    double sum_m = 0;
    for (const auto& [column, row] : ends) {
        if (column < 0 || row < 0 || column >= width || row >= height) return kNothing;
        sum_m += height_m(uint32_t(row * width + column));
    }
    return sum_m / 2;
}

double Surface::distance_px(uint32_t vertex, double other_m, const view::Camera& camera) const {
    uint32_t width = terrain_->shape.width;
    view::Axes axes = view::axes_of(camera);
    double focal_px = view::focal_px(camera);
    glm::dvec3 place_m(vertex % width * terrain_->frame.metres_per_column, -(vertex / width * terrain_->frame.metres_per_row), 0);
    auto seen = [&](double at_m) {
        glm::dvec3 from_eye = place_m + glm::dvec3(0, 0, at_m) - camera.position_m;
        double depth_m = glm::dot(from_eye, axes.forward);
        return glm::dvec3(focal_px * glm::dot(from_eye, axes.right) / depth_m, focal_px * glm::dot(from_eye, axes.up) / depth_m,
                          depth_m);
    };
    glm::dvec3 here = seen(height_m(vertex)), there = seen(other_m);
    bool is_seen =
        here.z >= camera.near_m && std::abs(here.x) <= camera.width_px / 2.0 && std::abs(here.y) <= camera.height_px / 2.0;
    return is_seen ? std::hypot(here.x - there.x, here.y - there.y) : kNothing;
}

}  // namespace overlook::measure
