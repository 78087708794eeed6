// Where each field of the terrain's sections stands: what writer and reader share. Documented in formats/spec/terrain.md.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "formats/container.h"
#include "formats/little_endian.h"

namespace overlook::terrain {

constexpr container::Tag kInfoTag = container::tag("TINF");
constexpr container::Tag kDirectoryTag = container::tag("TDIR");
constexpr container::Tag kBlocksTag = container::tag("TBLK");
constexpr container::Tag kTextureTag = container::tag("TTEX");
constexpr container::Tag kTilesTag = container::tag("TTIL");
constexpr container::Tag kTileDirectoryTag = container::tag("TTLD");

// Offsets within TINF, in bytes.
namespace info_at {
constexpr size_t width = 0, height = 4, height_step_m = 8, height_offset_m = 16, finest_error_m = 24, metres_per_column = 32,
                 metres_per_row = 40, flags = 48, block_log2_max = 52, centre_latitude_deg = 56, centre_longitude_deg = 64,
                 convergence_deg = 72, scale_distortion = 80, void_count = 88, crs = 96, error_m = 128, bytes = 1152;
}
constexpr uint64_t kSamplesMax = uint64_t(1) << 31;
constexpr size_t kCrsBytes = 32;
constexpr uint32_t kIsGeoreferenced = 1;

// Offsets within an entry of TDIR, in bytes.
namespace directory_at {
constexpr size_t offset = 0, stored_bytes = 8, raw_bytes = 12, checksum = 16, low = 24, high = 28, entry_bytes = 32;
}

// Offsets within TTLD, in bytes: its head, then within an entry.
namespace tiles_at {
constexpr size_t height_sum = 0, reserved = 8, head_bytes = 16;
constexpr size_t offset = 0, checksum = 8, stored_bytes = 16, raw_bytes = 20, entry_bytes = 24;
}  // namespace tiles_at

// TTEX: width and height (u32), then [height, width, 3] bytes.
constexpr size_t kTextureHeadBytes = 8;
constexpr uint32_t kTextureSideMax = 32768;

// XXH3-64 of a block's stored bytes.
uint64_t block_checksum(std::span<const std::byte> bytes);

}  // namespace overlook::terrain
