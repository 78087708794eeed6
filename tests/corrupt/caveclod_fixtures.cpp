#include "tests/corrupt/caveclod_fixtures.h"

#include <algorithm>
#include <functional>
#include <limits>

#include "tests/caveclod/synthetic_hierarchy.h"

namespace overlook::caveclod::fixtures {
namespace {

using Change = std::function<void(Parts&)>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();

Bytes changed(const Change& change, Codec codec = Codec::draco) {
    Parts parts = Parts::of(hexagon(), codec);
    change(parts);
    return parts.file();
}
Bytes with_u32(size_t at, uint32_t value) {
    return changed([&](Parts& parts) { store_le<uint32_t>(parts.info, at, value); });
}
Bytes with_f64(size_t at, double value) {
    return changed([&](Parts& parts) { store_f64(parts.info, at, value); });
}
// A number of a row of a block.
Bytes with_value(size_t block, Row row, size_t at, uint32_t value) {
    return changed([&](Parts& parts) { parts.blocks[block][row].at(at) = value; });
}
// The split with other flags and what they ask for.
Bytes with_rare(uint32_t flags, const std::vector<uint32_t>& rare) {
    return changed([&](Parts& parts) {
        parts.blocks[1][kFlags].at(0) = flags, parts.blocks[1][kRare] = rare;
        if ((flags & kOtherMoves) != 0) parts.blocks[1][kArcLength].clear(), parts.blocks[1][kArcBegin].clear();
    });
}
// Every position with two vertices, and the corners' choice of them.
Bytes with_two_wedges(uint32_t wedge) {
    return changed([&](Parts& parts) {
        Rows& base = parts.blocks[0];
        base[kWedgeCount].assign(6, 1), base[kNormal].assign(24, 0), base[kWedge].assign(12, wedge);
        store_le<uint32_t>(parts.info, 16, 13);
    });
}

Bytes without(std::string_view tag) {
    Bytes file = Parts::of(hexagon()).file();
    for (size_t entry = 64; entry < 64 * 5; entry += 64)
        if (load_le<uint32_t>(file, entry) == container::tag({tag[0], tag[1], tag[2], tag[3], 0})) {
            store_le<uint32_t>(file, entry, container::tag("XXXX"));
            store_le<uint32_t>(file, entry + 4, load_le<uint32_t>(file, entry + 4) & ~1u);
        }
    container::fixtures::seal(file);
    return file;
}
Bytes of_other_kind() {
    Bytes file = Parts::of(hexagon()).file();
    store_le<uint32_t>(file, 32, container::tag("DEMO"));
    container::fixtures::seal(file);
    return file;
}
Bytes with_surfaces(const std::function<void(Bytes&)>& change) {
    return changed([&](Parts& parts) { change(parts.surfaces); });
}
Bytes with_surface(const Surface& surface) {
    return changed([&](Parts& parts) { parts.surfaces = bytes_of_surfaces({surface}); });
}
// Other bytes for a block, and a directory that fits them.
Bytes with_stored(size_t block, const std::function<void(Bytes&)>& change) {
    Parts parts = Parts::of(hexagon());
    std::vector<Bytes> stored{parts.stored(0), parts.stored(1)};
    change(stored[block]);
    return parts.file_of(stored, parts.directory(stored));
}
Bytes with_directory(const std::function<void(Bytes&)>& change) {
    Parts parts = Parts::of(hexagon());
    std::vector<Bytes> stored{parts.stored(0), parts.stored(1)};
    Bytes directory = parts.directory(stored);
    change(directory);
    return parts.file_of(stored, directory);
}
Bytes with_entry(size_t at, uint32_t value) {
    return with_directory([&](Bytes& directory) { store_le<uint32_t>(directory, at, value); });
}

// A fan of 1,025 faces whose middle is split.
Bytes with_wide_star() {
    Hierarchy h = hexagon();
    Hierarchy fan = h;
    constexpr uint32_t kRim = 1026;
    fan.base_position_count = kRim + 1, fan.base_face_count = kRim - 1;
    fan.positions_m.assign(kRim + 1, {0, 0, 0}), fan.vertices.clear(), fan.face_positions.clear();
    fan.vertex_begin = {0}, fan.added_begin = {kRim - 1}, fan.moved_begin = {0}, fan.need_begin = {0};
    for (uint32_t p = 0; p <= kRim; ++p) {
        fan.vertices.push_back({p, {0, 0, 1}, {0, 0}, {255, 255, 255, 255}});
        fan.vertex_begin.push_back(p + 1);
    }
    for (uint32_t k = 1; k < kRim; ++k) fan.face_positions.push_back({0, k, k + 1});
    fan.face_group.assign(kRim - 1, 0), fan.birth_wedge.assign(3 * (kRim - 1), 0);
    fan.moved.clear(), fan.moved_wedge.clear(), fan.moved_back_wedge.clear(), fan.needs.clear();
    fan.owner.clear(), fan.error_m.clear();
    Parts parts = Parts::of(fan), split = Parts::of(h);
    parts.blocks.push_back(split.blocks[1]);
    parts.split_counts = {0, 1}, parts.rest_errors = split.rest_errors;
    store_le<uint32_t>(parts.info, 8, 1), store_le<uint32_t>(parts.info, 28, 1), store_le<uint32_t>(parts.info, 16, kRim + 2);
    return parts.file();
}

// The last split of a sphere needs once more what it needs already.
Bytes with_need_twice() {
    Hierarchy h = synthetic::bake(synthetic::sphere(5));
    Parts parts = Parts::of(h);
    uint32_t last = h.split_count() - 1;
    parts.blocks[1][kFlags].at(last) |= kMoreNeeds;
    parts.blocks[1][kRare].insert(parts.blocks[1][kRare].end(), {1, last - h.needs.back()});
    return parts.file();
}

std::vector<Fixture> broken_heads() {
    return {{"m01_other_kind.ovl", 1, of_other_kind()},
            {"m01_no_head.ovl", 1, without("MINF")},
            {"m01_no_blocks.ovl", 1, without("MBLK")},
            {"m01_no_directory.ovl", 1, without("MDIR")},
            {"m01_no_surfaces.ovl", 1, without("MSUR")},
            {"m02_empty.ovl", 2, changed([](Parts& parts) { parts.info.clear(); })},
            {"m02_byte_less.ovl", 2, changed([](Parts& parts) { parts.info.resize(127); })},
            {"m02_byte_more.ovl", 2, changed([](Parts& parts) { parts.info.resize(129); })},
            {"m03_no_position.ovl", 3, with_u32(0, 0)},
            {"m03_no_face.ovl", 3, with_u32(12, 0)},
            {"m03_no_group.ovl", 3, with_u32(20, 0)},
            {"m03_no_surface.ovl", 3, with_u32(24, 0)},
            {"m03_most_positions.ovl", 3, with_u32(0, 0xffffffff)},
            {"m03_most_faces.ovl", 3, with_u32(12, (1u << 28) + 1)},
            {"m03_most_splits.ovl", 3, with_u32(8, 0xffffffff)},
            {"m03_most_vertices.ovl", 3, with_u32(16, (1u << 28) + 1)},
            {"m03_few_vertices.ovl", 3, with_u32(16, 6)},
            {"m03_groups_over_faces.ovl", 3, with_u32(20, 7)},
            {"m03_base_over_faces.ovl", 3, with_u32(4, 7)},
            {"m03_most_surfaces.ovl", 3, with_u32(24, 65537)},
            {"m04_nan_origin.ovl", 4, with_f64(32, kNan)},
            {"m04_far_origin.ovl", 4, with_f64(40, 1e300)},
            {"m04_no_step.ovl", 4, with_f64(56, 0)},
            {"m04_infinite_step.ovl", 4, with_f64(56, kInfinity)},
            {"m04_negative_step.ovl", 4, with_f64(56, -1)},
            {"m04_nan_uv.ovl", 4, with_f64(64, kNan)},
            {"m04_no_uv_step.ovl", 4, with_f64(80, 0)},
            {"m04_seven_bits.ovl", 4, with_u32(88, 7)},
            {"m04_most_bits.ovl", 4, with_u32(88, 0xffffffff)},
            {"m04_uv_bits.ovl", 4, with_u32(92, 17)},
            {"m04_normal_bits.ovl", 4, with_u32(96, 5)},
            {"m05_attributes.ovl", 5, with_u32(100, 8)},
            {"m05_codec.ovl", 5, with_u32(104, 2)},
            {"m05_finest_error.ovl", 5, with_u32(108, 961)},
            {"m05_greatest_error.ovl", 5, with_u32(112, 0xffffffff)},
            {"m05_reserved.ovl", 5, with_u32(124, 1)}};
}

std::vector<Fixture> broken_surfaces() {
    Surface long_name{std::string(4097, 'a'), {}, "", {}, false, 0.5f, false}, line{"two\nlines", {}, "", {}, false, 0.5f, false};
    Surface beyond{"a", {}, "", {}, false, 2.0f, false}, nan{"a", {}, "", {}, false, float(kNan), false};
    return {{"m06_empty.ovl", 6, with_surfaces([](Bytes& bytes) { bytes.clear(); })},
            {"m06_cut_short.ovl", 6, with_surfaces([](Bytes& bytes) { bytes.pop_back(); })},
            {"m06_byte_more.ovl", 6, with_surfaces([](Bytes& bytes) { bytes.push_back(std::byte(0)); })},
            {"m06_name_beyond_end.ovl", 6, with_surfaces([](Bytes& bytes) { store_le<uint32_t>(bytes, 0, 0xffffffff); })},
            {"m06_flags.ovl", 6, with_surfaces([](Bytes& bytes) { store_le<uint32_t>(bytes, bytes.size() - 8, 4); })},
            {"m06_long_name.ovl", 6, with_surface(long_name)},
            {"m06_unprintable.ovl", 6, with_surface(line)},
            {"m06_alpha_beyond.ovl", 6, with_surface(beyond)},
            {"m06_alpha_nan.ovl", 6, with_surface(nan)}};
}

std::vector<Fixture> broken_directories() {
    return {{"m07_byte_less.ovl", 7, with_directory([](Bytes& bytes) { bytes.pop_back(); })},
            {"m07_entry_more.ovl", 7, with_directory([](Bytes& bytes) { bytes.resize(bytes.size() + 32); })},
            {"m07_most_blocks.ovl", 7, with_u32(28, 0xffffffff)},
            {"m07_compressed.ovl", 7, changed([](Parts& parts) { parts.directory_codec = 1; })},
            {"m07_splits_in_base.ovl", 7, with_entry(24, 1)},
            {"m07_no_splits.ovl", 7, with_entry(32 + 24, 0)},
            {"m07_most_splits.ovl", 7, with_entry(32 + 24, 16385)},
            {"m07_splits_short.ovl", 7, with_u32(8, 0)},
            {"m07_first_split.ovl", 7, with_entry(32 + 20, 1)},
            {"m08_begins_late.ovl", 8, with_entry(0, 1)},
            {"m08_gap.ovl", 8, with_entry(32, 5)},
            {"m08_ends_late.ovl", 8, with_entry(32 + 16, 0xffffffff)},
            {"m08_ends_early.ovl", 8, with_entry(32 + 16, 3)},
            {"m08_compressed_whole.ovl", 8, changed([](Parts& parts) { parts.blocks_codec = 1; })},
            {"m09_checksum.ovl", 9, with_entry(8, 1)},
            {"m09_second_block.ovl", 9, with_entry(32 + 12, 1)},
            {"m18_base_rest.ovl", 18, with_entry(28, 3)},
            {"m18_block_rest.ovl", 18, changed([](Parts& parts) {
                 parts.rest_errors = {900, 900};
             })},
            {"m19_faces.ovl", 19, with_u32(12, 7)},
            {"m19_vertices.ovl", 19, with_u32(16, 8)}};
}

std::vector<Fixture> broken_rows() {
    auto resized = [](Row row, size_t size) { return changed([&](Parts& parts) { parts.blocks[1][row].resize(size); }); };
    // The byte after the n-th of a zstd frame's beginning in a block of the other codec.
    auto meshopt_byte = [](ptrdiff_t n, uint8_t value) {
        Parts parts = Parts::of(hexagon(), Codec::meshopt);
        std::vector<Bytes> stored{parts.stored(0), parts.stored(1)};
        Bytes magic = container::fixtures::bytes_of("\x28\xb5\x2f\xfd");
        *(std::search(stored[1].begin(), stored[1].end(), magic.begin(), magic.end()) + n) = std::byte(value);
        return parts.file_of(stored, parts.directory(stored));
    };
    return {{"m10_empty.ovl", 10, with_stored(1, [](Bytes& bytes) { bytes.clear(); })},
            {"m10_cut_short.ovl", 10, with_stored(0, [](Bytes& bytes) { bytes.resize(bytes.size() / 2); })},
            {"m10_byte_more.ovl", 10, with_stored(1, [](Bytes& bytes) { bytes.push_back(std::byte(0)); })},
            {"m10_most_numbers.ovl", 10, with_stored(0, [](Bytes& bytes) { store_le<uint32_t>(bytes, 0, 0xffffffff); })},
            {"m10_chunk_beyond_end.ovl", 10, with_stored(0, [](Bytes& bytes) { store_le<uint32_t>(bytes, 4, 0xffffffff); })},
            {"m10_not_a_codec.ovl", 10, with_stored(0, [](Bytes& bytes) { bytes[12] = std::byte(7); })},
            {"m10_number_less.ovl", 10, resized(kPosition, 2)},
            {"m10_number_more.ovl", 10, resized(kPosition, 4)},
            {"m10_no_owner.ovl", 10, resized(kOwner, 0)},
            {"m10_rare_less.ovl", 10, resized(kRare, 1)},
            {"m10_not_zstd.ovl", 10, meshopt_byte(0, 0)},
            {"m10_other_raw_bytes.ovl", 10, meshopt_byte(-8, 255)},
            {"m11_below.ovl", 11, with_value(0, kPosition, 0, zigzag(-1))},
            {"m11_beyond.ovl", 11, with_value(1, kPosition, 0, zigzag(16384))},
            {"m11_far_beyond.ovl", 11, with_value(1, kPosition, 2, 0x7fffffff)},
            {"m12_normal.ovl", 12, with_value(0, kNormal, 0, zigzag(512))},
            {"m12_normal_of_split.ovl", 12, with_value(1, kNormal, 1, 0x7fffffff)},
            {"m12_most_wedges.ovl", 12, with_value(0, kWedgeCount, 0, 65535)},
            {"m12_wedge.ovl", 12, with_two_wedges(2)},
            {"m12_wedge_of_added.ovl", 12,
             with_rare(kOtherFaces | kOtherGroups | kOtherWedges, {2, 0, 1, 1, 5, 0, 0, 1, 0, 0, 0, 0, 0})},
            {"m13_surface.ovl", 13, with_value(0, kBase, 0, zigzag(1))},
            {"m13_packed.ovl", 13, with_value(0, kBase, 1, 65536)},
            {"m13_position.ovl", 13, with_value(0, kBase, 4, zigzag(6))},
            {"m13_negative_position.ovl", 13, with_value(0, kBase, 2, zigzag(-1))},
            {"m13_one_position_twice.ovl", 13, with_value(0, kBase, 3, zigzag(0))},
            {"m13_group.ovl", 13, with_value(0, kBase, 5, zigzag(1))},
            {"m14_owner.ovl", 14, with_value(1, kOwner, 0, zigzag(6))},
            {"m14_negative_owner.ovl", 14, with_value(1, kOwner, 0, zigzag(-1))},
            {"m14_flags.ovl", 14, with_value(1, kFlags, 0, 32)},
            {"m14_arc_too_long.ovl", 14, with_value(1, kArcLength, 0, 5)},
            {"m14_longest_arc.ovl", 14, with_value(1, kArcLength, 0, 0x7fffffff)},
            {"m14_other_move.ovl", 14, with_rare(kOtherMoves | kOtherFaces, {1, 4, 0})},
            {"m14_moves_twice.ovl", 14, with_rare(kOtherMoves | kOtherFaces, {2, 1, 1, 0})},
            {"m14_wide_star.ovl", 14, with_wide_star()},
            {"m15_three_faces.ovl", 15, with_rare(kOtherFaces, {3})},
            {"m15_third.ovl", 15, with_rare(kOtherFaces, {1, 0, 6})},
            {"m15_third_is_owner.ovl", 15, with_rare(kOtherFaces, {1, 0, 0})},
            {"m15_which_is_last.ovl", 15, with_rare(kOtherFaces, {1, 2, 1})},
            {"m15_group.ovl", 15, with_rare(kOtherFaces | kOtherGroups, {1, 0, 1, 1})},
            {"m16_itself.ovl", 16, with_rare(kMoreNeeds, {1, 0})},
            {"m16_before_the_first.ovl", 16, with_rare(kMoreNeeds, {1, 1})},
            {"m16_far_before.ovl", 16, with_rare(kMoreNeeds, {1, 0x7fffffff})},
            {"m16_twice.ovl", 16, with_need_twice()},
            {"m17_below_none.ovl", 17, with_value(1, kError, 0, 961)}};
}

}  // namespace

std::vector<Fixture> whole_files() {
    Parts base = Parts::of(hexagon());
    synthetic::Source striped = synthetic::hills(6, 5, 2);
    striped.attributes = {true, true, true};
    auto made = [](const Hierarchy& hierarchy, Codec codec) { return Parts::of(hierarchy, codec).file(); };
    return {{"hexagon.ovl", 0, base.file()},
            {"hexagon_meshopt.ovl", 0, made(hexagon(), Codec::meshopt)},
            {"other_moves.ovl", 0,
             with_rare(kOtherMoves | kOtherFaces | kOtherGroups | kOtherWedges,
                       {4, 0, 1, 2, 3, 2, 0, 1, 1, 5, 0, 0, 0, 0, 0, 0, 0, 0})},
            {"two_groups.ovl", 0, made(synthetic::bake(striped), Codec::draco)},
            {"two_groups_meshopt.ovl", 0, made(synthetic::bake(striped), Codec::meshopt)},
            {"sphere.ovl", 0, made(synthetic::bake(synthetic::sphere(5)), Codec::draco)}};
}

std::vector<Fixture> corrupt_files() {
    std::vector<Fixture> all;
    for (const auto& some : {broken_heads(), broken_surfaces(), broken_directories(), broken_rows()})
        all.insert(all.end(), some.begin(), some.end());
    return all;
}

}  // namespace overlook::caveclod::fixtures
