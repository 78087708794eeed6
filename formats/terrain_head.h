// What of a baked terrain stands before its heights, and how one block is taken from the file: what readers of the whole and of
// tiles share.
#pragma once

#include <span>
#include <vector>

#include "formats/container.h"
#include "formats/terrain.h"
#include "formats/terrain_blocks.h"

namespace overlook::terrain {

template <class... Args>
tl::unexpected<Error> broken(const container::Reader& file, int rule, fmt::format_string<Args...> text, Args&&... args) {
    return bad_input("{}: T{}: {}", file.name(), rule, fmt::format(text, std::forward<Args>(args)...));
}

struct DirectoryEntry {
    uint64_t offset, checksum;
    uint32_t stored_bytes, raw_bytes;
    BlockRange range;
};

struct Head {
    Terrain terrain;  // without heights, codes and texture
    uint64_t void_count = 0;
    std::vector<DirectoryEntry> entries;  // of the blocks
    std::span<const std::byte> stored;    // TBLK, in the file
};

// Rules T1 to T10.
Result<Head> read_head(const container::Reader& file);
// Rule T17; leaves the texture empty if there is none.
Result<void> read_texture(const container::Reader& file, ImageRgb8& texture);

// Null, or what is wrong with a block, and which rule that breaks.
struct Fault {
    int rule = 0;
    const char* text = nullptr;
};

// A block's bytes before compression, which are no more than raw_bytes_max: T11 and the first half of T12.
Fault raw_of_block(std::span<const std::byte> stored, const DirectoryEntry& entry, uint64_t raw_bytes_max,
                   std::vector<std::byte>& raw);

}  // namespace overlook::terrain
