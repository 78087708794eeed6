#include "tools/bake/wang_ldi/evenness.h"

#include <algorithm>
#include <cmath>

namespace overlook::wang_ldi {
namespace {

double corner_distance(double size, double x, double y) {
    return std::hypot(std::min(x, size - x), std::min(y, size - y));
}
double edge_distance(double size, double x, double y) {
    return std::min(std::min(x, size - x), std::min(y, size - y));
}

// Objects and area (by a fine grid of points) of each class that `which` puts a place in, as density over the mean.
template <typename Which>
std::vector<double> densities(const Planting& planting, size_t classes, Which which) {
    constexpr int kSide = 512;
    double size = planting.tile_size_m, all = 0;
    std::vector<double> objects(classes, 0), area(classes, 0);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            size_t c = which((x + 0.5) / kSide * size, (y + 0.5) / kSide * size);
            if (c < classes) area[c] += 1.0 / (kSide * kSide);
        }
    for (const auto& tile : planting.tiles)
        for (const Planted& object : tile) {
            ++all;
            size_t c = which(double(object.x_m), double(object.y_m));
            if (c < classes) ++objects[c];
        }
    for (size_t c = 0; c < classes; ++c) objects[c] = area[c] > 0 && all > 0 ? objects[c] / all / area[c] : 1;
    return objects;
}

}  // namespace

Planting fully_planted(const TileSet& set, const Planting& planting) {
    float most = *std::max_element(set.corner_density.begin(), set.corner_density.end());
    Planting full{planting.tile_size_m, planting.models, {}};
    for (size_t t = 0; t < set.tiles.size(); ++t) {
        std::array<uint8_t, 4> corners = corners_of(set, set.tiles[t]);
        if (std::all_of(corners.begin(), corners.end(), [&](uint8_t c) { return set.corner_density[c] == most; }))
            full.tiles.push_back(planting.tiles[t]);
    }
    return full.tiles.empty() ? planting : full;
}

ZoneDensity zone_density(const Planting& planting, double reach_m) {
    double size = planting.tile_size_m;
    std::vector<double> zones = densities(planting, 3, [&](double x, double y) -> size_t {
        if (corner_distance(size, x, y) < 3 * reach_m) return 0;
        return edge_distance(size, x, y) < 2 * reach_m ? 1 : 2;
    });
    return {zones[0], zones[1], zones[2]};
}

double unevenness_of(const TileSet& set, const Planting& planting, double reach_m) {
    constexpr double kZonesAreEven = 0.02;
    Planting full = fully_planted(set, planting);
    ZoneDensity zones = zone_density(full, reach_m);
    double farthest = std::max({std::abs(zones.corner - 1), std::abs(zones.edge - 1), std::abs(zones.inside - 1)});
    double squares = 0;
    std::vector<double> profile = density_by_edge_distance(full, reach_m / 2, 8);
    for (double density : profile) squares += (density - 1) * (density - 1);
    return 100 * std::max(0.0, farthest - kZonesAreEven) + std::sqrt(squares / double(profile.size()));
}

std::vector<double> density_by_corner_distance(const Planting& planting, double step_m, size_t bins) {
    return densities(planting, bins,
                     [&](double x, double y) { return size_t(corner_distance(planting.tile_size_m, x, y) / step_m); });
}
std::vector<double> density_by_edge_distance(const Planting& planting, double step_m, size_t bins) {
    return densities(planting, bins,
                     [&](double x, double y) { return size_t(edge_distance(planting.tile_size_m, x, y) / step_m); });
}

}  // namespace overlook::wang_ldi
