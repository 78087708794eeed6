#include "tools/bake/wang_ldi/levels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "formats/numbers.h"
#include "formats/steady_math.h"

namespace overlook::wang_ldi {
namespace {

constexpr std::array<uint32_t, 7> kPaperSides_px{468, 232, 151, 111, 88, 73, 62};
constexpr uint32_t kPaperDirections = 8;
constexpr uint32_t kLeastSide_px = 4;
constexpr double kNearestTiles = 2.5, kFarthestTiles = 40;

Level level_of(const LevelOptions& options, uint32_t side_px, double nearest_m) {
    double step_m = options.set.tile_m / side_px / options.steps_per_pixel;
    double least_m = (options.set.high_m - options.set.low_m) / 65534;
    return {side_px, float(nearest_m), float(std::max(step_m, least_m)), 1};
}

void take_paper(const LevelOptions& options, ImageSet& set) {
    for (size_t k = 0; k < kPaperSides_px.size(); ++k)
        set.levels.push_back(level_of(options, kPaperSides_px[k], (double(k) + 0.5) * set.tile_m));
    set.cell.nearest_m = 0.5 * set.tile_m, set.cell.farthest_m = 7.5 * set.tile_m;
    set.direction_count = kPaperDirections;
    set.level_fade = set.direction_fade = 0;
}

// Where a level that begins at distance_m begins to be shown.
double shown_from_m(const ImageSet& set, double distance_m) {
    return distance_m * (1 - double(set.level_fade));
}

double side_wanted(const ImageSet& set, double distance_m) {
    double nearest_m = nearest_of_tile_m(set, shown_from_m(set, distance_m));
    return set.tile_m * set.cell.focal_px / (set.cell.error_px * nearest_m);
}

// Where a level begins whose pixels are `ratio` times as wide as at distance_m.
double next_distance_m(const ImageSet& set, double distance_m, double ratio) {
    auto nearest_m = [&](double distance) { return nearest_of_tile_m(set, shown_from_m(set, distance)); };
    double wanted = ratio * nearest_m(distance_m), low = distance_m, high = 2 * ratio * (distance_m + set.tile_m);
    while (nearest_m(high) < wanted) high *= 2;
    for (int round = 0; round < 60; ++round) {
        double middle = (low + high) / 2;
        (nearest_m(middle) < wanted ? low : high) = middle;
    }
    return high;
}

Result<void> choose_directions(const LevelOptions& options, ImageSet& set) {
    double rim_m = set.tile_m / std::sqrt(2.0), distance_m = shown_from_m(set, set.cell.nearest_m);
    auto turn_px = [&](uint32_t count) {
        double turn_rad = std::min(1.0, (1 + 2 * double(set.direction_fade)) / count) * M_PI;
        return rim_turn_px(rim_m, distance_m, turn_rad, set.cell.focal_px);
    };
    set.direction_count = 1;
    while (set.direction_count < kMostDirections && turn_px(set.direction_count) > options.direction_px) ++set.direction_count;
    double turned_px = turn_px(set.direction_count);
    if (turned_px <= options.direction_px) return {};
    return bad_command(
        "a tile's rim turns by {:.4g} px within each of {} directions, the most that are possible; --direction-px {:.4g} at "
        "least, or a greater --nearest-m",
        turned_px, kMostDirections, std::ceil(turned_px * 10 + 0.1) / 10);
}

Result<void> choose(const LevelOptions& options, ImageSet& set) {
    double at = set.cell.nearest_m, rim = set.tile_m / std::sqrt(2.0);
    if (shown_from_m(set, at) <= rim)
        return bad_command(
            "tiles begin at {:g} m from the eye, within a tile of {} m; --nearest-m {} at least, nearer ones are drawn as "
            "geometry",
            shown_from_m(set, at), set.tile_m, std::ceil(rim / shown_from_m(set, 1) * 100 + 1) / 100);
    if (double most = side_wanted(set, at); most > kMostSide_px)
        return bad_command(
            "a pixel error of {} px needs {} pixels along a tile, {} are possible; ask for more error or a greater nearest "
            "distance",
            set.cell.error_px, with_commas(uint64_t(most)), with_commas(kMostSide_px));
    set.levels.push_back(level_of(options, std::max(kLeastSide_px, uint32_t(std::ceil(side_wanted(set, at)))), at));
    while (set.levels.size() < kMostLevels) {
        at = next_distance_m(set, at, options.level_ratio);
        auto side = uint32_t(std::ceil(side_wanted(set, at)));
        if (at >= set.cell.farthest_m || side >= set.levels.back().side_px || side < kLeastSide_px) break;
        set.levels.push_back(level_of(options, side, at));
    }
    return choose_directions(options, set);
}

}  // namespace

double nearest_of_tile_m(const ImageSet& set, double distance_m) {
    double ground = std::max(0.0, distance_m - set.tile_m / std::sqrt(2.0));
    double above = std::max({0.0, set.cell.eye_low_m - set.high_m, set.low_m - set.cell.eye_high_m});
    return std::max(std::hypot(ground, above), 1e-3);
}

// A point at the angle a from the eye's side is seen at a tangent of rim sin a / (distance - rim cos a), whose slope is steepest
// and even about a = 0 and which is greatest where cos a = rim / distance.
double rim_turn_px(double rim_m, double distance_m, double turn_rad, double focal_px) {
    double half_rad = turn_rad / 2;
    if (steady::cos(half_rad) < rim_m / distance_m)
        return focal_px * 2 * rim_m / std::sqrt(distance_m * distance_m - rim_m * rim_m);
    return focal_px * 2 * rim_m * steady::sin(half_rad) / (distance_m - rim_m * steady::cos(half_rad));
}

Result<ImageSet> leveled(const LevelOptions& options) {
    ImageSet set = options.set;
    set.levels.clear();
    if (options.constants == Constants::paper) {
        take_paper(options, set);
        return set;
    }
    if (set.cell.nearest_m == 0) set.cell.nearest_m = kNearestTiles * set.tile_m;
    if (set.cell.farthest_m == 0) set.cell.farthest_m = std::max(kFarthestTiles * set.tile_m, set.cell.nearest_m);
    if (set.cell.farthest_m < set.cell.nearest_m)
        return bad_command("tiles {} m from the eye at most, {} m at least; give --farthest-m {} or more, or --nearest-m",
                           set.cell.farthest_m, set.cell.nearest_m, set.cell.nearest_m);
    if (auto chosen = choose(options, set); !chosen) return tl::unexpected(chosen.error());
    return set;
}

}  // namespace overlook::wang_ldi
