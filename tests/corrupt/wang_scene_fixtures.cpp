#include "tests/corrupt/wang_scene_fixtures.h"

#include <functional>
#include <limits>

#include "formats/container_rules.h"
#include "tests/corrupt/terrain_parts.h"

namespace overlook::wang_ldi::scene_fixtures {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();
constexpr size_t kImage = scene_at::bytes + 2, kRows = kImage + picture_at::bytes;  // in WSCN: two tiles stand before the image

Bytes file_of(const Bytes& scene, const Bytes& pictures, uint32_t codec = 1, bool has_pictures = true,
              bool has_image = true) {
    auto section = [&](std::string_view tag, const Bytes& bytes) {
        return container::fixtures::RawSection{tag, 0, codec, codec == 0 ? bytes : terrain::fixtures::frame_of(bytes),
                                               bytes.size()};
    };
    std::vector<container::fixtures::RawSection> sections;
    if (has_image) sections.push_back(section("WSCN", scene));
    if (has_pictures) sections.push_back(section("WSCP", pictures));
    Bytes made = container::fixtures::file_of(sections);
    container::fixtures::seal(made);
    return made;
}
Bytes with(const std::function<void(Bytes& scene, Bytes& pictures)>& change) {
    Bytes scene = bytes_of_scene(two_tiles()), pictures = bytes_of_scene_pictures(two_tiles());
    change(scene, pictures);
    return file_of(scene, pictures);
}
Bytes with_u32(size_t at, uint32_t value) {
    return with([&](Bytes& scene, Bytes&) { store_le<uint32_t>(scene, at, value); });
}
Bytes with_f64(size_t at, double value) {
    return with([&](Bytes& scene, Bytes&) { store_f64(scene, kImage + at, value); });
}
Bytes with_f32(size_t at, float value) {
    return with([&](Bytes& scene, Bytes&) { store_f32(scene, kImage + at, value); });
}
Bytes with_byte(size_t at, uint8_t value) {
    return with([&](Bytes& scene, Bytes&) { scene[at] = std::byte(value); });
}
Bytes with_pictures_u32(size_t at, uint32_t value) {
    return with([&](Bytes&, Bytes& pictures) { store_le<uint32_t>(pictures, at, value); });
}

std::vector<Fixture> broken_sizes() {
    return {{"v01_no_pictures.ovl", 1, file_of(bytes_of_scene(two_tiles()), {}, 1, false)},
            {"v01_no_image.ovl", 1, file_of({}, bytes_of_scene_pictures(two_tiles()), 1, true, false)},
            {"v01_not_compressed.ovl", 1, file_of(bytes_of_scene(two_tiles()), bytes_of_scene_pictures(two_tiles()), 0)},
            {"v02_empty.ovl", 2, with([](Bytes& scene, Bytes&) { scene.clear(); })},
            {"v02_no_head.ovl", 2, with([](Bytes& scene, Bytes&) { scene.resize(kImage + 40); })},
            {"v02_no_tiles.ovl", 2, with([](Bytes& scene, Bytes&) { scene.resize(scene_at::bytes + 1); })},
            {"v02_byte_less.ovl", 2, with([](Bytes& scene, Bytes&) { scene.pop_back(); })},
            {"v02_byte_more.ovl", 2, with([](Bytes& scene, Bytes&) { scene.push_back({}); })},
            {"v02_wider.ovl", 2, with_u32(kImage + picture_at::width_px, 4096)},
            {"v02_no_pictures_head.ovl", 2, with([](Bytes&, Bytes& pictures) { pictures.resize(7); })},
            {"v02_picture_more.ovl", 2, with_pictures_u32(scene_at::pictures, 2)},
            {"v02_picture_less.ovl", 2, with_pictures_u32(scene_at::pictures, 0)},
            {"v02_most_pictures.ovl", 2, with_pictures_u32(scene_at::pictures, 4097)},
            {"v02_picture_cut.ovl", 2, with([](Bytes&, Bytes& pictures) { pictures.pop_back(); })},
            {"v03_no_column.ovl", 3, with_u32(scene_at::columns, 0)},
            {"v03_most_columns.ovl", 3, with_u32(scene_at::columns, 1025)},
            {"v03_no_row.ovl", 3, with_u32(scene_at::rows, 0)},
            {"v03_most_rows.ovl", 3, with_u32(scene_at::rows, 1025)},
            {"v03_no_such_tile.ovl", 3, with_byte(scene_at::bytes + 1, kTileCount)}};
}

std::vector<Fixture> broken_images() {
    return {{"v04_flags.ovl", 4, with_u32(kImage + picture_at::flags, 4)},
            {"v04_reserved.ovl", 4, with_u32(kImage + picture_at::reserved, 1)},
            {"v04_pictures_reserved.ovl", 4, with_pictures_u32(scene_at::reserved, 1)},
            {"v05_nan_place.ovl", 5, with_f64(picture_at::position_m, kNan)},
            {"v05_heading.ovl", 5, with_f64(picture_at::heading_deg, 400)},
            {"v05_pitch.ovl", 5, with_f64(picture_at::pitch_deg, -91)},
            {"v05_no_view.ovl", 5, with_f64(picture_at::fov_y_deg, 0)},
            {"v05_no_pixel.ovl", 5, with_u32(kImage + picture_at::height_px, 0)},
            {"v05_most_pixels.ovl", 5, with_u32(kImage + picture_at::width_px, 4097)},
            {"v05_no_near.ovl", 5, with_f64(picture_at::near_m, 0)},
            {"v05_far_before_near.ovl", 5, with_f64(picture_at::far_m, 0.5)},
            {"v05_infinite_far.ovl", 5, with_f64(picture_at::far_m, kInfinity)},
            {"v05_negative_cell.ovl", 5, with_f64(picture_at::cell_m, -1)},
            {"v05_unseen.ovl", 5, with_f32(picture_at::unseen_share, 1.5f)},
            {"v05_nan_unseen.ovl", 5, with_f32(picture_at::unseen_share, float(kNan))},
            {"v06_more_in_pixels.ovl", 6, with_byte(kRows, 9)},
            {"v06_less_in_pixels.ovl", 6, with_byte(kRows, 1)},
            {"v06_most_samples.ovl", 6, with_u32(kImage + picture_at::samples, (1u << 25) + 1)},
            // Of the image's 6 pixels and 5 samples: 12 bytes of counts, then the low bytes of depths.
            {"v07_twice.ovl", 7,
             with([](Bytes& scene, Bytes&) { scene[kRows + 13] = scene[kRows + 12], scene[kRows + 18] = scene[kRows + 17]; })},
            {"v08_normal.ovl", 8, with([](Bytes& scene, Bytes&) { scene.back() = std::byte(0x80); })}};
}

// Of one pixel, nothing in it, without normals and pictures.
Bytes bare() {
    Scene scene;
    scene.columns = scene.rows = 1, scene.tiles = {0};
    scene.image.view.width_px = scene.image.view.height_px = 1, scene.image.first = {0, 0};
    return file_of(bytes_of_scene(scene), bytes_of_scene_pictures(scene));
}

}  // namespace

