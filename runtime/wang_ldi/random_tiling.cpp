#include <algorithm>
#include <array>

#include "runtime/wang_ldi/random.h"
#include "runtime/wang_ldi/tiling.h"

namespace overlook::wang_ldi {
namespace {

constexpr uint32_t kMostBlock = 4, kMostFills = 64;
constexpr uint64_t kMostBorders = uint64_t(1) << 20, kMostKeptBorders = 4096;
enum Stream : uint64_t { kCorner = 1, kHorizontal, kVertical, kOrder, kVariant };

int64_t floor_div(int64_t value, int64_t by) {
    return value >= 0 ? value / by : -((-value + by - 1) / by);
}

}  // namespace

// Fills one block from the colours of its border, south-west first; tiles that fit are tried in an order from a hash.
struct BlockFiller {
    const RandomTiling& tiling;
    uint32_t side;
    // [side] each, west to east or south to north.
    std::array<uint8_t, kMostBlock> south{}, north{}, west{}, east{};
    std::array<uint8_t, (kMostBlock + 1) * (kMostBlock + 1)> corners{};  // [side + 1, side + 1], of sets with several colours
    uint64_t order_seed = 0;
    std::array<uint32_t, kMostBlock * kMostBlock> placed{};

    // Stops at the fill after `skip` others; false if there are no more than that.
    bool fill(uint32_t& skip, uint32_t cell = 0) {
        if (cell == side * side) return skip-- == 0;
        uint32_t x = cell % side, y = cell / side;
        uint8_t below = y == 0 ? south[x] : tiling.prototiles_[placed[cell - side]].north;
        uint8_t before = x == 0 ? west[y] : tiling.prototiles_[placed[cell - 1]].east;
        const std::vector<uint32_t>& fitting = tiling.fits_south_west_[below * tiling.vertical_.size() + before];
        auto count = uint32_t(fitting.size());
        uint32_t first = count == 0 ? 0 : wang_ldi::below(mixed(order_seed + cell), count);
        for (uint32_t i = 0; i < count; ++i) {
            placed[cell] = fitting[(first + i) % count];
            const Tile& tile = tiling.prototiles_[placed[cell]];
            if (x + 1 == side && tile.east != east[y]) continue;
            if (y + 1 == side && tile.north != north[x]) continue;
            if (tiling.corner_colours_ > 1 && tiling.horizontal_[tile.north].high != corner(x + 1, y + 1)) continue;
            if (fill(skip, cell + 1)) return true;
        }
        return false;
    }
    uint8_t& corner(uint32_t x, uint32_t y) { return corners[y * (side + 1) + x]; }
    // Those of the border from its edges; false if these disagree about one.
    bool take_corners() {
        bool agrees = true;
        auto take = [&](const EdgeColour& edge, uint32_t x, uint32_t y, uint32_t high_x, uint32_t high_y, bool is_first) {
            agrees &= is_first || corner(x, y) == edge.low;
            corner(x, y) = edge.low, corner(high_x, high_y) = edge.high;
        };
        for (uint32_t i = 0; i < side; ++i) take(tiling.horizontal_[south[i]], i, 0, i + 1, 0, i == 0);
        for (uint32_t i = 0; i < side; ++i) take(tiling.vertical_[east[i]], side, i, side, i + 1, false);
        for (uint32_t i = 0; i < side; ++i) take(tiling.vertical_[west[i]], 0, i, 0, i + 1, false);
        uint8_t north_east = corner(side, side);
        for (uint32_t i = 0; i < side; ++i) take(tiling.horizontal_[north[i]], i, side, i + 1, side, false);
        return agrees && corner(side, side) == north_east;
    }
    // Whatever the colours of the corners inside are.
    bool fills_with_any_corners() {
        uint64_t inside = uint64_t(side - 1) * (side - 1), ways = 1;
        for (uint64_t i = 0; i < inside; ++i) ways *= tiling.corner_colours_;
        for (uint64_t way = 0; way < ways; ++way) {
            uint64_t rest = way;
            for (uint32_t y = 1; y < side; ++y)
                for (uint32_t x = 1; x < side; ++x, rest /= tiling.corner_colours_)
                    corner(x, y) = uint8_t(rest % tiling.corner_colours_);
            if (!fill_first()) return false;
        }
        return true;
    }
    bool fill_first() {
        uint32_t skip = 0;
        return fill(skip);
    }
    // One of all fills, each as likely as the others; of more than kMostFills one of the first.
    void fill_any() {
        uint32_t rest = kMostFills;
        uint32_t fills = fill(rest) ? kMostFills : kMostFills - rest;
        uint32_t skip = wang_ldi::below(mixed(order_seed), fills);
        fill(skip);
    }

