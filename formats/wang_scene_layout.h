// Where each field of WSCN and WSCP stands: what writer and reader share. Documented in formats/spec/wang_scene.md.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "formats/wang_ldi_layout.h"
#include "formats/wang_scene.h"

namespace overlook::wang_ldi {

constexpr container::Tag kSceneTag = container::tag("WSCN");
constexpr container::Tag kScenePicturesTag = container::tag("WSCP");

// Offsets, in bytes. WSCN: a head, a byte for each tile, the image. WSCP: a head, the pictures.
namespace scene_at {
constexpr size_t columns = 0, rows = 4, bytes = 8;
constexpr size_t pictures = 0, reserved = 4, pictures_bytes = 8;
}  // namespace scene_at
// Of an image or picture, before its rows: counts of its pixels' samples, depths, red, green, blue, both parts of normals.
namespace picture_at {
constexpr size_t position_m = 0, heading_deg = 24, pitch_deg = 32, fov_y_deg = 40, near_m = 48, far_m = 56, cell_m = 64,
                 width_px = 72, height_px = 76, samples = 80, flags = 84, unseen_share = 88, reserved = 92, bytes = 96;
}
constexpr uint32_t kPictureHasNormals = 1, kPictureIsUnlit = 2;

std::vector<std::byte> bytes_of_scene(const Scene& scene);
std::vector<std::byte> bytes_of_scene_pictures(const Scene& scene);
// `bytes` may be hostile; no more memory is taken than they can fill. Pictures: of a scene whose image is read.
ImageFault scene_of_bytes(std::span<const std::byte> bytes, uint32_t tile_count, Scene& scene);
ImageFault scene_pictures_of_bytes(std::span<const std::byte> bytes, Scene& scene);

// The rules that hold of any scene, whether read or to be written. Each looks at what the ones before it left right.
ImageFault fault_of_scene_tiles(const Scene& scene, uint32_t tile_count);  // V3
ImageFault fault_of_view(const PerspectiveLdi& image);                     // V5
ImageFault fault_of_samples(const PerspectiveLdi& image);                  // V7, V8; laid out as it says

}  // namespace overlook::wang_ldi
