#include "tools/bake/wang_ldi/planting_check.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <numeric>
#include <vector>

#include "tools/bake/wang_ldi/free_area.h"
#include "tools/bake/wang_ldi/object_grid.h"

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
    Overlaps(const TileSet& set, const Planting& planting, uint64_t most_looks)
        : set_(set), planting_(planting), most_looks_(most_looks) {
        for (size_t t = 0; t < planting.tiles.size(); ++t) {
            grids_.emplace_back(planting, t), most_radius_m_ = std::max(most_radius_m_, grids_.back().most_radius_m());
            for (const Planted& object : planting.tiles[t])
                least_radius_m_ = std::min(least_radius_m_, packing_of(planting, object));
        }
    }
    // Pairs that are near each other, then ever farther ones, until no pair beyond can have the least gap or ratio.
    OverlapReport run() {
        OverlapReport last;
        for (double share = 1.5;; share *= 2) {
            pass(share);
            if (report_.is_cut_short && share > 1.5) last.is_cut_short = true, last.looks = report_.looks;
            if (report_.is_cut_short) return share > 1.5 ? last : report_;
            bool is_least =
                report_.least_packing_ratio <= share && report_.least_tight_gap_m <= 2 * least_radius_m_ * (share - 1);
            if (is_least || 2 * least_radius_m_ * share > 3 * planting_.tile_size_m) return report_;
            last = report_;
        }
    }

  private:
    static constexpr std::array<std::array<int, 2>, 4> kSides{{{1, 0}, {0, 1}, {1, 1}, {-1, 1}}};

    // Pairs whose middles are `share` of the sum of their packing radii apart or less.
    void pass(double share) {
        report_ = {0, 0, 0, HUGE_VAL, HUGE_VAL, report_.looks, false};
        size_t count = set_.tiles.size();
        for (size_t a = 0; a < count; ++a) {
            std::array<std::vector<uint32_t>, 4> near;
            for (size_t side = 0; side < 4; ++side) near[side] = near_side(a, kSides[side], share);
            std::vector<uint32_t> all(planting_.tiles[a].size());
            std::iota(all.begin(), all.end(), 0);
            look(a, a, {0, 0}, all, share);
            for (size_t b = 0; b < count; ++b)
                for (size_t side = 0; side < 4; ++side)
                    if (meet(set_.tiles[a], set_.tiles[b], side)) look(a, b, kSides[side], near[side], share);
        }
    }
    // Whether b may stand on that side of a.
    bool meet(const Tile& a, const Tile& b, size_t side) const {
        if (side == 0) return a.east == b.west;
        if (side == 1) return a.north == b.south;
        return side == 2 ? meet_north_east(a, b) : meet_north_west(a, b);
    }
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
    // Objects of a tile that can be near one of a neighbour's.
    std::vector<uint32_t> near_side(size_t tile, const std::array<int, 2>& side, double share) const {
        std::vector<uint32_t> near;
        const std::vector<Planted>& objects = planting_.tiles[tile];
        double size = planting_.tile_size_m;
        auto beyond = [&](double at, int tiles) { return tiles == 0 ? 0 : tiles > 0 ? size - at : at; };
        for (uint32_t o = 0; o < objects.size(); ++o) {
            double away = std::hypot(beyond(double(objects[o].x_m), side[0]), beyond(double(objects[o].y_m), side[1]));
            if (away <= share * (packing_of(planting_, objects[o]) + most_radius_m_)) near.push_back(o);
        }
        return near;
    }
    void look(size_t a, size_t b, const std::array<int, 2>& side, const std::vector<uint32_t>& of_a, double share) {
        if (report_.is_cut_short) return;
        ++report_.neighbourhoods;
        double size = planting_.tile_size_m;
        for (uint32_t i : of_a) {
            const Planted& p = planting_.tiles[a][i];
            double packing = packing_of(planting_, p);
            report_.looks += grids_[b].visit_near(double(p.x_m) - side[0] * size, double(p.y_m) - side[1] * size, packing, share,
                                                  [&](uint32_t j) {
                                                      if (b != a || side != std::array<int, 2>{0, 0} || j > i)
                                                          compare(p, planting_.tiles[b][j], side);
                                                      return ++report_.looks < most_looks_;
                                                  });
            if (report_.looks >= most_looks_) report_.is_cut_short = true;
            if (report_.is_cut_short) return;
        }
    }
    void compare(const Planted& p, const Planted& q, const std::array<int, 2>& side) {
        double size = planting_.tile_size_m;
        double apart = std::hypot(double(q.x_m) + side[0] * size - double(p.x_m), double(q.y_m) + side[1] * size - double(p.y_m));
        double gap = apart - tight_of(planting_, p) - tight_of(planting_, q);
        double ratio = apart / (packing_of(planting_, p) + packing_of(planting_, q));
        report_.tight_overlaps += gap < 0, report_.packing_overlaps += ratio < 1;
        report_.least_tight_gap_m = std::min(report_.least_tight_gap_m, gap);
        report_.least_packing_ratio = std::min(report_.least_packing_ratio, ratio);
    }

    const TileSet& set_;
    const Planting& planting_;
    uint64_t most_looks_;
    std::vector<ObjectGrid> grids_;
    double least_radius_m_ = HUGE_VAL, most_radius_m_ = 0;
    OverlapReport report_;
};

}  // namespace

OverlapReport check_overlaps(const TileSet& set, const Planting& planting, uint64_t most_looks) {
    return Overlaps(set, planting, most_looks).run();
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
