// A terrain of which a part is in memory: tiles that come and go as its cuts ask for them (runtime/stream).
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "formats/container.h"
#include "formats/terrain_diamond.h"
#include "formats/terrain_tiles.h"
#include "runtime/stream/stream.h"
#include "runtime/terrain/height_bounds.h"

namespace overlook::terrain {

// Each tile that is there has a slot of its own, in which a vertex's place is slot * kTileSamples + its local one: what cuts and
// graphics cards call it by.
class Tiles {
  public:
    // Takes in the coarsest tiles, which stay. Fails as TileFile::open, TileFile::decode and stream::Stream.
    static Result<std::unique_ptr<Tiles>> open(container::Reader file, const stream::Settings& settings);
    Tiles(const Tiles&) = delete;
    Tiles& operator=(const Tiles&) = delete;

    const Terrain& head() const { return file_->head(); }  // without heights and codes
    const TileFile& file() const { return *file_; }
    const TileGrid& grid() const { return file_->grid(); }
    const stream::Counts& counts() const { return stream_->counts(); }
    bool is_settled() const { return stream_->is_settled(); }

    // A frame: begin, any number of cuts, end. Of what begin_frame() tells, tiles that have arrived have their slot already.
    const stream::Stream::Changes& begin_frame();
    void end_frame();

    struct View {
        const int32_t* heights = nullptr;  // [kTileSide, kTileSide]; null: the tile is not there
        const HeightRange* ranges = nullptr;
        const uint8_t* codes = nullptr;
        uint32_t slot = 0;
    };
    const View& view(uint32_t tile) const { return views_[tile]; }
    uint32_t slot_count() const { return slot_count_; }  // the most there can be

    // May the cut split here? Only if the tiles of all that must be split before are there; marks them as used. If a vertex is
    // available, so are all those that its splitting follows from: then a cut that splits only what is available has no cracks.
    // Both may be called by many threads at once.
    bool is_available(GridPoint v, uint32_t level, bool is_square) const;
    // Asks for those of these tiles that are missing, the greatest priority >= 0 first.
    void ask_for(GridPoint v, uint32_t level, bool is_square, float priority) const;

    // A sample's height in steps, if the finest tile there is there.
    std::optional<int32_t> height(uint32_t column, uint32_t row) const;
    // How low and high the ground is in and round a cell (column < width - 1, row < height - 1), by the finest tile that is
    // there.
    HeightRange range_round(uint32_t column, uint32_t row) const;

  private:
    Tiles() = default;
    template <class Visit>
    void visit_wanted(GridPoint v, uint32_t level, bool is_square, const Visit& visit) const;
    void take_slot(uint32_t tile);

    container::Reader reader_;
    std::optional<TileFile> file_;
    std::vector<View> views_;
    std::vector<uint32_t> free_slots_;
    uint32_t slot_count_ = 0;
    // Of the present frame: 1 if wanted, and the bits of the greatest priority that a missing tile was asked for with, plus 1.
    mutable std::vector<std::atomic<uint32_t>> used_, asked_;
    std::unique_ptr<stream::Stream> stream_;  // last: its workers use the others
};

// The ranges of the tiles that are there, for BasicScreenTest. Only of vertices that are available.
class TileBounds {
  public:
    explicit TileBounds(const Tiles& tiles);
    HeightRange of_square(uint32_t x, uint32_t y, uint32_t level) const;

  private:
    const Tiles& tiles_;
    uint32_t top_;
    std::vector<GridPoint> last_;  // of each level, the middle of its last square
};

}  // namespace overlook::terrain
