// The head of a baked terrain: everything but the heights.
#include "formats/terrain_head.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "formats/compression.h"
#include "formats/terrain_check.h"
#include "formats/terrain_layout.h"

namespace overlook::terrain {
namespace {

using container::Reader;
using container::Section;

bool is_between(double value, double low, double high) {
    return value >= low && value <= high;
}  // false for NaN

// The fields of TINF that need no other section.
Result<void> read_shape(const Reader& file, std::span<const std::byte> info, Terrain& terrain) {
    uint32_t width = load_le<uint32_t>(info, info_at::width), height = load_le<uint32_t>(info, info_at::height);
    if (width < 2 || height < 2 || uint64_t(width) * height > kSamplesMax)
        return broken(file, 3, "a raster of {} x {} samples; at least 2 x 2 and at most 2^31 in all are allowed", width, height);
    terrain.shape = shape_of(width, height);

    Frame& frame = terrain.frame;
    frame.metres_per_column = load_f64(info, info_at::metres_per_column);
    frame.metres_per_row = load_f64(info, info_at::metres_per_row);
    for (double metres : {frame.metres_per_column, frame.metres_per_row})
        if (!is_between(metres, 1e-6, 1e7))
            return broken(file, 4, "cells of {} x {} metres", frame.metres_per_column, frame.metres_per_row);

    terrain.height_step_m = load_f64(info, info_at::height_step_m);
    terrain.height_offset_m = load_f64(info, info_at::height_offset_m);
    if (!(terrain.height_step_m > 0) ||
        !is_between(std::abs(terrain.height_offset_m) + terrain.height_step_m * kHeightMax, 0, 1e12))
        return broken(file, 5, "heights in steps of {} m from {} m", terrain.height_step_m, terrain.height_offset_m);
    return {};
}

Result<void> read_errors(const Reader& file, std::span<const std::byte> info, Terrain& terrain) {
    terrain.finest_error_m = load_f64(info, info_at::finest_error_m);
    for (size_t code = 0; code < 256; ++code) terrain.error_m[code] = load_f32(info, info_at::error_m + 4 * code);
    if (!is_between(terrain.finest_error_m, 0, 1e12) || terrain.error_m[0] != float_at_least(terrain.finest_error_m))
        return broken(file, 6, "a finest error of {} m, and {} m for code 0", terrain.finest_error_m, terrain.error_m[0]);
    for (size_t code = 1; code < kMustSplit; ++code)
        if (!std::isfinite(terrain.error_m[code]) || terrain.error_m[code] < terrain.error_m[code - 1])
            return broken(file, 7, "error code {} is {} m after {} m", code, terrain.error_m[code], terrain.error_m[code - 1]);
    if (terrain.error_m[kMustSplit] != std::numeric_limits<float>::infinity())
        return broken(file, 7, "error code 255 is {} m, it must be infinite", terrain.error_m[kMustSplit]);
    return {};
}

Result<void> read_place(const Reader& file, std::span<const std::byte> info, Frame& frame) {
    uint32_t flags = load_le<uint32_t>(info, info_at::flags);
    frame.is_georeferenced = flags == kIsGeoreferenced;
    frame.centre_latitude_deg = load_f64(info, info_at::centre_latitude_deg);
    frame.centre_longitude_deg = load_f64(info, info_at::centre_longitude_deg);
    frame.convergence_deg = load_f64(info, info_at::convergence_deg);
    frame.scale_distortion = load_f64(info, info_at::scale_distortion);
    const char* crs = reinterpret_cast<const char*>(info.data() + info_at::crs);
    frame.crs.assign(crs, strnlen(crs, kCrsBytes));

    bool is_tidy = flags <= kIsGeoreferenced && load_le<uint32_t>(info, info_at::block_log2_max) == kBlockLog2Max;
    is_tidy = is_tidy && std::all_of(frame.crs.begin(), frame.crs.end(), [](char c) { return c >= ' ' && c <= '~'; });
    is_tidy = is_tidy && std::all_of(crs + frame.crs.size(), crs + kCrsBytes, [](char c) { return c == 0; });
    if (!is_tidy) return broken(file, 8, "unknown flags, a block size that is not 128, or an unprintable reference system");
    if (!is_between(frame.centre_latitude_deg, -90, 90) || !is_between(frame.centre_longitude_deg, -540, 540) ||
        !is_between(frame.convergence_deg, -360, 360) || !is_between(frame.scale_distortion, 0, 1e6))
        return broken(file, 8, "a middle at latitude {}, longitude {}, turned by {} degrees", frame.centre_latitude_deg,
                      frame.centre_longitude_deg, frame.convergence_deg);
    return {};
}

// One entry a block, in order, filling TBLK exactly.
Result<std::vector<DirectoryEntry>> read_directory(const Reader& file, const Section& section, const Section& blocks,
                                                   const Shape& shape) {
    uint64_t count = block_count_of(shape);
    if (section.codec != container::Codec::none || section.raw_bytes != count * directory_at::entry_bytes)
        return broken(file, 9, "a directory of {} bytes; {} blocks need {}, uncompressed", section.raw_bytes, count,
                      count * directory_at::entry_bytes);
    if (blocks.codec != container::Codec::none)
        return broken(file, 10, "TBLK is compressed as a whole, its blocks must be one by one");
    auto bytes = file.read(section, section.raw_bytes);
    if (!bytes) return tl::unexpected(bytes.error());

    std::vector<DirectoryEntry> entries(count);
    uint64_t expected = 0;
    for (uint64_t i = 0; i < count; ++i) {
        std::span<const std::byte> at = std::span(*bytes).subspan(i * directory_at::entry_bytes, directory_at::entry_bytes);
        entries[i] = {load_le<uint64_t>(at, directory_at::offset),
                      load_le<uint64_t>(at, directory_at::checksum),
                      load_le<uint32_t>(at, directory_at::stored_bytes),
                      load_le<uint32_t>(at, directory_at::raw_bytes),
                      {int32_t(load_le<uint32_t>(at, directory_at::low)), int32_t(load_le<uint32_t>(at, directory_at::high))}};
        if (entries[i].offset != expected || entries[i].stored_bytes > blocks.stored_bytes - expected)
            return broken(file, 10, "block {} is {} bytes at {}; the one before ends at {} of {}", i, entries[i].stored_bytes,
                          entries[i].offset, expected, blocks.stored_bytes);
        expected += entries[i].stored_bytes;
    }
    if (expected != blocks.stored_bytes)
        return broken(file, 10, "the last block ends at {} of {} bytes", expected, blocks.stored_bytes);
    return entries;
}

}  // namespace

Result<Head> read_head(const Reader& file) {
    static constexpr container::Tag kKnown[] = {kInfoTag,          kDirectoryTag,         kBlocksTag, kTextureTag, kTilesTag,
                                                kTileDirectoryTag, container::tag("PROV")};
    const Section *info_section = file.find(kInfoTag), *directory = file.find(kDirectoryTag), *blocks = file.find(kBlocksTag);
    if (file.kind() != kKind || info_section == nullptr || directory == nullptr || blocks == nullptr)
        return broken(file, 1, "is no baked terrain (its kind is {})", container::tag_text(file.kind()));
    if (auto known = file.require_known(kKnown); !known) return tl::unexpected(known.error());
    if (info_section->raw_bytes != info_at::bytes) return broken(file, 2, "TINF has {} bytes", info_section->raw_bytes);
    auto info = file.read(*info_section, info_at::bytes);
    if (!info) return tl::unexpected(info.error());

    Head head;
    if (auto ok = read_shape(file, *info, head.terrain); !ok) return tl::unexpected(ok.error());
    if (auto ok = read_errors(file, *info, head.terrain); !ok) return tl::unexpected(ok.error());
    if (auto ok = read_place(file, *info, head.terrain.frame); !ok) return tl::unexpected(ok.error());
    head.void_count = load_le<uint64_t>(*info, info_at::void_count);
    auto entries = read_directory(file, *directory, *blocks, head.terrain.shape);
    if (!entries) return tl::unexpected(entries.error());
    head.entries = std::move(*entries);
    head.stored = file.stored(*blocks);
    return head;
}

Fault raw_of_block(std::span<const std::byte> stored, const DirectoryEntry& entry, uint64_t raw_bytes_max,
                   std::vector<std::byte>& raw) {
    if (block_checksum(stored) != entry.checksum) return {11, "its bytes do not match their checksum; was the file damaged?"};
    if (entry.raw_bytes > raw_bytes_max) return {12, "states more bytes than its vertices need"};
    if (!fault_of_zstd_frame(stored, entry.raw_bytes).empty()) return {12, "is not a zstd frame of the bytes it states"};
    raw.resize(entry.raw_bytes);
    if (!zstd_decode(stored, raw).empty()) return {12, "does not decode to the bytes it states"};
    return {};
}

Result<void> read_texture(const Reader& file, ImageRgb8& texture) {
    const Section* found = file.find(kTextureTag);
    if (found == nullptr) return {};
    const Section& section = *found;
    constexpr uint64_t kMost = kTextureHeadBytes + uint64_t(3) * kTextureSideMax * kTextureSideMax;
    if (section.raw_bytes < kTextureHeadBytes || section.raw_bytes > kMost)
        return broken(file, 17, "a texture of {} bytes", section.raw_bytes);
    auto bytes = file.read(section, kMost);
    if (!bytes) return tl::unexpected(bytes.error());
    texture.width = load_le<uint32_t>(*bytes, 0), texture.height = load_le<uint32_t>(*bytes, 4);
    bool fits =
        texture.width >= 1 && texture.width <= kTextureSideMax && texture.height >= 1 && texture.height <= kTextureSideMax;
    if (!fits || bytes->size() != kTextureHeadBytes + uint64_t(3) * texture.width * texture.height)
        return broken(file, 17, "a texture of {} x {} pixels in {} bytes", texture.width, texture.height, bytes->size());
    texture.pixels.resize(bytes->size() - kTextureHeadBytes);
    std::memcpy(texture.pixels.data(), bytes->data() + kTextureHeadBytes, texture.pixels.size());
    return {};
}

}  // namespace overlook::terrain
