#include "runtime/terrain/near_plane.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "formats/terrain_diamond.h"

namespace overlook::terrain {
namespace {

double distance_to_segment_m(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    glm::dvec3 along = b - a;
    double share = std::clamp(glm::dot(p - a, along) / glm::dot(along, along), 0.0, 1.0);
    return glm::length(p - a - share * along);
}

// A triangle whose corners do not lie over each other.
double distance_to_triangle_m(const glm::dvec3& p, const std::array<glm::dvec3, 3>& t) {
    glm::dvec3 normal = glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0]));
    double above = glm::dot(p - t[0], normal);
    bool is_over = true;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 &a = t[size_t(i)], &b = t[size_t((i + 1) % 3)];
        is_over = is_over && glm::dot(glm::cross(b - a, p - a), normal) >= 0;
    }
    if (is_over) return std::abs(above);
    return std::min(
        {distance_to_segment_m(p, t[0], t[1]), distance_to_segment_m(p, t[1], t[2]), distance_to_segment_m(p, t[2], t[0])});
}

// The cells from the one `before` to the one `after` a place, within 0 .. count - 1; none if first > last.
struct Span {
    int64_t first, last;
    Span(double before, double after, uint32_t count)
        : first(int64_t(std::floor(std::clamp(before, 0.0, double(count))))),
          last(int64_t(std::floor(std::clamp(after, -1.0, double(count) - 1)))) {}
};

}  // namespace

double distance_to_ground_m(const Terrain& terrain, const glm::dvec3& place_m, double within_m) {
    double column_m = terrain.frame.metres_per_column, row_m = terrain.frame.metres_per_row;
    uint32_t width = terrain.shape.width, height = terrain.shape.height;
    if (width < 2 || height < 2) return within_m;
    Span columns((place_m.x - within_m) / column_m, (place_m.x + within_m) / column_m, width - 1);
    Span rows((-place_m.y - within_m) / row_m, (-place_m.y + within_m) / row_m, height - 1);
    auto corner = [&](int64_t x, int64_t y) {
        int32_t steps = terrain.heights[size_t(y) * width + size_t(x)];
        return glm::dvec3{double(x) * column_m, -double(y) * row_m, terrain.height_offset_m + terrain.height_step_m * steps};
    };
    auto is_void = [&](int64_t x, int64_t y) { return terrain.heights[size_t(y) * width + size_t(x)] == kVoid; };

    double nearest_m = within_m;
    for (int64_t y = rows.first; y <= rows.last; ++y)
        for (int64_t x = columns.first; x <= columns.last; ++x) {
            struct Place {
                int64_t x, y;
            };
            Place nw{x, y}, ne{x + 1, y}, sw{x, y + 1}, se{x + 1, y + 1};
            bool main = is_main_diagonal(uint32_t(x), uint32_t(y));
            std::array<std::array<Place, 3>, 2> halves = {main ? std::array{ne, nw, se} : std::array{nw, sw, ne},
                                                          main ? std::array{sw, se, nw} : std::array{se, ne, sw}};
            for (const std::array<Place, 3>& half : halves) {
                if (std::any_of(half.begin(), half.end(), [&](const Place& at) { return is_void(at.x, at.y); })) continue;
                std::array<glm::dvec3, 3> corners;
                for (size_t i = 0; i < 3; ++i) corners[i] = corner(half[i].x, half[i].y);
                nearest_m = std::min(nearest_m, distance_to_triangle_m(place_m, corners));
            }
        }
    return nearest_m;
}

view::Camera with_clear_near_plane(const Terrain& terrain, const view::Camera& camera) {
    double reach_m = camera.near_m * view::corner_secant(camera) / kNearShare;
    double clear_m = distance_to_ground_m(terrain, camera.position_m, reach_m);
    view::Camera clear = camera;
    clear.near_m = std::max(std::min(camera.near_m, kLeastNear_m), camera.near_m * clear_m / reach_m);
    return clear;
}

}  // namespace overlook::terrain
