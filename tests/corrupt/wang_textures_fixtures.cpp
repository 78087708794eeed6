#include "tests/corrupt/wang_textures_fixtures.h"

#include <functional>
#include <limits>

#include "formats/container_rules.h"
#include "tests/corrupt/terrain_parts.h"

namespace overlook::wang_ldi::texture_fixtures {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();

// Images as a file, and these bytes as their textures.
Bytes file_of(const Bytes& textures, const Bytes& images, uint32_t codec = 1) {
    auto file = container::Reader::open_bytes(images, "images");
    std::vector<container::fixtures::RawSection> sections;
    for (std::string_view tag : {"WLDS", "WLDI"}) {
        const container::Section& section = *file->find(tag == "WLDS" ? kImagesTag : kDirectoryTag);
        auto stored = file->stored(section);
        sections.push_back({tag, section.flags, uint32_t(section.codec), Bytes(stored.begin(), stored.end()), section.raw_bytes});
    }
    sections.push_back({"WLDT", 0, codec, codec == 0 ? textures : terrain::fixtures::frame_of(textures), textures.size()});
    Bytes made = container::fixtures::file_of(sections);
    container::fixtures::seal(made);
    return made;
}
Bytes images_file(const ImageSet& images) {
    return image_fixtures::Pieces::of(images, image_fixtures::images_of_post()).file();
}
Bytes file_of(const Bytes& textures) {
    return file_of(textures, images_file(image_fixtures::post()));
}
Bytes with(const std::function<void(Bytes&)>& change) {
    Bytes bytes = bytes_of_textures(post());
    change(bytes);
    return file_of(bytes);
}
Bytes with_u32(size_t at, uint32_t value) {
    return with([&](Bytes& bytes) { store_le<uint32_t>(bytes, at, value); });
}
Bytes with_f64(size_t at, double value) {
    return with([&](Bytes& bytes) { store_f64(bytes, at, value); });
}
Bytes with_f32(size_t at, float value) {
    return with([&](Bytes& bytes) { store_f32(bytes, at, value); });
}
Bytes resized(int by) {
    return with([&](Bytes& bytes) { bytes.resize(size_t(int(bytes.size()) + by)); });
}
Bytes among(const std::function<void(ImageSet&)>& change) {
    ImageSet images = image_fixtures::post();
    change(images);
    return file_of(bytes_of_textures(post()), images_file(images));
}

std::vector<Fixture> broken_heads() {
    return {{"x01_no_textures.ovl", 1, image_fixtures::whole_files()[0].bytes},
            {"x01_not_compressed.ovl", 1, file_of(bytes_of_textures(post()), images_file(image_fixtures::post()), 0)},
            {"x02_empty.ovl", 2, with([](Bytes& bytes) { bytes.clear(); })},
            {"x02_byte_less.ovl", 2, resized(-1)},
            {"x02_byte_more.ovl", 2, resized(1)},
            {"x02_more_directions.ovl", 2, with_u32(4, 64)},
            {"x03_no_tile.ovl", 3, with_u32(0, 0)},
            {"x03_most_tiles.ovl", 3, with_u32(0, 65537)},
            {"x03_no_direction.ovl", 3, with_u32(4, 0)},
            {"x03_most_directions.ovl", 3, with_u32(4, 65)},
            {"x03_most_contexts.ovl", 3, with_u32(8, 3)},
            {"x03_no_texel.ovl", 3, with_u32(12, 0)},
            {"x03_no_power_of_two.ovl", 3, with_u32(12, 3)},
            {"x03_most_texels.ovl", 3, with_u32(12, 512)},
            {"x03_most_bytes.ovl", 3,
             with([](Bytes& bytes) { store_le<uint32_t>(bytes, 0, 65536), store_le<uint32_t>(bytes, 12, 64); })},
            {"x04_flags.ovl", 4, with_u32(16, 3)},
            {"x04_reserved.ovl", 4, with_u32(20, 1)},
            {"x05_no_tile.ovl", 5, with_f64(24, 0)},
            {"x05_nan_low.ovl", 5, with_f64(32, kNan)},
            {"x05_flat.ovl", 5, with_f64(40, 0)},
            {"x05_negative_nearest.ovl", 5, with_f64(48, -1)},
            {"x05_infinite_farthest.ovl", 5, with_f64(56, kInfinity)},
            {"x05_nan_eye.ovl", 5, with_f64(64, kNan)},
            {"x05_eyes_turned.ovl", 5, with_f64(72, 1)}};
}

std::vector<Fixture> broken_textures() {
    // Of the texture: 8 bytes, rows of 5 colours (4 numbers), of heights (2) and of normals (3).
    return {{"x06_other_size.ovl", 6, with_f64(24, 2.5)},
            {"x06_other_heights.ovl", 6, with_f64(40, 1.25)},
            {"x06_other_normals.ovl", 6, with([](Bytes& bytes) { store_le<uint32_t>(bytes, 16, 0), bytes.resize(80 + 8 + 30); })},
            {"x06_other_low.ovl", 6, among([](ImageSet& images) { images.low_m = -0.5; })},
            {"x07_unseen.ovl", 7, with_f32(80, 1.5f)},
            {"x07_nan_unseen.ovl", 7, with_f32(80, float(kNan))},
            {"x07_negative_error.ovl", 7, with_f32(84, -1)},
            {"x07_infinite_error.ovl", 7, with_f32(84, float(kInfinity))},
            {"x08_normal.ovl", 8, with([](Bytes& bytes) { bytes.back() = std::byte(0x80); })}};
}

// Without normals.
Bytes plain() {
    ImageSet images = image_fixtures::post();
    images.has_normals = images.has_splats = false;
    TextureSet set = post();
    set.has_normals = false, set.textures[0].normals.clear();
    std::vector<Ldi> ldis = image_fixtures::images_of_post();
    for (Ldi& ldi : ldis) ldi.normals.clear(), ldi.splats.clear();
    return file_of(bytes_of_textures(set), image_fixtures::Pieces::of(images, ldis).file());
}

}  // namespace

TextureSet post() {
    ImageSet images = image_fixtures::post();
    TextureSet set;
    set.side_px = 2, set.tile_m = images.tile_m, set.low_m = images.low_m, set.high_m = images.high_m;
    set.nearest_m = 40, set.farthest_m = 160, set.eye_low_m = 1.5, set.eye_high_m = 1.9;
    set.tile_count = set.direction_count = set.context_count = 1, set.has_normals = true;
    DirectionalTexture texture;
    texture.colours = {{40, 90, 30, 255}, {120, 140, 26, 0}, {120, 140, 26, 0}, {200, 180, 20, 64}, {120, 140, 26, 96}};
    texture.heights = {{100, 60}, {70, 70}, {70, 70}, {40, 1}, {70, 70}};
    texture.normals = {{0, -127, 0}, {10, -60, 20}, {10, -60, 20}, {20, 0, 90}, {10, -60, 20}};
    texture.unseen_share = 0.03125f, texture.standard_error = 0.0078125f;
    set.textures = {texture};
    return set;
}

std::vector<Fixture> whole_files() {
    return {{"post.ovl", 0, file_of(bytes_of_textures(post()))}, {"plain.ovl", 0, plain()}};
}

std::vector<Fixture> corrupt_files() {
    std::vector<Fixture> all = broken_heads();
    for (Fixture& fixture : broken_textures()) all.push_back(std::move(fixture));
    return all;
}

}  // namespace overlook::wang_ldi::texture_fixtures
