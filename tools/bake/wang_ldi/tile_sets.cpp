#include "tools/bake/wang_ldi/tile_sets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "runtime/wang_ldi/random.h"
#include "tools/bake/wang_ldi/tile_search.h"

namespace overlook::wang_ldi {
namespace {

constexpr size_t kMostTiles = 255;

Result<void> check(const SetOptions& options) {
    uint32_t pairs = options.horizontal_colours * options.vertical_colours;
    if (options.kind != SetKind::stochastic || (options.tiles == 1 && pairs == 1)) return {};
    if (pairs == 1) return bad_command("{} tiles of one colour each way: one tile is all there is", options.tiles);
    if (options.tiles % pairs != 0 || options.tiles < 2 * pairs || options.tiles > pairs * pairs)
        return bad_command(
            "{} tiles of {} x {} colours: there must be 2 to {} for each of the {} pairs of a west and a south colour, equally "
            "many "
            "for each",
            options.tiles, options.horizontal_colours, options.vertical_colours, pairs, pairs);
    return {};
}

// A colour for each two corners, a tile for each four.
TileSet corner_set(const std::vector<float>& corner_density) {
    TileSet set;
    size_t corners = corner_density.size();
    set.corner_density = corner_density, set.horizontal.clear(), set.vertical.clear();
    for (size_t low = 0; low < corners; ++low)
        for (size_t high = 0; high < corners; ++high) {
            set.horizontal.push_back({uint8_t(low), uint8_t(high)});
            set.vertical.push_back({uint8_t(low), uint8_t(high)});
        }
    for (size_t i = 0; i < corners * corners * corners * corners; ++i) {
        size_t sw = i / (corners * corners * corners), se = i / (corners * corners) % corners, nw = i / corners % corners,
               ne = i % corners;
        set.tiles.push_back(
            {uint8_t(nw * corners + ne), uint8_t(se * corners + ne), uint8_t(sw * corners + se), uint8_t(sw * corners + nw)});
    }
    return set;
}

// Colours of `edges` that join these corners.
std::vector<uint8_t> between(const std::vector<EdgeColour>& edges, uint8_t low, uint8_t high) {
    std::vector<uint8_t> colours;
    for (size_t c = 0; c < edges.size(); ++c)
        if (edges[c] == EdgeColour{low, high}) colours.push_back(uint8_t(c));
    return colours;
}

// A bare corner colour, the edges that lead to it, and a tile for every four edges about at least one bare corner.
void add_borders(TileSet& set) {
    auto planted = uint8_t(set.corner_density.size()), bare = planted;
    set.corner_density.push_back(0);
    for (uint8_t c = 0; c < planted; ++c)
        for (auto* edges : {&set.horizontal, &set.vertical}) edges->push_back({c, bare}), edges->push_back({bare, c});
    set.horizontal.push_back({bare, bare}), set.vertical.push_back({bare, bare});
    uint32_t colours = bare + 1u;
    for (uint32_t i = 0; i < colours * colours * colours * colours; ++i) {
        auto sw = uint8_t(i / (colours * colours * colours)), se = uint8_t(i / (colours * colours) % colours),
             nw = uint8_t(i / colours % colours), ne = uint8_t(i % colours);
        if (sw != bare && se != bare && nw != bare && ne != bare) continue;
        for (uint8_t north : between(set.horizontal, nw, ne))
            for (uint8_t east : between(set.vertical, se, ne))
                for (uint8_t south : between(set.horizontal, sw, se))
                    for (uint8_t west : between(set.vertical, sw, nw)) set.tiles.push_back({north, east, south, west});
    }
}

constexpr double kTurn = std::numbers::phi - 1;  // 1 / phi

// The label that theorem C gives the edge at (x, y).
std::array<int, 3> label(double x, double y) {
    auto whole = [](double v) { return int(std::floor(v + 1 - kTurn)); };
    return {whole(y), whole(kTurn * x + y), whole(std::numbers::phi * x + y)};
}
double fraction(double v) {
    return v - std::floor(v);
}

struct Labels {
    std::map<std::array<int, 3>, uint8_t> horizontal, vertical;

