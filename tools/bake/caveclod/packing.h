// How few identifiers surface groups need when those that share no position may have the same.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/result.h"

namespace overlook::caveclod {

// Compressed rows: the groups at position p, each once, are groups[begin[p] .. begin[p + 1]).
struct GroupsAtPositions {
    std::vector<uint32_t> begin;  // [P + 1]
    std::vector<uint32_t> groups;
};

// packed: [G] below count; two groups at one position have different ones. clique_bound: so many groups share a position
// pairwise, so that no packing has fewer.
struct Packing {
    std::vector<uint16_t> packed;
    uint32_t count = 0, clique_bound = 0;
};

// Colours the graph of groups that share a position: the group with most neighbours first, each with the least id that is free
// (D. Welsh, M. Powell, 1967). Where that takes more than the clique bound, also the group with most ids round it first (D.
// Brelaz, New Methods to Color the Vertices of a Graph, 1979), and then the classes of the better of the two in turn, which never
// takes more (J. Culberson, Iterated Greedy Graph Coloring, 1992). Time O(k n log n), n the length of the rows and k the groups
// at a position (at most 256 where they are more). Fails with Exit::impossible: "the surface groups need more than 65535
// identifiers; weld normals (--weld-normals) or leave texture coordinates out (--ignore-uv)".
Result<Packing> pack_groups(const GroupsAtPositions& at, uint32_t group_count);

}  // namespace overlook::caveclod
