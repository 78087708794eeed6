#include "runtime/wang_ldi/fade.h"

#include <algorithm>
#include <cmath>

#include "runtime/wang_ldi/tile_error.h"

namespace overlook::wang_ldi {
namespace {

// How far a value is through a band, in kWhole parts.
uint32_t share_of(double value, double from, double to) {
    if (value < from) return 0;
    if (value >= to) return kWhole;
    return uint32_t((value - from) / (to - from) * kWhole);
}

void add_far_rungs(const LadderOptions& options, double texture_from_m, std::vector<Rung>& wanted) {
    if (std::isinf(texture_from_m)) return;
    double from_m = options.texel_from_m;
    for (uint32_t level = 0; level == 0 || from_m < kFarthest_m; ++level, from_m *= 2) {
        bool is_texture = level < options.texture_levels;
        uint32_t own = is_texture ? level : level - options.texture_levels + 1;
        double at_m = level == 0 ? texture_from_m : std::max(from_m, texture_from_m);
        wanted.push_back({is_texture ? Stage::texture : Stage::colour, own, at_m, 0, 0});
    }
}

}  // namespace

Ladder ladder_of(const ImageSet& set, const LadderOptions& options) {
    std::vector<Rung> wanted;
    if (options.geometry_to_m > 0) wanted.push_back({Stage::geometry, 0, 0, 0, 0});
    double images_from_m = std::max(options.geometry_to_m, 0.0), images_to_m = std::min(options.texture_from_m, options.radius_m);
    uint32_t first = level_for(set, images_from_m * options.coarser);
    double rim_m = set.tile_m * std::sqrt(0.5), keeps_m = images_to_m * (1 - options.fade_share) - rim_m;
    double in_fading = (1 + options.fade_share) / (1 - options.fade_share);  // the last level gives way as the error shrinks
    for (uint32_t level = first; level < set.levels.size(); ++level) {
        if (level > first && !(sample_error_m(set, level, 0) * in_fading * options.samples_from < keeps_m)) break;
        wanted.push_back(
            {Stage::ldi, level, level == first ? images_from_m : double(set.levels[level].nearest_m) / options.coarser, 0, 0});
    }
    add_far_rungs(options, std::max(options.texture_from_m, images_from_m), wanted);
    wanted.push_back({Stage::bare, 0, options.radius_m, 0, 0});

    Ladder ladder;
    for (const Rung& rung : wanted) {
        if (std::isinf(rung.from_m) || (rung.stage == Stage::ldi && rung.from_m >= images_to_m)) continue;
        if (rung.stage < Stage::bare && rung.from_m >= options.radius_m) continue;
        if (!ladder.rungs.empty() && ladder.rungs.back().from_m >= rung.from_m) ladder.rungs.pop_back();
        ladder.rungs.push_back(rung);
    }
    auto& rungs = ladder.rungs;
    for (size_t r = 1; r < rungs.size(); ++r) {
        double from_m = rungs[r].from_m, half = options.fade_share * from_m;
        half = std::min(half, (from_m - rungs[r - 1].from_m) / 2);
        if (r + 1 < rungs.size()) half = std::min(half, (rungs[r + 1].from_m - from_m) / 2);
        rungs[r].fade_from_m = from_m - half, rungs[r].fade_to_m = from_m + half;
    }
    auto coarsest = uint32_t(set.levels.size() - 1), finest = coarsest;
    for (const Rung& rung : rungs)
        if (rung.stage == Stage::ldi) finest = std::min(finest, rung.level);
    bool has_coarsest = std::any_of(rungs.begin(), rungs.end(),
                                    [&](const Rung& rung) { return rung.stage == Stage::ldi && rung.level == coarsest; });
    if (finest < coarsest && !has_coarsest) rungs.push_back({Stage::ldi, coarsest, INFINITY, INFINITY, INFINITY});
    return ladder;
}

Mix rungs_at(const Ladder& ladder, double distance_m) {
    uint32_t last = 0;
    while (last + 1 < ladder.rungs.size() && distance_m >= ladder.rungs[last + 1].fade_from_m) ++last;
    if (last == 0) return {0, 0, 0};
    const Rung& rung = ladder.rungs[last];
    uint32_t share = share_of(distance_m, rung.fade_from_m, rung.fade_to_m);
    if (share == kWhole) return {last, last, 0};
    return share == 0 ? Mix{last - 1, last - 1, 0} : Mix{last - 1, last, share};
}

Mix directions_at(const ImageSet& set, const glm::dvec2& eye_from_middle_m, double fade_share) {
    uint32_t count = set.direction_count, nearest = direction_for(set, eye_from_middle_m);
    if (fade_share <= 0 || count == 1) return {nearest, nearest, 0};
    double step = 2 * M_PI / count, heading = std::atan2(eye_from_middle_m.x, eye_from_middle_m.y);
    double off = std::remainder(heading - nearest * step, 2 * M_PI) / step;  // -0.5 .. 0.5
    double edge = 0.5 - std::abs(off);
    if (edge >= fade_share) return {nearest, nearest, 0};
    // The one counter-clockwise is the first, whichever is the nearer, so that the places that show each stay the same.
    uint32_t first = off < 0 ? (nearest + count - 1) % count : nearest, second = (first + 1) % count;
    uint32_t share = share_of(off < 0 ? edge : -edge, -fade_share, fade_share);
    if (share == 0) return {first, first, 0};
    return share == kWhole ? Mix{second, second, 0} : Mix{first, second, share};
}

}  // namespace overlook::wang_ldi
