#include <algorithm>
#include <cstring>

#include "formats/caveclod_layout.h"
#include "formats/parallel.h"

namespace overlook::caveclod {
namespace {

using container::kCheckedInParts;
using container::kMustUnderstand;

tl::unexpected<Error> fault(const char* text) {
    return tl::unexpected(Error{Exit::our_bug, fmt::format("a hierarchy to write has {}", text)});
}

// What no reader would take, as far as it shows without walking through the splits; null if there is nothing.
const char* fault_of(const Hierarchy& h) {
    size_t splits = h.owner.size(), positions = h.positions_m.size(), faces = h.face_positions.size();
    if (h.grid.position_step_m <= 0) return "positions that are not quantised";
    bool fits = positions == h.base_position_count + splits && h.error_m.size() == splits && h.need_begin.size() == splits + 1 &&
                h.added_begin.size() == splits + 1 && h.moved_begin.size() == splits + 1 && h.added_begin.back() == faces &&
                h.added_begin.front() == h.base_face_count && h.moved.size() == h.moved_begin.back() &&
                h.moved_wedge.size() == h.moved.size() && h.moved_back_wedge.size() == h.moved.size() &&
                h.face_group.size() == faces && h.birth_wedge.size() == 3 * faces && h.needs.size() == h.need_begin.back() &&
                h.vertex_begin.size() == positions + 1 && h.vertices.size() == h.vertex_begin.back() &&
                h.group_packed.size() == h.group_surface.size();
    if (!fits) return "rows that do not fit each other";
    if (positions == 0 || faces == 0 || h.group_surface.empty() || h.surfaces.empty()) return "nothing in it";
    if (std::max({positions, faces, h.vertices.size()}) > kCountMax || h.surfaces.size() > kSurfacesMax)
        return "more than can be stored";
    for (float error_m : h.error_m)
        if (!(error_m >= 0 && error_m <= error_of_code(kErrorCodeMax))) return "an error that cannot be stored";
    for (size_t p = 0; p < positions; ++p)
        if (h.vertex_begin[p + 1] <= h.vertex_begin[p] || h.vertex_begin[p + 1] - h.vertex_begin[p] > kMostWedges)
            return "a position with no vertex or too many";
    return nullptr;
}

std::vector<std::byte> info_bytes(const Hierarchy& h, uint32_t block_count, Codec codec) {
    std::vector<std::byte> bytes(info_at::bytes, std::byte(0));
    auto put = [&](size_t at, size_t value) { store_le<uint32_t>(bytes, at, uint32_t(value)); };
    put(info_at::base_positions, h.base_position_count), put(info_at::base_faces, h.base_face_count);
    put(info_at::splits, h.split_count()), put(info_at::faces, h.face_positions.size());
    put(info_at::vertices, h.vertices.size()), put(info_at::groups, h.group_surface.size());
    put(info_at::surfaces, h.surfaces.size()), put(info_at::blocks, block_count);
    for (int axis = 0; axis < 3; ++axis) store_f64(bytes, info_at::origin_m + 8 * size_t(axis), h.origin_m[axis]);
    store_f64(bytes, info_at::position_step_m, h.grid.position_step_m);
    for (int axis = 0; axis < 2; ++axis) store_f64(bytes, info_at::uv_low + 8 * size_t(axis), h.grid.uv_low[axis]);
    store_f64(bytes, info_at::uv_step, h.grid.uv_step);
    put(info_at::position_bits, h.grid.position_bits), put(info_at::uv_bits, h.grid.uv_bits);
    put(info_at::normal_bits, h.grid.normal_bits), put(info_at::codec, size_t(codec));
    put(info_at::attributes,
        (h.attributes.normals ? kHasNormals : 0) | (h.attributes.uvs ? kHasUvs : 0) | (h.attributes.colours ? kHasColours : 0));
    float greatest = 0;
    for (float error_m : h.error_m) greatest = std::max(greatest, error_m);
    put(info_at::finest_error, code_of_error(h.finest_error_m)), put(info_at::greatest_error, code_of_error(greatest));
    return bytes;
}

// Blocks grow from few splits to many, so that a first picture comes early.
std::vector<uint32_t> block_begins(uint32_t split_count) {
    std::vector<uint32_t> begins;
    uint32_t size = kFirstBlockSplits;
    for (uint32_t at = 0; at < split_count; size = std::min(2 * size, kBlockSplitsMax)) {
        begins.push_back(at);
        at += std::min(size, split_count - at);
    }
    begins.push_back(split_count);
    return begins;
}

Result<void> write_blocks(container::Writer& writer, const Hierarchy& h, std::span<const uint32_t> begins, Codec codec,
                          std::vector<std::byte>& directory) {
    Packer packer(h);
    std::vector<Rows> rows(begins.size());
    if (const char* text = packer.base(rows[0])) return fault(text);
    for (size_t block = 1; block < begins.size(); ++block)
        for (uint32_t i = begins[block - 1]; i < begins[block]; ++i)
            if (const char* text = packer.split(i, rows[block])) return fault(text);

    std::vector<Result<std::vector<std::byte>>> packed(rows.size());
    parallel_ranges(rows.size(), 1, [&](size_t block, size_t) { packed[block] = bytes_of_rows(rows[block], codec); });
    if (auto begun = writer.begin(kBlocksTag, kMustUnderstand | kCheckedInParts); !begun) return begun;
    directory.resize(rows.size() * directory_at::entry_bytes);
    uint64_t offset = 0;
    for (size_t block = 0; block < packed.size(); ++block) {
        if (!packed[block]) return tl::unexpected(packed[block].error());
        std::span<std::byte> entry = std::span(directory).subspan(block * directory_at::entry_bytes, directory_at::entry_bytes);
        uint32_t first = block == 0 ? 0 : begins[block - 1];
        store_le<uint64_t>(entry, directory_at::offset, offset);
        store_le<uint64_t>(entry, directory_at::checksum, block_checksum(*packed[block]));
        store_le<uint32_t>(entry, directory_at::stored_bytes, uint32_t(packed[block]->size()));
        store_le<uint32_t>(entry, directory_at::first_split, first);
        store_le<uint32_t>(entry, directory_at::splits, block == 0 ? 0 : begins[block] - first);
        if (auto appended = writer.append(*packed[block]); !appended) return appended;
        offset += packed[block]->size();
    }
    uint32_t rest = 0;
    for (size_t block = packed.size(); block-- > 0;) {
        for (uint32_t i = block == 0 ? 0 : begins[block - 1]; block > 0 && i < begins[block]; ++i)
            rest = std::max(rest, code_of_error(h.error_m[i]));
        store_le<uint32_t>(std::span(directory), block * directory_at::entry_bytes + directory_at::rest_error, rest);
    }
    return writer.end();
}

}  // namespace

Result<void> write(container::Writer& writer, const Hierarchy& hierarchy, Codec codec) {
    if (const char* text = fault_of(hierarchy)) return fault(text);
    Hierarchy rounded = hierarchy;
    round_errors(rounded);
    std::vector<uint32_t> begins = block_begins(hierarchy.split_count());
    std::vector<std::byte> info = info_bytes(rounded, uint32_t(begins.size() - 1), codec), directory;
    if (auto added = writer.add(kInfoTag, kMustUnderstand, container::Codec::none, info); !added) return added;
    if (auto written = write_blocks(writer, rounded, begins, codec, directory); !written) return written;
    if (auto added = writer.add(kDirectoryTag, kMustUnderstand, container::Codec::none, directory); !added) return added;
    return writer.add(kSurfacesTag, kMustUnderstand, container::Codec::zstd, bytes_of_surfaces(hierarchy.surfaces));
}

}  // namespace overlook::caveclod
