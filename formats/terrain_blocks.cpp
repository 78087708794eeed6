#include "formats/terrain_blocks.h"

#include <algorithm>

#include "formats/little_endian.h"

namespace overlook::terrain {
namespace {

constexpr size_t kHeadBytes = 4;  // planes, has_voids, two reserved

uint32_t top_level(const Shape& shape) { return shape.root_log2 - std::min(shape.root_log2, kBlockLog2Max); }
uint32_t block_log2(const Shape& shape) { return std::min(shape.root_log2, kBlockLog2Max); }

uint32_t blocks_along(uint32_t samples, uint32_t span_log2) {
    return uint32_t((uint64_t(samples) - 1 + (uint64_t(1) << span_log2) - 1) >> span_log2);
}

// The grid of a level from which a block takes its vertices: [i_begin, i_end) x [j_begin, j_end). The last block of a row or column holds all that is left.
struct Extent {
    uint32_t level, i_begin, i_end, j_begin, j_end;
};

Extent extent_of(const Shape& shape, const Block& block, uint32_t level) {
    LevelGrid grid = level_grid(shape, level);
    uint32_t span_log2 = block_log2(shape) + block.level, side = span_log2 - level;
    bool is_last_x = block.bx + 1 == blocks_along(shape.width, span_log2), is_last_y = block.by + 1 == blocks_along(shape.height, span_log2);
    return {level, std::min(block.bx << side, grid.columns), is_last_x ? grid.columns : std::min((block.bx + 1) << side, grid.columns),
            std::min(block.by << side, grid.rows), is_last_y ? grid.rows : std::min((block.by + 1) << side, grid.rows)};
}

// The levels whose vertices a block holds, coarse to fine.
std::vector<Extent> extents_of(const Shape& shape, const Block& block) {
    std::vector<Extent> extents;
    if (block.is_top)
        for (uint32_t level = shape.root_log2; level-- > block.level;) extents.push_back(extent_of(shape, block, level));
    else
        extents.push_back(extent_of(shape, block, block.level));
    return extents;
}

// Calls visit(i, j) for the vertices of an extent that belong to its level: first middles of squares, then of edges, row by row.
template <class Visit>
void visit_vertices(const Extent& extent, const Visit& visit) {
    auto first_from = [](uint32_t begin, uint32_t parity) { return begin + ((begin ^ parity) & 1); };
    for (uint32_t j = first_from(extent.j_begin, 1); j < extent.j_end; j += 2)
        for (uint32_t i = first_from(extent.i_begin, 1); i < extent.i_end; i += 2) visit(i, j);
    for (uint32_t j = extent.j_begin; j < extent.j_end; ++j)
        for (uint32_t i = first_from(extent.i_begin, (j + 1) & 1); i < extent.i_end; i += 2) visit(i, j);
}

// The corners of root squares, which belong to no level, as far as a top block holds them.
template <class Visit>
void visit_corners(const Shape& shape, const Block& block, const Visit& visit) {
    if (!block.is_top) return;
    uint64_t side = uint64_t(1) << shape.root_log2;
    for (uint64_t y = block.by * side; y <= (block.by + 1) * side && y < shape.height; y += side)
        for (uint64_t x = block.bx * side; x <= (block.bx + 1) * side && x < shape.width; x += side) {
            bool is_next_x = x != block.bx * side && block.bx + 1 < shape.root_columns;
            bool is_next_y = y != block.by * side && block.by + 1 < shape.root_rows;
            if (!is_next_x && !is_next_y) visit(uint32_t(x), uint32_t(y));
        }
}

// A rounded-down mean of the neighbours that are already there: of a square its corners, of an edge its ends and, within the block, the middles of the squares beside it.
class Predictor {
  public:
    Predictor(const Terrain& terrain, const Extent& extent, bool is_top) : terrain_(terrain), extent_(extent), is_top_(is_top) {}

    int32_t at(uint32_t i, uint32_t j) {
        sum_ = count_ = 0;
        if ((i & j & 1) != 0) {
            coarser(i - 1, j - 1), coarser(i + 1, j - 1), coarser(i - 1, j + 1), coarser(i + 1, j + 1);
        } else if ((i & 1) != 0) {
            coarser(i - 1, j), coarser(i + 1, j), within(i, int64_t(j) - 1), within(i, int64_t(j) + 1);
        } else {
            coarser(i, j - 1), coarser(i, j + 1), within(int64_t(i) - 1, j), within(int64_t(i) + 1, j);
        }
        if (count_ == 0) return 0;
        return int32_t(sum_ >= 0 ? sum_ / count_ : -((-sum_ + count_ - 1) / count_));
    }

