#include "runtime/terrain/tiles.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <numeric>

namespace overlook::terrain {
namespace {

// Ranges in steps become such in metres, in their place.
void to_metres(const Terrain& head, const TileGrid& grid, uint32_t tile, stream::Bytes& bytes) {
    static_assert(sizeof(StepRange) == 8 && sizeof(HeightRange) == 8);
    for (uint32_t i = 0; i < grid.range_count(tile); ++i) {
        std::byte* at = bytes.data() + TileGrid::kRangesAt + 8 * size_t(i);
        StepRange steps;
        std::memcpy(&steps, at, 8);
        HeightRange metres = height_range_of(head, steps);
        std::memcpy(at, &metres, 8);
    }
}

stream::Source source_of(const TileFile& file) {
    stream::Source source;
    const TileGrid& grid = file.grid();
    for (uint32_t tile = 0; tile < grid.count(); ++tile) {
        source.decoded_bytes.push_back(grid.bytes(tile));
        for (uint32_t need : grid.needs_of(tile)) source.needs.push_back(need);
        source.need_begin.push_back(uint32_t(source.needs.size()));
    }
    source.decode = [&file](uint32_t tile, std::span<const std::span<const std::byte>> needed) {
        Result<stream::Bytes> bytes = file.decode(tile, needed);
        if (bytes) to_metres(file.head(), file.grid(), tile, *bytes);
        return bytes;
    };
    return source;
}

}  // namespace

Result<std::unique_ptr<Tiles>> Tiles::open(container::Reader file, const stream::Settings& settings) {
    std::unique_ptr<Tiles> tiles(new Tiles());
    tiles->reader_ = std::move(file);
    Result<TileFile> read = TileFile::open(tiles->reader_);
    if (!read) return tl::unexpected(read.error());
    tiles->file_.emplace(std::move(*read));
    const TileGrid& grid = tiles->grid();
    Result<std::unique_ptr<stream::Stream>> stream =
        stream::Stream::open(tiles->reader_.name(), source_of(*tiles->file_), settings);
    if (!stream) return tl::unexpected(stream.error());
    tiles->stream_ = std::move(*stream);

    std::vector<uint32_t> coarsest;
    for (uint32_t tile = 0; tile < grid.count() && grid.block(tile).is_top; ++tile) coarsest.push_back(tile);
    if (Result<void> kept = tiles->stream_->keep(coarsest); !kept) return tl::unexpected(kept.error());
    uint64_t least_bytes = grid.bytes(grid.count() - 1);
    tiles->slot_count_ = uint32_t(std::min<uint64_t>(settings.residency_budget_bytes / least_bytes, grid.count()));
    for (uint32_t slot = tiles->slot_count_; slot-- > 0;) tiles->free_slots_.push_back(slot);
    tiles->views_.resize(grid.count());
    tiles->used_ = std::vector<std::atomic<uint32_t>>(grid.count());
    tiles->asked_ = std::vector<std::atomic<uint32_t>>(grid.count());
    for (uint32_t tile : coarsest) tiles->take_slot(tile);
    return tiles;
}

void Tiles::take_slot(uint32_t tile) {
    const std::byte* bytes = stream_->bytes(tile).data();
    views_[tile] = {reinterpret_cast<const int32_t*>(bytes), reinterpret_cast<const HeightRange*>(bytes + TileGrid::kRangesAt),
                    reinterpret_cast<const uint8_t*>(bytes + grid().codes_at(tile)), free_slots_.back()};
    free_slots_.pop_back();
}

const stream::Stream::Changes& Tiles::begin_frame() {
    const stream::Stream::Changes& changes = stream_->begin_frame();
    for (uint32_t tile : changes.arrived) take_slot(tile);
    return changes;
}

void Tiles::end_frame() {
    for (uint32_t tile = 0; tile < grid().count(); ++tile) {
        if (used_[tile].exchange(0, std::memory_order_relaxed) != 0 && stream_->is_resident(tile)) stream_->use(tile);
        uint32_t asked = asked_[tile].exchange(0, std::memory_order_relaxed);
        if (asked != 0) stream_->ask(tile, std::bit_cast<float>(asked - 1));
    }
    stream_->end_frame();
    for (uint32_t tile = 0; tile < grid().count(); ++tile) {
        if (views_[tile].heights == nullptr || stream_->is_resident(tile)) continue;
        free_slots_.push_back(views_[tile].slot);
        views_[tile] = {};
    }
}

// Calls visit(tile) for the tiles of all that must be split before a vertex, but the coarsest. These lie, of level k, within
// 3 * 2^k - 2 * 2^level of it (an edge) or 3 * 2^k - 3 * 2^level (a square): from an edge to its squares is a step of 2^level,
// from a square to the edges of the next level another, and these sum up so. The reach of an ancestor lies within that of whom it
// belongs to, by as much as they are apart.
template <class Visit>
void Tiles::visit_wanted(GridPoint v, uint32_t level, bool is_square, const Visit& visit) const {
    const TileGrid& tiles = grid();
    for (uint32_t k = level; k < tiles.top(); ++k) {
        uint32_t reach = (3u << k) - ((is_square ? 3u : 2u) << level);
        uint32_t west = v.x >= reach ? v.x - reach : 0, north = v.y >= reach ? v.y - reach : 0;
        uint32_t first = tiles.at(k, west, north), last = tiles.at(k, v.x + reach, v.y + reach);
        visit(first);
        if (first == last) continue;
        visit(last), visit(tiles.at(k, v.x + reach, north)), visit(tiles.at(k, west, v.y + reach));
    }
}

bool Tiles::is_available(GridPoint v, uint32_t level, bool is_square) const {
    bool is_all_there = true;
    visit_wanted(v, level, is_square, [&](uint32_t tile) {
        is_all_there = is_all_there && views_[tile].heights != nullptr;
        // Those that are there are wanted even if others are missing.
        if (used_[tile].load(std::memory_order_relaxed) == 0) used_[tile].store(1, std::memory_order_relaxed);
    });
    return is_all_there;
}

void Tiles::ask_for(GridPoint v, uint32_t level, bool is_square, float priority) const {
    uint32_t wanted = std::bit_cast<uint32_t>(priority) + 1;
    visit_wanted(v, level, is_square, [&](uint32_t tile) {
        if (views_[tile].heights != nullptr) return;
        uint32_t known = asked_[tile].load(std::memory_order_relaxed);
        while (known < wanted && !asked_[tile].compare_exchange_weak(known, wanted, std::memory_order_relaxed)) {
        }
    });
}

std::optional<int32_t> Tiles::height(uint32_t column, uint32_t row) const {
    uint32_t tile = grid().at(0, column, row);
    if (views_[tile].heights == nullptr) return std::nullopt;
    return views_[tile].heights[grid().local(tile, column, row)];
}

HeightRange Tiles::range_round(uint32_t column, uint32_t row) const {
    const Shape& shape = head().shape;
    for (uint32_t level = 0; level < shape.root_log2; ++level) {
        uint32_t x = (column >> (level + 1) << (level + 1)) + (1u << level),
                 y = (row >> (level + 1) << (level + 1)) + (1u << level);
        const View& view = views_[grid().at(std::min(level, grid().top()), x, y)];
        if (view.heights != nullptr)
            return view.ranges[grid().local_square(grid().at(std::min(level, grid().top()), x, y), x, y, level)];
    }
    return height_range_of(head(), file_->whole());
}

TileBounds::TileBounds(const Tiles& tiles) : tiles_(tiles), top_(tiles.grid().top()) {
    for (uint32_t level = 0; level < tiles.head().shape.root_log2; ++level) {
        LevelGrid vertices = level_grid(tiles.head().shape, level);
        last_.push_back({(vertices.columns - 2) << level, (vertices.rows - 2) << level});
    }
}

HeightRange TileBounds::of_square(uint32_t x, uint32_t y, uint32_t level) const {
    x = std::min(x, last_[level].x), y = std::min(y, last_[level].y);
    uint32_t tile = tiles_.grid().at(std::min(level, top_), x, y);
    return tiles_.view(tile).ranges[tiles_.grid().local_square(tile, x, y, level)];
}

}  // namespace overlook::terrain