    // Whether every border of `block` can be filled; of more borders than can be tried: no.
    static bool fills_every_border(const RandomTiling& tiling, uint32_t block) {
        uint64_t borders = 1;
        std::array<uint64_t, 4 * kMostBlock> colours{};
        for (uint32_t i = 0; i < 4 * block; ++i) {
            colours[i] = i < 2 * block ? tiling.horizontal_.size() : tiling.vertical_.size();
            borders *= colours[i];
            if (borders > kMostBorders) return false;
        }
        for (uint64_t border = 0; border < borders; ++border) {
            BlockFiller filler{tiling, block};
            uint64_t rest = border;
            for (uint32_t i = 0; i < 4 * block; ++i) {
                auto colour = uint8_t(rest % colours[i]);
                rest /= colours[i];
                (i < block       ? filler.south
                 : i < 2 * block ? filler.north
                 : i < 3 * block ? filler.west
                                 : filler.east)[i % block] = colour;
            }
            if (filler.take_corners() && !filler.fills_with_any_corners()) return false;
        }
        return true;
    }
    // All fills of each border, in a fixed order; of a set with one colour of corners and few borders, else none.
    static void keep_fills(RandomTiling& tiling) {
        uint64_t borders = 1;
        for (uint32_t i = 0; i < 2 * tiling.block_; ++i) borders *= tiling.horizontal_.size() * tiling.vertical_.size();
        if (tiling.corner_colours_ > 1 || tiling.block_ == 1 || borders > kMostKeptBorders) return;
        for (uint64_t border = 0; border < borders; ++border) {
            tiling.first_fill_.push_back(uint32_t(tiling.fills_.size()));
            BlockFiller filler{tiling, tiling.block_};
            uint64_t rest = border;
            for (auto [edges, colours] : {std::pair(&filler.south, tiling.horizontal_.size()),
                                          {&filler.north, tiling.horizontal_.size()},
                                          {&filler.west, tiling.vertical_.size()},
                                          {&filler.east, tiling.vertical_.size()}})
                for (uint32_t i = 0; i < tiling.block_; ++i) (*edges)[i] = uint8_t(rest % colours), rest /= colours;
            for (uint32_t one = 0, skip = 0; one < kMostFills && filler.fill(skip); skip = ++one)
                for (uint32_t cell = 0; cell < tiling.block_ * tiling.block_; ++cell)
                    tiling.fills_.push_back(uint8_t(filler.placed[cell]));
        }
        tiling.first_fill_.push_back(uint32_t(tiling.fills_.size()));
    }
    // Of those the one that is placed.
    uint32_t kept(uint32_t cell) const {
        uint64_t border = 0, times = 1;
        for (auto [edges, colours] : {std::pair(&south, tiling.horizontal_.size()),
                                      {&north, tiling.horizontal_.size()},
                                      {&west, tiling.vertical_.size()},
                                      {&east, tiling.vertical_.size()}})
            for (uint32_t i = 0; i < side; ++i) border += times * (*edges)[i], times *= colours;
        uint32_t first = tiling.first_fill_[border], cells = side * side,
                 count = (tiling.first_fill_[border + 1] - first) / cells;
        return tiling.fills_[first + wang_ldi::below(mixed(order_seed), count) * cells + cell];
    }

