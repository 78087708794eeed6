#include "tools/bake/wang_ldi/figures.h"

#include <algorithm>

#include "formats/wang_layout.h"
#include "runtime/wang_ldi/random.h"

namespace overlook::wang_ldi {
namespace {

constexpr uint32_t kTilingSide = 1024, kSpectrumSide = 256, kPlantedSide = 32;
constexpr uint32_t kRings = 32;

void measure_tilings(const TileSet& set, const Recipe& recipe, const UsedTiling& used, Figures& figures) {
    figures.avoids_equal_neighbours = used.avoids_equal_neighbours;
    figures.correlation = greatest_correlation(used.tiling);
    figures.spectrum = shape_of(spectrum_of(used.tiling, set.tiles.size(), kSpectrumSide));
    figures.neighbours = count_neighbours(set, used.tiling);
    auto random = RandomTiling::of(set, recipe.seed);
    figures.block = random ? random->block() : 0;
    figures.no_random_access = random ? "" : random.error().message;
}

// Fewer where many small objects stand on each, so that what is looked at stays within memory.
uint32_t planted_side(const Planting& planting, double radius_m) {
    constexpr double kMostSquares = 1 << 20;
    double radii = planting.tile_size_m / radius_m;
    return uint32_t(std::clamp(2 + std::floor(std::sqrt(kMostSquares) / radii), 3.0, double(kPlantedSide)));
}

double least_radius_of(const Recipe& recipe) {
    double least_m = HUGE_VAL;
    for (const PlantModel& model : recipe.plant.models)
        if (model.per_tile == 0) least_m = std::min(least_m, double(model.packing_radius_m) * model.least_scale);
    return least_m;
}

void measure_spectra(const Planting& planting, const Tiling& tiling, const Recipe& recipe, Figures& figures) {
    double radius_m = least_radius_of(recipe), most_m = 0;
    for (const PlantModel& model : recipe.plant.models)
        most_m = std::max(most_m, double(model.packing_radius_m) * model.most_scale);
    if (most_m > 1.001 * radius_m) return;
    Points points = points_of(planting, tiling);
    double most_frequency = 3 / (2 * radius_m);
    figures.power = spectrum_of(points, most_frequency, kRings);
    figures.plain_power = spectrum_of(poisson_disk_points(points.size_m, radius_m, recipe.seed), most_frequency, kRings);
}

void count_borders(const TileSet& set, const Planting& planting, Figures& figures) {
    for (size_t t = 0; t < set.tiles.size(); ++t) {
        int bare = 0;
        for (uint8_t corner : corners_of(set, set.tiles[t])) bare += set.corner_density[corner] == 0;
        if (bare == 0 || bare == 4) continue;
        ++figures.border_tiles;
        figures.border_bytes += 4 + planting.tiles[t].size() * kPlantedBytes;
    }
}

}  // namespace

Result<UsedTiling> used_tiling(const TileSet& set, const SetOptions& options, uint32_t side, uint64_t seed) {
    if (options.kind == SetKind::robinson) return UsedTiling{robinson_tiling(set, side, side, seed), false};
    TilingOptions tiling_options;
    tiling_options.seed = seed, tiling_options.avoids_equal_neighbours = !can_dead_end(set);
    if (options.has_borders) {
        auto bare = uint8_t(set.corner_density.size() - 1);
        tiling_options.corner_at = [seed, bare](int64_t x, int64_t y) { return uint8_t(below(hash_of(seed, 0x63, x, y), bare)); };
    }
    auto tiling = tile_row_by_row(set, side, side, tiling_options);
    if (!tiling) return tl::unexpected(tiling.error());
    return UsedTiling{std::move(*tiling), tiling_options.avoids_equal_neighbours};
}

Result<Figures> measure_ground(const TileSet& set, const Planting& planting, const Recipe& recipe, bool with_spectra) {
    Figures figures;
    auto used = used_tiling(set, recipe.set, kTilingSide, recipe.seed);
    if (!used) return tl::unexpected(used.error());
    measure_tilings(set, recipe, *used, figures);

    Planting full = fully_planted(set, planting);
    figures.edge_reach_m = edge_reach_m(recipe.plant);
    figures.zones = zone_density(full, figures.edge_reach_m);
    figures.by_edge_distance = density_by_edge_distance(full, figures.edge_reach_m / 2, 8);
    figures.by_corner_distance = density_by_corner_distance(full, figures.edge_reach_m / 2, 8);
    figures.overlaps = check_overlaps(set, planting);
    figures.relative_radius = relative_radius(full, figures.overlaps);
    figures.tiles_with_a_place = tiles_with_a_place(set, planting, least_radius_of(recipe));

    uint32_t side = planted_side(planting, least_radius_of(recipe));
    auto planted = used_tiling(set, recipe.set, side, recipe.seed);
    if (!planted) return tl::unexpected(planted.error());
    figures.more_per_tile = more_per_tile(planting, planted->tiling, least_radius_of(recipe), recipe.seed);
    if (with_spectra) measure_spectra(planting, planted->tiling, recipe, figures);
    count_borders(set, planting, figures);
    return figures;
}

}  // namespace overlook::wang_ldi
