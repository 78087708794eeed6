#include "tests/corrupt/terrain_fixtures.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>

#include "formats/little_endian.h"
#include "formats/terrain_layout.h"
#include "tests/corrupt/terrain_parts.h"
#include "tests/formats/synthetic_terrain.h"

namespace overlook::terrain::fixtures {
namespace {

using container::fixtures::RawSection;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();
constexpr float kNanF = std::numeric_limits<float>::quiet_NaN(), kInfinityF = std::numeric_limits<float>::infinity();

Terrain textured_hill() {
    Terrain terrain = hill();
    terrain.texture = {2, 1, {1, 2, 3, 4, 5, 6}};
    return terrain;
}
Terrain hill_with_hole() {
    return synthetic_terrain(3, 3, [](uint32_t x, uint32_t y) { return x == 1 && y == 1; });
}
Terrain strip() {  // two blocks
    return synthetic_terrain(2, 3, no_void);
}

// The file of a terrain after a change of its parts.
Bytes changed(const Terrain& terrain, const std::function<void(Parts&)>& change) {
    Parts parts = Parts::of(terrain);
    change(parts);
    return parts.file();
}
Bytes with_u32(size_t at, uint32_t value) {
    return changed(hill(), [&](Parts& parts) { store_le<uint32_t>(parts.info, at, value); });
}
Bytes with_size(uint32_t width, uint32_t height) {
    return changed(hill(),
                   [&](Parts& parts) { store_le<uint32_t>(parts.info, 0, width), store_le<uint32_t>(parts.info, 4, height); });
}
Bytes with_f64(size_t at, double value) {
    return changed(hill(), [&](Parts& parts) { store_f64(parts.info, at, value); });
}
Bytes with_error(size_t code, float error_m) {
    return changed(hill(), [&](Parts& parts) { store_f32(parts.info, 128 + 4 * code, error_m); });
}
Bytes with_finest_error(double finest_error_m, float error_m) {
    return changed(hill(), [&](Parts& parts) { store_f64(parts.info, 24, finest_error_m), store_f32(parts.info, 128, error_m); });
}
Bytes with_crs(std::string_view text) {
    return changed(hill(), [&](Parts& parts) {
        for (size_t i = 0; i < text.size(); ++i) parts.info[96 + i] = std::byte(text[i]);
    });
}
Bytes with_section_resized(Bytes Parts::*section, size_t bytes) {
    return changed(hill(), [&](Parts& parts) { (parts.*section).resize(bytes); });
}
template <class T>
Bytes with_entry(const Terrain& terrain, size_t at, T value) {
    return changed(terrain, [&](Parts& parts) { store_le<T>(parts.directory, at, value); });
}

// The one block of a terrain after a change of its raw bytes; its checksum and sizes are right.
Bytes with_block(const Terrain& terrain, const std::function<void(Bytes&)>& change) {
    Block block = blocks_of(terrain.shape).front();
    Bytes raw = pack_block(terrain, block);
    change(raw);
    return changed(terrain, [&](Parts& parts) { parts.lay_out(std::array{piece_of(raw, range_of(terrain, block))}); });
}
Bytes with_byte(const Terrain& terrain, size_t at, uint8_t value) {
    return with_block(terrain, [&](Bytes& raw) { raw[at] = std::byte(value); });
}
// Other stored bytes for the one block of the hill, which states `raw_bytes` of content.
Bytes with_stored(const Bytes& stored, uint32_t raw_bytes) {
    return changed(hill(), [&](Parts& parts) { parts.lay_out(std::array{Piece{stored, raw_bytes, {100, 110}}}); });
}

Bytes without(std::string_view tag) {
    Parts parts = Parts::of(hill());
    std::vector<RawSection> sections{{"TINF", 1, 0, parts.info, parts.info.size()},
                                     {"TBLK", 3, 0, parts.blocks, parts.blocks.size()},
                                     {"TDIR", 1, 0, parts.directory, parts.directory.size()}};
    std::erase_if(sections, [&](const RawSection& section) { return section.tag == tag; });
    return terrain_file_of(sections);
}
Bytes of_other_kind() {
    Bytes file = file_of(hill());
    store_le<uint32_t>(file, 32, container::tag("DEMO"));
    container::fixtures::seal(file);
    return file;
}

Bytes with_texture(uint32_t width, uint32_t height, size_t pixel_bytes) {
    return changed(textured_hill(), [&](Parts& parts) {
        parts.texture.assign(8 + pixel_bytes, std::byte(7));
        store_le<uint32_t>(parts.texture, 0, width), store_le<uint32_t>(parts.texture, 4, height);
    });
}
Bytes with_texture_that_states(uint64_t raw_bytes) {
    Parts parts = Parts::of(hill());
    Bytes frame = frame_of(Bytes(20));
    return terrain_file_of(std::array{
        RawSection{"TINF", 1, 0, parts.info, parts.info.size()}, RawSection{"TBLK", 3, 0, parts.blocks, parts.blocks.size()},
        RawSection{"TDIR", 1, 0, parts.directory, parts.directory.size()}, RawSection{"TTEX", 0, 1, frame, raw_bytes}});
}

// The hill with its one tile: one square, low 100 and 11 steps from there on, each as a folded step from the number before.
constexpr uint64_t kHillSum = 942;
const Bytes kHillTile{std::byte(0xc8), std::byte(0xb1), {}, {}, {}, {}, {}, {}};
Bytes with_tile(
    const Bytes& raw, uint64_t height_sum = kHillSum, const std::function<void(Parts&)>& change = [](Parts&) {}) {
    return changed(hill(), [&](Parts& parts) { parts.lay_out_tile(raw, height_sum), change(parts); });
}
template <class T>
Bytes with_tile_entry(size_t at, T value) {
    return with_tile(kHillTile, kHillSum, [&](Parts& parts) { store_le<T>(parts.tile_directory, at, value); });
}

std::vector<Fixture> broken_tiles() {
    Bytes longer = kHillTile, other = kHillTile;
    longer.push_back(std::byte(0)), other[1] = std::byte(0xb3);
    return {{"t18_no_directory.ovl", 18, with_tile(kHillTile, 0, [](Parts& parts) { parts.tile_directory.clear(); })},
            {"t18_no_tiles.ovl", 18, with_tile(kHillTile, 0, [](Parts& parts) { parts.tiles.clear(); })},
            {"t18_byte_less.ovl", 18, with_tile(kHillTile, 0, [](Parts& parts) { parts.tile_directory.pop_back(); })},
            {"t18_reserved.ovl", 18, with_tile_entry<uint64_t>(8, 1)},
            {"t18_begins_late.ovl", 18, with_tile_entry<uint64_t>(16, 1)},
            {"t18_most_bytes.ovl", 18, with_tile_entry<uint32_t>(32, ~0u)},
            {"t18_bytes_after.ovl", 18, with_tile(kHillTile, 0, [](Parts& parts) { parts.tiles.push_back({}); })},
            {"t19_checksum.ovl", 19, with_tile_entry<uint64_t>(24, 0)},
            {"t19_states_most.ovl", 19, with_tile_entry<uint32_t>(36, ~0u)},
            {"t19_byte_more.ovl", 19, with_tile(longer)},
            {"t20_sum.ovl", 20, with_tile(kHillTile, kHillSum + 1)},
            {"t20_high.ovl", 20, with_tile(other)}};
}

std::vector<Fixture> broken_heads() {
    std::string too_high(1, '\x7f');
    return {{"t01_other_kind.ovl", 1, of_other_kind()},
            {"t01_no_head.ovl", 1, without("TINF")},
            {"t01_no_blocks.ovl", 1, without("TBLK")},
            {"t01_no_directory.ovl", 1, without("TDIR")},
            {"t02_empty.ovl", 2, with_section_resized(&Parts::info, 0)},
            {"t02_byte_less.ovl", 2, with_section_resized(&Parts::info, 1151)},
            {"t02_byte_more.ovl", 2, with_section_resized(&Parts::info, 1153)},
            {"t03_no_columns.ovl", 3, with_size(0, 3)},
            {"t03_one_column.ovl", 3, with_size(1, 3)},
            {"t03_one_row.ovl", 3, with_size(3, 1)},
            {"t03_product_wraps.ovl", 3, with_size(65536, 65536)},
            {"t03_one_row_over.ovl", 3, with_size(2, (1u << 30) + 1)},
            {"t03_most.ovl", 3, with_size(~0u, ~0u)},
            {"t04_no_width.ovl", 4, with_f64(32, 0)},
            {"t04_negative.ovl", 4, with_f64(40, -30)},
            {"t04_nan.ovl", 4, with_f64(32, kNan)},
            {"t04_infinite.ovl", 4, with_f64(40, kInfinity)},
            {"t05_no_step.ovl", 5, with_f64(8, 0)},
            {"t05_negative_step.ovl", 5, with_f64(8, -1)},
            {"t05_nan_step.ovl", 5, with_f64(8, kNan)},
            {"t05_infinite_step.ovl", 5, with_f64(8, kInfinity)},
            {"t05_nan_offset.ovl", 5, with_f64(16, kNan)},
            {"t05_infinite_offset.ovl", 5, with_f64(16, -kInfinity)},
            {"t05_beyond.ovl", 5, with_f64(8, 4000)},
            {"t06_nan.ovl", 6, with_finest_error(kNan, kNanF)},
            {"t06_negative.ovl", 6, with_finest_error(-1, -1)},
            {"t06_infinite.ovl", 6, with_finest_error(kInfinity, kInfinityF)},
            {"t06_rounded_down.ovl", 6, with_finest_error(0.1, 0.099999994f)},
            {"t06_more_than_rounded.ovl", 6, with_finest_error(0.1, 0.11f)},
            {"t07_nan.ovl", 7, with_error(100, kNanF)},
            {"t07_below.ovl", 7, with_error(100, 5)},
            {"t07_negative.ovl", 7, with_error(1, -1)},
            {"t07_254_infinite.ovl", 7, with_error(254, kInfinityF)},
            {"t07_255_finite.ovl", 7, with_error(255, 1000)},
            {"t07_255_nan.ovl", 7, with_error(255, kNanF)},
            {"t08_flag_2.ovl", 8, with_u32(48, 2)},
            {"t08_other_blocks.ovl", 8, with_u32(52, 8)},
            {"t08_unprintable.ovl", 8, with_crs("EPSG:4326\n")},
            {"t08_delete.ovl", 8, with_crs(too_high)},
            {"t08_after_the_name.ovl", 8, with_crs(std::string_view("EPSG:4326\0more", 14))},
            {"t08_latitude.ovl", 8, with_f64(56, 91)},
            {"t08_nan_latitude.ovl", 8, with_f64(56, kNan)},
            {"t08_longitude.ovl", 8, with_f64(64, kInfinity)},
            {"t08_convergence.ovl", 8, with_f64(72, -361)},
            {"t08_distortion.ovl", 8, with_f64(80, -0.5)}};
}

std::vector<Fixture> broken_directories() {
    Parts two = Parts::of(strip());
    auto first_bytes = load_le<uint32_t>(two.directory, 8);
    return {{"t09_empty.ovl", 9, with_section_resized(&Parts::directory, 0)},
            {"t09_entry_more.ovl", 9, with_section_resized(&Parts::directory, 64)},
            {"t09_byte_less.ovl", 9, with_section_resized(&Parts::directory, 31)},
            {"t09_compressed.ovl", 9, changed(hill(), [](Parts& parts) { parts.directory_codec = 1; })},
            {"t09_most_columns.ovl", 9, with_size(1u << 30, 2)},
            {"t09_most_rows.ovl", 9, with_size(2, 1u << 30)},
            {"t09_most_samples.ovl", 9, with_size(46340, 46340)},
            {"t10_compressed_whole.ovl", 10, changed(hill(), [](Parts& parts) { parts.blocks_codec = 1; })},
            {"t10_begins_late.ovl", 10, with_entry<uint64_t>(hill(), 0, 1)},
            {"t10_begins_nowhere.ovl", 10, with_entry<uint64_t>(hill(), 0, ~uint64_t(0))},
            {"t10_overlap.ovl", 10, with_entry<uint64_t>(strip(), 32, first_bytes - 1)},
            {"t10_gap.ovl", 10, with_entry<uint64_t>(strip(), 32, first_bytes + 1)},
            {"t10_ends_early.ovl", 10, with_entry<uint32_t>(hill(), 8, 26)},
            {"t10_ends_late.ovl", 10, with_entry<uint32_t>(hill(), 8, 28)},
            {"t10_most_bytes.ovl", 10, with_entry<uint32_t>(strip(), 40, ~0u)},
            {"t10_bytes_after.ovl", 10, changed(hill(), [](Parts& parts) { parts.blocks.resize(parts.blocks.size() + 1); })},
            {"t11_checksum.ovl", 11, with_entry<uint64_t>(hill(), 16, 0)},
            {"t11_byte_of_block.ovl", 11, changed(hill(), [](Parts& parts) { parts.blocks[13] ^= std::byte(1); })},
            {"t11_second_block.ovl", 11, changed(strip(), [](Parts& parts) { parts.blocks.back() ^= std::byte(128); })}};
}

std::vector<Fixture> broken_blocks() {
    Bytes raw = pack_block(hill(), blocks_of(hill().shape).front());
    Bytes frame = frame_of(raw), garbage = frame, longer = frame;
    garbage[6] = std::byte(uint8_t(garbage[6]) | 4);  // the same bytes as a compressed block
    longer.push_back(std::byte(0));
    auto far = [](Bytes& bytes) {  // four planes, the first height 2^28 + 1
        Bytes residuals(9 * 4);
        residuals[0] = std::byte(2), residuals[27] = std::byte(0x20);
        Bytes all{std::byte(4), std::byte(0), std::byte(0), std::byte(0)};
        all.insert(all.end(), residuals.begin(), residuals.end());
        all.resize(all.size() + 5);
        bytes = all;
    };
    return {{"t12_no_planes.ovl", 12, with_byte(hill(), 0, 0)},
            {"t12_five_planes.ovl", 12, with_byte(hill(), 0, 5)},
            {"t12_two_planes_stated.ovl", 12, with_byte(hill(), 0, 2)},
            {"t12_flag_2.ovl", 12, with_byte(hill(), 1, 2)},
            {"t12_reserved.ovl", 12, with_byte(hill(), 3, 1)},
            {"t12_no_bytes.ovl", 12, with_block(hill(), [](Bytes& bytes) { bytes.clear(); })},
            {"t12_head_cut.ovl", 12, with_block(hill(), [](Bytes& bytes) { bytes.resize(3); })},
            {"t12_voids_cut.ovl", 12, with_block(hill_with_hole(), [](Bytes& bytes) { bytes.resize(5); })},
            {"t12_byte_less.ovl", 12, with_block(hill(), [](Bytes& bytes) { bytes.pop_back(); })},
            {"t12_byte_more.ovl", 12, with_block(hill(), [](Bytes& bytes) { bytes.push_back(std::byte(0)); })},
            {"t12_void_more.ovl", 12, with_byte(hill_with_hole(), 4, 0x30)},
            {"t12_void_after_last.ovl", 12,
             with_block(hill_with_hole(),
                        [](Bytes& bytes) {
                            bytes[5] = std::byte(0x80);
                            bytes.erase(bytes.begin() + 6);  // a height less, so that the sizes fit
                        })},
            {"t12_beyond_2_28.ovl", 12, with_block(hill(), far)},
            {"t12_states_too_much.ovl", 12, with_block(hill(), [](Bytes& bytes) { bytes.resize(4 + 2 + 36 + 5 + 1); })},
            {"t12_states_most.ovl", 12, with_entry<uint32_t>(hill(), 12, ~0u)},
            {"t12_states_other.ovl", 12, with_entry<uint32_t>(hill(), 12, 17)},
            {"t12_not_zstd.ovl", 12, with_stored(raw, uint32_t(raw.size()))},
            {"t12_bytes_after_frame.ovl", 12, with_stored(longer, uint32_t(raw.size()))},
            {"t12_not_decodable.ovl", 12, with_stored(garbage, uint32_t(raw.size()))},
            {"t12_no_frame.ovl", 12, with_stored({}, 0)},
            {"t13_low.ovl", 13, with_entry<uint32_t>(hill(), 24, 99)},
            {"t13_high.ovl", 13, with_entry<uint32_t>(hill(), 28, 111)},
            {"t13_all_void.ovl", 13, changed(hill(), [](Parts& parts) {
                 store_le<uint32_t>(parts.directory, 24, 0), store_le<uint32_t>(parts.directory, 28, ~0u);
             })}};
}

std::vector<Fixture> broken_promises() {
    Terrain low_edge = synthetic_terrain(5, 5, no_void);
    low_edge.codes[1][1] = 0;  // an edge of level 1, whose splitting the squares of level 0 beside it follow from
    Terrain unmarked = hill_with_hole();
    unmarked.codes[0][1] = 7;
    Terrain corner = synthetic_terrain(3, 3, [](uint32_t x, uint32_t y) { return x == 0 && y == 0; });
    corner.codes[0][3] = 7;
    return {{"t14_edge_above_square.ovl", 14, with_byte(hill(), 14, 2)},
            {"t14_level_above_level.ovl", 14, file_of(low_edge)},
            {"t15_beside_a_hole.ovl", 15, file_of(unmarked)},
            {"t15_at_the_corner.ovl", 15, file_of(corner)},
            {"t16_one_more.ovl", 16, with_u32(88, 1)},
            {"t16_most.ovl", 16, changed(hill(), [](Parts& parts) { store_le<uint64_t>(parts.info, 88, ~uint64_t(0)); })},
            {"t17_no_bytes.ovl", 17, with_texture_that_states(0)},
            {"t17_head_cut.ovl", 17, changed(textured_hill(), [](Parts& parts) { parts.texture.resize(7); })},
            {"t17_no_width.ovl", 17, with_texture(0, 1, 0)},
            {"t17_byte_less.ovl", 17, with_texture(2, 1, 5)},
            {"t17_byte_more.ovl", 17, with_texture(2, 1, 7)},
            {"t17_product_wraps.ovl", 17, with_texture(1u << 31, 2, 0)},
            {"t17_side_over.ovl", 17, with_texture(32769, 1, 3 * 32769)},
            {"t17_most_bytes.ovl", 17, with_texture_that_states(uint64_t(1) << 40)}};
}

}  // namespace

Terrain hill() {
    Terrain terrain;
    terrain.shape = shape_of(3, 3);
    terrain.frame.metres_per_column = terrain.frame.metres_per_row = 30;
    terrain.heights = {100, 101, 102, 103, 110, 105, 106, 107, 108};
    terrain.error_m.fill(6);
    terrain.error_m[0] = 0;
    terrain.error_m[kMustSplit] = kInfinityF;
    terrain.codes = {{0, 0, 0, 0, 1, 0, 0, 0, 0}};
    return terrain;
}

std::vector<Fixture> whole_files() {
    auto checkerboard = [](uint32_t x, uint32_t y) { return ((x ^ y) & 1) != 0; };
    Terrain flat = synthetic_terrain(130, 130, no_void);
    std::fill(flat.heights.begin(), flat.heights.end(), 0);
    for (auto& level : flat.codes) std::fill(level.begin(), level.end(), uint8_t(0));
    return {{"hill.ovl", 0, file_of(hill())},
            {"hill_with_texture.ovl", 0, file_of(textured_hill())},
            {"hill_with_tile.ovl", 0, with_tile(kHillTile)},
            {"hill_with_hole.ovl", 0, file_of(hill_with_hole())},
            {"smallest.ovl", 0, file_of(synthetic_terrain(2, 2, no_void))},
            {"two_blocks.ovl", 0, file_of(strip())},
            {"two_levels_squeezed.ovl", 0, file_of(synthetic_terrain(5, 4, no_void))},
            {"checkerboard.ovl", 0, file_of(synthetic_terrain(9, 5, checkerboard))},
            {"all_void.ovl", 0, file_of(synthetic_terrain(6, 3, [](uint32_t, uint32_t) { return true; }))},
            {"flat_with_two_stages.ovl", 0, file_of(flat)}};
}

std::vector<Fixture> corrupt_files() {
    std::vector<Fixture> all = broken_heads();
    for (auto make : {broken_directories, broken_blocks, broken_promises, broken_tiles}) {
        std::vector<Fixture> more = make();
        all.insert(all.end(), more.begin(), more.end());
    }
    return all;
}

}  // namespace overlook::terrain::fixtures
