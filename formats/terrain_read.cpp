#include <algorithm>
#include <new>

#include "formats/parallel.h"
#include "formats/terrain_check.h"
#include "formats/terrain_head.h"
#include "formats/terrain_tiles.h"

namespace overlook::terrain {
namespace {

using container::Reader;

Fault read_block(std::span<const std::byte> stored, const DirectoryEntry& entry, const Block& block, Terrain& terrain) {
    std::vector<std::byte> raw;
    if (Fault fault = raw_of_block(stored, entry, packed_bytes_max(terrain.shape, block), raw); fault.text != nullptr)
        return fault;
    if (const char* wrong = unpack_block(raw, block, terrain)) return {12, wrong};
    BlockRange range = range_of(terrain, block);
    if (range.low != entry.range.low || range.high != entry.range.high)
        return {13, "its heights are not in the range that its entry states"};
    return {};
}

// Blocks of one level do not depend on each other: they are read in parallel, level by level.
Result<void> read_blocks(const Reader& file, std::span<const std::byte> stored, std::span<const DirectoryEntry> entries,
                         Terrain& terrain) {
    std::vector<Block> blocks = blocks_of(terrain.shape);
    std::vector<Fault> faults(blocks.size());
    for (size_t first = 0; first < blocks.size();) {
        size_t end = first;
        while (end < blocks.size() && blocks[end].level == blocks[first].level) ++end;
        parallel_ranges(end - first, 1, [&](size_t i, size_t) {
            const DirectoryEntry& entry = entries[first + i];
            faults[first + i] = read_block(stored.subspan(entry.offset, entry.stored_bytes), entry, blocks[first + i], terrain);
        });
        for (size_t i = first; i < end; ++i)
            if (faults[i].text != nullptr) return broken(file, faults[i].rule, "block {}: {}", i, faults[i].text);
        first = end;
    }
    return {};
}

// What the cuts rely on: nested codes, voids that nothing unsplit covers.
Result<void> check_promises(const Reader& file, uint64_t stated, const Terrain& terrain) {
    if (auto place = find_code_above_parent(terrain))
        return broken(file, 14, "the diamond at column {}, row {}, level {} has a higher code than its parent", place->x,
                      place->y, place->level);
    if (auto place = find_unmarked_void(terrain))
        return broken(file, 15, "the diamond at column {}, row {} covers a void and is not marked", place->x, place->y);
    uint64_t voids = uint64_t(std::count(terrain.heights.begin(), terrain.heights.end(), kVoid));
    if (voids != stated) return broken(file, 16, "{} voids, its head states {}", voids, stated);
    return {};
}

Result<Terrain> read_all(const Reader& file) {
    Result<Head> head = read_head(file);
    if (!head) return tl::unexpected(head.error());
    Terrain& terrain = head->terrain;
    terrain.heights.assign(size_t(terrain.shape.width) * terrain.shape.height, 0);
    for (uint32_t level = 0; level < terrain.shape.root_log2; ++level) {
        LevelGrid grid = level_grid(terrain.shape, level);
        terrain.codes.emplace_back(size_t(grid.columns) * grid.rows, uint8_t(0));
    }
    if (auto ok = read_blocks(file, head->stored, head->entries, terrain); !ok) return tl::unexpected(ok.error());
    if (auto ok = check_promises(file, head->void_count, terrain); !ok) return tl::unexpected(ok.error());
    if (auto ok = read_texture(file, terrain.texture); !ok) return tl::unexpected(ok.error());
    if (auto ok = check_tiles(file, *head); !ok) return tl::unexpected(ok.error());
    return std::move(terrain);
}

}  // namespace

Result<Terrain> read(const Reader& file) {
    try {
        return read_all(file);
    } catch (const std::bad_alloc&) {
        return impossible("{}: there is not enough memory for this terrain", file.name());
    }
}

Result<Terrain> read(const std::string& path) {
    auto file = Reader::open(path);
    if (!file) return tl::unexpected(file.error());
    return read(*file);
}

}  // namespace overlook::terrain
