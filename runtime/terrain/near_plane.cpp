#include "runtime/terrain/near_plane.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "formats/terrain_diamond.h"
#include "runtime/terrain/tiles.h"

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

struct Cells {
    Span columns, rows;
};
Cells cells_within(const Terrain& head, const glm::dvec3& place_m, double within_m) {
    double column_m = head.frame.metres_per_column, row_m = head.frame.metres_per_row;
    return {Span((place_m.x - within_m) / column_m, (place_m.x + within_m) / column_m, head.shape.width - 1),
            Span((-place_m.y - within_m) / row_m, (-place_m.y + within_m) / row_m, head.shape.height - 1)};
}

// steps_at(x, y): the height of a sample in steps.
template <class StepsAt>
double distance_to_cells_m(const Terrain& terrain, const Cells& cells, const glm::dvec3& place_m, double within_m,
                           const StepsAt& steps_at) {
    double column_m = terrain.frame.metres_per_column, row_m = terrain.frame.metres_per_row;
    const Span &columns = cells.columns, &rows = cells.rows;
    auto corner = [&](int64_t x, int64_t y) {
        int32_t steps = steps_at(uint32_t(x), uint32_t(y));
        return glm::dvec3{double(x) * column_m, -double(y) * row_m, terrain.height_offset_m + terrain.height_step_m * steps};
    };
    auto is_void = [&](int64_t x, int64_t y) { return steps_at(uint32_t(x), uint32_t(y)) == kVoid; };

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

view::Camera with_near_plane_of(const view::Camera& camera, double clear_m, double reach_m) {
    view::Camera clear = camera;
    clear.near_m = std::max(std::min(camera.near_m, kLeastNear_m), camera.near_m * clear_m / reach_m);
    return clear;
}

double reach_m_of(const view::Camera& camera) {
    return camera.near_m * view::corner_secant(camera) / kNearShare;
}

}  // namespace

double distance_to_ground_m(const Terrain& terrain, const glm::dvec3& place_m, double within_m) {
    uint32_t width = terrain.shape.width, height = terrain.shape.height;
    if (width < 2 || height < 2) return within_m;
    return distance_to_cells_m(terrain, cells_within(terrain, place_m, within_m), place_m, within_m,
                               [&](uint32_t x, uint32_t y) { return terrain.heights[size_t(y) * width + x]; });
}

double distance_to_ground_m(const Tiles& tiles, const glm::dvec3& place_m, double within_m) {
    const Terrain& head = tiles.head();
    Cells cells = cells_within(head, place_m, within_m);
    bool is_known = true, is_apart = true;
    for (int64_t y = cells.rows.first; y <= cells.rows.last; ++y)
        for (int64_t x = cells.columns.first; x <= cells.columns.last; ++x) {
            for (int64_t corner = 0; corner < 4; ++corner)
                is_known = is_known && tiles.height(uint32_t(x + corner % 2), uint32_t(y + corner / 2)).has_value();
            HeightRange range = tiles.range_round(uint32_t(x), uint32_t(y));
            is_apart = is_apart && (range.is_empty() || place_m.z - double(range.high_m) >= within_m ||
                                    double(range.low_m) - place_m.z >= within_m);
        }
    if (is_apart) return within_m;
    if (!is_known) return 0;
    return distance_to_cells_m(head, cells, place_m, within_m, [&](uint32_t x, uint32_t y) { return *tiles.height(x, y); });
}

view::Camera with_clear_near_plane(const Terrain& terrain, const view::Camera& camera) {
    double reach_m = reach_m_of(camera);
    return with_near_plane_of(camera, distance_to_ground_m(terrain, camera.position_m, reach_m), reach_m);
}

view::Camera with_clear_near_plane(const Tiles& tiles, const view::Camera& camera) {
    double reach_m = reach_m_of(camera);
    return with_near_plane_of(camera, distance_to_ground_m(tiles, camera.position_m, reach_m), reach_m);
}

}  // namespace overlook::terrain
