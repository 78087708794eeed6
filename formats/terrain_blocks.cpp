#include "formats/terrain_blocks.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "formats/little_endian.h"
#include "formats/terrain_extents.h"

namespace overlook::terrain {
namespace {

constexpr size_t kHeadBytes = 4;  // planes, has_voids, two reserved

// A rounded-down mean of the neighbours that are already there: of a square its corners, of an edge its ends and, within the
// block, the middles of the squares beside it.
class Predictor {
  public:
    // `extent` is one on the raster.
    Predictor(const Shape& shape, const HeightGrid& grid, const Extent& extent, bool is_top)
        : shape_(shape),
          grid_(grid),
          extent_(extent),
          is_top_(is_top),
          step_x_(ptrdiff_t(1) << (extent.level - grid.log2)),
          step_y_(step_x_ * ptrdiff_t(grid.stride)) {}

    // Where all four neighbours of a vertex of row j are within the block: columns [begin, end), none if end <= begin.
    std::pair<uint32_t, uint32_t> inner_columns(uint32_t j) const {
        if (j <= extent_.j_begin || j + 1 >= extent_.j_end) return {0, 0};
        return {extent_.i_begin + 1, extent_.i_end - 1};
    }

    // The same as at() for such a vertex, which stands at `height`.
    int32_t at_inner(const int32_t* height, uint32_t i, uint32_t j) const {
        bool is_square = (i & j & 1) != 0;
        ptrdiff_t first = is_square ? step_y_ + step_x_ : step_x_, second = is_square ? step_y_ - step_x_ : step_y_;
        int32_t a = height[-first], b = height[first], c = height[-second], d = height[second];
        if (a == kVoid || b == kVoid || c == kVoid || d == kVoid) return at(i, j);
        return int32_t((int64_t(a) + b + c + d) >> 2);
    }

    int32_t at(uint32_t i, uint32_t j) const {
        Sum sum;
        if ((i & j & 1) != 0) {
            coarser(i - 1, j - 1, sum), coarser(i + 1, j - 1, sum), coarser(i - 1, j + 1, sum), coarser(i + 1, j + 1, sum);
        } else if ((i & 1) != 0) {
            coarser(i - 1, j, sum), coarser(i + 1, j, sum), within(i, int64_t(j) - 1, sum), within(i, int64_t(j) + 1, sum);
        } else {
            coarser(i, j - 1, sum), coarser(i, j + 1, sum), within(int64_t(i) - 1, j, sum), within(int64_t(i) + 1, j, sum);
        }
        if (sum.count == 0) return 0;
        return int32_t(sum.heights >= 0 ? sum.heights / sum.count : -((-sum.heights + sum.count - 1) / sum.count));
    }

  private:
    struct Sum {
        int64_t heights = 0, count = 0;
    };

    // A vertex of a coarser level: there in any case, but for those of the top block beside this one.
    void coarser(uint32_t i, uint32_t j, Sum& sum) const { is_top_ ? within(i, j, sum) : add(i, j, sum); }
    void within(int64_t i, int64_t j, Sum& sum) const {
        bool inside = i >= int64_t(extent_.i_begin) && i < int64_t(extent_.i_end) && j >= int64_t(extent_.j_begin) &&
                      j < int64_t(extent_.j_end);
        if (inside) add(uint32_t(i), uint32_t(j), sum);
    }
    void add(uint32_t i, uint32_t j, Sum& sum) const {
        uint64_t x = uint64_t(i) << extent_.level, y = uint64_t(j) << extent_.level;
        if (x >= shape_.width || y >= shape_.height) return;
        int32_t height = grid_.heights[grid_.index(uint32_t(x), uint32_t(y))];
        if (height == kVoid) return;
        sum.heights += height, ++sum.count;
    }

