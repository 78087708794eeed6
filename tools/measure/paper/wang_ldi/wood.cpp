#include "tools/measure/paper/wang_ldi/wood.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <numbers>

#include "runtime/gl/timer.h"
#include "runtime/view/picture_rays.h"
#include "tools/measure/paper/wang_ldi/one_direction.h"

namespace overlook::measure::paper::wang {
namespace {

constexpr uint32_t kSide = 2 * uint32_t(kRadius_tiles) + 4;  // of the ground, in tiles
constexpr double kHeading_deg = 25, kPitch_deg = -4;
constexpr std::array<uint8_t, 3> kEarth{92, 84, 58}, kZenith{120, 160, 205}, kHorizon{205, 218, 226};

// Whether a sphere round a tile meets what the camera sees.
bool is_in_sight(const view::Camera& camera, const std::array<glm::dvec3, 4>& sides, const glm::dvec3& middle_m,
                 double radius_m) {
    return std::all_of(sides.begin(), sides.end(), [&](const glm::dvec3& side) {
        return glm::dot(side, middle_m - camera.position_m) >= -radius_m * glm::length(side);
    });
}

std::array<uint8_t, 3> mixed(const std::array<uint8_t, 3>& a, const std::array<uint8_t, 3>& b, double share) {
    std::array<uint8_t, 3> colour{};
    for (size_t c = 0; c < 3; ++c) colour[c] = uint8_t(a[c] + (b[c] - a[c]) * std::clamp(share, 0.0, 1.0) + 0.5);
    return colour;
}

std::array<uint8_t, 3> hue_of(double share, double value) {
    std::array<uint8_t, 3> colour{};
    for (size_t c = 0; c < 3; ++c) {
        double k = std::fmod(5 - 2 * double(c) + 6 * share, 6.0);
        colour[c] = uint8_t(255 * value * (1 - 0.6 * std::clamp(std::min(k, 4 - k), 0.0, 1.0)) + 0.5);
    }
    return colour;
}

}  // namespace

Result<Wood> Wood::make(const Bake& bake, uint64_t seed) {
    Wood wood(bake);
    auto tiling = wang_ldi::tile_square(bake.ground.set, kSide, seed);
    if (!tiling) return tl::unexpected(Error{tiling.error().exit, bake.path + ": " + tiling.error().message});
    wood.tiling_ = std::move(*tiling);
    return wood;
}

Wood::Wood(const Bake& bake, const wang_ldi::Scene& scene)
    : bake_(&bake), radius_m_(std::numeric_limits<double>::infinity()), tiling_{scene.columns, scene.rows, scene.tiles} {}

view::Camera Wood::camera(uint32_t width_px, uint32_t height_px) const {
    view::Camera camera;
    glm::dvec2 middle = middle_m(kSide / 2, kSide / 2);
    camera.position_m = {middle, (set().cell.eye_low_m + set().cell.eye_high_m) / 2};
    camera.heading_deg = kHeading_deg, camera.pitch_deg = kPitch_deg;
    camera.width_px = width_px, camera.height_px = height_px, camera.near_m = 0.1;
    return camera;
}

Result<WoodCounts> Wood::draw(const view::Camera& camera, wang_ldi::Warped& picture, wang_ldi::Hiding hiding) {
    double tile_m = set().tile_m, radius_m = std::hypot(tile_m * 0.75, (set().high_m - set().low_m) / 2 + tile_m / 4);
    std::array<glm::dvec3, 4> sides = view::sides_of(camera);
    std::vector<wang_ldi::Drawn> drawn;
    std::deque<wang_ldi::Ldi> facing_eye;
    WoodCounts counts;
    for (uint32_t row = 0; row < tiling_.rows; ++row)
        for (uint32_t column = 0; column < tiling_.columns; ++column) {
            glm::dvec2 middle = middle_m(column, row), from_middle = glm::dvec2(camera.position_m) - middle;
            double distance_m = glm::length(from_middle);
            glm::dvec3 inside(middle, (set().low_m + set().high_m) / 2);
            if (distance_m > radius_m_ || !is_in_sight(camera, sides, inside, radius_m)) continue;
            uint32_t level = level_for(set(), distance_m);
            uint64_t index =
                index_of(set(), {0, tiling_.at(column, row), level, distance_m > 0 ? direction_for(set(), from_middle) : 0});
            auto at = images_.find(index);
            if (at == images_.end()) {
                auto ldi = bake_->images().read(index);
                if (!ldi) return tl::unexpected(ldi.error());
                at = images_.emplace(index, std::move(*ldi)).first;
            }
            counts.samples += at->second.sample_count();
            const wang_ldi::Ldi* ldi = &at->second;
            if (skips_)
                ldi = &facing_eye.emplace_back(facing(set(), level, *ldi, camera.position_m, glm::dvec2(column, row) * tile_m));
            counts.kept += ldi->sample_count();
            drawn.push_back({ldi, level, {column * tile_m, row * tile_m, 0}, glm::dvec2(0), 1});
        }
    order_of_tiles(camera.position_m, tile_m, drawn);
    gl::Timer timer;
    warp(camera, set(), drawn, hiding, picture);
    counts.warp_ms = timer.elapsed_ms(), counts.tiles = drawn.size();
    counts.pixels = uint64_t(picture.colours.size()) - uint64_t(std::count(picture.colours.begin(), picture.colours.end(), 0u));
    return counts;
}

ImageRgb8 Wood::rings(const view::Camera& camera, uint32_t tiles, uint32_t tile_px) const {
    uint32_t side = 2 * tiles + 1;
    double tile_m = set().tile_m;
    ImageRgb8 picture{side * tile_px, side * tile_px, {}};
    for (uint32_t y = 0; y < side * tile_px; ++y)
        for (uint32_t x = 0; x < side * tile_px; ++x) {
            bool is_line = x % tile_px == 0 || y % tile_px == 0;
            glm::dvec2 eye = glm::dvec2(camera.position_m) / tile_m;
            glm::dvec2 tile = glm::floor(eye) + glm::dvec2(x / tile_px, side - 1 - y / tile_px) - double(tiles);
            glm::dvec2 from_middle = (eye - tile - 0.5) * tile_m;
            uint32_t level = level_for(set(), glm::length(from_middle));
            double hue = glm::length(from_middle) > 0 ? double(direction_for(set(), from_middle)) / set().direction_count : 0;
            double value = 1 - 0.75 * double(level) / double(set().levels.size());
            auto colour = hue_of(hue, is_line ? 0.7 * value : value);
            picture.pixels.insert(picture.pixels.end(), colour.begin(), colour.end());
        }
    return picture;
}

ImageRgb8 with_ground(const view::Camera& camera, const wang_ldi::Warped& picture) {
    view::PictureRays rays(camera);
    ImageRgb8 image{picture.width_px, picture.height_px, {}};
    for (uint32_t y = 0; y < picture.height_px; ++y)
        for (uint32_t x = 0; x < picture.width_px; ++x) {
            uint32_t drawn = picture.colours[size_t(y) * picture.width_px + x];
            glm::dvec3 along = rays.through_pixel(x, y);
            double up = along.z / glm::length(along);
            std::array<uint8_t, 3> colour =
                up > 0 ? mixed(kHorizon, kZenith, 2 * up) : mixed(kEarth, kHorizon, std::min(1.0, 0.012 / std::max(-up, 1e-6)));
            if (drawn != 0) colour = {uint8_t(drawn), uint8_t(drawn >> 8), uint8_t(drawn >> 16)};
            image.pixels.insert(image.pixels.end(), colour.begin(), colour.end());
        }
    return image;
}

}  // namespace overlook::measure::paper::wang