    // Whether there is a tile for any colours of four edges whose corners agree.
    static bool is_complete(const RandomTiling& tiling) {
        for (size_t south = 0; south < tiling.horizontal_.size(); ++south)
            for (size_t west = 0; west < tiling.vertical_.size(); ++west) {
                const EdgeColour &s = tiling.horizontal_[south], &w = tiling.vertical_[west];
                if (s.low != w.low) continue;
                uint64_t wanted = 0;
                for (const EdgeColour& n : tiling.horizontal_)
                    for (const EdgeColour& e : tiling.vertical_) wanted += n.low == w.high && e.low == s.high && n.high == e.high;
                if (tiling.fits_south_west_[south * tiling.vertical_.size() + west].size() != wanted) return false;
            }
        return true;
    }
};

Result<RandomTiling> RandomTiling::of(const TileSet& set, uint64_t seed, CornerAt corner_at) {
    RandomTiling made;
    made.seed_ = seed, made.corner_at_ = std::move(corner_at), made.corner_colours_ = set.corner_density.size();
    made.horizontal_ = set.horizontal, made.vertical_ = set.vertical;
    size_t corners = made.corner_colours_;
    made.horizontal_between_.resize(corners * corners), made.vertical_between_.resize(corners * corners);
    for (size_t c = 0; c < set.horizontal.size(); ++c)
        made.horizontal_between_[set.horizontal[c].low * corners + set.horizontal[c].high].push_back(uint8_t(c));
    for (size_t c = 0; c < set.vertical.size(); ++c)
        made.vertical_between_[set.vertical[c].low * corners + set.vertical[c].high].push_back(uint8_t(c));
    for (size_t t = 0; t < set.tiles.size(); ++t) {
        auto same = std::find(made.prototiles_.begin(), made.prototiles_.end(), set.tiles[t]);
        if (same == made.prototiles_.end()) {
            made.prototiles_.push_back(set.tiles[t]), made.variants_.emplace_back();
            same = made.prototiles_.end() - 1;
        }
        made.variants_[size_t(same - made.prototiles_.begin())].push_back(uint8_t(t));
    }
    made.fits_south_west_.resize(set.horizontal.size() * set.vertical.size());
    for (size_t p = 0; p < made.prototiles_.size(); ++p)
        made.fits_south_west_[made.prototiles_[p].south * set.vertical.size() + made.prototiles_[p].west].push_back(uint32_t(p));

    bool has_all_edges =
        std::none_of(made.horizontal_between_.begin(), made.horizontal_between_.end(), [](auto& c) { return c.empty(); }) &&
        std::none_of(made.vertical_between_.begin(), made.vertical_between_.end(), [](auto& c) { return c.empty(); });
    if (has_all_edges && BlockFiller::is_complete(made)) return made;
    for (made.block_ = 2; made.block_ <= kMostBlock; ++made.block_)
        if (BlockFiller::fills_every_border(made, made.block_)) {
            BlockFiller::keep_fills(made);
            return made;
        }
    return impossible(
        "a set of {} tiles permits no random access: some border of {} x {} tiles cannot be filled, or there are too "
        "many to try",
        set.tiles.size(), kMostBlock, kMostBlock);
}

uint8_t RandomTiling::corner(int64_t x, int64_t y) const {
    if (corner_at_) return corner_at_(x, y);
    return uint8_t(wang_ldi::below(hash_of(seed_, kCorner, x, y), uint32_t(corner_colours_)));
}

uint8_t RandomTiling::horizontal_edge(int64_t x, int64_t y) const {
    const auto& colours = horizontal_between_[corner(x, y) * corner_colours_ + corner(x + 1, y)];
    return colours[wang_ldi::below(hash_of(seed_, kHorizontal, x, y), uint32_t(colours.size()))];
}

uint8_t RandomTiling::vertical_edge(int64_t x, int64_t y) const {
    const auto& colours = vertical_between_[corner(x, y) * corner_colours_ + corner(x, y + 1)];
    return colours[wang_ldi::below(hash_of(seed_, kVertical, x, y), uint32_t(colours.size()))];
}

uint32_t RandomTiling::prototile(int64_t x, int64_t y) const {
    int64_t side = block_, left = floor_div(x, side) * side, bottom = floor_div(y, side) * side;
    BlockFiller filler{*this, block_};
    for (uint32_t i = 0; i < block_; ++i) {
        filler.south[i] = horizontal_edge(left + i, bottom), filler.north[i] = horizontal_edge(left + i, bottom + side);
        filler.west[i] = vertical_edge(left, bottom + i), filler.east[i] = vertical_edge(left + side, bottom + i);
    }
    for (uint32_t j = 0; corner_colours_ > 1 && j <= block_; ++j)
        for (uint32_t i = 0; i <= block_; ++i) filler.corner(i, j) = corner(left + i, bottom + j);
    filler.order_seed = hash_of(seed_, kOrder, left, bottom);
    auto cell = uint32_t((y - bottom) * side + x - left);
    if (!fills_.empty()) return filler.kept(cell);
    block_ == 1 ? void(filler.fill_first()) : filler.fill_any();
    return filler.placed[cell];
}

// Of a place where x + y is even: with fewer than five variants the last is left to those places where it is odd, which so
// have always one that none of their four neighbours has.
uint32_t RandomTiling::black_variant(int64_t x, int64_t y, uint32_t variants) const {
    return wang_ldi::below(hash_of(seed_, kVariant, x, y), variants < 5 ? std::max(1u, variants - 1) : variants);
}

uint8_t RandomTiling::at(int64_t x, int64_t y) const {
    return tiles_->at(x, y, [&] { return found_at(x, y); });
}

uint8_t RandomTiling::found_at(int64_t x, int64_t y) const {
    uint32_t proto = prototile(x, y);
    const std::vector<uint8_t>& variants = variants_[proto];
    auto count = uint32_t(variants.size());
    if (count == 1) return variants[0];
    if (((x + y) & 1) == 0) return variants[black_variant(x, y, count)];
    std::array<bool, 256> taken{};
    uint32_t taken_count = 0;
    for (auto [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
        if (prototile(x + dx, y + dy) != proto) continue;
        bool& is_taken = taken[black_variant(x + dx, y + dy, count)];
        taken_count += !is_taken, is_taken = true;
    }
    uint32_t skip = wang_ldi::below(hash_of(seed_, kVariant, x, y), count - taken_count);
    for (uint32_t v = 0; v < count; ++v)
        if (!taken[v] && skip-- == 0) return variants[v];
    return variants[0];
}

}  // namespace overlook::wang_ldi