    const Shape& shape_;
    const HeightGrid& grid_;
    const Extent& extent_;
    bool is_top_;
    ptrdiff_t step_x_, step_y_;  // to the next vertex of the level, in the grid
};

// Calls visit(height index, prediction) for every sample of a block, in the order in which it stands in the file.
template <class Visit>
void visit_samples(const Shape& shape, const HeightGrid& grid, const Block& block, const Visit& visit) {
    int32_t last = 0;
    visit_corners(shape, block, [&](uint32_t x, uint32_t y) {
        size_t index = grid.index(x, y);
        visit(index, last);
        if (grid.heights[index] != kVoid) last = grid.heights[index];
    });
    for (const Extent& whole : extents_of(shape, block)) {
        Extent extent = on_raster(shape, whole);
        Predictor predictor(shape, grid, extent, block.is_top);
        visit_runs(extent, [&](Run run) {
            if (run.i >= run.i_end) return;
            size_t index = grid.index(run.i << extent.level, run.j << extent.level);
            auto [begin, end] = predictor.inner_columns(run.j);
            for (uint32_t i = run.i; i < run.i_end; i += 2, index += size_t(2) << (extent.level - grid.log2)) {
                bool is_inner = i >= begin && i < end;
                visit(index, is_inner ? predictor.at_inner(grid.heights + index, i, run.j) : predictor.at(i, run.j));
            }
        });
    }
}

// The codes of a terrain, or of one tile.
const uint8_t* codes_of(const Terrain& terrain, const Extent& extent, Run run) {
    return terrain.codes[extent.level].data() + size_t(run.j) * level_grid(terrain.shape, extent.level).columns + run.i;
}

// The heights of a whole terrain; those who only look at them take care not to write.
HeightGrid grid_of(const Terrain& terrain) {
    return {const_cast<int32_t*>(terrain.heights.data()), terrain.shape.width, 0, 0, 0};
}

uint32_t zigzag(int32_t value) {
    return (uint32_t(value) << 1) ^ uint32_t(value >> 31);
}
int32_t unzigzag(uint32_t value) {
    return int32_t((value >> 1) ^ (0u - (value & 1)));
}

struct Counts {
    uint64_t samples = 0, codes = 0;
};

Counts counts_of(const Shape& shape, const Block& block) {
    Counts counts;
    visit_corners(shape, block, [&](uint32_t, uint32_t) { ++counts.samples; });
    for (const Extent& extent : extents_of(shape, block)) {
        counts.codes += vertex_count(extent);
        counts.samples += vertex_count(on_raster(shape, extent));
    }
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
    auto add = [&](int32_t height) {
        if (height == kVoid) return;
        range.low = std::min(range.low, height), range.high = std::max(range.high, height);
    };
    const Shape& shape = terrain.shape;
    visit_corners(shape, block, [&](uint32_t x, uint32_t y) { add(terrain.heights[size_t(y) * shape.width + x]); });
    for (const Extent& extent : extents_of(shape, block))
        visit_runs(on_raster(shape, extent), [&](Run run) {
            const int32_t* row = terrain.heights.data() + (size_t(run.j) << extent.level) * shape.width;
            for (uint32_t i = run.i; i < run.i_end; i += 2) add(row[size_t(i) << extent.level]);
        });
    return range.low <= range.high ? range : BlockRange{};
}

std::vector<std::byte> pack_block(const Terrain& terrain, const Block& block) {
    Counts counts = counts_of(terrain.shape, block);
    std::vector<std::byte> void_bits((counts.samples + 7) / 8, std::byte(0));
    std::vector<uint32_t> residuals;
    residuals.reserve(counts.samples);
    uint64_t sample = 0;
    uint32_t all_bits = 0;
    visit_samples(terrain.shape, grid_of(terrain), block, [&](size_t index, int32_t prediction) {
        int32_t height = terrain.heights[index];
        if (height == kVoid) {
            void_bits[sample / 8] |= std::byte(1u << (sample % 8));
        } else {
            residuals.push_back(zigzag(height - prediction));
            all_bits |= residuals.back();
        }
        ++sample;
    });
    uint32_t planes = all_bits >> 24 ? 4 : all_bits >> 16 ? 3 : all_bits >> 8 ? 2 : 1;
    bool has_voids = residuals.size() < counts.samples;

    std::vector<std::byte> bytes{std::byte(planes), std::byte(has_voids), std::byte(0), std::byte(0)};
    bytes.reserve(kHeadBytes + void_bits.size() + planes * residuals.size() + counts.codes);
    if (has_voids) bytes.insert(bytes.end(), void_bits.begin(), void_bits.end());
    for (uint32_t plane = 0; plane < planes; ++plane)
        for (uint32_t residual : residuals) bytes.push_back(std::byte(residual >> (8 * plane) & 255));
    for (const Extent& extent : extents_of(terrain.shape, block))
        visit_runs(extent, [&](Run run) {
            const uint8_t* code = codes_of(terrain, extent, run);
            for (uint32_t i = run.i; i < run.i_end; i += 2, code += 2) bytes.push_back(std::byte(*code));
        });
    return bytes;
}

const char* unpack_block(std::span<const std::byte> bytes, const Block& block, Terrain& terrain) {
    auto code_row = [&](const Extent& extent, Run run) {
        return CodeRow{const_cast<uint8_t*>(codes_of(terrain, extent, run)), 2};
    };
    return unpack_block(bytes, block, terrain.shape, grid_of(terrain), code_row);
}

const char* unpack_block(std::span<const std::byte> bytes, const Block& block, const Shape& shape, const HeightGrid& grid,
                         const std::function<CodeRow(const Extent&, Run)>& code_row) {
    Counts counts = counts_of(shape, block);
    if (bytes.size() < kHeadBytes) return "is shorter than its head";
    uint32_t planes = uint32_t(bytes[0]);
    if (planes < 1 || planes > 4) return "has a count of height planes outside 1..4";
    if (uint8_t(bytes[1]) > 1 || bytes[2] != std::byte(0) || bytes[3] != std::byte(0))
        return "has reserved bits that are not zero";
    bool has_voids = bytes[1] == std::byte(1);

    uint64_t void_bytes = has_voids ? (counts.samples + 7) / 8 : 0;
    if (bytes.size() < kHeadBytes + void_bytes) return "is shorter than its map of voids";
    std::span<const std::byte> void_bits = bytes.subspan(kHeadBytes, void_bytes);
    uint64_t void_count = 0;
    for (std::byte bits : void_bits) void_count += uint64_t(std::popcount(uint8_t(bits)));
    if (has_voids && counts.samples % 8 != 0 && uint8_t(void_bits.back()) >> (counts.samples % 8) != 0)
        return "marks voids after its last sample";
    uint64_t valid_count = counts.samples - void_count;
    if (bytes.size() != kHeadBytes + void_bytes + planes * valid_count + counts.codes)
        return "has another length than its vertices need";

    std::vector<uint32_t> residuals(valid_count);
    for (uint32_t plane = 0; plane < planes; ++plane) {
        const std::byte* stored = bytes.data() + kHeadBytes + void_bytes + plane * valid_count;
        for (uint64_t k = 0; k < valid_count; ++k) residuals[k] |= uint32_t(stored[k]) << (8 * plane);
    }
    uint64_t sample = 0;
    const uint32_t* residual = residuals.data();
    bool in_range = true;
    visit_samples(shape, grid, block, [&](size_t index, int32_t prediction) {
        uint64_t k = sample++;
        if (has_voids && (uint8_t(void_bits[k / 8]) >> (k % 8) & 1) != 0) {
            grid.heights[index] = kVoid;
            return;
        }
        int64_t height = int64_t(prediction) + unzigzag(*residual++);
        if (height > kHeightMax || height < -kHeightMax) in_range = false, height = 0;
        grid.heights[index] = int32_t(height);
    });
    const std::byte* code = bytes.data() + kHeadBytes + void_bytes + planes * valid_count;
    for (const Extent& extent : extents_of(shape, block))
        visit_runs(extent, [&](Run run) {
            if (run.i >= run.i_end) return;
            CodeRow row = code_row(extent, run);
            for (uint32_t i = run.i; i < run.i_end; i += 2, row.code += row.step) *row.code = uint8_t(*code++);
        });
    return in_range ? nullptr : "has a height beyond 2^28 steps";
}

uint64_t packed_bytes_max(const Shape& shape, const Block& block) {
    Counts counts = counts_of(shape, block);
    return kHeadBytes + (counts.samples + 7) / 8 + 4 * counts.samples + counts.codes;
}

}  // namespace overlook::terrain
