#include "runtime/wang_ldi/portraits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "runtime/wang_ldi/own_objects.h"
#include "runtime/wang_ldi/plate.h"
#include "runtime/wang_ldi/tiling.h"

namespace overlook::wang_ldi {
namespace {

constexpr uint32_t kTilingSide = 64;
constexpr double kMargin = 0.12;  // around a tile from above, of its side
constexpr double kFarUp = 1000;   // so many sides away rays are as good as parallel: 0.1 pixels off in 200
constexpr double kAsideHeading_deg = 218, kAsideElevation_deg = 30, kAsideDistance = 3.5;  // in sides of the tile
constexpr double kFilled = 0.92;  // of a picture by the box of what is looked at

double radians(double degrees) {
    return degrees * std::numbers::pi / 180;
}

Result<void> check(const ImageReader& images, const PlantedTiles& ground) {
    const ImageSet& set = images.set();
    if (set.tile_count == ground.set.tiles.size() && set.tile_m == ground.planting.tile_size_m) return {};
    return bad_input("images of {} tiles of {:g} m, planted are {} of {:g} m", set.tile_count, set.tile_m,
                     ground.set.tiles.size(), ground.planting.tile_size_m);
}

// The coarsest level with so many pixels along a side, or the finest.
uint32_t level_of_side(const ImageSet& set, uint32_t side_px) {
    uint32_t level = uint32_t(set.levels.size()) - 1;
    while (level > 0 && set.levels[level].side_px < side_px) --level;
    return level;
}

// Row by row from the south, the tile in the middle; -1: none.
using Around = std::array<int, 9>;

std::vector<Around> surroundings(const TileSet& set, uint32_t count, uint64_t seed) {
    std::vector<Around> around;
    for (uint32_t t = 0; t < count; ++t) around.push_back({-1, -1, -1, -1, int(t), -1, -1, -1, -1});
    auto tiling = tile_square(set, kTilingSide, seed);
    if (!tiling) return around;
    for (uint32_t y = kTilingSide - 2; y > 0; --y)
        for (uint32_t x = kTilingSide - 2; x > 0; --x) {
            uint32_t tile = tiling->at(x, y);
            if (tile >= count) continue;
            for (uint32_t k = 0; k < 9; ++k) around[tile][k] = tiling->at(x + k % 3 - 1, y + k / 3 - 1);
        }
    return around;
}

// One picture of a tile that is being drawn, and from where.
struct Sitting {
    view::Camera camera;
    Warped drawn;

