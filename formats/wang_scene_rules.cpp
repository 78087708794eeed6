#include <algorithm>
#include <cmath>

#include "formats/steady_math.h"
#include "formats/wang_scene_layout.h"

namespace overlook::wang_ldi {
namespace {

constexpr std::array<std::string_view, 8> kRules{
    "The sections WSCN and WSCP, compressed, are both there.",
    "WSCN is 8 bytes, one for each tile and an image; WSCP is 8 bytes and as many pictures as it says, 4,096 at most; an image "
    "or "
    "picture is 96 bytes and its rows, and no more; neither section has more than 2^28.",
    "The scene is 1 to 1,024 tiles wide and long, each of the file's set.",
    "The flags are known ones, reserved numbers are 0.",
    "A view's place, angles, size, depths, cell and unseen share are finite and in their ranges.",
    "A picture's pixels have as many samples together as it has, 2^25 at most.",
    "Depths ascend within a pixel, each by a step at least.",
    "A normal's numbers are -127 to 127.",
};

bool is_between(double value, double low, double high) {
    return value >= low && value <= high;
}  // false for NaN

}  // namespace

std::string_view scene_rule_text(int rule) {
    return rule >= 1 && rule <= scene_rule_count() ? kRules[size_t(rule - 1)] : std::string_view();
}
int scene_rule_count() {
    return int(kRules.size());
}

double depth_of_code(const PerspectiveView& view, uint16_t code) {
    return view.near_m * steady::exp2(steady::log2(view.far_m / view.near_m) * (double(code) / 65535));
}
uint16_t code_of_depth(const PerspectiveView& view, double depth_m) {
    double step = 65535 * steady::log2(depth_m / view.near_m) / steady::log2(view.far_m / view.near_m);
    return uint16_t(std::clamp(std::round(step), 0.0, 65535.0));
}

ImageFault fault_of_scene_tiles(const Scene& scene, uint32_t tile_count) {
    auto is_in = [](uint32_t count) { return count >= 1 && count <= kMostSceneTiles; };
    if (!is_in(scene.columns) || !is_in(scene.rows)) return {3, fmt::format("{} x {} tiles", scene.columns, scene.rows)};
    for (size_t t = 0; t < scene.tiles.size(); ++t)
        if (scene.tiles[t] >= tile_count)
            return {3, fmt::format("tile {} at column {}, row {}; the set has {}", scene.tiles[t], t % scene.columns,
                                   t / scene.columns, tile_count)};
    return {};
}

ImageFault fault_of_view(const PerspectiveLdi& image) {
    const PerspectiveView& view = image.view;
    bool is_there = is_between(view.position_m.x, -1e6, 1e6) && is_between(view.position_m.y, -1e6, 1e6) &&
                    is_between(view.position_m.z, -1e6, 1e6) && is_between(view.heading_deg, -360, 360) &&
                    is_between(view.pitch_deg, -90, 90) && is_between(view.fov_y_deg, 1, 170);
    if (!is_there)
        return {5, fmt::format("an eye at ({}, {}, {}) m, a heading of {}, a pitch of {} and a field of view of {} degrees",
                               view.position_m.x, view.position_m.y, view.position_m.z, view.heading_deg, view.pitch_deg,
                               view.fov_y_deg)};
    auto is_side = [](uint32_t side_px) { return side_px >= 1 && side_px <= kMostPerspectiveSide_px; };
    bool is_fine = is_side(view.width_px) && is_side(view.height_px) && is_between(view.near_m, 1e-4, 1e6) &&
                   is_between(view.far_m, view.near_m * 1.001, 1e7) && is_between(image.cell_m, 0, 1e6) &&
                   is_between(double(image.unseen_share), 0, 1);
    if (is_fine) return {};
    return {5, fmt::format("{} x {} pixels from {} to {} m for eyes within {} m, {} of it unseen", view.width_px, view.height_px,
                           view.near_m, view.far_m, image.cell_m, image.unseen_share)};
}

ImageFault fault_of_samples(const PerspectiveLdi& image) {
    for (size_t p = 0; p + 1 < image.first.size(); ++p)
        for (uint32_t s = image.first[p] + 1; s < image.first[p + 1]; ++s)
            if (image.depths[s] <= image.depths[s - 1])
                return {7, fmt::format("pixel {} has a sample at step {} behind one at step {}", p, image.depths[s],
                                       image.depths[s - 1])};
    for (size_t s = 0; s < image.normals.size(); ++s)
        if (image.normals[s][0] == -128 || image.normals[s][1] == -128)
            return {8, fmt::format("sample {} has a normal of -128", s)};
    return {};
}

}  // namespace overlook::wang_ldi
