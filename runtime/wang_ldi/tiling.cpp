#include "runtime/wang_ldi/tiling.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <map>

#include "runtime/wang_ldi/random.h"

namespace overlook::wang_ldi {
namespace {

using Mask = std::bitset<256>;  // of tiles

// What fits where, by colour.
class Fits {
  public:
    explicit Fits(const TileSet& set) : set_(set) {
        for (size_t t = 0; t < set.tiles.size(); ++t) {
            of_west[set.tiles[t].west].set(t), of_south[set.tiles[t].south].set(t), all.set(t);
            std::array<uint8_t, 4> corners = corners_of(set, set.tiles[t]);
            for (size_t c = 0; c < 4; ++c) of_corner[c][corners[c]].set(t);
        }
    }
    // At (x, y), but for its neighbours.
    Mask of_place(const CornerAt& corner_at, int64_t x, int64_t y) const {
        if (!corner_at) return all;
        return of_corner[0][corner_at(x, y)] & of_corner[1][corner_at(x + 1, y)] & of_corner[2][corner_at(x, y + 1)] &
               of_corner[3][corner_at(x + 1, y + 1)];
    }
    const TileSet& set() const { return set_; }

    std::array<Mask, 256> of_west, of_south;
    std::array<std::array<Mask, 256>, 4> of_corner;
    Mask all;

  private:
    const TileSet& set_;
};

uint8_t any_of(const Mask& mask, size_t tile_count, Random& random) {
    uint32_t skip = random.next_below(uint32_t(mask.count()));
    for (size_t t = 0; t < tile_count; ++t)
        if (mask[t] && skip-- == 0) return uint8_t(t);
    return 0;
}

// One row over another.
class Row {
  public:
    Row(const Fits& fits, const TilingOptions& options, uint32_t columns, bool looks_ahead)
        : fits_(fits), options_(options), may_stand_(columns), looks_ahead_(looks_ahead) {}

    // Columns that can be completed to the east, or all of them; where that fails, the column at which nothing fits.
    std::optional<uint32_t> prepare(const uint8_t* below, int64_t y) {
        auto columns = uint32_t(may_stand_.size());
        for (uint32_t x = columns; x-- > 0;) {
            Mask mask = fits_.of_place(options_.corner_at, x, y);
            if (below) mask &= fits_.of_south[fits_.set().tiles[below[x]].north];
            if (below && options_.avoids_equal_neighbours) mask.reset(below[x]);
            if (looks_ahead_ && x + 1 < columns) keep_those_that_go_on(mask, may_stand_[x + 1]);
            if (mask.none()) return x;
            may_stand_[x] = mask;
        }
        return std::nullopt;
    }
    std::optional<uint32_t> fill(uint8_t* row, Random& random) const {
        for (uint32_t x = 0; x < may_stand_.size(); ++x) {
            Mask mask = may_stand_[x];
            if (x > 0) mask &= fits_.of_west[fits_.set().tiles[row[x - 1]].east];
            if (x > 0 && options_.avoids_equal_neighbours) mask.reset(row[x - 1]);
            if (mask.none()) return x;
            row[x] = any_of(mask, fits_.set().tiles.size(), random);
        }
        return std::nullopt;
    }

  private:
    void keep_those_that_go_on(Mask& mask, const Mask& east) const {
        for (size_t t = 0; t < fits_.set().tiles.size(); ++t) {
            if (!mask[t]) continue;
            Mask next = east & fits_.of_west[fits_.set().tiles[t].east];
            if (options_.avoids_equal_neighbours) next.reset(t);
            if (next.none()) mask.reset(t);
        }
    }

