// Any bytes as ground of Wang tiles: nothing may crash, leak or take memory without bound; what is read keeps its promises, has
// surroundings, tiles the plane or says why not, and packs into the same again.
#include <cstdint>
#include <vector>

#include "formats/little_endian.h"
#include "formats/wang_layout.h"
#include "runtime/wang_ldi/tiling.h"
#include "tests/fuzz/fuzz_sections.h"

namespace {

using namespace overlook;
using namespace overlook::container;
using fuzz::require;

// There is no directory of blocks: nothing more to mend than the kind.
constexpr fuzz::Blocks kBlocks{wang_ldi::kKind, 0, 0, 64, 0, 0, 0, nullptr};

void use(const wang_ldi::PlantedTiles& ground) {
    require(!wang_ldi::fault_of_set(ground.set) && !wang_ldi::fault_of_models(ground.planting) &&
            !wang_ldi::fault_of_objects(ground.set, ground.planting));
    wang_ldi::TileSet set;
    require(!wang_ldi::tiles_of_bytes(wang_ldi::bytes_of_tiles(ground.set), set) && set == ground.set);
    wang_ldi::Planting planting;
    require(!wang_ldi::planting_of_bytes(wang_ldi::bytes_of_planting(ground.planting), planting) && planting == ground.planting);
    for (size_t t = 0; t < ground.set.tiles.size(); ++t)
        for (const wang_ldi::Planted& object : wang_ldi::overhang(ground.set, ground.planting, t))
            require(object.model < ground.planting.models.size());
    auto tiling = wang_ldi::tile_row_by_row(ground.set, 4, 4, {});
    if (tiling) require(wang_ldi::count_neighbours(ground.set, *tiling).disagreeing == 0);
}

void read_all(std::span<const std::byte> bytes) {
    Result<Reader> file = Reader::open_bytes(bytes, "fuzz");
    if (!file) return;
    Result<wang_ldi::PlantedTiles> read = wang_ldi::read(*file);
    if (read) use(*read);
    if (!read) require(read.error().exit != Exit::our_bug);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    fuzz::read_both({reinterpret_cast<const std::byte*>(data), size}, kBlocks, fuzz::has_small_sections, read_all);
    return 0;
}
