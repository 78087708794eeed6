#include <algorithm>
#include <cmath>
#include <new>

#include "formats/caveclod_layout.h"

namespace overlook::caveclod {
namespace {

using container::Reader;
using container::Section;

template <class... Args>
tl::unexpected<Error> broken(const Reader& file, int rule, fmt::format_string<Args...> text, Args&&... args) {
    return bad_input("{}: M{}: {}", file.name(), rule, fmt::format(text, std::forward<Args>(args)...));
}

struct Info {
    uint32_t split_count = 0, face_count = 0, vertex_count = 0, group_count = 0, surface_count = 0, block_count = 0;
    Codec codec = Codec::meshopt;
    uint32_t finest_error = 0, greatest_error = 0;
};

struct Entry {
    uint64_t offset = 0, checksum = 0;
    uint32_t stored_bytes = 0, split_count = 0, rest_error = 0;
};

bool is_between(double value, double low, double high) {
    return value >= low && value <= high;
}  // false for NaN

Result<void> read_counts(const Reader& file, std::span<const std::byte> bytes, Info& info, Hierarchy& h) {
    auto get = [&](size_t at) { return load_le<uint32_t>(bytes, at); };
    h.base_position_count = get(info_at::base_positions), h.base_face_count = get(info_at::base_faces);
    info.split_count = get(info_at::splits), info.face_count = get(info_at::faces), info.vertex_count = get(info_at::vertices);
    info.group_count = get(info_at::groups), info.surface_count = get(info_at::surfaces), info.block_count = get(info_at::blocks);
    uint64_t positions = uint64_t(h.base_position_count) + info.split_count;
    bool is_some = h.base_position_count > 0 && info.face_count > 0 && info.group_count > 0 && info.surface_count > 0;
    bool is_few = positions <= kCountMax && info.face_count <= kCountMax && info.vertex_count <= kCountMax &&
                  info.group_count <= info.face_count && info.surface_count <= kSurfacesMax;
    if (!is_some || !is_few || h.base_face_count > info.face_count || info.vertex_count < positions)
        return broken(file, 3, "{} positions, {} faces, {} vertices, {} groups and {} surfaces", positions, info.face_count,
                      info.vertex_count, info.group_count, info.surface_count);
    return {};
}

Result<void> read_grid(const Reader& file, std::span<const std::byte> bytes, Hierarchy& h) {
    auto get = [&](size_t at) { return load_le<uint32_t>(bytes, at); };
    bool is_fine = true;
    for (int axis = 0; axis < 3; ++axis) {
        h.origin_m[axis] = load_f64(bytes, info_at::origin_m + 8 * size_t(axis));
        is_fine = is_fine && is_between(h.origin_m[axis], -1e12, 1e12);
    }
    Grid& grid = h.grid;
    grid.position_step_m = load_f64(bytes, info_at::position_step_m);
    grid.uv_step = load_f64(bytes, info_at::uv_step);
    for (int axis = 0; axis < 2; ++axis) {
        grid.uv_low[axis] = load_f64(bytes, info_at::uv_low + 8 * size_t(axis));
        is_fine = is_fine && is_between(grid.uv_low[axis], -1e9, 1e9);
    }
    grid.position_bits = get(info_at::position_bits), grid.uv_bits = get(info_at::uv_bits);
    grid.normal_bits = get(info_at::normal_bits);
    is_fine = is_fine && is_between(grid.position_step_m, 1e-12, 1e9) && is_between(grid.uv_step, 1e-12, 1e9) &&
              is_between(grid.position_bits, 8, 20) && is_between(grid.uv_bits, 8, 16) && is_between(grid.normal_bits, 6, 16);
    if (!is_fine)
        return broken(file, 4, "steps of {} m from ({}, {}, {}) in {} bits, of uv {} in {} bits, and normals of {} bits",
                      grid.position_step_m, h.origin_m.x, h.origin_m.y, h.origin_m.z, grid.position_bits, grid.uv_step,
                      grid.uv_bits, grid.normal_bits);
    return {};
}

Result<void> read_flags(const Reader& file, std::span<const std::byte> bytes, Info& info, Hierarchy& h) {
    uint32_t attributes = load_le<uint32_t>(bytes, info_at::attributes), codec = load_le<uint32_t>(bytes, info_at::codec);
    h.attributes = {(attributes & kHasNormals) != 0, (attributes & kHasUvs) != 0, (attributes & kHasColours) != 0};
    info.finest_error = load_le<uint32_t>(bytes, info_at::finest_error);
    info.greatest_error = load_le<uint32_t>(bytes, info_at::greatest_error);
    bool is_zero = true;
    for (size_t at = info_at::reserved; at < info_at::bytes; ++at) is_zero = is_zero && bytes[at] == std::byte(0);
    if (attributes > 7 || codec > uint32_t(Codec::draco) || std::max(info.finest_error, info.greatest_error) > kErrorCodeMax ||
        !is_zero)
        return broken(file, 5, "attributes {}, codec {}, error codes {} and {}, or a reserved number that is not 0", attributes,
                      codec, info.finest_error, info.greatest_error);
    info.codec = Codec(codec);
    return {};
}

Result<void> read_surfaces(const Reader& file, const Section& section, const Info& info, Hierarchy& h) {
    if (section.raw_bytes > kSurfaceBytesMax) return broken(file, 6, "surfaces of {} bytes", section.raw_bytes);
    auto bytes = file.read(section, kSurfaceBytesMax);
    if (!bytes) return tl::unexpected(bytes.error());
    if (const char* fault = surfaces_of_bytes(*bytes, info.surface_count, h.surfaces)) return broken(file, 6, "MSUR {}", fault);
    return {};
}

Result<std::vector<Entry>> read_directory(const Reader& file, const Section& section, const Section& blocks, const Info& info) {
    uint64_t count = uint64_t(info.block_count) + 1;
    if (section.codec != container::Codec::none || section.raw_bytes != count * directory_at::entry_bytes)
        return broken(file, 7, "a directory of {} bytes; {} blocks need {}, uncompressed", section.raw_bytes, count,
                      count * directory_at::entry_bytes);
    if (blocks.codec != container::Codec::none)
        return broken(file, 8, "MBLK is compressed as a whole, its blocks must be one by one");
    auto bytes = file.read(section, section.raw_bytes);
    if (!bytes) return tl::unexpected(bytes.error());

    std::vector<Entry> entries(count);
    uint64_t offset = 0, split_count = 0;
    for (uint64_t i = 0; i < count; ++i) {
        std::span<const std::byte> at = std::span(*bytes).subspan(i * directory_at::entry_bytes, directory_at::entry_bytes);
        Entry& entry = entries[i];
        entry = {load_le<uint64_t>(at, directory_at::offset), load_le<uint64_t>(at, directory_at::checksum),
                 load_le<uint32_t>(at, directory_at::stored_bytes), load_le<uint32_t>(at, directory_at::splits),
                 load_le<uint32_t>(at, directory_at::rest_error)};
        if (entry.offset != offset || entry.stored_bytes > blocks.stored_bytes - offset)
            return broken(file, 8, "block {} is {} bytes at {}; the one before ends at {} of {}", i, entry.stored_bytes,
                          entry.offset, offset, blocks.stored_bytes);
        bool is_whole = i == 0 ? entry.split_count == 0 : entry.split_count >= 1 && entry.split_count <= kBlockSplitsMax;
        if (!is_whole || load_le<uint32_t>(at, directory_at::first_split) != split_count)
            return broken(file, 7, "block {} has {} splits from {}; {} are before it", i, entry.split_count,
                          load_le<uint32_t>(at, directory_at::first_split), split_count);
        offset += entry.stored_bytes, split_count += entry.split_count;
    }
    if (split_count != info.split_count) return broken(file, 7, "{} splits in all, {} stated", split_count, info.split_count);
    if (offset != blocks.stored_bytes)
        return broken(file, 8, "the last block ends at {} of {} bytes", offset, blocks.stored_bytes);
    return entries;
}

// What is left of splits after a block, by the directory: its rest_error.
Result<void> check_rest(const Reader& file, std::span<const Entry> entries, size_t block, uint32_t greatest) {
    uint32_t after = block + 1 < entries.size() ? entries[block + 1].rest_error : 0;
    if (entries[block].rest_error == std::max(greatest, after) && after <= kErrorCodeMax) return {};
    return broken(file, 18, "block {} has errors up to code {}, those after it {}; {} is stated", block, greatest, after,
                  entries[block].rest_error);
}

Result<void> read_block(const Reader& file, std::span<const std::byte> stored, const Info& info, std::span<const Entry> entries,
                        size_t block, Unpacker& unpacker, Rows& rows) {
    const Entry& entry = entries[block];
    std::span<const std::byte> bytes = stored.subspan(entry.offset, entry.stored_bytes);
    if (block_checksum(bytes) != entry.checksum)
        return broken(file, 9, "block {}: its bytes do not match their checksum; was the file damaged?", block);
    if (const char* fault = rows_of_bytes(bytes, info.codec, rows)) return broken(file, 10, "block {} {}", block, fault);
    uint32_t greatest = 0;
    Fault fault = block == 0 ? unpacker.base(rows, info.group_count) : unpacker.splits(rows, entry.split_count, greatest);
    if (fault) return broken(file, fault.rule, "block {} {}", block, fault.text);
    return check_rest(file, entries, block, greatest);
}

Result<Hierarchy> read_all(const Reader& file, uint32_t most_blocks) {
    static constexpr container::Tag kKnown[] = {kInfoTag, kDirectoryTag, kBlocksTag, kSurfacesTag, container::tag("PROV")};
    const Section *info_section = file.find(kInfoTag), *directory = file.find(kDirectoryTag), *blocks = file.find(kBlocksTag),
                  *surfaces = file.find(kSurfacesTag);
    if (file.kind() != kKind || !info_section || !directory || !blocks || !surfaces)
        return broken(file, 1, "is no baked mesh (its kind is {})", container::tag_text(file.kind()));
    if (auto known = file.require_known(kKnown); !known) return tl::unexpected(known.error());
    if (info_section->raw_bytes != info_at::bytes) return broken(file, 2, "MINF has {} bytes", info_section->raw_bytes);
    auto bytes = file.read(*info_section, info_at::bytes);
    if (!bytes) return tl::unexpected(bytes.error());

    Hierarchy h;
    Info info;
    if (auto ok = read_counts(file, *bytes, info, h); !ok) return tl::unexpected(ok.error());
    if (auto ok = read_grid(file, *bytes, h); !ok) return tl::unexpected(ok.error());
    if (auto ok = read_flags(file, *bytes, info, h); !ok) return tl::unexpected(ok.error());
    if (auto ok = read_surfaces(file, *surfaces, info, h); !ok) return tl::unexpected(ok.error());
    auto entries = read_directory(file, *directory, *blocks, info);
    if (!entries) return tl::unexpected(entries.error());

    Unpacker unpacker(h, info.greatest_error);
    Rows rows;
    size_t read_count = std::min<size_t>(entries->size(), size_t(most_blocks) + 1);
    for (size_t block = 0; block < read_count; ++block)
        if (auto ok = read_block(file, file.stored(*blocks), info, *entries, block, unpacker, rows); !ok)
            return tl::unexpected(ok.error());
    bool is_whole = read_count == entries->size();
    if (is_whole && (h.face_positions.size() != info.face_count || h.vertices.size() != info.vertex_count))
        return broken(file, 19, "{} faces and {} vertices, {} and {} stated", h.face_positions.size(), h.vertices.size(),
                      info.face_count, info.vertex_count);
    uint32_t missing = is_whole ? 0 : (*entries)[read_count].rest_error;
    h.finest_error_m = error_of_code(std::max(info.finest_error, missing));
    if (auto completed = complete(h); !completed) return tl::unexpected(completed.error());
    return h;
}

}  // namespace

Result<Hierarchy> read(const Reader& file, uint32_t most_blocks) {
    try {
        return read_all(file, most_blocks);
    } catch (const std::bad_alloc&) {
        return impossible("{}: there is not enough memory for this mesh", file.name());
    }
}

Result<Hierarchy> read(const std::string& path) {
    auto file = Reader::open(path);
    if (!file) return tl::unexpected(file.error());
    return read(*file);
}

}  // namespace overlook::caveclod
