// Where each field of the caveclod sections stands: what writer and reader share. Documented in formats/spec/caveclod.md.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "formats/caveclod_codes.h"
#include "formats/container.h"
#include "formats/little_endian.h"

namespace overlook::caveclod {

constexpr container::Tag kInfoTag = container::tag("MINF");
constexpr container::Tag kBlocksTag = container::tag("MBLK");
constexpr container::Tag kDirectoryTag = container::tag("MDIR");
constexpr container::Tag kSurfacesTag = container::tag("MSUR");

// Offsets within MINF, in bytes.
namespace info_at {
constexpr size_t base_positions = 0, base_faces = 4, splits = 8, faces = 12, vertices = 16, groups = 20, surfaces = 24,
                 blocks = 28, origin_m = 32, position_step_m = 56, uv_low = 64, uv_step = 80, position_bits = 88, uv_bits = 92,
                 normal_bits = 96, attributes = 100, codec = 104, finest_error = 108, greatest_error = 112, reserved = 116,
                 bytes = 128;
}
constexpr uint32_t kCountMax = 1u << 28;
constexpr uint32_t kSurfacesMax = 1u << 16;
constexpr uint32_t kHasNormals = 1, kHasUvs = 2, kHasColours = 4;

// Offsets within an entry of MDIR, in bytes.
namespace directory_at {
constexpr size_t offset = 0, checksum = 8, stored_bytes = 16, first_split = 20, splits = 24, rest_error = 28, entry_bytes = 32;
}
constexpr uint32_t kBlockSplitsMax = 1u << 14, kFirstBlockSplits = 1u << 10;
// A block holds no more numbers than this for each of its bytes: what bounds the memory that a short file can ask for.
constexpr uint64_t kValuesPerByte = 256;

constexpr uint64_t kSurfaceBytesMax = uint64_t(1) << 30;
constexpr uint32_t kNameBytesMax = 1 << 12;

// XXH3-64 of a block's stored bytes.
uint64_t block_checksum(std::span<const std::byte> bytes);

// A block's rows of numbers as its bytes. Fails with what a codec cannot do.
Result<std::vector<std::byte>> bytes_of_rows(const Rows& rows, Codec codec);
// The same back; null, or what is wrong. `bytes` may be hostile: no more memory is taken than kValuesPerByte allows.
const char* rows_of_bytes(std::span<const std::byte> bytes, Codec codec, Rows& rows);
// How many numbers each row states, without decoding them. False if the bytes end before.
bool count_rows(std::span<const std::byte> bytes, Codec codec, std::array<uint32_t, kRowCount>& counts);

// MSUR's bytes, and back; null, or what is wrong.
std::vector<std::byte> bytes_of_surfaces(const std::vector<Surface>& surfaces);
const char* surfaces_of_bytes(std::span<const std::byte> bytes, uint32_t count, std::vector<Surface>& surfaces);

// A hierarchy on its way into rows.
class Packer {
  public:
    explicit Packer(const Hierarchy& hierarchy);
    // Null, or what no reader would take.
    const char* base(Rows& rows);
    const char* split(uint32_t i, Rows& rows);

  private:
    void add_vertices(uint32_t position, Rows& rows, std::span<const StarCorner> moved, std::span<const uint16_t> new_wedges);
    void add_vertex(const Steps& steps, const Steps& expected, Rows& rows);
    void find_moves(std::span<const StarCorner> star, uint32_t i);
    uint32_t other_flags(const Added& expected, uint32_t i) const;
    void add_others(uint32_t i, uint32_t flags, std::span<const StarCorner> star, Rows& rows);
    const char* add_error(uint32_t i, std::span<const uint32_t> touched, Rows& rows);
    void apply(uint32_t i);

    const Hierarchy& hierarchy_;
    uint32_t greatest_error_ = 0, last_owner_ = 0;
    MeshState state_;
    std::vector<GridPosition> positions_;
    std::vector<Steps> vertices_;
    // Of the split at hand: where in the star its corners are, in the order they are told; whether that is an arc.
    std::vector<uint32_t> moved_places_, needs_, more_needs_;
    std::vector<uint8_t> is_moved_;
    std::vector<StarCorner> moved_;
    std::vector<uint16_t> new_wedges_;
    bool is_arc_ = false;
};

struct Fault {
    int rule = 0;
    const char* text = nullptr;
    explicit operator bool() const { return text != nullptr; }
};
constexpr Fault kNoFault{};
constexpr Fault kCutShort{10, "ends before its rows do"};

// A hierarchy on its way out of rows. What it holds is whole after base() and after each split().
class Unpacker {
  public:
    Unpacker(Hierarchy& hierarchy, uint32_t greatest_error) : hierarchy_(hierarchy), greatest_error_(greatest_error) {}
    Fault base(const Rows& rows, uint32_t group_count);
    Fault splits(const Rows& rows, uint32_t count, uint32_t& greatest_error);
    uint64_t bytes() const;  // beside the hierarchy

  private:
    bool take(Row row, uint32_t& value);
    bool take_signed(Row row, int32_t& value);
    bool rows_are_done() const;
    Fault take_position(const GridPosition& expected);
    Fault take_row(std::span<const StarCorner> moved);
    Fault take_vertex(uint32_t position, const Steps& expected);
    Fault take_groups(uint32_t count);
    Fault take_faces();
    Fault take_split();
    Fault take_moves(std::span<const StarCorner> star, uint32_t flags, uint32_t& begin);
    Fault take_added(uint32_t flags, uint32_t owner, uint32_t created, const Added& expected, Added& added);
    Fault take_needs(uint32_t flags, uint32_t owner, const Added& added);
    Fault take_error();
    void apply(uint32_t owner, uint32_t created, const Added& added);

    Hierarchy& hierarchy_;
    uint32_t greatest_error_, block_error_ = 0, last_owner_ = 0;
    const Rows* rows_ = nullptr;
    std::array<size_t, kRowCount> taken_{};
    MeshState state_;
    std::vector<GridPosition> positions_;
    std::vector<Steps> vertices_;
    std::vector<uint32_t> error_codes_, needs_, corners_;
    std::vector<StarCorner> moved_;
    std::vector<uint16_t> new_wedges_;
};

}  // namespace overlook::caveclod
