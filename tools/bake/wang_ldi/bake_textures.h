// Directional textures among the parts of a bake.
#pragma once

#include "tools/bake/wang_ldi/bake_images.h"

namespace overlook::wang_ldi {

// A part as images have them; its bytes are the texture's, before compression, and what was judged of it.
Shard shard_of_texture(const TextureSampled& sampled, const TextureJudgement& judgement);
// shard: made so, for a texture of `set`.
DirectionalTexture texture_of_shard(const Shard& shard, const TextureSet& set, TextureRow& row);

}  // namespace overlook::wang_ldi
