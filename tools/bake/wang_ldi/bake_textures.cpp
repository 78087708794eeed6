#include "tools/bake/wang_ldi/bake_textures.h"

#include "formats/container_rules.h"
#include "formats/wang_textures_layout.h"

namespace overlook::wang_ldi {
namespace {

constexpr size_t kJudgementBytes = 4 * 8;

}  // namespace

Shard shard_of_texture(const TextureSampled& sampled, const TextureJudgement& judgement) {
    Shard shard;
    std::vector<std::byte>& bytes = shard.packed.bytes;
    bytes.resize(kJudgementBytes);
    store_le<uint64_t>(bytes, 0, judgement.pixels), store_f64(bytes, 8, judgement.coverage);
    store_f64(bytes, 16, judgement.drawn_coverage), store_f64(bytes, 24, judgement.mean_error);
    std::vector<std::byte> texture = bytes_of_texture(sampled.texture);
    bytes.insert(bytes.end(), texture.begin(), texture.end());
    shard.packed.checksum = container::checksum_of(bytes), shard.packed.raw_bytes = uint32_t(bytes.size());
    shard.rays = sampled.rays, shard.hits = sampled.hits, shard.eyes = sampled.eyes;
    return shard;
}

DirectionalTexture texture_of_shard(const Shard& shard, const TextureSet& set, TextureRow& row) {
    std::span<const std::byte> bytes(shard.packed.bytes);
    DirectionalTexture texture = texture_of_bytes(bytes.subspan(kJudgementBytes), set.side_px, set.has_normals);
    row.rays = shard.rays, row.hits = shard.hits, row.eyes = shard.eyes;
    row.unseen_share = double(texture.unseen_share), row.standard_error = double(texture.standard_error);
    row.judgement = {load_le<uint64_t>(bytes, 0), load_f64(bytes, 8), load_f64(bytes, 16), load_f64(bytes, 24)};
    return texture;
}

}  // namespace overlook::wang_ldi