    const Fits& fits_;
    const TilingOptions& options_;
    std::vector<Mask> may_stand_;
    bool looks_ahead_;
};

constexpr int kMostRetries = 1000;

}  // namespace

bool can_dead_end(const TileSet& set) {
    Fits fits(set);
    // Whether some tile stands to the south of `west` and to the west of `south`, equal to neither.
    auto meet = [&](size_t west, size_t south) {
        for (size_t t = 0; t < set.tiles.size(); ++t)
            if (t != west && t != south && set.tiles[t].north == set.tiles[west].south &&
                set.tiles[t].east == set.tiles[south].west)
                return true;
        return false;
    };
    // In the first row and the first column there is one neighbour only.
    for (size_t t = 0; t < set.tiles.size(); ++t) {
        Mask east = fits.of_west[set.tiles[t].east], north = fits.of_south[set.tiles[t].north];
        east.reset(t), north.reset(t);
        if (east.none() || north.none()) return true;
    }
    for (size_t west = 0; west < set.tiles.size(); ++west)
        for (size_t south = 0; south < set.tiles.size(); ++south) {
            Mask mask = fits.of_west[set.tiles[west].east] & fits.of_south[set.tiles[south].north];
            mask.reset(west), mask.reset(south);
            if (mask.none() && meet(west, south)) return true;
        }
    return false;
}

Result<Tiling> tile_row_by_row(const TileSet& set, uint32_t columns, uint32_t rows, const TilingOptions& options) {
    Fits fits(set);
    bool looks_ahead = options.corner_at || (options.avoids_equal_neighbours && can_dead_end(set));
    Row row(fits, options, columns, looks_ahead);
    Random random(options.seed, 0x7469);
    Tiling tiling{columns, rows, std::vector<uint8_t>(size_t(columns) * rows)};
    int retries = 0;
    for (uint32_t y = 0; y < rows;) {
        uint8_t* at = tiling.tiles.data() + size_t(y) * columns;
        auto stuck = row.prepare(y == 0 ? nullptr : at - columns, y);
        if (!stuck) stuck = row.fill(at, random);
        if (!stuck) {
            ++y;
            continue;
        }
        if (y == 0 || ++retries > kMostRetries)
            return impossible("no tile of the set of {} fits at column {}, row {}{}", set.tiles.size(), *stuck, y,
                              options.avoids_equal_neighbours ? "; let equal tiles stand side by side" : "");
        --y;  // another row below, from where the random numbers are now
    }
    return tiling;
}

Result<RowTiling> RowTiling::of(const TileSet& set, const Rect& rect, const TilingOptions& options) {
    TilingOptions inside = options;
    if (options.corner_at) inside.corner_at = [&](int64_t x, int64_t y) { return options.corner_at(rect.x + x, rect.y + y); };
    auto tiling = tile_row_by_row(set, rect.columns, rect.rows, inside);
    if (!tiling) return tl::unexpected(tiling.error());
    RowTiling made;
    made.rect_ = rect, made.tiling_ = std::move(*tiling);
    return made;
}

uint8_t RowTiling::at(int64_t x, int64_t y) const {
    auto inside = [](int64_t value, int64_t count) { return uint32_t((value % count + count) % count); };
    return tiling_.at(inside(x - rect_.x, rect_.columns), inside(y - rect_.y, rect_.rows));
}

Result<Tiling> tile_square(const TileSet& set, uint32_t side, uint64_t seed) {
    TilingOptions options;
    options.seed = seed, options.avoids_equal_neighbours = set.tiles.size() > 1;
    auto tiling = tile_row_by_row(set, side, side, options);
    if (tiling || !options.avoids_equal_neighbours) return tiling;
    options.avoids_equal_neighbours = false;
    return tile_row_by_row(set, side, side, options);
}

NeighbourCount count_neighbours(const TileSet& set, const Tiling& tiling) {
    NeighbourCount count;
    for (uint32_t y = 0; y < tiling.rows; ++y)
        for (uint32_t x = 0; x < tiling.columns; ++x) {
            uint8_t here = tiling.at(x, y);
            const Tile& tile = set.tiles[here];
            if (x + 1 < tiling.columns) {
                count.disagreeing += tile.east != set.tiles[tiling.at(x + 1, y)].west;
                count.equal += here == tiling.at(x + 1, y);
            }
            if (y + 1 < tiling.rows) {
                count.disagreeing += tile.north != set.tiles[tiling.at(x, y + 1)].south;
                count.equal += here == tiling.at(x, y + 1);
            }
        }
    return count;
}

CornerAt corners_of_density(const TileSet& set, std::function<double(int64_t x, int64_t y)> density_at, uint64_t seed) {
    std::map<float, std::vector<uint8_t>> by_density;  // colours of one density stand for each other
    for (size_t c = 0; c < set.corner_density.size(); ++c) by_density[set.corner_density[c]].push_back(uint8_t(c));
    std::vector<double> densities;
    std::vector<std::vector<uint8_t>> colours;
    for (const auto& [density, of_density] : by_density) densities.push_back(double(density)), colours.push_back(of_density);
    return [densities, colours, density_at = std::move(density_at), seed](int64_t x, int64_t y) {
        double wanted = density_at(x, y), unit = double(hash_of(seed, 0x64, x, y) >> 11) * 0x1p-53;
        size_t chosen = 0;
        while (chosen + 1 < densities.size() && densities[chosen] < wanted) ++chosen;
        if (chosen > 0) {
            double low = densities[chosen - 1], high = densities[chosen];
            chosen -= unit >= std::clamp((wanted - low) / (high - low), 0.0, 1.0);
        }
        const std::vector<uint8_t>& of_density = colours[chosen];
        return of_density[below(hash_of(seed, 0x6463, x, y), uint32_t(of_density.size()))];
    };
}

}  // namespace overlook::wang_ldi
