// A mesh taken apart for its chain: what moves as one, and of that what is solid and what is cards of foliage.
#pragma once

#include <vector>

#include "tools/bake/discrete/shape.h"
#include "tools/bake/mesh.h"

namespace overlook::discrete {

// Which components count as cards: wholly of surfaces that are alpha-masked or seen from both sides, of few triangles, and small
// beside the whole.
struct CardOptions {
    uint32_t most_triangles = 64;
    double most_share_of_size = 0.25;  // a card's diagonal, of the whole's
    uint64_t least_count = 16;         // fewer are no foliage: they are solid
};

// The faces whose mark is not 0, with all that belongs to them; positions that were one point stay linked.
mesh::Mesh part_of(const mesh::Mesh& mesh, const std::vector<uint8_t>& takes);

// [F] 1 of faces of cards.
std::vector<uint8_t> find_cards(const mesh::Mesh& mesh, const CardOptions& options);

}  // namespace overlook::discrete