  private:
    // A vertex of a coarser level: there in any case, but for those of the top block beside this one.
    void coarser(uint32_t i, uint32_t j) { is_top_ ? within(i, j) : add(i, j); }
    void within(int64_t i, int64_t j) {
        bool inside = i >= int64_t(extent_.i_begin) && i < int64_t(extent_.i_end) && j >= int64_t(extent_.j_begin) && j < int64_t(extent_.j_end);
        if (inside) add(uint32_t(i), uint32_t(j));
    }
    void add(uint32_t i, uint32_t j) {
        uint64_t x = uint64_t(i) << extent_.level, y = uint64_t(j) << extent_.level;
        if (x >= terrain_.shape.width || y >= terrain_.shape.height) return;
        int32_t height = terrain_.heights[y * terrain_.shape.width + x];
        if (height == kVoid) return;
        sum_ += height, ++count_;
    }

    const Terrain& terrain_;
    const Extent& extent_;
    bool is_top_;
    int64_t sum_ = 0, count_ = 0;
};

// Calls visit(height index, prediction) for every sample of a block, in the order in which it stands in the file.
template <class Visit>
void visit_samples(const Terrain& terrain, const Block& block, const Visit& visit) {
    const Shape& shape = terrain.shape;
    int32_t last = 0;
    visit_corners(shape, block, [&](uint32_t x, uint32_t y) {
        size_t index = size_t(y) * shape.width + x;
        visit(index, last);
        if (terrain.heights[index] != kVoid) last = terrain.heights[index];
    });
    for (const Extent& extent : extents_of(shape, block)) {
        Predictor predictor(terrain, extent, block.is_top);
        visit_vertices(extent, [&](uint32_t i, uint32_t j) {
            uint64_t x = uint64_t(i) << extent.level, y = uint64_t(j) << extent.level;
            if (x < shape.width && y < shape.height) visit(size_t(y * shape.width + x), predictor.at(i, j));
        });
    }
}

// Calls visit(code) for every error code of a block, in file order.
template <class Terrain_, class Visit>
void visit_codes(Terrain_& terrain, const Block& block, const Visit& visit) {
    for (const Extent& extent : extents_of(terrain.shape, block)) {
        uint32_t columns = level_grid(terrain.shape, extent.level).columns;
        visit_vertices(extent, [&](uint32_t i, uint32_t j) { visit(terrain.codes[extent.level][size_t(j) * columns + i]); });
    }
}

uint32_t zigzag(int32_t value) { return (uint32_t(value) << 1) ^ uint32_t(value >> 31); }
int32_t unzigzag(uint32_t value) { return int32_t((value >> 1) ^ (0u - (value & 1))); }

struct Counts {
    uint64_t samples = 0, codes = 0;
};

Counts counts_of(const Shape& shape, const Block& block) {
    Counts counts;
    visit_corners(shape, block, [&](uint32_t, uint32_t) { ++counts.samples; });
    for (const Extent& extent : extents_of(shape, block))
        visit_vertices(extent, [&](uint32_t i, uint32_t j) {
            ++counts.codes;
            counts.samples += (uint64_t(i) << extent.level) < shape.width && (uint64_t(j) << extent.level) < shape.height;
        });
    return counts;
}

}  // namespace

std::vector<Block> blocks_of(const Shape& shape) {
    std::vector<Block> blocks;
    for (uint32_t level = top_level(shape) + 1; level-- > 0;) {
        uint32_t span_log2 = block_log2(shape) + level;
        uint32_t columns = blocks_along(shape.width, span_log2), rows = blocks_along(shape.height, span_log2);
        for (uint32_t by = 0; by < rows; ++by)
            for (uint32_t bx = 0; bx < columns; ++bx) blocks.push_back({level, bx, by, level == top_level(shape)});
    }
    return blocks;
}

uint64_t block_count_of(const Shape& shape) {
    uint64_t count = 0;
    for (uint32_t level = 0; level <= top_level(shape); ++level) {
        uint32_t span_log2 = block_log2(shape) + level;
        count += uint64_t(blocks_along(shape.width, span_log2)) * blocks_along(shape.height, span_log2);
    }
    return count;
}

BlockRange range_of(const Terrain& terrain, const Block& block) {
    BlockRange range{std::numeric_limits<int32_t>::max(), std::numeric_limits<int32_t>::min()};
    visit_samples(terrain, block, [&](size_t index, int32_t) {
        int32_t height = terrain.heights[index];
        if (height == kVoid) return;
        range.low = std::min(range.low, height), range.high = std::max(range.high, height);
    });
    return range.low <= range.high ? range : BlockRange{};
}

std::vector<std::byte> pack_block(const Terrain& terrain, const Block& block) {
    std::vector<uint8_t> void_bits;
    std::vector<uint32_t> residuals;
    uint64_t sample_count = 0;
    bool has_voids = false;
    uint32_t all_bits = 0;
    visit_samples(terrain, block, [&](size_t index, int32_t prediction) {
        if (sample_count % 8 == 0) void_bits.push_back(0);
        int32_t height = terrain.heights[index];
        if (height == kVoid) {
            void_bits.back() = uint8_t(void_bits.back() | 1u << (sample_count % 8));
            has_voids = true;
        } else {
            residuals.push_back(zigzag(height - prediction));
            all_bits |= residuals.back();
        }
        ++sample_count;
    });
    uint32_t planes = all_bits >> 24 ? 4 : all_bits >> 16 ? 3 : all_bits >> 8 ? 2 : 1;

    std::vector<std::byte> bytes{std::byte(planes), std::byte(has_voids), std::byte(0), std::byte(0)};
    if (has_voids)
        for (uint8_t bits : void_bits) bytes.push_back(std::byte(bits));
    for (uint32_t plane = 0; plane < planes; ++plane)
        for (uint32_t residual : residuals) bytes.push_back(std::byte(residual >> (8 * plane) & 255));
    visit_codes(terrain, block, [&](uint8_t code) { bytes.push_back(std::byte(code)); });
    return bytes;
}

const char* unpack_block(std::span<const std::byte> bytes, const Block& block, Terrain& terrain) {
    Counts counts = counts_of(terrain.shape, block);
    if (bytes.size() < kHeadBytes) return "is shorter than its head";
    uint32_t planes = uint32_t(bytes[0]);
    if (planes < 1 || planes > 4) return "has a count of height planes outside 1..4";
    if (uint8_t(bytes[1]) > 1 || bytes[2] != std::byte(0) || bytes[3] != std::byte(0)) return "has reserved bits that are not zero";
    bool has_voids = bytes[1] == std::byte(1);

    uint64_t void_bytes = has_voids ? (counts.samples + 7) / 8 : 0;
    if (bytes.size() < kHeadBytes + void_bytes) return "is shorter than its map of voids";
    std::span<const std::byte> void_bits = bytes.subspan(kHeadBytes, void_bytes);
    auto is_void = [&](uint64_t k) { return has_voids && (uint8_t(void_bits[k / 8]) >> (k % 8) & 1) != 0; };
    uint64_t valid_count = 0;
    for (uint64_t k = 0; k < counts.samples; ++k) valid_count += !is_void(k);
    if (bytes.size() != kHeadBytes + void_bytes + planes * valid_count + counts.codes) return "has another length than its vertices need";

    std::span<const std::byte> heights = bytes.subspan(kHeadBytes + void_bytes, planes * valid_count);
    std::span<const std::byte> codes = bytes.subspan(kHeadBytes + void_bytes + planes * valid_count);
    uint64_t sample = 0, valid = 0, code = 0;
    bool in_range = true;
    visit_samples(terrain, block, [&](size_t index, int32_t prediction) {
        if (is_void(sample++)) {
            terrain.heights[index] = kVoid;
            return;
        }
        uint32_t residual = 0;
        for (uint32_t plane = 0; plane < planes; ++plane) residual |= uint32_t(heights[plane * valid_count + valid]) << (8 * plane);
        ++valid;
        int64_t height = int64_t(prediction) + unzigzag(residual);
        if (height > kHeightMax || height < -kHeightMax) in_range = false, height = 0;
        terrain.heights[index] = int32_t(height);
    });
    visit_codes(terrain, block, [&](uint8_t& stored) { stored = uint8_t(codes[code++]); });
    return in_range ? nullptr : "has a height beyond 2^28 steps";
}

uint64_t packed_bytes_max(const Shape& shape, const Block& block) {
    Counts counts = counts_of(shape, block);
    return kHeadBytes + (counts.samples + 7) / 8 + 4 * counts.samples + counts.codes;
}

}  // namespace overlook::terrain
