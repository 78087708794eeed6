// A tree: trunk, boughs, branches and twigs as tubes, and alpha-masked cards of leaves.
#pragma once

#include "formats/result.h"
#include "tools/bake/mesh.h"

namespace overlook::sample {

// How much of it is modelled; those of tree_detail are levels as an artist would make them, of the same tree.
struct TreeDetail {
    double leaf_share = 1;   // of the cards; those left grow to keep the area
    double round_share = 1;  // of the tubes' sides and rings
    int finest_order = 3;    // 0 trunk, 1 boughs, 2 branches, 3 twigs: finer ones are left out
};
constexpr int kTreeLevels = 5;
// 0: 93,000 triangles, about; kTreeLevels - 1: 5,000.
TreeDetail tree_detail(int level);

// 9 m high, its foot at the origin, z up. Same seed, same tree at every detail. Fails as png_bytes does.
Result<mesh::Mesh> tree_mesh(uint64_t seed, const TreeDetail& detail);

}  // namespace overlook::sample
