#include "tools/bake/wang_ldi/planting_check.h"

#include <algorithm>
#include <numbers>
#include <vector>

#include "tools/bake/wang_ldi/free_area.h"

namespace overlook::wang_ldi {
namespace {

double packing_of(const Planting& planting, const Planted& object) {
    return double(planting.models[object.model].packing_radius_m) * double(object.scale);
}
double tight_of(const Planting& planting, const Planted& object) {
    return double(planting.models[object.model].tight_radius_m) * double(object.scale);
}

class Overlaps {
  public:
    Overlaps(const TileSet& set, const Planting& planting) : set_(set), planting_(planting) {
        report_.least_tight_gap_m = HUGE_VAL, report_.least_packing_ratio = HUGE_VAL;
    }
    OverlapReport run() {
        size_t count = set_.tiles.size();
        for (size_t a = 0; a < count; ++a)
            for (size_t b = 0; b < count; ++b) {
                if (a == b) look(a, b, 0, 0);
                if (set_.tiles[a].east == set_.tiles[b].west) look(a, b, 1, 0);
                if (set_.tiles[a].north == set_.tiles[b].south) look(a, b, 0, 1);
                if (meet_north_east(set_.tiles[a], set_.tiles[b])) look(a, b, 1, 1);
                if (meet_north_west(set_.tiles[a], set_.tiles[b])) look(a, b, -1, 1);
            }
        return report_;
    }

  private:
    template <typename Fits>
    bool some(Fits fits) const {
        return std::any_of(set_.tiles.begin(), set_.tiles.end(), fits);
    }
    // Whether two more tiles complete the four about a corner.
    bool meet_north_east(const Tile& a, const Tile& b) const {
        return some([&](const Tile& t) { return t.west == a.east && t.north == b.south; }) &&
               some([&](const Tile& t) { return t.south == a.north && t.east == b.west; });
    }
    bool meet_north_west(const Tile& a, const Tile& b) const {
        return some([&](const Tile& t) { return t.east == a.west && t.north == b.south; }) &&
               some([&](const Tile& t) { return t.south == a.north && t.west == b.east; });
    }
    void look(size_t a, size_t b, int x_tiles, int y_tiles) {
        ++report_.neighbourhoods;
        double size = planting_.tile_size_m;
        bool is_same = x_tiles == 0 && y_tiles == 0;
        for (size_t i = 0; i < planting_.tiles[a].size(); ++i)
            for (size_t j = is_same ? i + 1 : 0; j < planting_.tiles[b].size(); ++j) {
                const Planted &p = planting_.tiles[a][i], &q = planting_.tiles[b][j];
                double apart =
                    std::hypot(double(q.x_m) + x_tiles * size - double(p.x_m), double(q.y_m) + y_tiles * size - double(p.y_m));
                double gap = apart - tight_of(planting_, p) - tight_of(planting_, q);
                double ratio = apart / (packing_of(planting_, p) + packing_of(planting_, q));
                report_.tight_overlaps += gap < 0, report_.packing_overlaps += ratio < 1;
                report_.least_tight_gap_m = std::min(report_.least_tight_gap_m, gap);
                report_.least_packing_ratio = std::min(report_.least_packing_ratio, ratio);
            }
    }

    const TileSet& set_;
    const Planting& planting_;
    OverlapReport report_;
};

}  // namespace

OverlapReport check_overlaps(const TileSet& set, const Planting& planting) {
    return Overlaps(set, planting).run();
}

double relative_radius(const Planting& planting, const OverlapReport& overlaps) {
    const double kHexagonal = std::numbers::pi / (2 * std::numbers::sqrt3);
    double covered = 0;
    for (const auto& tile : planting.tiles)
        for (const Planted& object : tile) covered += std::numbers::pi * std::pow(packing_of(planting, object), 2);
    double share = covered / double(planting.tiles.size()) / (planting.tile_size_m * planting.tile_size_m);
    return std::sqrt(share / kHexagonal) * overlaps.least_packing_ratio;
}

uint32_t tiles_with_a_place(const TileSet& set, const Planting& planting, double least_radius_m) {
    double size = planting.tile_size_m, most = least_radius_m, slack = 3e-6 * size;
    for (const auto& tile : planting.tiles)
        for (const Planted& object : tile) most = std::max(most, packing_of(planting, object));
    most += slack;
    uint32_t count = 0;
    for (size_t t = 0; t < set.tiles.size(); ++t) {
        DiscGrid grid({-2 * most, -2 * most, size + 2 * most, size + 2 * most}, most);
        std::vector<Planted> all = overhang(set, planting, t);
        all.insert(all.end(), planting.tiles[t].begin(), planting.tiles[t].end());
        for (const Planted& object : all) grid.add({double(object.x_m), double(object.y_m), packing_of(planting, object)});
        Bounds tile{0, 0, size, size};
        FreeArea area(std::span(&tile, 1), least_radius_m + slack, 1e-4 * least_radius_m);
        Random random(t);
        count += area.draw(grid, random).has_value();
    }
    return count;
}

double more_per_tile(const Planting& planting, const Tiling& tiling, double radius_m, uint64_t seed) {
    double size = planting.tile_size_m, slack = 3e-6 * size, most = radius_m;
    for (const auto& tile : planting.tiles)
        for (const Planted& object : tile) most = std::max(most, packing_of(planting, object));
    most += slack;
    Bounds all{0, 0, tiling.columns * size, tiling.rows * size};
    DiscGrid grid(all, most);
    for (uint32_t y = 0; y < tiling.rows; ++y)
        for (uint32_t x = 0; x < tiling.columns; ++x)
            for (const Planted& object : planting.tiles[tiling.at(x, y)])
                grid.add({x * size + double(object.x_m), y * size + double(object.y_m), packing_of(planting, object)});
    // Without the outermost tiles, whose surroundings are not there.
    Bounds within{size, size, all.high_x - size, all.high_y - size};
    FreeArea area(std::span(&within, 1), radius_m + slack, 1e-3 * radius_m);
    Random random(seed);
    uint64_t more = 0;
    while (auto place = area.draw(grid, random)) grid.add({place->x, place->y, radius_m}), ++more;
    return double(more) / (double(tiling.columns - 2) * (tiling.rows - 2));
}

}  // namespace overlook::wang_ldi