    explicit Sitting(const view::Camera& from) : camera(from) { drawn.clear(from.width_px, from.height_px); }
    // One image alone.
    void see(const ImageSet& set, const Ldi& ldi, uint32_t level) {
        Drawn tile{&ldi, level, glm::dvec3(0), glm::dvec2(0), 1};
        warp(camera, set, std::span(&tile, 1), Hiding::by_order, drawn);
    }
    // Images of one tile among others, in any order.
    void see_at(const ImageSet& set, const Ldi& ldi, uint32_t level, const glm::dvec2& place_m, double splat_scale = 1) {
        Drawn tile{&ldi, level, {place_m, 0}, glm::dvec2(0), float(splat_scale)};
        warp(camera, set, std::span(&tile, 1), Hiding::by_depth, drawn);
    }
};

glm::dvec2 place_of(size_t k, double tile_m) {
    return {(double(k % 3) - 1) * tile_m, (double(k / 3) - 1) * tile_m};
}

// Every image of a level for all tiles and directions, read once: see(tile, image).
Result<void> visit_images(const ImageReader& images, uint32_t level,
                          const std::function<void(uint32_t tile, const Ldi& ldi)>& see) {
    const ImageSet& set = images.set();
    for (uint32_t tile = 0; tile < set.tile_count; ++tile)
        for (uint32_t direction = 0; direction < set.direction_count; ++direction) {
            auto ldi = images.read(index_of(set, {set.context_count - 1, tile, level, direction}));
            if (!ldi) return tl::unexpected(ldi.error());
            see(tile, *ldi);
        }
    return {};
}

// Looks at the middle of a tile's box from eye_m; as wide a picture as asked, and as high as the box then is, both doubled.
view::Camera looking_at_tile(const ImageSet& set, const glm::dvec3& eye_m, uint32_t width_px) {
    glm::dvec3 middle_m(set.tile_m / 2, set.tile_m / 2, (set.low_m + set.high_m) / 2), along = middle_m - eye_m;
    view::Camera camera;
    camera.position_m = eye_m, camera.near_m = 1e-3 * set.tile_m;
    camera.heading_deg = std::atan2(along.x, along.y) * 180 / std::numbers::pi;
    camera.pitch_deg = std::atan2(along.z, std::hypot(along.x, along.y)) * 180 / std::numbers::pi;
    view::Axes axes = view::axes_of(camera);
    glm::dvec2 reach(0);  // tangents
    for (int corner = 0; corner < 8; ++corner) {
        glm::dvec3 at((corner & 1) * set.tile_m, (corner >> 1 & 1) * set.tile_m, corner < 4 ? set.low_m : set.high_m);
        double depth_m = std::max(glm::dot(at - eye_m, axes.forward), 0.1 * glm::length(along));
        reach = glm::max(reach, glm::abs(glm::dvec2(glm::dot(at - eye_m, axes.right), glm::dot(at - eye_m, axes.up))) / depth_m);
    }
    camera.width_px = 2 * width_px;
    camera.height_px = 2 * uint32_t(std::lround(std::clamp(reach.y / reach.x, 0.2, 2.0) * width_px));
    double focal_px = kFilled * std::min(camera.width_px / 2 / reach.x, camera.height_px / 2 / reach.y);
    camera.fov_y_deg = 2 * std::atan(camera.height_px / 2 / focal_px) * 180 / std::numbers::pi;
    return camera;
}

// The same picture from another eye.
view::Camera moved(const ImageSet& set, view::Camera camera, const glm::dvec3& eye_m) {
    view::Camera there = looking_at_tile(set, eye_m, camera.width_px);
    camera.position_m = eye_m, camera.heading_deg = there.heading_deg, camera.pitch_deg = there.pitch_deg;
    return camera;
}

// An eye of the cell's mean height, so far from the tile's middle on the ground.
glm::dvec3 eye_at(const ImageSet& set, double heading_deg, double distance_m) {
    double heading = radians(heading_deg);
    return {set.tile_m / 2 + distance_m * std::sin(heading), set.tile_m / 2 + distance_m * std::cos(heading),
            (set.cell.eye_low_m + set.cell.eye_high_m) / 2};
}

// Half-way through the distances that the finest level is for, and far enough to see the tile as a whole.
double near_m_of(const ImageSet& set) {
    double end_m = set.levels.size() > 1 ? double(set.levels[1].nearest_m) : set.cell.farthest_m;
    return std::max((double(set.levels[0].nearest_m) + end_m) / 2, 1.4 * set.tile_m);
}

uint32_t columns_for(uint32_t count) {
    return uint32_t(std::ceil(std::sqrt(double(count) * 1.5)));
}

}  // namespace

Result<ImageRgb8> tiles_from_above(const ImageReader& images, const PlantedTiles& ground, const PortraitOptions& options) {
    if (auto checked = check(images, ground); !checked) return tl::unexpected(checked.error());
    const ImageSet& set = images.set();
    uint32_t count = std::min(set.tile_count, options.most_tiles), level = level_of_side(set, options.width_px);
    double span_m = set.tile_m * (1 + 2 * kMargin), height_m = set.high_m + kFarUp * std::max(set.tile_m, set.high_m - set.low_m);
    view::Camera camera;
    camera.position_m = {set.tile_m / 2, set.tile_m / 2, height_m}, camera.pitch_deg = -90;
    camera.width_px = camera.height_px = 2 * options.width_px;
    camera.fov_y_deg = 2 * std::atan(span_m / 2 / (height_m - set.high_m)) * 180 / std::numbers::pi;
    // Of a pixel of the level; splats are rounded up to whole pixels, or gaps would run between parallel rays.
    double wide_px = 2 * options.width_px / span_m * set.tile_m / set.levels[level].side_px;
    std::vector<Around> around = surroundings(ground.set, count, options.seed);
    std::vector<Sitting> sittings(count, Sitting(camera));
    auto seen = visit_images(images, level, [&](uint32_t tile, const Ldi& ldi) {
        for (uint32_t t = 0; t < count; ++t)
            for (size_t k = 0; k < 9; ++k) {
                if (around[t][k] != int(tile)) continue;
                sittings[t].see_at(set, ldi, level, place_of(k, set.tile_m), std::ceil(wide_px) / wide_px);
            }
    });
    if (!seen) return tl::unexpected(seen.error());
    Plate plate(count, columns_for(count), options.width_px, options.width_px);
    auto low_px = uint32_t(std::lround(options.width_px * kMargin / (1 + 2 * kMargin)));
    for (uint32_t t = 0; t < count; ++t) {
        plate.put(t, sittings[t].drawn);
        plate.frame(t, low_px, options.width_px - low_px);
    }
    return plate.picture();
}

Result<ImageRgb8> tiles_from_aside(const ImageReader& images, const PlantedTiles& ground, const PortraitOptions& options) {
    if (auto checked = check(images, ground); !checked) return tl::unexpected(checked.error());
    const ImageSet& set = images.set();
    uint32_t count = std::min(set.tile_count, options.most_tiles), level = level_of_side(set, options.width_px);
    double far_m = kAsideDistance * set.tile_m, elevation = radians(kAsideElevation_deg);
    glm::dvec3 eye = eye_at(set, kAsideHeading_deg, far_m * std::cos(elevation));
    eye.z = (set.low_m + set.high_m) / 2 + far_m * std::sin(elevation);
    view::Camera camera = looking_at_tile(set, eye, options.width_px);
    std::vector<Around> around = surroundings(ground.set, count, options.seed);
    std::vector<Sitting> sittings(count, Sitting(camera));
    std::optional<ObjectMap> map;
    uint32_t of_tile = 0;
    auto seen = visit_images(images, level, [&](uint32_t tile, const Ldi& ldi) {
        if (!map || of_tile != tile) map.emplace(ground, tile, ldi.side_px), of_tile = tile;
        for (size_t k = 0; k < 9; ++k) {
            glm::dvec2 place_m = place_of(k, set.tile_m);
            Ldi own;  // what stands here of the tile in the middle, whichever that is
            for (uint32_t t = 0; t < count; ++t) {
                if (around[t][k] != int(tile)) continue;
                if (own.side_px == 0) own = map->only_of_square(ldi, -place_m);
                sittings[t].see_at(set, own, level, place_m);
            }
        }
    });
    if (!seen) return tl::unexpected(seen.error());
    Plate plate(count, columns_for(count), options.width_px, camera.height_px / 2);
    for (uint32_t t = 0; t < count; ++t) plate.put(t, sittings[t].drawn);
    return plate.picture();
}

Result<ImageRgb8> directions_portrait(const ImageReader& images, uint32_t tile, const PortraitOptions& options) {
    constexpr std::array<double, 4> kHeadings_deg{180, 270, 0, 90};
    const ImageSet& set = images.set();
    double distance_m = near_m_of(set);
    view::Camera camera = looking_at_tile(set, eye_at(set, 0, distance_m), options.width_px);
    Plate plate(8, 4, options.width_px, camera.height_px / 2);
    for (uint32_t column = 0; column < 4; ++column) {
        glm::dvec3 eye = eye_at(set, kHeadings_deg[column], distance_m);
        uint32_t direction = direction_for(set, glm::dvec2(eye) - glm::dvec2(set.tile_m / 2));
        auto ldi = images.read(index_of(set, {0, tile, 0, direction}));
        if (!ldi) return tl::unexpected(ldi.error());
        for (uint32_t turn = 0; turn < 2; ++turn) {
            Sitting sitting(moved(set, camera, eye_at(set, kHeadings_deg[(column + turn) % 4], distance_m)));
            sitting.see(set, *ldi, 0);
            plate.put(4 * turn + column, sitting.drawn);
        }
    }
    return plate.picture();
}

Result<ImageRgb8> levels_portrait(const ImageReader& images, uint32_t tile, const PortraitOptions& options) {
    const ImageSet& set = images.set();
    uint32_t coarse = level_of_side(set, (set.levels[0].side_px + 7) / 8);
    double near_m = near_m_of(set), far_m = std::max(near_m, double(set.levels[coarse].nearest_m));
    glm::dvec3 near = eye_at(set, kAsideHeading_deg, near_m), far = eye_at(set, kAsideHeading_deg, far_m);
    uint32_t direction = direction_for(set, glm::dvec2(near) - glm::dvec2(set.tile_m / 2));
    view::Camera camera = looking_at_tile(set, near, options.width_px);
    Plate plate(3, 3, options.width_px, camera.height_px / 2);
    uint32_t cell = 0;
    for (auto [level, eye] : {std::pair(coarse, far), {coarse, near}, {0u, near}}) {
        auto ldi = images.read(index_of(set, {0, tile, level, direction}));
        if (!ldi) return tl::unexpected(ldi.error());
        Sitting sitting(moved(set, camera, eye));
        sitting.see(set, *ldi, level);
        plate.put(cell++, sitting.drawn);
    }
    return plate.picture();
}

}  // namespace overlook::wang_ldi
