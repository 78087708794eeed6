// A baked terrain tile by tile, so that a part of it can be in memory: a tile is one block with all that a cut asks of it there -
// every height of its grid, its codes, and how low and high the ground is round its squares. See formats/spec/terrain.md, TTIL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "formats/container.h"
#include "formats/terrain.h"
#include "formats/terrain_head.h"
#include "formats/terrain_ranges.h"

namespace overlook::terrain {

struct GridPlace {
    uint32_t x = 0, y = 0;  // virtual
};

constexpr uint32_t kTileSide = 129;  // vertices of its level each way, the first of the next tile's counted in
constexpr uint32_t kTileSamples = kTileSide * kTileSide;

// Which tiles there are: tile i is block i of the file, coarse to fine; those of stage t hold split vertices of level t, those of
// the coarsest stage of all levels from there up.
class TileGrid {
  public:
    explicit TileGrid(const Shape& shape);

    uint32_t count() const { return uint32_t(blocks_.size()); }
    uint32_t top() const { return top_; }
    const Block& block(uint32_t tile) const { return blocks_[tile]; }
    // The tile that has virtual vertex (x, y) in its grid of stage `stage`, of that stage or a coarser level.
    uint32_t at(uint32_t stage, uint32_t x, uint32_t y) const {
        const Stage& s = stages_[stage];
        uint32_t bx = x >> (span_log2_ + stage), by = y >> (span_log2_ + stage);
        return s.first + (by < s.rows ? by : s.rows - 1) * s.columns + (bx < s.columns ? bx : s.columns - 1);
    }
    // Its first vertex, and where a vertex of its grid stands in a tile's heights and codes.
    GridPlace origin(uint32_t tile) const {
        const Block& b = blocks_[tile];
        return {b.bx << (span_log2_ + b.level), b.by << (span_log2_ + b.level)};
    }
    uint32_t local(uint32_t tile, uint32_t x, uint32_t y) const {
        GridPlace from = origin(tile);
        uint32_t level = blocks_[tile].level;
        return ((y - from.y) >> level) * kTileSide + ((x - from.x) >> level);
    }
    // Where the range of the square of side 2^(level+1) round vertex (x, y) stands in a tile's ranges.
    uint32_t local_square(uint32_t tile, uint32_t x, uint32_t y, uint32_t level) const {
        GridPlace from = origin(tile);
        uint32_t up = level - blocks_[tile].level;
        return kSquaresBefore[up] + ((y - from.y) >> (level + 1)) * (64u >> up) + ((x - from.x) >> (level + 1));
    }
    // The tiles of the next coarser stage that have the coarser vertices of a tile's grid: 0 of a coarsest one, else 1, 2 or 4.
    std::vector<uint32_t> needs_of(uint32_t tile) const;

    // A tile in memory: kTileSamples heights in steps (i32), range_count() ranges (two i32), kTileSamples codes.
    uint32_t range_count(uint32_t tile) const { return blocks_[tile].is_top ? kSquaresBefore[7] : kSquaresBefore[1]; }
    static constexpr size_t kRangesAt = size_t(4) * kTileSamples;
    size_t codes_at(uint32_t tile) const { return kRangesAt + size_t(8) * range_count(tile); }
    size_t bytes(uint32_t tile) const { return codes_at(tile) + kTileSamples; }

  private:
    static constexpr uint32_t kSquaresBefore[8] = {0, 4096, 5120, 5376, 5440, 5456, 5460, 5461};
    struct Stage {
        uint32_t first = 0, columns = 0, rows = 0;
    };
    Shape shape_;
    uint32_t top_, span_log2_;
    std::vector<Block> blocks_;
    std::vector<Stage> stages_;
};

// Adds the sections TTIL and TTLD, which let a terrain be streamed: after write().
Result<void> write_tiles(container::Writer& writer, const Terrain& terrain);

class TileFile {
  public:
    // Checks T1 to T10, T17 and T18. The file must outlive it. Fails with Exit::bad_input, besides by the rules:
    //   "valley.ovl: holds no tiles to stream; bake it again with --streamed"
    static Result<TileFile> open(const container::Reader& file);

    const Terrain& head() const { return head_.terrain; }  // without heights and codes
    const TileGrid& grid() const { return grid_; }
    double mean_height_m() const;  // of all valid samples; the offset if there is none
    StepRange whole() const;       // of all samples, as the file states it

    // A tile in memory; needed: those of needs_of(tile), in their order. Heights beyond the raster are those at its edge, heights
    // of vertices that the tile has not, kVoid. Checks T11, T12 and T19; what a whole reading checks besides is not known
    // of one tile. May be called by several threads at once.
    Result<std::vector<std::byte>> decode(uint32_t tile, std::span<const std::span<const std::byte>> needed) const;

  private:
    friend Result<void> check_tiles(const container::Reader& file, const Head& head);
    struct Entry {
        uint64_t offset, checksum;
        uint32_t stored_bytes, raw_bytes;
    };
    TileFile(const container::Reader& file, Head head);
    Result<void> read_directory();
    Fault raw_values(uint32_t tile, std::vector<std::byte>& raw) const;

    const container::Reader* file_;
    Head head_;
    TileGrid grid_;
    int64_t height_sum_ = 0;
    std::vector<Entry> entries_;
    std::span<const std::byte> stored_;  // TTIL
};

// T18 to T20 of a terrain read whole (head.terrain), if it has tiles.
Result<void> check_tiles(const container::Reader& file, const Head& head);

}  // namespace overlook::terrain