    static uint8_t of(std::map<std::array<int, 3>, uint8_t>& known, const std::array<int, 3>& l) {
        return known.emplace(l, uint8_t(known.size())).first->second;
    }
    Tile tile_at(double x, double y) {
        return {of(horizontal, label(y, x)), of(vertical, label(x, y)), of(horizontal, label(fraction(y - kTurn), x)),
                of(vertical, label(fraction(x - kTurn), y))};
    }
};

// Every tile that a fine grid of points meets, in the order of the grid.
TileSet robinson_with(Labels& labels) {
    constexpr int kSide = 499;
    TileSet set;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            Tile tile = labels.tile_at((x + 0.5) / kSide, (y + 0.5) / kSide);
            if (std::find(set.tiles.begin(), set.tiles.end(), tile) == set.tiles.end()) set.tiles.push_back(tile);
        }
    set.horizontal.assign(labels.horizontal.size(), {}), set.vertical.assign(labels.vertical.size(), {});
    return set;
}

}  // namespace

TileSet robinson_set() {
    Labels labels;
    return robinson_with(labels);
}

Tiling robinson_tiling(const TileSet& set, uint32_t columns, uint32_t rows, uint64_t seed) {
    Labels labels;
    robinson_with(labels);
    Random random(seed, 0x726f);
    double x0 = random.next_unit(), y0 = random.next_unit();
    Tiling tiling{columns, rows, std::vector<uint8_t>(size_t(columns) * rows)};
    for (uint32_t y = 0; y < rows; ++y)
        for (uint32_t x = 0; x < columns; ++x) {
            Tile tile = labels.tile_at(fraction(x0 + x * kTurn), fraction(y0 + y * kTurn));
            tiling.tiles[size_t(y) * columns + x] =
                uint8_t(std::find(set.tiles.begin(), set.tiles.end(), tile) - set.tiles.begin());
        }
    return tiling;
}

Result<TileSet> make_tile_set(const SetOptions& options, SearchReport& report) {
    report = {};
    if (auto checked = check(options); !checked) return tl::unexpected(checked.error());
    TileSet set;
    if (options.kind == SetKind::robinson) {
        set = robinson_set();
    } else if (options.kind == SetKind::corners) {
        set = corner_set(options.corner_density);
    } else if (options.tiles == 1) {
        set.tiles = {{}};
    } else {
        set = search_set(options, report);
    }
    if (options.has_borders) add_borders(set);
    size_t all = set.tiles.size() * options.variants;
    if (all > kMostTiles)
        return bad_command("{} prototiles in {} variants are {} tiles, a file holds {} at most", set.tiles.size(),
                           options.variants, all, kMostTiles);
    std::vector<Tile> prototiles = std::move(set.tiles);
    set.tiles.clear();
    for (const Tile& tile : prototiles) set.tiles.insert(set.tiles.end(), options.variants, tile);
    return set;
}

std::vector<float> repeated_densities(const TileSet& set) {
    std::map<float, size_t, std::greater<>> tiles_of;  // all of whose corners have the density
    for (float density : set.corner_density) tiles_of[density] = 0;
    for (const Tile& tile : set.tiles) {
        std::array<uint8_t, 4> corners = corners_of(set, tile);
        float first = set.corner_density[corners[0]];
        tiles_of[first] += std::all_of(corners.begin(), corners.end(), [&](uint8_t c) { return set.corner_density[c] == first; });
    }
    std::vector<float> repeated;
    for (const auto& [density, tiles] : tiles_of)
        if (density > 0 && tiles == 1 && set.tiles.size() > 1) repeated.push_back(density);
    return repeated;
}

std::string text_of(const TileSet& set) {
    std::string text;
    for (const Tile& tile : set.tiles)
        text += fmt::format("{}{:x}{:x}{:x}{:x}", text.empty() ? "" : " ", tile.north, tile.east, tile.south, tile.west);
    return text;
}

}  // namespace overlook::wang_ldi
