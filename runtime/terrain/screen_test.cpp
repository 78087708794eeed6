#include "runtime/terrain/screen_test.h"

#include <array>

#include "runtime/terrain/tiles.h"

namespace overlook::terrain {
namespace {
// What the arithmetic of the bound may round away, many times over.
constexpr double kRoundingAllowance = 1 + 1e-9;
}  // namespace

template <class Bounds>
BasicScreenTest<Bounds>::BasicScreenTest(const Terrain& terrain, const Bounds& bounds, const view::Camera& camera,
                                         const view::PixelDetail& detail)
    : bounds_(bounds),
      last_column_(terrain.shape.width - 1),
      last_row_(terrain.shape.height - 1),
      eye_z_(camera.position_m.z),
      near_m_(camera.near_m),
      far_(detail.error_px, detail.morph),
      near_(detail.near_error_px, detail.morph),
      near_depth_m_(detail.near_depth_m),
      finer_in_(camera, detail.finer_in) {
    for (uint32_t x = 0; x <= last_column_; ++x) column_x_.push_back(x * terrain.frame.metres_per_column - camera.position_m.x);
    for (uint32_t y = 0; y <= last_row_; ++y) row_y_.push_back(-(y * terrain.frame.metres_per_row) - camera.position_m.y);

    view::Axes axes = view::axes_of(camera);
    auto direction = [](const glm::dvec3& v) { return Direction{v.x, v.y, v.z}; };
    right_ = direction(axes.right), up_ = direction(axes.up), forward_ = direction(axes.forward);
    std::array<glm::dvec3, 4> sides = view::sides_of(camera);
    for (size_t i = 0; i < 4; ++i) planes_[i] = direction(sides[i]);
    planes_[4] = forward_;
    plane_offsets_[4] = near_m_;
    if (detail.seen_by) {
        side_count_ = 4;
        std::array<glm::dvec3, 4> others = view::sides_of(*detail.seen_by);
        for (size_t i = 0; i < 4; ++i) {
            sides_[i] = direction(others[i]);
            side_offsets_[i] = glm::dot(others[i], detail.seen_by->position_m - camera.position_m);
        }
    }

    double focal = view::focal_px(camera);
    axis_rise_ = std::abs(axes.forward.z);
    double corner = view::corner_secant(camera);
    corner_squared_ = corner * corner, corner_cosine_ = 1 / corner;
    focal_squared_ = focal * focal, morphs_ = detail.morph > 0;
    for (int code = 0; code < 256; ++code) error_m_[code] = double(terrain.error_m[size_t(code)]) * kRoundingAllowance;
    finest_error_is_zero_ = terrain.error_m[0] == 0;
}

template class BasicScreenTest<HeightBounds>;
template class BasicScreenTest<TileBounds>;

}  // namespace overlook::terrain
