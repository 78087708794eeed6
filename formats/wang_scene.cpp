// A scene as the bytes of its sections, and back.
#include "formats/wang_scene.h"

#include <algorithm>
#include <new>

#include "formats/wang_scene_layout.h"

namespace overlook::wang_ldi {
namespace {

tl::unexpected<Error> bug(std::string_view has) {
    return tl::unexpected(Error{Exit::our_bug, fmt::format("a scene to write has {}", has)});
}
tl::unexpected<Error> broken(const container::Reader& file, const ImageFault& fault) {
    return bad_input("{}: V{}: {}", file.name(), fault.rule, fault.text);
}

uint64_t rows_bytes(uint64_t pixels, uint64_t samples, bool has_normals) {
    return 2 * pixels + samples * (has_normals ? 7u : 5u);
}

void put_picture(std::vector<std::byte>& bytes, const PerspectiveLdi& image) {
    const PerspectiveView& view = image.view;
    std::vector<std::byte> head(picture_at::bytes);
    for (int axis = 0; axis < 3; ++axis) store_f64(head, picture_at::position_m + 8 * size_t(axis), view.position_m[axis]);
    store_f64(head, picture_at::heading_deg, view.heading_deg), store_f64(head, picture_at::pitch_deg, view.pitch_deg);
    store_f64(head, picture_at::fov_y_deg, view.fov_y_deg), store_f64(head, picture_at::near_m, view.near_m);
    store_f64(head, picture_at::far_m, view.far_m), store_f64(head, picture_at::cell_m, image.cell_m);
    store_le<uint32_t>(head, picture_at::width_px, view.width_px),
        store_le<uint32_t>(head, picture_at::height_px, view.height_px);
    store_le<uint32_t>(head, picture_at::samples, image.sample_count());
    store_le<uint32_t>(head, picture_at::flags,
                       (image.normals.empty() ? 0 : kPictureHasNormals) | (image.is_unlit ? kPictureIsUnlit : 0));
    store_f32(head, picture_at::unseen_share, image.unseen_share);
    bytes.insert(bytes.end(), head.begin(), head.end());
    std::vector<uint16_t> counts(image.first.size() - 1);
    for (size_t p = 0; p < counts.size(); ++p) counts[p] = uint16_t(image.first[p + 1] - image.first[p]);
    put_planes(bytes, counts), put_planes(bytes, image.depths);
    for (size_t c = 0; c < 3; ++c)
        for (const auto& colour : image.colours) bytes.push_back(std::byte(colour[c]));
    for (size_t axis = 0; axis < 2; ++axis)
        for (const auto& normal : image.normals) bytes.push_back(std::byte(normal[axis]));
}

// What rows of numbers cannot even be laid out, or a rule that does not hold.
std::string fault_to_write(const PerspectiveLdi& image) {
    if (ImageFault fault = fault_of_view(image)) return fault.text;
    size_t samples = image.depths.size();
    bool fits = image.first.size() == size_t(image.view.width_px) * image.view.height_px + 1 && image.first.front() == 0 &&
                image.first.back() == samples && samples <= kMostPerspectiveSamples && image.colours.size() == samples &&
                (image.normals.empty() || image.normals.size() == samples);
    if (!fits) return "not one number for each sample";
    for (size_t p = 0; p + 1 < image.first.size(); ++p)
        if (image.first[p + 1] < image.first[p] || image.first[p + 1] - image.first[p] > 65535)
            return "a pixel of too many samples";
    return fault_of_samples(image).text;
}

ImageFault rows_of_bytes(std::span<const std::byte> bytes, size_t samples, bool has_normals, PerspectiveLdi& image) {
    auto take = [&](size_t count) {
        auto taken = bytes.first(count);
        bytes = bytes.subspan(count);
        return taken;
    };
    size_t pixels = size_t(image.view.width_px) * image.view.height_px;
    std::span<const std::byte> counts = take(2 * pixels), depths = take(2 * samples), colours = take(3 * samples);
    image.first.assign(pixels + 1, 0);
    uint64_t sum = 0;
    for (size_t p = 0; p < pixels && sum <= samples; ++p)
        sum += plane_value(counts, pixels, p), image.first[p + 1] = uint32_t(sum);
    if (sum != samples) return {6, fmt::format("its pixels have {} samples or more, {} are stated", sum, samples)};
    image.depths.resize(samples), image.colours.resize(samples);
    for (size_t s = 0; s < samples; ++s) image.depths[s] = plane_value(depths, samples, s);
    for (size_t c = 0; c < 3; ++c)
        for (size_t s = 0; s < samples; ++s) image.colours[s][c] = uint8_t(colours[c * samples + s]);
    image.normals.resize(has_normals ? samples : 0);
    for (size_t axis = 0; axis < 2 && has_normals; ++axis)
        for (size_t s = 0; s < samples; ++s) image.normals[s][axis] = int8_t(bytes[axis * samples + s]);
    return fault_of_samples(image);
}

// Takes an image from the front of the bytes.
ImageFault take_picture(std::span<const std::byte>& bytes, PerspectiveLdi& image) {
    if (bytes.size() < picture_at::bytes) return {2, fmt::format("{} bytes are left", bytes.size())};
    std::span<const std::byte> head = bytes.first(picture_at::bytes);
    auto f64 = [&](size_t at) { return load_f64(head, at); };
    auto u32 = [&](size_t at) { return load_le<uint32_t>(head, at); };
    uint32_t flags = u32(picture_at::flags), samples = u32(picture_at::samples);
    if (flags > (kPictureHasNormals | kPictureIsUnlit) || u32(picture_at::reserved) != 0)
        return {4, fmt::format("flags {}, or a reserved number that is not 0", flags)};
    image.view = {{f64(picture_at::position_m), f64(picture_at::position_m + 8), f64(picture_at::position_m + 16)},
                  f64(picture_at::heading_deg),
                  f64(picture_at::pitch_deg),
                  f64(picture_at::fov_y_deg),
                  u32(picture_at::width_px),
                  u32(picture_at::height_px),
                  f64(picture_at::near_m),
                  f64(picture_at::far_m)};
    image.cell_m = f64(picture_at::cell_m), image.unseen_share = load_f32(head, picture_at::unseen_share);
    image.is_unlit = (flags & kPictureIsUnlit) != 0;
    if (ImageFault fault = fault_of_view(image)) return fault;
    if (samples > kMostPerspectiveSamples) return {6, fmt::format("{} samples", samples)};
    bool has_normals = (flags & kPictureHasNormals) != 0;
    uint64_t rows = rows_bytes(uint64_t(image.view.width_px) * image.view.height_px, samples, has_normals);
    bytes = bytes.subspan(picture_at::bytes);
    if (bytes.size() < rows) return {2, fmt::format("{} bytes are left, its rows need {}", bytes.size(), rows)};
    ImageFault fault = rows_of_bytes(bytes.first(size_t(rows)), samples, has_normals, image);
    bytes = bytes.subspan(size_t(rows));
    return fault;
}

Result<Scene> read_whole(const container::Reader& file, uint32_t tile_count) {
    Scene scene;
    for (container::Tag tag : {kSceneTag, kScenePicturesTag}) {
        const container::Section* section = file.find(tag);
        if (!section || section->codec != container::Codec::zstd)
            return broken(file, {1, "has no perspective image of a scene as it is stored"});
        if (section->raw_bytes > kMostSceneBytes)
            return broken(file, {2, fmt::format("{} has {} bytes", container::tag_text(tag), section->raw_bytes)});
        auto bytes = file.read(*section, kMostSceneBytes);
        if (!bytes) return tl::unexpected(bytes.error());
        ImageFault fault = tag == kSceneTag ? scene_of_bytes(*bytes, tile_count, scene) : scene_pictures_of_bytes(*bytes, scene);
        if (fault) return broken(file, fault);
    }
    return scene;
}

}  // namespace

std::vector<std::byte> bytes_of_scene(const Scene& scene) {
    std::vector<std::byte> bytes(scene_at::bytes);
    store_le<uint32_t>(bytes, scene_at::columns, scene.columns), store_le<uint32_t>(bytes, scene_at::rows, scene.rows);
    for (uint8_t tile : scene.tiles) bytes.push_back(std::byte(tile));
    put_picture(bytes, scene.image);
    return bytes;
}

std::vector<std::byte> bytes_of_scene_pictures(const Scene& scene) {
    std::vector<std::byte> bytes(scene_at::pictures_bytes);
    store_le<uint32_t>(bytes, scene_at::pictures, uint32_t(scene.pictures.size()));
    for (const PerspectiveLdi& picture : scene.pictures) put_picture(bytes, picture);
    return bytes;
}

ImageFault scene_of_bytes(std::span<const std::byte> bytes, uint32_t tile_count, Scene& scene) {
    if (bytes.size() < scene_at::bytes) return {2, fmt::format("WSCN has {} bytes", bytes.size())};
    scene.columns = load_le<uint32_t>(bytes, scene_at::columns), scene.rows = load_le<uint32_t>(bytes, scene_at::rows);
    if (ImageFault fault = fault_of_scene_tiles(scene, tile_count)) return fault;
    bytes = bytes.subspan(scene_at::bytes);
    size_t tiles = size_t(scene.columns) * scene.rows;
    if (bytes.size() < tiles) return {2, fmt::format("WSCN has {} bytes for {} tiles", bytes.size(), tiles)};
    scene.tiles.clear();
    for (std::byte tile : bytes.first(tiles)) scene.tiles.push_back(uint8_t(tile));
    if (ImageFault fault = fault_of_scene_tiles(scene, tile_count)) return fault;
    bytes = bytes.subspan(tiles);
    if (ImageFault fault = take_picture(bytes, scene.image)) return {fault.rule, "the image: " + fault.text};
    return bytes.empty() ? ImageFault() : ImageFault{2, fmt::format("WSCN has {} bytes too many", bytes.size())};
}

ImageFault scene_pictures_of_bytes(std::span<const std::byte> bytes, Scene& scene) {
    if (bytes.size() < scene_at::pictures_bytes) return {2, fmt::format("WSCP has {} bytes", bytes.size())};
    uint32_t count = load_le<uint32_t>(bytes, scene_at::pictures);
    if (count > kMostScenePictures) return {2, fmt::format("{} pictures", count)};
    if (load_le<uint32_t>(bytes, scene_at::reserved) != 0) return {4, "WSCP's reserved number is not 0"};
    bytes = bytes.subspan(scene_at::pictures_bytes);
    scene.pictures.clear();
    for (uint32_t i = 0; i < count; ++i)
        if (ImageFault fault = take_picture(bytes, scene.pictures.emplace_back()))
            return {fault.rule, fmt::format("picture {}: {}", i, fault.text)};
    return bytes.empty() ? ImageFault() : ImageFault{2, fmt::format("WSCP has {} bytes too many", bytes.size())};
}

Result<void> write_scene(container::Writer& writer, const Scene& scene, uint32_t tile_count) {
    if (ImageFault fault = fault_of_scene_tiles(scene, tile_count)) return bug(fault.text);
    if (scene.tiles.size() != size_t(scene.columns) * scene.rows) return bug("not a tile for each place");
    if (scene.pictures.size() > kMostScenePictures) return bug("too many pictures");
    if (std::string fault = fault_to_write(scene.image); !fault.empty()) return bug(fault);
    for (const PerspectiveLdi& picture : scene.pictures)
        if (std::string fault = fault_to_write(picture); !fault.empty()) return bug(fault);
    std::vector<std::byte> image = bytes_of_scene(scene), pictures = bytes_of_scene_pictures(scene);
    if (std::max(image.size(), pictures.size()) > kMostSceneBytes)
        return impossible("a scene's image takes {} bytes and its pictures {}, more than 2^28; ask for fewer or smaller ones",
                          image.size(), pictures.size());
    if (auto added = writer.add(kSceneTag, 0, container::Codec::zstd, image); !added) return added;
    return writer.add(kScenePicturesTag, 0, container::Codec::zstd, pictures);
}

bool has_scene(const container::Reader& file) {
    return file.find(kSceneTag) != nullptr || file.find(kScenePicturesTag) != nullptr;
}

Result<Scene> read_scene(const container::Reader& file, uint32_t tile_count) {
    try {
        return read_whole(file, tile_count);
    } catch (const std::bad_alloc&) {
        return impossible("{}: there is not enough memory for its scene", file.name());
    }
}

uint64_t stored_bytes_of_scene_image(const container::Reader& file) {
    const container::Section* section = file.find(kSceneTag);
    return section ? section->stored_bytes : 0;
}

}  // namespace overlook::wang_ldi
