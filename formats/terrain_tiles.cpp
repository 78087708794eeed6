#include "formats/terrain_tiles.h"

#include <algorithm>
#include <cstring>

#include "formats/compression.h"
#include "formats/parallel.h"
#include "formats/terrain_extents.h"
#include "formats/terrain_layout.h"

namespace overlook::terrain {
namespace {

constexpr size_t kTilesAtOnce = 256;

// Calls visit(x, y, level) for the middles of the squares of a block's levels.
template <class Visit>
void visit_squares(const Shape& shape, const Block& block, const Visit& visit) {
    for (const Extent& extent : extents_of(shape, block))
        for (uint32_t j = extent.j_begin | 1; j < extent.j_end; j += 2)
            for (uint32_t i = extent.i_begin | 1; i < extent.i_end; i += 2)
                visit(i << extent.level, j << extent.level, extent.level);
}

// Calls visit(x, y) for the vertices of a block that stand beyond the raster: corners of its root, then as in the block.
template <class Visit>
void visit_beyond(const Shape& shape, const Block& block, const Visit& visit) {
    auto is_beyond = [&](uint64_t x, uint64_t y) { return x >= shape.width || y >= shape.height; };
    for (uint64_t corner = 0; block.is_top && corner < 4; ++corner) {
        uint64_t x = (block.bx + corner % 2) << shape.root_log2, y = (block.by + corner / 2) << shape.root_log2;
        if (is_beyond(x, y)) visit(uint32_t(x), uint32_t(y));
    }
    for (const Extent& extent : extents_of(shape, block))
        visit_runs(extent, [&](Run run) {
            for (uint32_t i = run.i; i < run.i_end; i += 2)
                if (is_beyond(uint64_t(i) << extent.level, uint64_t(run.j) << extent.level))
                    visit(i << extent.level, run.j << extent.level);
        });
}

// How many numbers a tile has besides its block: two a square, one a vertex beyond the raster.
struct Counts {
    size_t squares = 0, beyond = 0;
    size_t values() const { return 2 * squares + beyond; }
};
Counts counts_of(const Shape& shape, const Block& block) {
    Counts counts;
    visit_squares(shape, block, [&](uint32_t, uint32_t, uint32_t) { ++counts.squares; });
    visit_beyond(shape, block, [&](uint32_t, uint32_t) { ++counts.beyond; });
    return counts;
}

uint32_t zigzag(uint32_t value) {
    return (value << 1) ^ (0u - (value >> 31));
}
uint32_t unzigzag(uint32_t value) {
    return (value >> 1) ^ (0u - (value & 1));
}

// Lows, then extents of the squares' ranges, then heights beyond the raster.
std::vector<uint32_t> values_of(const Terrain& terrain, const SquareRanges& ranges, const Block& block) {
    std::vector<uint32_t> lows, extents, beyond;
    visit_squares(terrain.shape, block, [&](uint32_t x, uint32_t y, uint32_t level) {
        StepRange range = ranges.of_square(x, y, level);
        uint32_t last = lows.empty() ? 0 : lows.back();
        lows.push_back(range.is_empty() ? last : uint32_t(range.low));
        extents.push_back(range.is_empty() ? 0 : uint32_t(range.high) - uint32_t(range.low) + 1);
    });
    visit_beyond(terrain.shape, block, [&](uint32_t x, uint32_t y) {
        size_t row = std::min(y, terrain.shape.height - 1), column = std::min(x, terrain.shape.width - 1);
        beyond.push_back(uint32_t(terrain.heights[row * terrain.shape.width + column]));
    });
    lows.insert(lows.end(), extents.begin(), extents.end());
    lows.insert(lows.end(), beyond.begin(), beyond.end());
    return lows;
}

// Each as the folded step from the one before (modulo 2^32), the lowest bytes first.
std::vector<std::byte> bytes_of_values(std::span<const uint32_t> values) {
    std::vector<std::byte> bytes(4 * values.size());
    for (size_t i = 0; i < values.size(); ++i) {
        uint32_t step = zigzag(values[i] - (i > 0 ? values[i - 1] : 0));
        for (size_t plane = 0; plane < 4; ++plane) bytes[plane * values.size() + i] = std::byte(step >> (8 * plane) & 255);
    }
    return bytes;
}
std::vector<uint32_t> values_of_bytes(std::span<const std::byte> bytes) {
    std::vector<uint32_t> values(bytes.size() / 4);
    uint32_t last = 0;
    for (size_t i = 0; i < values.size(); ++i) {
        uint32_t step = 0;
        for (size_t plane = 0; plane < 4; ++plane) step |= uint32_t(bytes[plane * values.size() + i]) << (8 * plane);
        values[i] = last += unzigzag(step);
    }
    return values;
}

bool is_height(int64_t value) {
    return value >= -kHeightMax && value <= kHeightMax;
}

}  // namespace

TileGrid::TileGrid(const Shape& shape)
    : shape_(shape), top_(top_level(shape)), span_log2_(block_log2(shape)), blocks_(blocks_of(shape)), stages_(top_ + 1) {
    uint32_t first = 0;
    for (uint32_t stage = top_ + 1; stage-- > 0;) {
        uint32_t span_log2 = span_log2_ + stage;
        stages_[stage] = {first, blocks_along(shape.width, span_log2), blocks_along(shape.height, span_log2)};
        first += stages_[stage].columns * stages_[stage].rows;
    }
}

std::vector<uint32_t> TileGrid::needs_of(uint32_t tile) const {
    const Block& b = blocks_[tile];
    if (b.is_top) return {};
    LevelGrid grid = level_grid(shape_, b.level);
    GridPlace from = origin(tile);
    uint32_t side = (kTileSide - 1) << b.level;
    uint32_t x_last = std::min(from.x + side, (grid.columns - 1) << b.level),
             y_last = std::min(from.y + side, (grid.rows - 1) << b.level);
    std::vector<uint32_t> needs{at(b.level + 1, from.x, from.y), at(b.level + 1, x_last, from.y), at(b.level + 1, from.x, y_last),
                                at(b.level + 1, x_last, y_last)};
    std::sort(needs.begin(), needs.end());
    needs.erase(std::unique(needs.begin(), needs.end()), needs.end());
    return needs;
}

Result<void> write_tiles(container::Writer& writer, const Terrain& terrain) {
    SquareRanges ranges(terrain);
    std::vector<Block> blocks = blocks_of(terrain.shape);
    std::vector<std::byte> directory(tiles_at::head_bytes + blocks.size() * tiles_at::entry_bytes, std::byte(0));
    int64_t sum = 0;
    for (int32_t height : terrain.heights) sum += height == kVoid ? 0 : height;
    store_le<uint64_t>(directory, tiles_at::height_sum, uint64_t(sum));

    if (auto begun = writer.begin(kTilesTag, container::kCheckedInParts); !begun) return begun;
    uint64_t offset = 0;
    for (size_t first = 0; first < blocks.size(); first += kTilesAtOnce) {
        std::vector<Result<std::vector<std::byte>>> packed(std::min(kTilesAtOnce, blocks.size() - first));
        std::vector<uint32_t> raw_bytes(packed.size());
        parallel_ranges(packed.size(), 1, [&](size_t i, size_t) {
            std::vector<std::byte> raw = bytes_of_values(values_of(terrain, ranges, blocks[first + i]));
            raw_bytes[i] = uint32_t(raw.size());
            packed[i] = zstd_compressed("terrain tile", raw);
        });
        for (size_t i = 0; i < packed.size(); ++i) {
            if (!packed[i]) return tl::unexpected(packed[i].error());
            std::span<std::byte> entry =
                std::span(directory).subspan(tiles_at::head_bytes + (first + i) * tiles_at::entry_bytes, tiles_at::entry_bytes);
            store_le<uint64_t>(entry, tiles_at::offset, offset);
            store_le<uint64_t>(entry, tiles_at::checksum, block_checksum(*packed[i]));
            store_le<uint32_t>(entry, tiles_at::stored_bytes, uint32_t(packed[i]->size()));
            store_le<uint32_t>(entry, tiles_at::raw_bytes, raw_bytes[i]);
            if (auto appended = writer.append(*packed[i]); !appended) return appended;
            offset += packed[i]->size();
        }
    }
    if (auto ended = writer.end(); !ended) return ended;
    return writer.add(kTileDirectoryTag, 0, container::Codec::none, directory);
}

TileFile::TileFile(const container::Reader& file, Head head) : file_(&file), head_(std::move(head)), grid_(head_.terrain.shape) {}

Result<TileFile> TileFile::open(const container::Reader& file) {
    Result<Head> head = read_head(file);
    if (!head) return tl::unexpected(head.error());
    if (file.find(kTilesTag) == nullptr && file.find(kTileDirectoryTag) == nullptr)
        return bad_input("{}: holds no tiles to stream; bake it again with --streamed", file.name());
    TileFile tiles(file, std::move(*head));
    if (auto read = tiles.read_directory(); !read) return tl::unexpected(read.error());
    if (auto read = read_texture(file, tiles.head_.terrain.texture); !read) return tl::unexpected(read.error());
    return tiles;
}

Result<void> TileFile::read_directory() {
    const container::Section *parts = file_->find(kTilesTag), *section = file_->find(kTileDirectoryTag);
    if (parts == nullptr || section == nullptr) return broken(*file_, 18, "one of the sections TTIL and TTLD is missing");
    uint64_t expected = tiles_at::head_bytes + uint64_t(grid_.count()) * tiles_at::entry_bytes;
    bool is_plain = parts->codec == container::Codec::none && section->codec == container::Codec::none;
    if (!is_plain || section->raw_bytes != expected)
        return broken(*file_, 18, "a directory of {} bytes; {} tiles need {}, uncompressed", section->raw_bytes, grid_.count(),
                      expected);
    auto bytes = file_->read(*section, expected);
    if (!bytes) return tl::unexpected(bytes.error());
    if (load_le<uint64_t>(*bytes, tiles_at::reserved) != 0) return broken(*file_, 18, "a reserved number is not zero");
    height_sum_ = int64_t(load_le<uint64_t>(*bytes, tiles_at::height_sum));

    stored_ = file_->stored(*parts);
    uint64_t offset = 0;
    for (uint32_t i = 0; i < grid_.count(); ++i) {
        std::span<const std::byte> at =
            std::span(*bytes).subspan(tiles_at::head_bytes + i * tiles_at::entry_bytes, tiles_at::entry_bytes);
        Entry entry{load_le<uint64_t>(at, tiles_at::offset), load_le<uint64_t>(at, tiles_at::checksum),
                    load_le<uint32_t>(at, tiles_at::stored_bytes), load_le<uint32_t>(at, tiles_at::raw_bytes)};
        if (entry.offset != offset || entry.stored_bytes > stored_.size() - offset)
            return broken(*file_, 18, "tile {} is {} bytes at {}; the one before ends at {} of {}", i, entry.stored_bytes,
                          entry.offset, offset, stored_.size());
        offset += entry.stored_bytes;
        entries_.push_back(entry);
    }
    if (offset != stored_.size()) return broken(*file_, 18, "the last tile ends at {} of {} bytes", offset, stored_.size());
    return {};
}

double TileFile::mean_height_m() const {
    const Terrain& terrain = head_.terrain;
    uint64_t count = uint64_t(terrain.shape.width) * terrain.shape.height;
    if (head_.void_count >= count) return terrain.height_offset_m;
    return terrain.height_offset_m + terrain.height_step_m * (double(height_sum_) / double(count - head_.void_count));
}

StepRange TileFile::whole() const {
    StepRange whole;
    for (const DirectoryEntry& entry : head_.entries) {
        if (entry.range.low > entry.range.high) continue;
        whole = {std::min(whole.low, entry.range.low), std::max(whole.high, entry.range.high)};
    }
    return whole;
}

Fault TileFile::raw_values(uint32_t tile, std::vector<std::byte>& raw) const {
    const Entry& entry = entries_[tile];
    std::span<const std::byte> stored = stored_.subspan(entry.offset, entry.stored_bytes);
    if (block_checksum(stored) != entry.checksum) return {19, "its bytes do not match their checksum; was the file damaged?"};
    if (entry.raw_bytes != 4 * counts_of(head_.terrain.shape, grid_.block(tile)).values())
        return {19, "states other bytes than its squares and its edge need"};
    if (!fault_of_zstd_frame(stored, entry.raw_bytes).empty()) return {19, "is not a zstd frame of the bytes it states"};
    raw.resize(entry.raw_bytes);
    if (!zstd_decode(stored, raw).empty()) return {19, "does not decode to the bytes it states"};
    return {};
}

Result<std::vector<std::byte>> TileFile::decode(uint32_t tile, std::span<const std::span<const std::byte>> needed) const {
    const Shape& shape = head_.terrain.shape;
    const Block& block = grid_.block(tile);
    std::vector<std::byte> bytes(grid_.bytes(tile), std::byte(0)), raw;
    auto* heights = reinterpret_cast<int32_t*>(bytes.data());
    auto* ranges = reinterpret_cast<StepRange*>(bytes.data() + TileGrid::kRangesAt);
    auto* codes = reinterpret_cast<uint8_t*>(bytes.data() + grid_.codes_at(tile));
    std::fill(heights, heights + kTileSamples, kVoid);

    // Take over the coarser vertices.
    GridPlace from = grid_.origin(tile);
    std::vector<uint32_t> needs = grid_.needs_of(tile);
    LevelGrid level = level_grid(shape, block.level);
    for (uint32_t j = 0; !block.is_top && j < kTileSide; j += 2)
        for (uint32_t i = 0; i < kTileSide; i += 2) {
            uint32_t x = from.x + (i << block.level), y = from.y + (j << block.level);
            if ((x >> block.level) >= level.columns || (y >> block.level) >= level.rows) continue;
            uint32_t owner = grid_.at(block.level + 1, x, y);
            size_t place = size_t(std::find(needs.begin(), needs.end(), owner) - needs.begin());
            std::memcpy(heights + j * kTileSide + i, needed[place].data() + 4 * size_t(grid_.local(owner, x, y)), 4);
        }

    // Unpack its own.
    const DirectoryEntry& entry = head_.entries[tile];
    Fault fault =
        raw_of_block(head_.stored.subspan(entry.offset, entry.stored_bytes), entry, packed_bytes_max(shape, block), raw);
    if (fault.text != nullptr) return broken(*file_, fault.rule, "block {}: {}", tile, fault.text);
    HeightGrid grid{heights, kTileSide, from.x, from.y, block.level};
    auto code_row = [&](const Extent& extent, Run run) {
        return CodeRow{codes + grid.index(run.i << extent.level, run.j << extent.level), ptrdiff_t(2)
                                                                                             << (extent.level - block.level)};
    };
    if (const char* wrong = unpack_block(raw, block, shape, grid, code_row))
        return broken(*file_, 12, "block {}: {}", tile, wrong);

    // Add what stands beside the block.
    fault = raw_values(tile, raw);
    if (fault.text != nullptr) return broken(*file_, fault.rule, "tile {}: {}", tile, fault.text);
    std::vector<uint32_t> values = values_of_bytes(raw);
    size_t square = 0, square_count = counts_of(shape, block).squares, beyond = 2 * square_count;
    bool is_fine = true;
    visit_squares(shape, block, [&](uint32_t x, uint32_t y, uint32_t at_level) {
        int64_t low = int32_t(values[square]), extent = values[square_count + square];
        ++square;
        if (extent == 0) {
            ranges[grid_.local_square(tile, x, y, at_level)] = StepRange{};
            return;
        }
        is_fine = is_fine && is_height(low) && is_height(low + extent - 1);
        ranges[grid_.local_square(tile, x, y, at_level)] = {int32_t(low), int32_t(low + extent - 1)};
    });
    visit_beyond(shape, block, [&](uint32_t x, uint32_t y) {
        int32_t height = int32_t(values[beyond++]);
        is_fine = is_fine && (height == kVoid || is_height(height));
        heights[grid.index(x, y)] = height;
    });
    if (!is_fine) return broken(*file_, 19, "tile {}: has a height beyond 2^28 steps", tile);
    return bytes;
}

Result<void> check_tiles(const container::Reader& file, const Head& head) {
    if (file.find(kTilesTag) == nullptr && file.find(kTileDirectoryTag) == nullptr) return {};
    const Terrain& terrain = head.terrain;
    Head bare;
    bare.terrain.shape = terrain.shape;
    TileFile tiles(file, std::move(bare));
    if (auto read = tiles.read_directory(); !read) return read;

    SquareRanges ranges(terrain);
    std::vector<Fault> faults(tiles.grid_.count());
    parallel_ranges(faults.size(), 1, [&](size_t i, size_t) {
        std::vector<std::byte> raw;
        faults[i] = tiles.raw_values(uint32_t(i), raw);
        if (faults[i].text != nullptr) return;
        if (raw != bytes_of_values(values_of(terrain, ranges, tiles.grid_.block(uint32_t(i)))))
            faults[i] = {20, "says other of its squares or its edge than the heights do"};
    });
    for (size_t i = 0; i < faults.size(); ++i)
        if (faults[i].text != nullptr) return broken(file, faults[i].rule, "tile {}: {}", i, faults[i].text);
    int64_t sum = 0;
    for (int32_t height : terrain.heights) sum += height == kVoid ? 0 : height;
    if (sum != tiles.height_sum_) return broken(file, 20, "heights of {} steps in all, {} stated", sum, tiles.height_sum_);
    return {};
}

}  // namespace overlook::terrain
