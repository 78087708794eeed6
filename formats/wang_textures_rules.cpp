#include <bit>

#include "formats/wang_textures_layout.h"

namespace overlook::wang_ldi {
namespace {

constexpr std::array<std::string_view, 8> kRules{
    "The section WLDT, compressed, is there beside the images.",
    "WLDT is 80 bytes, and of each texture 8 and those of its texels, and no more.",
    "There are 1 to 65,536 tiles, 1 to 64 directions and 1 or 2 contexts; a side has 1 to 256 texels, a power of two; all take "
    "2^28 bytes at most.",
    "The flags are known ones, reserved numbers are 0.",
    "The tile's size and heights and where the eyes are are finite and in their ranges.",
    "Tiles, directions, contexts, the tile's size and heights and whether there are normals are those of the images.",
    "A texture's unseen share is 0 to 1, its standard error 0 or more and finite.",
    "A normal's numbers are -127 to 127.",
};

bool is_between(double value, double low, double high) {
    return value >= low && value <= high;
}  // false for NaN

}  // namespace

std::string_view texture_rule_text(int rule) {
    return rule >= 1 && rule <= texture_rule_count() ? kRules[size_t(rule - 1)] : std::string_view();
}
int texture_rule_count() {
    return int(kRules.size());
}

uint32_t texture_levels(uint32_t side_px) {
    return uint32_t(std::bit_width(side_px));
}
size_t texture_level_at(uint32_t side_px, uint32_t level) {
    size_t at = 0;
    for (uint32_t l = 0; l < level; ++l) at += size_t(side_px >> l) * (side_px >> l);
    return at;
}
size_t texture_texels(uint32_t side_px) {
    return texture_level_at(side_px, texture_levels(side_px));
}

uint64_t bytes_of_one_texture(uint32_t side_px, bool has_normals) {
    return textures_at::entry_bytes + texture_texels(side_px) * (has_normals ? 9u : 6u);
}
uint64_t texture_bytes_of(const TextureSet& set) {
    return textures_at::bytes + set.texture_count() * bytes_of_one_texture(set.side_px, set.has_normals);
}

ImageFault fault_of_texture_counts(const TextureSet& set) {
    auto is_in = [](uint64_t count, uint64_t most) { return count >= 1 && count <= most; };
    bool is_fine = is_in(set.tile_count, kMostImageTiles) && is_in(set.direction_count, kMostDirections) &&
                   is_in(set.context_count, kMostContexts) && is_in(set.side_px, kMostTextureSide_px) &&
                   std::has_single_bit(set.side_px) && texture_bytes_of(set) <= kMostTextureBytes;
    if (is_fine) return {};
    return {3, fmt::format("{} tiles, {} directions, {} contexts, {} texels a side", set.tile_count, set.direction_count,
                           set.context_count, set.side_px)};
}

ImageFault fault_of_texture_places(const TextureSet& set) {
    bool is_tile = is_between(set.tile_m, 1e-3, 1e6) && is_between(set.low_m, -1e6, 1e6) && is_between(set.high_m, -1e6, 1e6) &&
                   set.low_m < set.high_m;
    if (!is_tile) return {5, fmt::format("a tile of {} m, heights from {} to {} m", set.tile_m, set.low_m, set.high_m)};
    bool is_seen = is_between(set.nearest_m, 0, 1e7) && is_between(set.farthest_m, set.nearest_m, 1e7) &&
                   is_between(set.eye_low_m, -1e6, 1e6) && is_between(set.eye_high_m, set.eye_low_m, 1e6);
    if (is_seen) return {};
    return {5,
            fmt::format("eyes {} to {} m up and {} to {} m away", set.eye_low_m, set.eye_high_m, set.nearest_m, set.farthest_m)};
}

ImageFault fault_of_agreement(const TextureSet& set, const ImageSet& images) {
    auto counts = [](const auto& of) { return std::array{of.tile_count, of.direction_count, of.context_count}; };
    auto sizes = [](const auto& of) { return std::array{of.tile_m, of.low_m, of.high_m}; };
    if (counts(set) == counts(images) && sizes(set) == sizes(images) && set.has_normals == images.has_normals) return {};
    auto text = [](const auto& of) {
        return fmt::format("{} tiles of {} m and {} to {} m high, {} directions, {} contexts, {}", of.tile_count, of.tile_m,
                           of.low_m, of.high_m, of.direction_count, of.context_count, of.has_normals ? "unlit" : "lit");
    };
    return {6, fmt::format("textures of {}; images of {}", text(set), text(images))};
}

ImageFault fault_of_texture(const TextureSet& set, uint64_t index) {
    const DirectionalTexture& texture = set.textures[size_t(index)];
    if (!is_between(double(texture.unseen_share), 0, 1) || !is_between(double(texture.standard_error), 0, 1e6))
        return {7, fmt::format("texture {} has {} of it unseen and a standard error of {}", index, texture.unseen_share,
                               texture.standard_error)};
    for (size_t t = 0; t < texture.normals.size(); ++t)
        for (int8_t number : texture.normals[t])
            if (number == -128) return {8, fmt::format("texture {} has a normal of -128 at texel {}", index, t)};
    return {};
}

}  // namespace overlook::wang_ldi
