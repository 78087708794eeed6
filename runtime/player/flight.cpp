#include "runtime/player/flight.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace overlook::player {
namespace {

double degrees(double radians) {
    return radians * 180 / std::numbers::pi;
}

double mean_height_m(const terrain::Terrain& terrain, double otherwise_m) {
    double sum = 0;
    uint64_t count = 0;
    for (int32_t height : terrain.heights) {
        if (height == terrain::kVoid) continue;
        sum += height;
        ++count;
    }
    return count == 0 ? otherwise_m : terrain.height_offset_m + terrain.height_step_m * (sum / double(count));
}

}  // namespace

view::Camera overview(const terrain::Terrain& terrain, double lowest_m, double highest_m, uint32_t width_px, uint32_t height_px) {
    auto ground = [&](double x_m, double y_m) { return ground_m(terrain, x_m, y_m); };
    return overview(terrain, mean_height_m(terrain, lowest_m), highest_m, ground, width_px, height_px);
}

view::Camera overview(const terrain::Terrain& head, double mean_m, double highest_m,
                      const std::function<std::optional<double>(double x_m, double y_m)>& ground_at, uint32_t width_px,
                      uint32_t height_px) {
    view::Camera camera;
    camera.width_px = width_px;
    camera.height_px = height_px;
    camera.fov_y_deg = 42;

    double width_m = head.frame.metres_per_column * (head.shape.width - 1);
    double depth_m = head.frame.metres_per_row * (head.shape.height - 1);
    double diagonal_m = std::hypot(width_m, depth_m);

    // Half-way between the corner's bisector and the way to the middle; the corner's own edges stay out of sight.
    double to_middle_deg = degrees(std::atan2(width_m, depth_m));
    camera.heading_deg = -(45 + to_middle_deg) / 2;
    camera.position_m = {width_m * 0.97, -depth_m * 0.97, 0};
    double above_mean_m = std::max(0.055 * diagonal_m, 0.8 * (highest_m - mean_m));
    camera.position_m.z = mean_m + above_mean_m;
    std::optional<double> ground = ground_at(camera.position_m.x, camera.position_m.y);
    if (ground) camera.position_m.z = std::max(camera.position_m.z, *ground + 0.03 * diagonal_m);

    double half_tangent = std::tan(camera.fov_y_deg / 2 * std::numbers::pi / 180);
    camera.pitch_deg = -degrees(std::atan(0.42 * half_tangent));
    return camera;
}

std::optional<double> ground_m(const terrain::Terrain& terrain, double x_m, double y_m) {
    double column = x_m / terrain.frame.metres_per_column, row = -y_m / terrain.frame.metres_per_row;
    if (!(column >= 0 && row >= 0 && column <= terrain.shape.width - 1 && row <= terrain.shape.height - 1)) return std::nullopt;
    uint32_t left = std::min(uint32_t(column), terrain.shape.width - 2);
    uint32_t top = std::min(uint32_t(row), terrain.shape.height - 2);
    std::optional<double> highest;
    for (uint32_t corner = 0; corner < 4; ++corner) {
        uint32_t c = left + corner % 2, r = top + corner / 2;
        if (terrain.is_void(c, r)) return std::nullopt;
        highest = std::max(highest.value_or(terrain.height_m(c, r)), terrain.height_m(c, r));
    }
    return highest;
}

double TerrainGround::distance_m(const glm::dvec3& place_m) const {
    double x_m = std::clamp(place_m.x, 0.0, terrain_.frame.metres_per_column * (terrain_.shape.width - 1));
    double y_m = std::clamp(place_m.y, -terrain_.frame.metres_per_row * (terrain_.shape.height - 1), 0.0);
    double height = ground_m(terrain_, x_m, y_m).value_or(terrain_.height_offset_m);
    return std::hypot(place_m.z - height, place_m.x - x_m, place_m.y - y_m);
}

double TerrainGround::step_m() const {
    return std::min(terrain_.frame.metres_per_column, terrain_.frame.metres_per_row);
}

}  // namespace overlook::player
