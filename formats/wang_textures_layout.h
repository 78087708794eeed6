// Where each field of WLDT stands: what writer and reader share. Documented in formats/spec/wang_textures.md.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "formats/wang_ldi_layout.h"
#include "formats/wang_textures.h"

namespace overlook::wang_ldi {

constexpr container::Tag kTexturesTag = container::tag("WLDT");

// Offsets within WLDT, in bytes.
namespace textures_at {
constexpr size_t tiles = 0, directions = 4, contexts = 8, side_px = 12, flags = 16, reserved = 20, tile_m = 24, low_m = 32,
                 high_m = 40, nearest_m = 48, farthest_m = 56, eye_low_m = 64, eye_high_m = 72, bytes = 80;
// Of each texture, after the head: its entry, then a row of each number of its texels.
constexpr size_t unseen_share = 0, standard_error = 4, entry_bytes = 8;
}  // namespace textures_at

// Of the whole section; counts must keep rule 3.
uint64_t texture_bytes_of(const TextureSet& set);

// Of one texture, its entry first; and back, from exactly so many bytes.
std::vector<std::byte> bytes_of_texture(const DirectionalTexture& texture);
DirectionalTexture texture_of_bytes(std::span<const std::byte> bytes, uint32_t side_px, bool has_normals);
uint64_t bytes_of_one_texture(uint32_t side_px, bool has_normals);

std::vector<std::byte> bytes_of_textures(const TextureSet& set);
// `bytes` may be hostile; no more memory is taken than they can fill.
ImageFault textures_of_bytes(std::span<const std::byte> bytes, const ImageSet& images, TextureSet& set);

// The rules that hold of any set, whether read or to be written. Each looks at what the ones before it left right.
ImageFault fault_of_texture_counts(const TextureSet& set);                     // X3
ImageFault fault_of_texture_places(const TextureSet& set);                     // X5
ImageFault fault_of_agreement(const TextureSet& set, const ImageSet& images);  // X6
ImageFault fault_of_texture(const TextureSet& set, uint64_t index);            // X7, X8

}  // namespace overlook::wang_ldi
