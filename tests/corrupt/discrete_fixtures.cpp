#include "tests/corrupt/discrete_fixtures.h"

#include <functional>
#include <limits>

namespace overlook::discrete::fixtures {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();
constexpr float kNanF = std::numeric_limits<float>::quiet_NaN(), kInfinityF = std::numeric_limits<float>::infinity();

Bytes with(const std::function<void(Pieces&)>& change) {
    Pieces pieces = Pieces::of(pyramid());
    change(pieces);
    return pieces.file();
}
// The same of a chain that is broken before it is laid out.
Bytes of(const std::function<void(Chain&)>& change) {
    Chain chain = pyramid();
    change(chain);
    return Pieces::of(chain).file();
}
Bytes with_u32(size_t at, uint32_t value) {
    return with([&](Pieces& pieces) { store_le<uint32_t>(pieces.info, at, value); });
}
Bytes with_f64(size_t at, double value) {
    return with([&](Pieces& pieces) { store_f64(pieces.info, at, value); });
}
// A number of the entry of a level.
Bytes with_entry(size_t level, size_t at, uint32_t value) {
    return with([&](Pieces& pieces) { store_le<uint32_t>(pieces.levels, 40 * level + at, value); });
}
Bytes without(const char* tag) {
    return with([&](Pieces& pieces) { pieces.without = tag; });
}
Bytes resized(Bytes Pieces::*piece, int by) {
    return with([&](Pieces& pieces) { (pieces.*piece).resize(size_t(int((pieces.*piece).size()) + by)); });
}
// DPRT: part 0 is 20 bytes; the vane's name begins at 24, its pivot at 28, its keys at 44.
Bytes with_part(size_t at, uint32_t value) {
    return with([&](Pieces& pieces) { store_le<uint32_t>(pieces.parts, at, value); });
}
Bytes with_part(size_t at, float value) {
    return with_part(at, std::bit_cast<uint32_t>(value));
}
Bytes with_visibility(size_t at, uint32_t value) {
    return with([&](Pieces& pieces) { store_le<uint32_t>(pieces.visibility, at, value); });
}
Bytes with_other_kind() {
    Bytes file = Pieces::of(pyramid()).file();
    store_le<uint32_t>(file, 32, container::tag("CAVE"));
    container::fixtures::seal(file);
    return file;
}

std::vector<Fixture> broken_heads() {
    return {{"d01_other_kind.ovl", 1, with_other_kind()},
            {"d01_no_head.ovl", 1, without("DINF")},
            {"d01_no_levels.ovl", 1, without("DLEV")},
            {"d01_no_geometry.ovl", 1, without("DGEO")},
            {"d01_no_surfaces.ovl", 1, without("DSUR")},
            {"d01_no_parts.ovl", 1, without("DPRT")},
            {"d02_empty.ovl", 2, resized(&Pieces::info, -128)},
            {"d02_byte_less.ovl", 2, resized(&Pieces::info, -1)},
            {"d02_byte_more.ovl", 2, resized(&Pieces::info, 1)},
            {"d03_no_level.ovl", 3, with_u32(0, 0)},
            {"d03_most_levels.ovl", 3, with_u32(0, 33)},
            {"d03_no_part.ovl", 3, with_u32(4, 0)},
            {"d03_most_parts.ovl", 3, with_u32(4, 1025)},
            {"d03_no_surface.ovl", 3, with_u32(8, 0)},
            {"d03_most_surfaces.ovl", 3, with_u32(8, 65537)},
            {"d03_two_visibilities.ovl", 3, with_u32(12, 2)},
            {"d04_nan_origin.ovl", 4, with_f64(24, kNan)},
            {"d04_far_origin.ovl", 4, with_f64(40, -1e13)},
            {"d04_no_step.ovl", 4, with_f64(48, 0)},
            {"d04_infinite_step.ovl", 4, with_f64(48, kInfinity)},
            {"d04_nan_uv.ovl", 4, with_f64(64, kNan)},
            {"d04_negative_uv_step.ovl", 4, with_f64(72, -1)},
            {"d04_nan_middle.ovl", 4, with_f64(88, kNan)},
            {"d04_negative_radius.ovl", 4, with_f64(104, -1)},
            {"d04_infinite_clip.ovl", 4, with_f64(112, kInfinity)},
            {"d04_nan_error.ovl", 4, with_f64(120, kNan)},
            {"d05_attributes.ovl", 5, with_u32(16, 8)},
            {"d06_empty.ovl", 6, with([](Pieces& pieces) { pieces.surfaces.clear(); })},
            {"d06_cut_short.ovl", 6, resized(&Pieces::surfaces, -1)},
            {"d06_byte_more.ovl", 6, resized(&Pieces::surfaces, 1)},
            {"d06_unprintable.ovl", 6, with([](Pieces& pieces) { pieces.surfaces[4] = std::byte(7); })},
            {"d06_long_name.ovl", 6, with([](Pieces& pieces) { store_le<uint32_t>(pieces.surfaces, 0, 0xffffffff); })}};
}

std::vector<Fixture> broken_levels() {
    return {{"d07_byte_less.ovl", 7, resized(&Pieces::levels, -1)},
            {"d07_entry_more.ovl", 7, resized(&Pieces::levels, 40)},
            {"d07_compressed.ovl", 7, with([](Pieces& pieces) { pieces.levels_codec = 1; })},
            {"d07_rung.ovl", 7, with_entry(0, 0, 3)},
            {"d07_flags.ovl", 7, with_entry(0, 4, 2)},
            {"d07_no_vertices.ovl", 7, with_entry(0, 16, 0)},
            {"d07_most_vertices.ovl", 7, with_entry(0, 16, 0xffffffff)},
            {"d07_more_than_bytes_hold.ovl", 7, with_entry(0, 16, 100000)},
            {"d07_no_indices.ovl", 7, with_entry(0, 20, 0)},
            {"d07_half_a_triangle.ovl", 7, with_entry(0, 20, 16)},
            {"d07_most_indices.ovl", 7, with_entry(0, 20, 0xffffffff)},
            {"d07_no_draws.ovl", 7, with_entry(0, 24, 0)},
            {"d07_most_draws.ovl", 7, with_entry(1, 24, 2)},
            {"d08_byte_less.ovl", 8, resized(&Pieces::geometry, -1)},
            {"d08_byte_more.ovl", 8, resized(&Pieces::geometry, 1)},
            {"d08_most_bytes.ovl", 8, with_entry(1, 28, 0xffffffff)},
            {"d09_finest_error.ovl", 9, of([](Chain& chain) { chain.levels[0].error_m = 1; })},
            {"d09_finest_loss.ovl", 9, of([](Chain& chain) { chain.levels[0].lost_area_share = 0.1f; })},
            {"d09_negative.ovl", 9, of([](Chain& chain) { chain.levels[1].error_m = -1; })},
            {"d09_nan.ovl", 9, of([](Chain& chain) { chain.levels[1].error_m = kNanF; })},
            {"d09_infinite.ovl", 9, of([](Chain& chain) { chain.levels[1].error_m = kInfinityF; })},
            {"d09_loss_above_all.ovl", 9, of([](Chain& chain) { chain.levels[1].lost_area_share = 1.5f; })},
            {"d09_loss_nan.ovl", 9, of([](Chain& chain) { chain.levels[1].lost_area_share = kNanF; })},
            {"d09_finest_added.ovl", 9, of([](Chain& chain) { chain.levels[0].added_area_share = 0.1f; })},
            {"d09_added_negative.ovl", 9, of([](Chain& chain) { chain.levels[1].added_area_share = -0.1f; })},
            {"d09_added_infinite.ovl", 9, of([](Chain& chain) { chain.levels[1].added_area_share = kInfinityF; })},
            {"d09_added_nan.ovl", 9, of([](Chain& chain) { chain.levels[1].added_area_share = kNanF; })},
            {"d10_not_vertices.ovl", 10, with([](Pieces& pieces) { pieces.geometry[0] = std::byte(0x55); })},
            {"d10_vertices_more.ovl", 10, with_entry(0, 16, 250)},
            {"d10_not_indices.ovl", 10, with([](Pieces& pieces) {
                 auto vertex_bytes = load_le<uint32_t>(pieces.levels, 28);
                 pieces.geometry[vertex_bytes] = std::byte(0x55);
             })},
            {"d11_part.ovl", 11, of([](Chain& chain) { chain.levels[0].vertices[7].part = 2; })},
            {"d11_most_part.ovl", 11, of([](Chain& chain) { chain.levels[1].vertices[0].part = 65535; })},
            {"d11_normal.ovl", 11, of([](Chain& chain) { chain.levels[0].vertices[2].normal[1] = -32768; })},
            {"d12_index.ovl", 12, of([](Chain& chain) { chain.levels[0].indices[14] = 8; })},
            {"d13_surface.ovl", 13, of([](Chain& chain) { chain.levels[0].draws[1].surface = 2; })},
            {"d13_none.ovl", 13, of([](Chain& chain) { chain.levels[0].draws[1].index_count = 0; })},
            {"d13_half_a_triangle.ovl", 13, of([](Chain& chain) { chain.levels[0].draws[0].index_count = 11; })},
            {"d13_beyond.ovl", 13, of([](Chain& chain) { chain.levels[0].draws[1].index_count = 0xffffffff; })},
            {"d13_short.ovl", 13, of([](Chain& chain) { chain.levels[0].draws[0].index_count = 9; })}};
}

std::vector<Fixture> broken_parts() {
    return {{"d14_empty.ovl", 14, with([](Pieces& pieces) { pieces.parts.clear(); })},
            {"d14_cut_short.ovl", 14, resized(&Pieces::parts, -1)},
            {"d14_byte_more.ovl", 14, resized(&Pieces::parts, 1)},
            {"d14_long_name.ovl", 14, with_part(20, 4097u)},
            {"d14_unprintable.ovl", 14, with_part(24, 7u)},
            {"d14_most_keys.ovl", 14, with_part(40, 0xffffffffu)},
            {"d15_first_moves.ovl", 15, of([](Chain& chain) { chain.parts[0] = chain.parts[1]; })},
            {"d15_begins_late.ovl", 15, with_part(44, 0.5f)},
            {"d15_goes_back.ovl", 15, with_part(44 + 64, 0.5f)},
            {"d15_nan.ovl", 15, with_part(44 + 64, kNanF)},
            {"d15_ends_early.ovl", 15, with_f64(112, 5)},
            {"d16_turn.ovl", 16, with_part(48, 2.0f)},
            {"d16_turn_nan.ovl", 16, with_part(52, kNanF)},
            {"d16_move.ovl", 16, with_part(64, 1e10f)},
            {"d16_pivot.ovl", 16, with_part(28, kInfinityF)},
            {"d17_small.ovl", 17, with_f64(104, 3)},
            {"d17_elsewhere.ovl", 17, with_f64(80, 100)}};
}

std::vector<Fixture> broken_pictures() {
    auto of_boards = [](const std::function<void(Chain&)>& change) {
        Chain chain = boards();
        change(chain);
        return Pieces::of(chain).file();
    };
    return {{"d19_most.ovl", 19, with_u32(20, 3)},
            {"d19_all.ovl", 19, with_u32(20, 0xffffffff)},
            {"d19_no_mask.ovl", 19, with_u32(20, 1)},
            {"d19_no_picture.ovl", 19, of_boards([](Chain& chain) { chain.surfaces[2].texture_bytes.clear(); })},
            {"d19_of_a_mesh.ovl", 19, of_boards([](Chain& chain) { chain.levels[1].rung = Rung::mesh; })}};
}

std::vector<Fixture> broken_visibilities() {
    return {{"d18_missing.ovl", 18, without("DVIS")},
            {"d18_not_stated.ovl", 18, with_u32(12, 0)},
            {"d18_lookup.ovl", 18, with_visibility(0, 2)},
            {"d18_no_width.ovl", 18, with_visibility(4, 0)},
            {"d18_most_height.ovl", 18, with_visibility(8, 4097)},
            {"d18_deep_picture.ovl", 18, with_visibility(12, 2)},
            {"d18_most_values.ovl", 18, of([](Chain& chain) {
                 chain.visibility[0].lookup = Visibility::Lookup::volume;
                 chain.visibility[0].width = chain.visibility[0].height = 4096, chain.visibility[0].depth = 2;
             })},
            {"d18_no_period.ovl", 18, with_visibility(16, 0)},
            {"d18_nan_period.ovl", 18, with_visibility(16, 0x7fc00000)},
            {"d18_cut_short.ovl", 18, resized(&Pieces::visibility, -1)},
            {"d18_head_cut.ovl", 18, resized(&Pieces::visibility, -10)},
            {"d18_byte_more.ovl", 18, resized(&Pieces::visibility, 1)}};
}

}  // namespace

std::vector<Fixture> whole_files() {
    auto of_one = [](Chain& chain) { chain.levels.pop_back(), chain.parts.pop_back(); };
    return {{"pyramid.ovl", 0, Pieces::of(pyramid()).file()},
            {"one_level.ovl", 0, of([&](Chain& chain) {
                 of_one(chain);
                 for (Vertex& vertex : chain.levels[0].vertices) vertex.part = 0;
                 chain.visibility.clear(), chain.clip_s = 0;
             })},
            {"billboards.ovl", 0, Pieces::of(boards()).file()},
            {"volume.ovl", 0, of([](Chain& chain) {
                 chain.visibility[0] = {Visibility::Lookup::volume, 2, 2, 2, 2.0f, {0, 30, 60, 90, 120, 150, 180, 210}};
             })}};
}

std::vector<Fixture> corrupt_files() {
    std::vector<Fixture> all;
    for (const auto& some : {broken_heads(), broken_levels(), broken_parts(), broken_visibilities(), broken_pictures()})
        all.insert(all.end(), some.begin(), some.end());
    return all;
}

}  // namespace overlook::discrete::fixtures
