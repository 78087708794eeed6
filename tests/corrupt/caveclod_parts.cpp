#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>

#include "tests/corrupt/caveclod_fixtures.h"
#include "tests/corrupt/terrain_parts.h"

namespace overlook::caveclod::fixtures {
namespace {

using container::fixtures::RawSection;

void put_u32(Bytes& bytes, size_t at, size_t value) {
    store_le<uint32_t>(bytes, at, uint32_t(value));
}

Bytes info_of(const Hierarchy& h, size_t block_count, Codec codec, uint32_t greatest_error) {
    Bytes info(128);
    put_u32(info, 0, h.base_position_count), put_u32(info, 4, h.base_face_count), put_u32(info, 8, h.owner.size());
    put_u32(info, 12, h.face_positions.size()), put_u32(info, 16, h.vertices.size());
    put_u32(info, 20, h.group_surface.size()), put_u32(info, 24, h.surfaces.size()), put_u32(info, 28, block_count);
    for (int axis = 0; axis < 3; ++axis) store_f64(info, 32 + 8 * size_t(axis), h.origin_m[axis]);
    store_f64(info, 56, h.grid.position_step_m);
    store_f64(info, 64, h.grid.uv_low.x), store_f64(info, 72, h.grid.uv_low.y), store_f64(info, 80, h.grid.uv_step);
    put_u32(info, 88, h.grid.position_bits), put_u32(info, 92, h.grid.uv_bits), put_u32(info, 96, h.grid.normal_bits);
    put_u32(info, 100, size_t(h.attributes.normals) | size_t(h.attributes.uvs) << 1 | size_t(h.attributes.colours) << 2);
    put_u32(info, 104, size_t(codec)), put_u32(info, 108, code_of_error(h.finest_error_m)), put_u32(info, 112, greatest_error);
    return info;
}

}  // namespace

Hierarchy hexagon() {
    Hierarchy h;
    h.base_position_count = 6, h.base_face_count = 4;
    h.positions_m = {{4, 2, 0}, {3, 4, 0}, {1, 4, 0}, {0, 2, 0}, {1, 0, 0}, {3, 0, 0}, {2, 2, 1}};
    h.owner = {0};
    h.error_m = {1};
    for (uint32_t k = 1; k < 5; ++k) h.face_positions.push_back({0, k, k + 1});
    h.face_positions.push_back({0, 1, 6}), h.face_positions.push_back({0, 6, 5});
    h.added_begin = {4, 6};
    for (uint32_t face = 0; face < 4; ++face) h.moved.push_back(face * kCorners);
    h.moved_begin = {0, 4};
    h.face_group.assign(6, 0);
    h.group_surface = {0}, h.group_packed = {0};
    for (uint32_t p = 0; p < 7; ++p) h.vertices.push_back({p, {0, 0, 1}, {0, 0}, {255, 255, 255, 255}});
    h.vertex_begin = {0, 1, 2, 3, 4, 5, 6, 7};
    h.birth_wedge.assign(18, 0), h.moved_wedge.assign(4, 0), h.moved_back_wedge.assign(4, 0);
    h.attributes = {true, false, false};
    h.surfaces = {{"slate", {90, 96, 104, 255}, "", {}, false, 0.5f, false}};
    h.grid.normal_bits = 10, h.grid.uv_bits = 14, h.grid.uv_step = 1, h.grid.position_bits = 14;
    h.grid.position_step_m = 1.0 / 1024;
    (void)complete(h);
    return h;
}

Parts Parts::of(const Hierarchy& hierarchy, Codec codec) {
    Parts parts;
    parts.codec = codec;
    Packer packer(hierarchy);
    parts.blocks.resize(hierarchy.split_count() > 0 ? 2 : 1);
    (void)packer.base(parts.blocks[0]);
    uint32_t greatest = 0;
    for (uint32_t i = 0; i < hierarchy.split_count(); ++i) {
        (void)packer.split(i, parts.blocks[1]);
        greatest = std::max(greatest, code_of_error(hierarchy.error_m[i]));
    }
    parts.split_counts = {0, hierarchy.split_count()}, parts.rest_errors = {greatest, greatest};
    parts.split_counts.resize(parts.blocks.size()), parts.rest_errors.resize(parts.blocks.size());
    parts.info = info_of(hierarchy, parts.blocks.size() - 1, codec, greatest);
    parts.surfaces = bytes_of_surfaces(hierarchy.surfaces);
    return parts;
}

Bytes Parts::stored(size_t block) const {
    return *bytes_of_rows(blocks[block], codec);
}

Bytes Parts::directory(const std::vector<Bytes>& stored) const {
    Bytes directory;
    size_t offset = 0, first = 0;
    for (size_t block = 0; block < stored.size(); ++block) {
        Bytes entry(32);
        store_le<uint64_t>(entry, 0, offset), store_le<uint64_t>(entry, 8, block_checksum(stored[block]));
        put_u32(entry, 16, stored[block].size()), put_u32(entry, 20, first), put_u32(entry, 24, split_counts[block]);
        put_u32(entry, 28, rest_errors[block]);
        directory.insert(directory.end(), entry.begin(), entry.end());
        offset += stored[block].size(), first += split_counts[block];
    }
    return directory;
}

Bytes Parts::file_of(const std::vector<Bytes>& stored, const Bytes& directory) const {
    Bytes bytes;
    for (const Bytes& block : stored) bytes.insert(bytes.end(), block.begin(), block.end());
    auto section = [](std::string_view tag, uint32_t flags, uint32_t section_codec, const Bytes& raw) {
        return RawSection{tag, flags, section_codec, section_codec == 0 ? raw : terrain::fixtures::frame_of(raw), raw.size()};
    };
    std::array sections{section("MINF", 1, 0, info), section("MBLK", blocks_codec == 0 ? 3 : 1, blocks_codec, bytes),
                        section("MDIR", 1, directory_codec, directory), section("MSUR", 1, 1, surfaces)};
    Bytes file = container::fixtures::file_of(sections);
    store_le<uint32_t>(file, 32, kKind);
    container::fixtures::seal(file);
    return file;
}

Bytes Parts::file() const {
    std::vector<Bytes> all;
    for (size_t block = 0; block < blocks.size(); ++block) all.push_back(stored(block));
    return file_of(all, directory(all));
}

}  // namespace overlook::caveclod::fixtures
