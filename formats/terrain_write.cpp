#include <algorithm>
#include <cstring>

#include "formats/compression.h"
#include "formats/parallel.h"
#include "formats/terrain.h"
#include "formats/terrain_blocks.h"
#include "formats/terrain_layout.h"

namespace overlook::terrain {
namespace {

using container::Codec;
using container::kCheckedInParts;
using container::kMustUnderstand;

// Blocks packed at once, so that memory stays small beside the terrain's own.
constexpr size_t kBlocksAtOnce = 256;

std::vector<std::byte> info_bytes(const Terrain& terrain) {
    std::vector<std::byte> bytes(info_at::bytes, std::byte(0));
    const Frame& frame = terrain.frame;
    store_le<uint32_t>(bytes, info_at::width, terrain.shape.width);
    store_le<uint32_t>(bytes, info_at::height, terrain.shape.height);
    store_f64(bytes, info_at::height_step_m, terrain.height_step_m);
    store_f64(bytes, info_at::height_offset_m, terrain.height_offset_m);
    store_f64(bytes, info_at::finest_error_m, terrain.finest_error_m);
    store_f64(bytes, info_at::metres_per_column, frame.metres_per_column);
    store_f64(bytes, info_at::metres_per_row, frame.metres_per_row);
    store_le<uint32_t>(bytes, info_at::flags, frame.is_georeferenced ? kIsGeoreferenced : 0);
    store_le<uint32_t>(bytes, info_at::block_log2_max, kBlockLog2Max);
    store_f64(bytes, info_at::centre_latitude_deg, frame.centre_latitude_deg);
    store_f64(bytes, info_at::centre_longitude_deg, frame.centre_longitude_deg);
    store_f64(bytes, info_at::convergence_deg, frame.convergence_deg);
    store_f64(bytes, info_at::scale_distortion, frame.scale_distortion);
    store_le<uint64_t>(bytes, info_at::void_count, uint64_t(std::count(terrain.heights.begin(), terrain.heights.end(), kVoid)));
    std::memcpy(bytes.data() + info_at::crs, frame.crs.data(), std::min(frame.crs.size(), kCrsBytes));
    for (size_t code = 0; code < 256; ++code) store_f32(bytes, info_at::error_m + 4 * code, terrain.error_m[code]);
    return bytes;
}

// What no reader would take, if we made it; null if there is nothing.
const char* fault_of(const Terrain& terrain) {
    const Shape& shape = terrain.shape;
    if (shape.width < 2 || shape.height < 2 || uint64_t(shape.width) * shape.height > kSamplesMax)
        return "a raster of too few or too many samples";
    bool fits = terrain.heights.size() == uint64_t(shape.width) * shape.height && terrain.codes.size() == shape.root_log2;
    for (uint32_t level = 0; fits && level < shape.root_log2; ++level) {
        LevelGrid grid = level_grid(shape, level);
        fits = terrain.codes[level].size() == uint64_t(grid.columns) * grid.rows;
    }
    if (!fits) return "heights or codes that do not fit the raster's size";
    const std::string& crs = terrain.frame.crs;
    bool is_plain = std::all_of(crs.begin(), crs.end(), [](char c) { return c >= ' ' && c <= '~'; });
    if (crs.size() > kCrsBytes || !is_plain) return "a reference system's name that is too long or not printable";
    const ImageRgb8& texture = terrain.texture;
    if (texture.pixels.size() != uint64_t(3) * texture.width * texture.height) return "a texture without all its pixels";
    return nullptr;
}

struct PackedBlock {
    Result<std::vector<std::byte>> bytes;
    size_t raw_bytes = 0;
    BlockRange range;
};

Result<void> write_blocks(container::Writer& writer, const Terrain& terrain, std::vector<std::byte>& directory) {
    std::vector<Block> blocks = blocks_of(terrain.shape);
    directory.resize(blocks.size() * directory_at::entry_bytes);
    if (auto begun = writer.begin(kBlocksTag, kMustUnderstand | kCheckedInParts); !begun) return begun;
    uint64_t offset = 0;
    for (size_t first = 0; first < blocks.size(); first += kBlocksAtOnce) {
        std::vector<PackedBlock> packed(std::min(kBlocksAtOnce, blocks.size() - first));
        parallel_ranges(packed.size(), 1, [&](size_t i, size_t) {
            std::vector<std::byte> raw = pack_block(terrain, blocks[first + i]);
            packed[i] = {zstd_compressed("terrain block", raw), raw.size(), range_of(terrain, blocks[first + i])};
        });
        for (size_t i = 0; i < packed.size(); ++i) {
            if (!packed[i].bytes) return tl::unexpected(packed[i].bytes.error());
            const std::vector<std::byte>& bytes = *packed[i].bytes;
            std::span<std::byte> entry =
                std::span(directory).subspan((first + i) * directory_at::entry_bytes, directory_at::entry_bytes);
            store_le<uint64_t>(entry, directory_at::offset, offset);
            store_le<uint32_t>(entry, directory_at::stored_bytes, uint32_t(bytes.size()));
            store_le<uint32_t>(entry, directory_at::raw_bytes, uint32_t(packed[i].raw_bytes));
            store_le<uint64_t>(entry, directory_at::checksum, block_checksum(bytes));
            store_le<uint32_t>(entry, directory_at::low, uint32_t(packed[i].range.low));
            store_le<uint32_t>(entry, directory_at::high, uint32_t(packed[i].range.high));
            if (auto appended = writer.append(bytes); !appended) return appended;
            offset += bytes.size();
        }
    }
    return writer.end();
}

Result<void> write_texture(container::Writer& writer, const ImageRgb8& texture) {
    std::vector<std::byte> bytes(kTextureHeadBytes + texture.pixels.size());
    store_le<uint32_t>(bytes, 0, texture.width);
    store_le<uint32_t>(bytes, 4, texture.height);
    std::memcpy(bytes.data() + kTextureHeadBytes, texture.pixels.data(), texture.pixels.size());
    return writer.add(kTextureTag, 0, Codec::zstd, bytes);
}

}  // namespace

Result<void> write(container::Writer& writer, const Terrain& terrain) {
    if (const char* fault = fault_of(terrain))
        return tl::unexpected(Error{Exit::our_bug, fmt::format("a terrain to write has {}", fault)});
    if (auto added = writer.add(kInfoTag, kMustUnderstand, Codec::none, info_bytes(terrain)); !added) return added;
    std::vector<std::byte> directory;
    if (auto written = write_blocks(writer, terrain, directory); !written) return written;
    if (auto added = writer.add(kDirectoryTag, kMustUnderstand, Codec::none, directory); !added) return added;
    if (terrain.texture.pixels.empty()) return {};
    return write_texture(writer, terrain.texture);
}

}  // namespace overlook::terrain
