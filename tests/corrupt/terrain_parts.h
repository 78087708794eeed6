// A baked terrain in pieces that can be broken one by one, and put together with right checksums.
#pragma once

#include "formats/terrain_blocks.h"
#include "tests/corrupt/terrain_fixtures.h"

namespace overlook::terrain::fixtures {

// One zstd frame by hand (RFC 8878): a raw block, and what is left if it is one repeated byte as a run.
Bytes frame_of(std::span<const std::byte> raw);

// A block as its entry states it.
struct Piece {
    Bytes stored;
    uint32_t raw_bytes = 0;
    BlockRange range;
};
Piece piece_of(const Bytes& raw, BlockRange range);

struct Parts {
    Bytes info, directory, blocks, texture;
    Bytes tiles, tile_directory;                     // both empty: the file has no tiles
    uint32_t directory_codec = 0, blocks_codec = 0;  // with another than 0 those bytes go into a frame

    static Parts of(const Terrain& terrain);
    // Directory and blocks anew.
    void lay_out(std::span<const Piece> pieces);
    // One tile of these raw bytes, as its entry states it.
    void lay_out_tile(const Bytes& raw, uint64_t height_sum);
    // The file; has no section TTEX if the texture is empty.
    Bytes file() const;
};

// A file of any sections, of kind TERR.
Bytes terrain_file_of(std::span<const container::fixtures::RawSection> sections);

}  // namespace overlook::terrain::fixtures
