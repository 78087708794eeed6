#include "tests/corrupt/wang_images_fixtures.h"

#include <functional>
#include <limits>

#include "formats/container_rules.h"
#include "formats/wang_ldi_grouped.h"

namespace overlook::wang_ldi::image_fixtures {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();
constexpr float kNanF = std::numeric_limits<float>::quiet_NaN();

// Where the entries of images begin in WLDI.
constexpr size_t kEntries = 128 + 2 * 16;

Bytes with(const std::function<void(Pieces&)>& change) {
    Pieces pieces = Pieces::of(post(), images_of_post());
    change(pieces);
    return pieces.file();
}
Bytes with_u32(size_t at, uint32_t value) {
    return with([&](Pieces& pieces) { store_le<uint32_t>(pieces.directory, at, value); });
}
Bytes with_f64(size_t at, double value) {
    return with([&](Pieces& pieces) { store_f64(pieces.directory, at, value); });
}
Bytes with_level(size_t level, size_t at, float value) {
    return with([&](Pieces& pieces) { store_f32(pieces.directory, 128 + 16 * level + at, value); });
}
Bytes with_entry(size_t image, size_t at, uint32_t value) {
    return with_u32(kEntries + 40 * image + at, value);
}
Bytes resized(Bytes Pieces::*piece, int by) {
    return with([&](Pieces& pieces) { (pieces.*piece).resize(size_t(int((pieces.*piece).size()) + by)); });
}
// Of images that are broken before they are laid out, and of bytes that are, laid out rightly.
Bytes of(const std::function<void(std::vector<Ldi>&)>& change) {
    std::vector<Ldi> ldis = images_of_post();
    change(ldis);
    return Pieces::of(post(), ldis).file();
}
Bytes of_raw(const std::function<void(Bytes&)>& change) {
    std::vector<Ldi> ldis = images_of_post();
    std::vector<Bytes> raw{bytes_of_ldi(post(), ldis[0]), bytes_of_ldi(post(), ldis[1])};
    change(raw[0]);
    return Pieces::of_raw(post(), ldis, raw).file();
}
// The first byte of the first image's frame another, its checksum right.
Bytes with_other_frame() {
    return with([](Pieces& pieces) {
        pieces.images[0] ^= std::byte(1);
        auto bytes = load_le<uint32_t>(pieces.directory, kEntries + 16);
        store_le<uint64_t>(pieces.directory, kEntries + 8, container::checksum_of(std::span(pieces.images).first(bytes)));
    });
}

std::vector<Fixture> broken_heads() {
    return {{"l01_no_directory.ovl", 1, with([](Pieces& pieces) { pieces.without = "WLDI"; })},
            {"l01_no_images.ovl", 1, with([](Pieces& pieces) { pieces.without = "WLDS"; })},
            {"l01_compressed.ovl", 1, with([](Pieces& pieces) { pieces.directory_codec = 1; })},
            {"l01_not_in_parts.ovl", 1, with([](Pieces& pieces) { pieces.image_flags = 1; })},
            {"l02_empty.ovl", 2, with([](Pieces& pieces) { pieces.directory.clear(); })},
            {"l02_byte_less.ovl", 2, resized(&Pieces::directory, -1)},
            {"l02_entry_more.ovl", 2, resized(&Pieces::directory, 40)},
            {"l02_more_tiles.ovl", 2, with_u32(0, 65536)},
            {"l03_no_tile.ovl", 3, with_u32(0, 0)},
            {"l03_most_tiles.ovl", 3, with_u32(0, 65537)},
            {"l03_no_level.ovl", 3, with_u32(4, 0)},
            {"l03_most_levels.ovl", 3, with_u32(4, 0xffffffff)},
            {"l03_no_direction.ovl", 3, with_u32(8, 0)},
            {"l03_most_directions.ovl", 3, with_u32(8, 65)},
            {"l03_no_context.ovl", 3, with_u32(12, 0)},
            {"l03_most_contexts.ovl", 3, with_u32(12, 3)},
            {"l03_most_images.ovl", 3, with([](Pieces& pieces) {
                 store_le<uint32_t>(pieces.directory, 0, 65536), store_le<uint32_t>(pieces.directory, 8, 64);
             })},
            {"l04_flags.ovl", 4, with_u32(16, 8)},
            {"l04_reserved.ovl", 4, with_u32(20, 1)},
            {"l04_reserved_of_image.ovl", 4, with_entry(1, 36, 1)},
            {"l05_no_tile.ovl", 5, with_f64(24, 0)},
            {"l05_nan_low.ovl", 5, with_f64(32, kNan)},
            {"l05_flat.ovl", 5, with_f64(40, 0)},
            {"l05_nan_eye.ovl", 5, with_f64(48, kNan)},
            {"l05_eyes_turned.ovl", 5, with_f64(56, 1)},
            {"l05_negative_nearest.ovl", 5, with_f64(64, -1)},
            {"l05_farthest_before_nearest.ovl", 5, with_f64(72, 0.5)},
            {"l05_no_focal_length.ovl", 5, with_f64(80, 0)},
            {"l05_infinite_error.ovl", 5, with_f64(88, kInfinity)},
            {"l05_long_sun.ovl", 5, with_f64(96, 2)},
            {"l05_nan_sun.ovl", 5, with_f64(112, kNan)},
            {"l05_nan_level_fade.ovl", 5, with_u32(120, std::bit_cast<uint32_t>(kNanF))},
            {"l05_wide_level_fade.ovl", 5, with_u32(120, std::bit_cast<uint32_t>(0.51f))},
            {"l05_negative_direction_fade.ovl", 5, with_u32(124, std::bit_cast<uint32_t>(-0.1f))},
            {"l05_wide_direction_fade.ovl", 5, with_u32(124, std::bit_cast<uint32_t>(0.51f))}};
}

std::vector<Fixture> broken_levels() {
    return {{"l06_no_pixel.ovl", 6, with_u32(128, 0)},
            {"l06_most_pixels.ovl", 6, with_u32(128, 4097)},
            {"l06_same_pixels.ovl", 6, with_u32(144, 2)},
            {"l06_nearest_falls.ovl", 6, with_level(1, 4, 1)},
            {"l06_nan_nearest.ovl", 6, with_level(0, 4, kNanF)},
            {"l06_no_step.ovl", 6, with_level(0, 8, 0)},
            {"l06_short_steps.ovl", 6, with_level(1, 8, 1e-5f)},
            {"l06_nan_step.ovl", 6, with_level(0, 8, kNanF)},
            {"l06_no_splat.ovl", 6, with_level(0, 12, 0)},
            {"l06_wide_splat.ovl", 6, with_level(1, 12, 65)},
            {"l07_gap.ovl", 7, with_entry(1, 0, 1000)},
            {"l07_byte_less.ovl", 7, resized(&Pieces::images, -1)},
            {"l07_byte_more.ovl", 7, resized(&Pieces::images, 1)},
            {"l08_sample_more.ovl", 8, with_entry(0, 24, 5)},
            {"l08_most_samples.ovl", 8, with_entry(0, 24, 0xffffffff)},
            {"l08_no_colour.ovl", 8, with_entry(1, 28, 0)},
            {"l08_most_colours.ovl", 8, with_entry(1, 28, 257)},
            {"l08_raw_bytes.ovl", 8, with_entry(0, 20, 0xffffffff)},
            {"l08_unseen.ovl", 8, with_entry(0, 32, std::bit_cast<uint32_t>(1.5f))},
            {"l08_nan_unseen.ovl", 8, with_entry(0, 32, std::bit_cast<uint32_t>(kNanF))}};
}

std::vector<Fixture> broken_images() {
    // Raw bytes of image 0: palette to 6, counts to 14, residuals to 22, colours to 26.
    return {{"l09_damaged.ovl", 9, with([](Pieces& pieces) { pieces.images[9] ^= std::byte(1); })},
            {"l09_other_checksum.ovl", 9, with_entry(1, 8, 1)},
            {"l10_no_frame.ovl", 10, with_other_frame()},
            {"l11_sample_less.ovl", 11, of_raw([](Bytes& raw) { raw[6] = std::byte(2); })},
            {"l11_many_samples.ovl", 11, of_raw([](Bytes& raw) { raw[10] = std::byte(255); })},
            {"l12_above_all.ovl", 12, of([](std::vector<Ldi>& ldis) { ldis[0].heights[2] = 7; })},
            {"l12_above_16_bits.ovl", 12, of_raw([](Bytes& raw) { raw[16] = raw[20] = std::byte(255); })},
            {"l13_colour.ovl", 13, of([](std::vector<Ldi>& ldis) { ldis[1].colours[1] = 1; })},
            {"l14_normal.ovl", 14, of([](std::vector<Ldi>& ldis) { ldis[0].normals[3][1] = -128; })},
            {"l15_splat.ovl", 15, of([](std::vector<Ldi>& ldis) { ldis[1].splats[0] = 0; })}};
}

Bytes of_grouped_raw(const std::function<void(Bytes&)>& change) {
    std::vector<Ldi> ldis = images_of_post();
    std::vector<Bytes> raw;
    for (uint32_t level : {0u, 1u}) raw.push_back(grouped_bytes_of(grouped_post(), level, ldis[level]).bytes);
    change(raw[0]);
    return Pieces::of_raw(grouped_post(), ldis, raw).file();
}

std::vector<Fixture> broken_groups() {
    // Raw bytes of image 0: sizes to 16, palette to 22, which pixels have samples to 23, counts to 31, heights to 39, colours
    // to 43.
    auto with_byte = [](size_t at, int value) { return of_grouped_raw([=](Bytes& raw) { raw[at] = std::byte(value); }); };
    return {
        {"l11_grouped_sample_less.ovl", 11, with_byte(23, 1)},
        {"l11_grouped_many_samples.ovl", 11, with_byte(27, 255)},
        {"l11_grouped_beyond.ovl", 11, with_byte(22, 0x89)},
        {"l12_grouped_above_16_bits.ovl", 12, of_grouped_raw([](Bytes& raw) { raw[34] = raw[38] = std::byte(255); })},
        {"l12_grouped_above_all.ovl", 12, with_byte(34, 6)},
        {"l13_grouped_colour.ovl", 13, with_byte(41, 2)},
        {"l14_grouped_normal.ovl", 14, with_byte(44, 0x80)},
        {"l15_grouped_splat.ovl", 15, with_byte(54, 0)},
        {"l16_count_more.ovl", 16, with_byte(0, 3)},
        {"l16_count_less.ovl", 16, with_byte(0, 1)},
        {"l16_height_in_other_group.ovl", 16, of_grouped_raw([](Bytes& raw) { raw[4] = std::byte(1), raw[8] = std::byte(3); })},
        {"l16_height_less.ovl", 16, with_byte(8, 1)},
        {"l16_most_heights.ovl", 16, with_byte(7, 255)},
        {"l16_colour_less.ovl", 16, with_byte(12, 3)},
        {"l16_most_colours.ovl", 16, with_byte(15, 255)},
        {"l16_number_behind.ovl", 16, with_byte(26, 1)}};
}

Bytes plain() {
    ImageSet set = post();
    set.has_normals = set.has_splats = false, set.to_sun = {0, 0.6, 0.8}, set.levels.pop_back();
    Ldi ldi = images_of_post()[0], none;
    ldi.normals.clear(), ldi.splats.clear();
    none.side_px = 2, none.first.resize(5);
    set.context_count = 2;
    return Pieces::of(set, {ldi, none}).file();
}

}  // namespace

std::vector<Fixture> whole_files() {
    return {{"post.ovl", 0, Pieces::of(post(), images_of_post()).file()},
            {"plain.ovl", 0, plain()},
            {"grouped.ovl", 0, Pieces::of(grouped_post(), images_of_post()).file()}};
}

std::vector<Fixture> corrupt_files() {
    std::vector<Fixture> all;
    for (const auto& some : {broken_heads(), broken_levels(), broken_images(), broken_groups()})
        all.insert(all.end(), some.begin(), some.end());
    return all;
}

}  // namespace overlook::wang_ldi::image_fixtures
