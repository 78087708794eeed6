// Where each field of the discrete sections stands: what writer and reader share. Documented in formats/spec/discrete.md.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "formats/container.h"
#include "formats/discrete.h"
#include "formats/little_endian.h"

namespace overlook::discrete {

constexpr container::Tag kInfoTag = container::tag("DINF");
constexpr container::Tag kLevelsTag = container::tag("DLEV");
constexpr container::Tag kGeometryTag = container::tag("DGEO");
constexpr container::Tag kSurfacesTag = container::tag("DSUR");
constexpr container::Tag kPartsTag = container::tag("DPRT");
constexpr container::Tag kVisibilityTag = container::tag("DVIS");

// Offsets within DINF, in bytes.
namespace info_at {
constexpr size_t levels = 0, parts = 4, surfaces = 8, visibilities = 12, attributes = 16, pictures = 20, origin_m = 24,
                 position_step_m = 48, uv_low = 56, uv_step = 72, middle_m = 80, radius_m = 104, clip_s = 112,
                 finest_error_m = 120, bytes = 128;
}
constexpr uint32_t kHasNormals = 1, kHasUvs = 2, kHasColours = 4;
constexpr double kMostClip_s = 1e6;

// Offsets within an entry of DLEV, in bytes.
namespace level_at {
constexpr size_t rung = 0, flags = 4, error_m = 8, lost_area_share = 12, vertices = 16, indices = 20, draws = 24,
                 vertex_bytes = 28, index_bytes = 32, added_area_share = 36, entry_bytes = 40;
}
constexpr uint32_t kIsPlain = 1;
constexpr uint32_t kCountMax = 1u << 28;
constexpr uint32_t kSurfacesMax = 1u << 16;
constexpr size_t kDrawBytes = 8;  // surface, count of indices
constexpr uint64_t kGeometryBytesMax = uint64_t(1) << 31;
constexpr uint64_t kSurfaceBytesMax = uint64_t(1) << 30;

// DPRT: of each part its name (size, bytes), pivot (3 f32), count of keys; then of each key its time (f32) and pose (7 f32).
constexpr size_t kKeyBytes = 32;
constexpr uint32_t kNameBytesMax = 1 << 12;
constexpr uint64_t kPartBytesMax = uint64_t(1) << 28;
constexpr double kTurnSlack = 1e-3;  // of a turn's length from 1

// DVIS: of each lookup, width, height, depth (u32), period (f32), then a byte for each value.
constexpr size_t kVisibilityHeadBytes = 20;
constexpr uint32_t kMostSide = 4096, kMostValues = 1u << 24;
constexpr uint64_t kVisibilityBytesMax = uint64_t(kMostLevels) * (kMostValues + kVisibilityHeadBytes);

// Of the sphere: what rests may stand out of it by so much of its radius, for rounding.
constexpr double kSphereSlack = 1e-6;

// Which rule something breaks, and how; rule 0: none.
struct Fault {
    int rule = 0;
    std::string text;
    explicit operator bool() const { return rule != 0; }
};

// How much of DGEO a level takes.
struct LevelSize {
    uint32_t vertices = 0, indices = 0, draws = 0, vertex_bytes = 0, index_bytes = 0;
    uint64_t bytes() const { return uint64_t(vertex_bytes) + index_bytes + kDrawBytes * uint64_t(draws); }
};

// A level's part of DGEO, and back. `bytes` are exactly its size and may be hostile; no more memory is taken than they can hold.
std::vector<std::byte> bytes_of_level(const Level& level, LevelSize& size);
Fault level_of_bytes(std::span<const std::byte> bytes, const LevelSize& size, uint32_t part_count, uint32_t surface_count,
                     Level& level);

// The rules that hold of any chain, whether it was read or is to be written. Each looks at what the ones before it left right.
Fault fault_of_places(const Chain& chain);                         // D4
Fault fault_of_errors(const Chain& chain);                         // D9
Fault fault_of_level(const Level& level, uint32_t part_count);     // D11, D12
Fault fault_of_draws(const Level& level, uint32_t surface_count);  // D13
Fault fault_of_pictures(const Chain& chain);                       // D19
Fault fault_of_part(const Part& part, double clip_s, bool rests);  // D15, D16
Fault fault_of_sphere(const Chain& chain);                         // D17
Fault fault_of_visibility(const Visibility& visibility);           // D18, but for the count of its values

std::vector<std::byte> bytes_of_parts(const std::vector<Part>& parts);
Fault parts_of_bytes(std::span<const std::byte> bytes, uint32_t count, std::vector<Part>& parts);
std::vector<std::byte> bytes_of_visibility(const std::vector<Visibility>& visibility);
Fault visibility_of_bytes(std::span<const std::byte> bytes, uint32_t count, std::vector<Visibility>& visibility);

}  // namespace overlook::discrete
