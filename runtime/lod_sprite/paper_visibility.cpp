#include "runtime/lod_sprite/paper_visibility.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "runtime/lod_sprite/paper_quadrants.h"

namespace overlook::lod_sprite::paper {
namespace {

constexpr double kNoDepth = std::numeric_limits<double>::infinity();

// Of an ordinary depth buffer; 1 for infinity, as it is cleared to.
double window_depth(double depth_m, double near_m, double far_m) {
    return depth_m == kNoDepth ? 1 : far_m * (depth_m - near_m) / (depth_m * (far_m - near_m));
}

// The triangle's samples from the least on, in the same turn.
Triple key_of(const terrain::Terrain& terrain, const terrain::Cut& cut, size_t triangle) {
    uint32_t s[3];
    for (size_t i = 0; i < 3; ++i) s[i] = sample_of_index(terrain, cut, cut.indices[3 * triangle + i]);
    size_t first = size_t(std::min_element(s, s + 3) - s);
    return {s[first], s[(first + 1) % 3], s[(first + 2) % 3]};
}

}  // namespace

void KeyDepth::keep(const view::Camera& camera, std::span<const float> near_over_depth) {
    assert(near_over_depth.size() == size_t(camera.width_px) * camera.height_px);
    camera_ = camera;
    axes_ = view::axes_of(camera);
    focal_px_ = view::focal_px(camera);
    near_over_depth_.assign(near_over_depth.begin(), near_over_depth.end());
}

bool KeyDepth::is_visible(const glm::dvec3& place_m, const DepthTest& test) const {
    glm::dvec3 p = place_m - camera_.position_m;
    double depth_m = glm::dot(p, axes_.forward);
    if (!(depth_m >= camera_.near_m)) return false;
    double x_px = camera_.width_px / 2.0 + focal_px_ * glm::dot(p, axes_.right) / depth_m;
    double y_px = camera_.height_px / 2.0 - focal_px_ * glm::dot(p, axes_.up) / depth_m;
    if (!(x_px >= 0 && x_px < camera_.width_px && y_px >= 0 && y_px < camera_.height_px)) return false;

    // Pixel (i, j) was taken at (i + 1/2, j + 1/2): that of the pixel in which the vertex lies is the closest.
    float stored = near_over_depth_[size_t(y_px) * camera_.width_px + size_t(x_px)];
    double stored_m = stored > 0 ? camera_.near_m / double(stored) : kNoDepth;
    if (test.space == DepthSpace::eye) return std::abs(depth_m - stored_m) < test.thickness;
    if (depth_m > test.far_m) return false;
    return std::abs(window_depth(depth_m, camera_.near_m, test.far_m) - window_depth(stored_m, camera_.near_m, test.far_m)) <
           test.thickness;
}

bool TriangleFlags::is_vertex_visible(const KeyDepth& key, uint32_t sample) {
    bool is_new = false;
    uint32_t& visible = vertices_.at({sample, 0, 0}, 0, is_new);
    uint32_t width = terrain_.shape.width;
    if (is_new) visible = key.is_visible(place_of(terrain_, sample % width, sample / width), test_);
    return visible != 0;
}

bool TriangleFlags::is_triangle_visible(const KeyDepth& key, const Triple& triangle) {
    bool a = is_vertex_visible(key, triangle.a), b = is_vertex_visible(key, triangle.b), c = is_vertex_visible(key, triangle.c);
    return a && b && c;
}

void TriangleFlags::start(const KeyDepth& key, const terrain::Cut& low) {
    vertices_.clear();
    triangles_.clear();
    for (size_t i = 0; i < low.triangle_count(); ++i) {
        Triple triangle = key_of(terrain_, low, i);
        bool is_new = false;
        triangles_.at(triangle, is_triangle_visible(key, triangle), is_new);
    }
}

void TriangleFlags::read(const KeyDepth& key, const terrain::Cut& low, std::vector<uint8_t>& is_visible) {
    is_visible.resize(low.triangle_count());
    for (size_t i = 0; i < low.triangle_count(); ++i) {
        Triple triangle = key_of(terrain_, low, i);
        bool is_new = false;
        uint32_t& flag = triangles_.at(triangle, 0, is_new);
        if (is_new && new_triangles_ == NewTriangles::tested) flag = is_triangle_visible(key, triangle);
        is_visible[i] = uint8_t(flag);
    }
}

}  // namespace overlook::lod_sprite::paper
