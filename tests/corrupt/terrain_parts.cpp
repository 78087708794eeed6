#include "tests/corrupt/terrain_parts.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <sstream>

#include "formats/little_endian.h"
#include "formats/terrain_layout.h"

namespace overlook::terrain::fixtures {
namespace {

using container::fixtures::RawSection;

void append(Bytes& bytes, std::span<const std::byte> more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
}

// Header of a block of a frame: its size, type (0 raw, 1 run) and whether it is the last.
void append_block_header(Bytes& frame, size_t size, uint32_t type, bool is_last) {
    uint32_t header = uint32_t(size) << 3 | type << 1 | uint32_t(is_last);
    for (int shift = 0; shift < 24; shift += 8) frame.push_back(std::byte(header >> shift & 255));
}

void put_u32(Bytes& bytes, size_t at, uint32_t value) {
    store_le<uint32_t>(bytes, at, value);
}

Bytes info_of(const Terrain& terrain) {
    Bytes info(1152);
    put_u32(info, 0, terrain.shape.width), put_u32(info, 4, terrain.shape.height);
    store_f64(info, 8, terrain.height_step_m), store_f64(info, 16, terrain.height_offset_m),
        store_f64(info, 24, terrain.finest_error_m);
    store_f64(info, 32, terrain.frame.metres_per_column), store_f64(info, 40, terrain.frame.metres_per_row);
    put_u32(info, 48, terrain.frame.is_georeferenced), put_u32(info, 52, 7);
    store_f64(info, 56, terrain.frame.centre_latitude_deg), store_f64(info, 64, terrain.frame.centre_longitude_deg);
    store_f64(info, 72, terrain.frame.convergence_deg), store_f64(info, 80, terrain.frame.scale_distortion);
    store_le<uint64_t>(info, 88, uint64_t(std::count(terrain.heights.begin(), terrain.heights.end(), kVoid)));
    for (size_t i = 0; i < terrain.frame.crs.size(); ++i) info[96 + i] = std::byte(terrain.frame.crs[i]);
    for (size_t code = 0; code < 256; ++code) store_f32(info, 128 + 4 * code, terrain.error_m[code]);
    return info;
}

}  // namespace

Bytes frame_of(std::span<const std::byte> raw) {
    Bytes frame = container::fixtures::bytes_of("\x28\xb5\x2f\xfd");
    frame.push_back(std::byte(raw.size() < 256 ? 0x20 : 0xa0));  // single segment, content size in one or four bytes
    for (size_t i = 0; i < (raw.size() < 256 ? 1u : 4u); ++i) frame.push_back(std::byte(raw.size() >> (8 * i) & 255));

    size_t plain = raw.size();
    while (plain > 0 && raw[plain - 1] == raw.back()) --plain;
    size_t run = raw.size() - plain;
    if (run < 16) plain = raw.size(), run = 0;
    append_block_header(frame, plain, 0, run == 0);
    append(frame, raw.first(plain));
    if (run == 0) return frame;
    append_block_header(frame, run, 1, true);
    frame.push_back(raw.back());
    return frame;
}

Piece piece_of(const Bytes& raw, BlockRange range) {
    return {frame_of(raw), uint32_t(raw.size()), range};
}

void Parts::lay_out(std::span<const Piece> pieces) {
    directory.clear(), blocks.clear();
    for (const Piece& piece : pieces) {
        Bytes entry(32);
        store_le<uint64_t>(entry, 0, blocks.size());
        put_u32(entry, 8, uint32_t(piece.stored.size())), put_u32(entry, 12, piece.raw_bytes);
        store_le<uint64_t>(entry, 16, block_checksum(piece.stored));
        put_u32(entry, 24, uint32_t(piece.range.low)), put_u32(entry, 28, uint32_t(piece.range.high));
        append(directory, entry), append(blocks, piece.stored);
    }
}

void Parts::lay_out_tile(const Bytes& raw, uint64_t height_sum) {
    tiles = frame_of(raw);
    tile_directory.assign(16 + 24, std::byte(0));
    store_le<uint64_t>(tile_directory, 0, height_sum);
    store_le<uint64_t>(tile_directory, 24, block_checksum(tiles));
    put_u32(tile_directory, 32, uint32_t(tiles.size())), put_u32(tile_directory, 36, uint32_t(raw.size()));
}

Parts Parts::of(const Terrain& terrain) {
    Parts parts;
    parts.info = info_of(terrain);
    std::vector<Piece> pieces;
    for (const Block& block : blocks_of(terrain.shape))
        pieces.push_back(piece_of(pack_block(terrain, block), range_of(terrain, block)));
    parts.lay_out(pieces);
    if (terrain.texture.pixels.empty()) return parts;
    parts.texture.resize(8);
    put_u32(parts.texture, 0, terrain.texture.width), put_u32(parts.texture, 4, terrain.texture.height);
    append(parts.texture, std::as_bytes(std::span(terrain.texture.pixels)));
    return parts;
}

Bytes terrain_file_of(std::span<const RawSection> sections) {
    Bytes file = container::fixtures::file_of(sections);
    store_le<uint32_t>(file, 32, kKind);
    container::fixtures::seal(file);
    return file;
}

Bytes Parts::file() const {
    auto section = [](std::string_view tag, uint32_t flags, uint32_t codec, const Bytes& raw) {
        return RawSection{tag, flags, codec, codec == 0 ? raw : frame_of(raw), raw.size()};
    };
    std::vector<RawSection> sections{section("TINF", 1, 0, info),
                                     section("TBLK", blocks_codec == 0 ? 3 : 1, blocks_codec, blocks),
                                     section("TDIR", 1, directory_codec, directory)};
    if (!texture.empty()) sections.push_back(section("TTEX", 0, 1, texture));
    if (!tiles.empty()) sections.push_back(section("TTIL", 2, 0, tiles));
    if (!tile_directory.empty()) sections.push_back(section("TTLD", 0, 0, tile_directory));
    return terrain_file_of(sections);
}

Bytes file_of(const Terrain& terrain) {
    return Parts::of(terrain).file();
}

Bytes bytes_of_hexdump(const std::string& document) {
    std::istringstream lines(document.substr(document.find("```hexdump\n") + 11));
    Bytes bytes;
    bool repeats = false;
    for (std::string line; std::getline(lines, line) && line != "```";) {
        if (line == "*") {
            repeats = true;
            continue;
        }
        size_t offset = std::strtoull(line.c_str(), nullptr, 16);
        while (repeats && bytes.size() >= 16 && bytes.size() < offset) {
            Bytes last(bytes.end() - 16, bytes.end());
            append(bytes, last);
        }
        repeats = false;
        if (line.size() < 60) continue;  // the last line is an offset alone
        std::istringstream digits(line.substr(8, line.find('|') - 8));
        for (std::string pair; digits >> pair;) bytes.push_back(std::byte(std::stoul(pair, nullptr, 16)));
    }
    return bytes;
}

}  // namespace overlook::terrain::fixtures