Scene two_tiles() {
    Scene scene;
    scene.columns = 2, scene.rows = 1, scene.tiles = {2, 0};
    PerspectiveLdi& image = scene.image;
    image.view = {{2, 1, 1.75}, 25, -4, 60, 3, 2, 1, 64};
    image.cell_m = 0.25, image.unseen_share = 0.0625f;
    image.first = {0, 2, 2, 3, 5, 5, 5}, image.depths = {10000, 40000, 65535, 300, 301};
    image.colours = {{40, 90, 30}, {200, 180, 20}, {90, 110, 28}, {41, 91, 31}, {42, 92, 32}};
    image.normals = {{0, -127}, {10, 20}, {0, 0}, {-90, 3}, {127, 0}};
    PerspectiveLdi picture;
    picture.view = image.view, picture.view.position_m.x = 3, picture.view.width_px = 2, picture.view.height_px = 1;
    picture.is_unlit = true, picture.first = {0, 0, 1}, picture.depths = {20000}, picture.colours = {{200, 180, 20}};
    scene.pictures = {picture};
    return scene;
}

std::vector<Fixture> whole_files() {
    return {{"two_tiles.ovl", 0, file_of(bytes_of_scene(two_tiles()), bytes_of_scene_pictures(two_tiles()))},
            {"bare.ovl", 0, bare()}};
}

std::vector<Fixture> corrupt_files() {
    std::vector<Fixture> all = broken_sizes();
    for (Fixture& fixture : broken_images()) all.push_back(std::move(fixture));
    return all;
}

}  // namespace overlook::wang_ldi::scene_fixtures
