#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "runtime/wang_ldi/random.h"
#include "tools/bake/wang_ldi/periodicity.h"
#include "tools/bake/wang_ldi/tile_search.h"

namespace overlook::wang_ldi {
namespace {

constexpr uint32_t kFirstSide = 256, kLastSide = 1024;
constexpr size_t kFinalists = 12;

TileSet empty_set(uint32_t horizontal_colours, uint32_t vertical_colours) {
    TileSet set;
    set.horizontal.assign(horizontal_colours, {}), set.vertical.assign(vertical_colours, {});
    return set;
}

bool is_balanced(const TileSet& set) {
    std::array<size_t, 256> north{}, east{};
    for (const Tile& tile : set.tiles) ++north[tile.north], ++east[tile.east];
    auto all_are = [&](const std::array<size_t, 256>& count, size_t colours) {
        return std::all_of(count.begin(), count.begin() + std::ptrdiff_t(colours),
                           [&](size_t c) { return c * colours == set.tiles.size(); });
    };
    return all_are(north, set.horizontal.size()) && all_are(east, set.vertical.size());
}

bool is_there(const TileSet& set, size_t begin, size_t end, const Tile& tile) {
    return std::find(set.tiles.begin() + std::ptrdiff_t(begin), set.tiles.begin() + std::ptrdiff_t(end), tile) !=
           set.tiles.begin() + std::ptrdiff_t(end);
}

// A balanced set at random: north and east colours dealt out evenly, then swapped until no tile is there twice.
TileSet dealt_set(uint32_t horizontals, uint32_t verticals, uint32_t per_pair, Random& random) {
    TileSet set = empty_set(horizontals, verticals);
    size_t count = size_t(horizontals) * verticals * per_pair;
    for (size_t t = 0; t < count; ++t) {
        size_t pair = t / per_pair;
        set.tiles.push_back(
            {uint8_t(t % horizontals), uint8_t(t % verticals), uint8_t(pair % horizontals), uint8_t(pair / horizontals)});
    }
    for (size_t t = count; t-- > 1;) {
        std::swap(set.tiles[t].north, set.tiles[random.next_below(uint32_t(t + 1))].north);
        std::swap(set.tiles[t].east, set.tiles[random.next_below(uint32_t(t + 1))].east);
    }
    for (size_t t = 0; t < count;) {
        size_t begin = t / per_pair * per_pair;
        if (!is_there(set, begin, t, set.tiles[t]) && !is_there(set, t + 1, begin + per_pair, set.tiles[t])) {
            ++t;
            continue;
        }
        std::swap(set.tiles[t].east, set.tiles[random.next_below(uint32_t(count))].east);
        std::swap(set.tiles[t].north, set.tiles[random.next_below(uint32_t(count))].north);
        t = 0;
    }
    return set;
}

}  // namespace

double score_of(const TileSet& set, uint32_t side, uint64_t seed) {
    TilingOptions options;
    options.seed = seed, options.avoids_equal_neighbours = false;
    auto tiling = tile_row_by_row(set, side, side, options);
    return tiling ? std::abs(greatest_correlation(*tiling).value) : 1;
}

std::vector<TileSet> balanced_sets(uint32_t per_pair) {
    std::vector<uint32_t> choices;  // bits: which of the four (north, east) there are
    for (uint32_t bits = 0; bits < 16; ++bits)
        if (uint32_t(std::popcount(bits)) == per_pair) choices.push_back(bits);
    std::vector<TileSet> sets;
    auto count = uint32_t(choices.size());
    for (uint32_t which = 0; which < count * count * count * count; ++which) {
        TileSet set = empty_set(2, 2);
        for (uint32_t pair = 0, rest = which; pair < 4; ++pair, rest /= count)
            for (uint32_t c = 0; c < 4; ++c)
                if (choices[rest % count] >> c & 1)
                    set.tiles.push_back({uint8_t(c >> 1), uint8_t(c & 1), uint8_t(pair & 1), uint8_t(pair >> 1)});
        if (is_balanced(set)) sets.push_back(std::move(set));
    }
    return sets;
}

TileSet search_set(const SetOptions& options, SearchReport& report) {
    uint32_t pairs = options.horizontal_colours * options.vertical_colours, per_pair = options.tiles / pairs;
    std::vector<TileSet> sets;
    report.is_exhaustive = per_pair == pairs || (options.horizontal_colours == 2 && options.vertical_colours == 2);
    if (options.horizontal_colours == 2 && options.vertical_colours == 2) {
        sets = balanced_sets(per_pair);
    } else {
        Random random(options.seed, 0x7365);
        for (uint32_t c = 0; c < (per_pair == pairs ? 1 : options.candidates); ++c)
            sets.push_back(dealt_set(options.horizontal_colours, options.vertical_colours, per_pair, random));
    }
    report.candidates = sets.size();
    std::vector<std::pair<double, size_t>> scores;
    for (size_t s = 0; s < sets.size(); ++s) {
        scores.emplace_back(score_of(sets[s], kFirstSide, options.seed), s);
        report.dead_ending += can_dead_end(sets[s]);
    }
    std::sort(scores.begin(), scores.end());
    report.worst = scores.back().first;
    scores.resize(std::min(scores.size(), kFinalists));
    for (auto& [score, s] : scores) score = score_of(sets[s], kLastSide, options.seed);
    std::sort(scores.begin(), scores.end());
    report.best = scores.front().first;
    return sets[scores.front().second];
}

}  // namespace overlook::wang_ldi
