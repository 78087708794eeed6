// How opaque the boxes of a directional texture have to be.
#pragma once

#include <span>
#include <vector>

#include "formats/wang_textures.h"

namespace overlook::wang_ldi {

// A sight line that nothing stops before the tile.
struct Line {
    glm::vec3 from_m{0}, along{0};
};

// Sets the opacities of all texels so that, of such lines, boxes drawn back to front show each texel with its `shown` share
// ([texels], how many lines end over its square). Found by repetition, from the front of the tile to its back: what a box needs
// depends on what those before it let through. pictures: only of so many, from the finest. Same arguments, same opacities.
void choose_opacity(const TextureSet& set, std::span<const Line> lines, std::span<const double> shown,
                    DirectionalTexture& texture, uint32_t pictures = 32);

}  // namespace overlook::wang_ldi
