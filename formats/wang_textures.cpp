// Directional textures as the bytes of their section, and back.
#include "formats/wang_textures.h"

#include <new>

#include "formats/wang_textures_layout.h"

namespace overlook::wang_ldi {
namespace {

tl::unexpected<Error> bug(std::string_view has) {
    return tl::unexpected(Error{Exit::our_bug, fmt::format("textures to write have {}", has)});
}
tl::unexpected<Error> broken(const container::Reader& file, const ImageFault& fault) {
    return bad_input("{}: X{}: {}", file.name(), fault.rule, fault.text);
}

// Rows of one number of each texel, one row after the other.
template <class Number, size_t count>
void put_rows(std::vector<std::byte>& bytes, const std::vector<std::array<Number, count>>& texels) {
    for (size_t n = 0; n < count; ++n)
        for (const auto& texel : texels) bytes.push_back(std::byte(texel[n]));
}
template <class Number, size_t count>
void take_rows(std::span<const std::byte>& bytes, size_t texel_count, std::vector<std::array<Number, count>>& texels) {
    texels.resize(texel_count);
    for (size_t n = 0; n < count; ++n)
        for (size_t t = 0; t < texel_count; ++t) texels[t][n] = Number(bytes[n * texel_count + t]);
    bytes = bytes.subspan(count * texel_count);
}

bool is_laid_out(const TextureSet& set) {
    size_t texels = texture_texels(set.side_px);
    if (set.textures.size() != set.texture_count()) return false;
    for (const DirectionalTexture& texture : set.textures) {
        bool fits = texture.colours.size() == texels && texture.heights.size() == texels &&
                    texture.normals.size() == (set.has_normals ? texels : 0);
        if (!fits) return false;
    }
    return true;
}

ImageFault head_of_bytes(std::span<const std::byte> bytes, TextureSet& set) {
    auto u32 = [&](size_t at) { return load_le<uint32_t>(bytes, at); };
    auto f64 = [&](size_t at) { return load_f64(bytes, at); };
    if (bytes.size() < textures_at::bytes) return {2, fmt::format("WLDT has {} bytes", bytes.size())};
    set.tile_count = u32(textures_at::tiles), set.direction_count = u32(textures_at::directions);
    set.context_count = u32(textures_at::contexts), set.side_px = u32(textures_at::side_px);
    set.has_normals = (u32(textures_at::flags) & kHasNormals) != 0;
    if (ImageFault fault = fault_of_texture_counts(set)) return fault;
    if (u32(textures_at::flags) > kHasNormals || u32(textures_at::reserved) != 0)
        return {4, fmt::format("flags {}, or a reserved number that is not 0", u32(textures_at::flags))};
    set.tile_m = f64(textures_at::tile_m), set.low_m = f64(textures_at::low_m), set.high_m = f64(textures_at::high_m);
    set.nearest_m = f64(textures_at::nearest_m), set.farthest_m = f64(textures_at::farthest_m);
    set.eye_low_m = f64(textures_at::eye_low_m), set.eye_high_m = f64(textures_at::eye_high_m);
    return fault_of_texture_places(set);
}

Result<TextureSet> read_whole(const container::Reader& file, const ImageSet& images) {
    const container::Section* section = file.find(kTexturesTag);
    if (!section || section->codec != container::Codec::zstd)
        return broken(file, {1, "has no directional textures as they are stored"});
    if (section->raw_bytes > kMostTextureBytes) return broken(file, {2, fmt::format("WLDT has {} bytes", section->raw_bytes)});
    auto bytes = file.read(*section, kMostTextureBytes);
    if (!bytes) return tl::unexpected(bytes.error());
    TextureSet set;
    if (ImageFault fault = textures_of_bytes(*bytes, images, set)) return broken(file, fault);
    return set;
}

}  // namespace

std::vector<std::byte> bytes_of_texture(const DirectionalTexture& texture) {
    std::vector<std::byte> bytes(textures_at::entry_bytes);
    store_f32(bytes, textures_at::unseen_share, texture.unseen_share);
    store_f32(bytes, textures_at::standard_error, texture.standard_error);
    put_rows(bytes, texture.colours), put_rows(bytes, texture.heights), put_rows(bytes, texture.normals);
    return bytes;
}

DirectionalTexture texture_of_bytes(std::span<const std::byte> bytes, uint32_t side_px, bool has_normals) {
    DirectionalTexture texture;
    texture.unseen_share = load_f32(bytes, textures_at::unseen_share);
    texture.standard_error = load_f32(bytes, textures_at::standard_error);
    size_t texels = texture_texels(side_px);
    bytes = bytes.subspan(textures_at::entry_bytes);
    take_rows(bytes, texels, texture.colours), take_rows(bytes, texels, texture.heights);
    if (has_normals) take_rows(bytes, texels, texture.normals);
    return texture;
}

std::vector<std::byte> bytes_of_textures(const TextureSet& set) {
    std::vector<std::byte> bytes(textures_at::bytes);
    bytes.reserve(size_t(texture_bytes_of(set)));
    auto u32 = [&](size_t at, uint32_t value) { store_le<uint32_t>(bytes, at, value); };
    u32(textures_at::tiles, set.tile_count), u32(textures_at::directions, set.direction_count);
    u32(textures_at::contexts, set.context_count), u32(textures_at::side_px, set.side_px);
    u32(textures_at::flags, set.has_normals ? kHasNormals : 0);
    store_f64(bytes, textures_at::tile_m, set.tile_m), store_f64(bytes, textures_at::low_m, set.low_m);
    store_f64(bytes, textures_at::high_m, set.high_m), store_f64(bytes, textures_at::nearest_m, set.nearest_m);
    store_f64(bytes, textures_at::farthest_m, set.farthest_m), store_f64(bytes, textures_at::eye_low_m, set.eye_low_m);
    store_f64(bytes, textures_at::eye_high_m, set.eye_high_m);
    for (const DirectionalTexture& texture : set.textures) {
        std::vector<std::byte> one = bytes_of_texture(texture);
        bytes.insert(bytes.end(), one.begin(), one.end());
    }
    return bytes;
}

ImageFault textures_of_bytes(std::span<const std::byte> bytes, const ImageSet& images, TextureSet& set) {
    if (ImageFault fault = head_of_bytes(bytes, set)) return fault;
    if (bytes.size() != texture_bytes_of(set))
        return {2, fmt::format("WLDT has {} bytes, {} textures of {} texels a side need {}", bytes.size(), set.texture_count(),
                               set.side_px, texture_bytes_of(set))};
    if (ImageFault fault = fault_of_agreement(set, images)) return fault;
    set.direction_fade = images.direction_fade;
    size_t of_one = size_t(bytes_of_one_texture(set.side_px, set.has_normals));
    set.textures.reserve(size_t(set.texture_count()));
    for (uint64_t i = 0; i < set.texture_count(); ++i) {
        auto one = bytes.subspan(textures_at::bytes + size_t(i) * of_one, of_one);
        set.textures.push_back(texture_of_bytes(one, set.side_px, set.has_normals));
        if (ImageFault fault = fault_of_texture(set, i)) return fault;
    }
    return {};
}

Result<void> write_textures(container::Writer& writer, const ImageSet& images, const TextureSet& set) {
    for (auto rule : {fault_of_texture_counts, fault_of_texture_places})
        if (ImageFault fault = rule(set)) return bug(fault.text);
    if (ImageFault fault = fault_of_agreement(set, images)) return bug(fault.text);
    if (!is_laid_out(set)) return bug("not one number for each texel");
    for (uint64_t i = 0; i < set.texture_count(); ++i)
        if (ImageFault fault = fault_of_texture(set, i)) return bug(fault.text);
    return writer.add(kTexturesTag, 0, container::Codec::zstd, bytes_of_textures(set));
}

bool has_textures(const container::Reader& file) {
    return file.find(kTexturesTag) != nullptr;
}

Result<TextureSet> read_textures(const container::Reader& file, const ImageSet& images) {
    try {
        return read_whole(file, images);
    } catch (const std::bad_alloc&) {
        return impossible("{}: there is not enough memory for its directional textures", file.name());
    }
}

}  // namespace overlook::wang_ldi
