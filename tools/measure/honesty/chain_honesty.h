// G, honesty: what chains of levels promise of a frame, against what they do.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "formats/discrete.h"
#include "runtime/discrete/director.h"
#include "tools/measure/numbers/honesty.h"

namespace overlook::measure {

// A level of a thing promises that no point of it is displaced by more than its error is on the screen. That is held against the
// greatest displacement there, both ways: of level 0's vertices to the nearest point of the level, and of the level's triangles'
// middles to the nearest point of level 0. (The nearest point is at most as far away as the bound allows any to be, so an honest
// bound holds for it.) Of billboards the first way alone: what of a card is drawn, its picture says. Parts that move are measured
// at rest. Looked at are so many places of a level, evenly, and of those the farthest displaced are projected.
class ChainHonesty {
  public:
    static constexpr size_t kPlaces = 4096, kProjected = 64;  // each way

    explicit ChainHonesty(const discrete::Chain& chain);

    // Appends one promise for each level of each instance that the director's frame draws and that is in the picture.
    void append_to(Promises& promises, const discrete::Director& director, const view::Camera& camera) const;

  private:
    // Of the chain's own world.
    struct Displaced {
        glm::dvec3 from_m{0}, to_m{0};
    };
    std::vector<std::vector<Displaced>> of_level_;  // those of level 0 are none
};

}  // namespace overlook::measure
