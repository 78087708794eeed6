// Cards' pictures side by side in one.
#pragma once

#include <span>
#include <vector>

#include "tools/bake/discrete/card.h"
#include "tools/bake/discrete/drawn_texels.h"
#include "tools/bake/images.h"

namespace overlook::discrete {

struct PackedPicture {
    PictureRgba8 picture;  // opacity 0 or 255
    Mask mask;
    struct Place {
        uint32_t left = 0, top = 0;  // of a card's first texel
    };
    std::vector<Place> places;  // [cards]
    glm::dvec2 white{0};        // uv of a place that is white and opaque
};
// Cards in rows, the highest first, some texels apart: what lies between takes the colour of the card beside it. Fails with
// Exit::impossible if the picture would be more than 8,192 texels a side.
Result<PackedPicture> pack(std::span<const Card> cards);

}  // namespace overlook::discrete
