// Where each field of WLDI and of an image's bytes stands: what writer and reader share. Documented in formats/spec/wang_ldi.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "formats/container.h"
#include "formats/little_endian.h"
#include "formats/wang_ldi.h"

namespace overlook::wang_ldi {

constexpr container::Tag kDirectoryTag = container::tag("WLDI");
constexpr container::Tag kImagesTag = container::tag("WLDS");

// Offsets within WLDI, in bytes.
namespace head_at {
constexpr size_t tiles = 0, levels = 4, directions = 8, contexts = 12, flags = 16, reserved = 20, tile_m = 24, low_m = 32,
                 high_m = 40, eye_low_m = 48, eye_high_m = 56, nearest_m = 64, farthest_m = 72, focal_px = 80, error_px = 88,
                 to_sun = 96, level_fade = 120, direction_fade = 124, bytes = 128;
}
constexpr uint32_t kHasNormals = 1, kHasSplats = 2, kIsGrouped = 4;

// Within a level's entry, after the head, and an image's, after the levels'.
namespace level_at {
constexpr size_t side_px = 0, nearest_m = 4, height_step_m = 8, splat_px = 12, entry_bytes = 16;
}
namespace ldi_at {
constexpr size_t offset = 0, checksum = 8, stored_bytes = 16, raw_bytes = 20, samples = 24, colours = 28, unseen_share = 32,
                 reserved = 36, entry_bytes = 40;
}

constexpr float kMostSplat_px = 64;
constexpr uint64_t kMostRawBytes = uint64_t(1) << 30;

// Which rule something breaks, and how; rule 0: none.
struct ImageFault {
    int rule = 0;
    std::string text;
    explicit operator bool() const { return rule != 0; }
};

// Bytes of an image before compression.
uint64_t raw_bytes_of(const ImageSet& set, uint32_t side_px, uint64_t samples, uint64_t colours);

std::vector<std::byte> bytes_of_ldi(const ImageSet& set, const Ldi& ldi);  // not grouped
// `bytes` are exactly raw_bytes_of the entry's counts and may be hostile otherwise.
ImageFault ldi_of_bytes(std::span<const std::byte> bytes, const ImageSet& set, uint32_t level, const Entry& entry, Ldi& ldi);

// Rows of 16-bit numbers: all low bytes, then all high bytes.
void put_planes(std::vector<std::byte>& bytes, std::span<const uint16_t> values);
inline uint16_t plane_value(std::span<const std::byte> planes, size_t count, size_t i) {
    return uint16_t(uint16_t(planes[i]) | uint16_t(planes[count + i]) << 8);
}
// Rows of either form that are neither predicted nor grouped. take_...: ldi has its samples, `bytes` these rows and no more.
void put_normals_and_splats(const Ldi& ldi, std::vector<std::byte>& bytes);
void take_normals_and_splats(std::span<const std::byte> bytes, const ImageSet& set, Ldi& ldi);

// The head and the levels; bytes_of_head does not ask whether they keep the rules.
std::vector<std::byte> bytes_of_head(const ImageSet& set);

// Of the set's heights, the highest: 0..65535.
uint32_t highest_step(const ImageSet& set, uint32_t level);

// The rules that hold of any set and image, whether read or to be written. Each looks at what the ones before it left right.
ImageFault fault_of_counts(const ImageSet& set);                               // L3; the levels' count is that of set.levels
ImageFault fault_of_places(const ImageSet& set);                               // L5
ImageFault fault_of_levels(const ImageSet& set);                               // L6
ImageFault fault_of_ldi(const ImageSet& set, uint32_t level, const Ldi& ldi);  // L12 to L15

}  // namespace overlook::wang_ldi
