#include <algorithm>
#include <array>
#include <cmath>

#include "formats/wang_ldi_layout.h"

namespace overlook::wang_ldi {
namespace {

constexpr std::array<std::string_view, 16> kRules{
    "The sections WLDI, uncompressed, and WLDS, checked in parts, are both there.",
    "WLDI is 128 bytes, 16 for each level and 40 for each image, and no more.",
    "There are 1 to 65,536 tiles, 1 to 32 levels, 1 to 64 directions and 1 or 2 contexts, 2^20 images at most.",
    "The flags are known ones, reserved numbers are 0.",
    "The tile's size and heights, the cell, the fades and the sun's direction are finite and in their ranges.",
    "Levels have 1 to 4,096 pixels a side, fewer from level to level, ascending nearest distances, steps that reach from the "
    "lowest height to the highest, and splats of at most 64 pixels.",
    "WLDS is its images, one after the other, the last ending with it.",
    "An image has as many raw bytes as its pixels, samples and colours need, 2^30 at most, 2^26 samples at most, and 1 to 256 "
    "colours if it has samples; its unseen share is 0 to 1.",
    "An image's stored bytes have its checksum.",
    "An image is one zstd frame of exactly its raw bytes.",
    "An image's pixels have as many samples together as it has.",
    "Heights ascend within a pixel, each by a step at least, and none lies above the highest.",
    "A sample's colour is in its image's palette.",
    "A normal is on the octahedron's square, -127 to 127.",
    "A splat is wider than nothing.",
    "Groups of grouped rows have as many numbers as they state, with zeros behind the last.",
};

bool is_between(double value, double low, double high) {
    return value >= low && value <= high;
}  // false for NaN

}  // namespace

std::string_view image_rule_text(int rule) {
    return rule >= 1 && rule <= image_rule_count() ? kRules[size_t(rule - 1)] : std::string_view();
}
int image_rule_count() {
    return int(kRules.size());
}

ImageFault fault_of_counts(const ImageSet& set) {
    auto is_in = [](uint64_t count, uint64_t most) { return count >= 1 && count <= most; };
    bool is_fine = is_in(set.tile_count, kMostImageTiles) && is_in(set.levels.size(), kMostLevels) &&
                   is_in(set.direction_count, kMostDirections) && is_in(set.context_count, kMostContexts) &&
                   set.ldi_count() <= kMostLdis;
    if (is_fine) return {};
    return {3, fmt::format("{} tiles, {} levels, {} directions, {} contexts", set.tile_count, set.levels.size(),
                           set.direction_count, set.context_count)};
}

ImageFault fault_of_places(const ImageSet& set) {
    const Cell& cell = set.cell;
    bool is_fine = is_between(set.tile_m, 1e-3, 1e6) && is_between(set.low_m, -1e6, 1e6) && is_between(set.high_m, -1e6, 1e6) &&
                   set.low_m < set.high_m;
    if (!is_fine) return {5, fmt::format("a tile of {} m, heights from {} to {} m", set.tile_m, set.low_m, set.high_m)};
    bool is_cell = is_between(cell.eye_low_m, -1e6, 1e6) && is_between(cell.eye_high_m, cell.eye_low_m, 1e6) &&
                   is_between(cell.nearest_m, 0, 1e6) && is_between(cell.farthest_m, cell.nearest_m, 1e6) &&
                   is_between(cell.focal_px, 1, 1e6) && is_between(cell.error_px, 1e-6, 1e6);
    if (!is_cell)
        return {5, fmt::format("a cell of eyes {} to {} m up and {} to {} m away, a focal length of {} px, an error of {} px",
                               cell.eye_low_m, cell.eye_high_m, cell.nearest_m, cell.farthest_m, cell.focal_px, cell.error_px)};
    if (!is_between(double(set.level_fade), 0, 0.5) || !is_between(double(set.direction_fade), 0, 0.5))
        return {5, fmt::format("fades of {} and {}", set.level_fade, set.direction_fade)};
    double length = glm::length(set.to_sun);
    if (length == 0 || std::abs(length - 1) < 1e-6) return {};
    return {5, fmt::format("a direction to the sun of ({}, {}, {})", set.to_sun.x, set.to_sun.y, set.to_sun.z)};
}

ImageFault fault_of_levels(const ImageSet& set) {
    uint32_t side = kMostSide_px + 1;
    double nearest = -1;
    for (size_t k = 0; k < set.levels.size(); ++k) {
        const Level& level = set.levels[k];
        bool is_fine = level.side_px >= 1 && level.side_px < side && is_between(double(level.nearest_m), 0, 1e6) &&
                       double(level.nearest_m) > nearest && is_between(double(level.height_step_m), 1e-9, 1e6) &&
                       set.low_m + 65535 * double(level.height_step_m) >= set.high_m && level.splat_px > 0 &&
                       level.splat_px <= kMostSplat_px;
        if (!is_fine)
            return {6, fmt::format("level {} has {} pixels a side, begins at {} m, has steps of {} m and splats of {} px", k,
                                   level.side_px, level.nearest_m, level.height_step_m, level.splat_px)};
        side = level.side_px, nearest = double(level.nearest_m);
    }
    return {};
}

uint32_t highest_step(const ImageSet& set, uint32_t level) {
    return uint32_t(std::min(65535.0, std::ceil((set.high_m - set.low_m) / double(set.levels[level].height_step_m))));
}

ImageFault fault_of_ldi(const ImageSet& set, uint32_t level, const Ldi& ldi) {
    uint32_t steps = highest_step(set, level);
    for (size_t p = 0; p + 1 < ldi.first.size(); ++p) {
        for (uint32_t s = ldi.first[p]; s < ldi.first[p + 1]; ++s) {
            bool ascends = s == ldi.first[p] || ldi.heights[s] > ldi.heights[s - 1];
            if (!ascends || ldi.heights[s] > steps)
                return {12, fmt::format("sample {} in pixel {} is at step {}", s, p, ldi.heights[s])};
        }
    }
    for (size_t s = 0; s < ldi.heights.size(); ++s) {
        if (ldi.colours[s] >= ldi.palette.size())
            return {13, fmt::format("sample {} has colour {}, there are {}", s, ldi.colours[s], ldi.palette.size())};
        if (set.has_normals && (ldi.normals[s][0] == -128 || ldi.normals[s][1] == -128))
            return {14, fmt::format("sample {} has a normal of -128", s)};
        if (set.has_splats && ldi.splats[s] == 0) return {15, fmt::format("sample {} has a splat of 0", s)};
    }
    return {};
}

uint64_t index_of(const ImageSet& set, const Which& which) {
    uint64_t tile = uint64_t(which.context) * set.tile_count + which.tile;
    return (tile * set.levels.size() + which.level) * set.direction_count + which.direction;
}

Which which_of(const ImageSet& set, uint64_t index) {
    Which which;
    which.direction = uint32_t(index % set.direction_count), index /= set.direction_count;
    which.level = uint32_t(index % set.levels.size()), index /= set.levels.size();
    which.tile = uint32_t(index % set.tile_count), which.context = uint32_t(index / set.tile_count);
    return which;
}

SampledFor sampled_for(const ImageSet& set, uint32_t level, uint32_t direction) {
    double step_rad = 2 * M_PI / set.direction_count, fade = double(set.level_fade);
    double begins_m = double(set.levels[level].nearest_m);
    bool is_last = level + 1 == set.levels.size();
    double ends_m = is_last ? std::max(set.cell.farthest_m, begins_m) : double(set.levels[level + 1].nearest_m);
    return {begins_m * (1 - fade), ends_m * (1 + fade), direction * step_rad, (0.5 + double(set.direction_fade)) * step_rad};
}

bool is_sampled_for(const ImageSet& set, uint32_t level, uint32_t direction, const glm::dvec2& from_middle_m, double above_m) {
    constexpr double kRounding = 1e-6;
    SampledFor eyes = sampled_for(set, level, direction);
    double distance_m = glm::length(from_middle_m), heading_rad = std::atan2(from_middle_m.x, from_middle_m.y);
    double off_rad = std::abs(std::remainder(heading_rad - eyes.heading_rad, 2 * M_PI));
    double slack_m = kRounding * std::max({1.0, std::abs(set.cell.eye_low_m), std::abs(set.cell.eye_high_m)});
    return above_m >= set.cell.eye_low_m - slack_m && above_m <= set.cell.eye_high_m + slack_m &&
           distance_m >= eyes.nearest_m * (1 - kRounding) && distance_m <= eyes.farthest_m * (1 + kRounding) &&
           off_rad <= eyes.half_width_rad + kRounding;
}

uint32_t direction_for(const ImageSet& set, const glm::dvec2& from_middle_m) {
    uint32_t best = 0;
    double greatest = -INFINITY;
    for (uint32_t d = 0; d < set.direction_count; ++d) {
        double heading = 2 * M_PI * d / set.direction_count;
        double along = from_middle_m.x * std::sin(heading) + from_middle_m.y * std::cos(heading);
        if (along > greatest) greatest = along, best = d;
    }
    return best;
}

uint32_t level_for(const ImageSet& set, double distance_m) {
    uint32_t level = 0;
    while (level + 1 < set.levels.size() && distance_m >= double(set.levels[level + 1].nearest_m)) ++level;
    return level;
}

}  // namespace overlook::wang_ldi
