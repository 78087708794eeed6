// Section 3.4 of Chen, Swan and Kuo, LOD-Sprite Technique for Accelerated Terrain Rendering (1999): triangles are sent in strips,
// and a strip has one texture. "For strips which contain both visible and invisible triangles, we can only use the original
// texture map."
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/lod_sprite/paper_table.h"
#include "runtime/terrain/refine.h"

namespace overlook::lod_sprite::paper {

struct StripOptions {
    uint32_t longest = 64;  // triangles in a strip at most, >= 1. The paper does not say; longer strips lose more
};

// Strips with turns: each triangle shares an edge with the one before it, whichever that is, and a turn costs a repeated vertex,
// as in the strips of the paper's own terrain (Lindstrom et al., Real-Time, Continuous Level of Detail Rendering of Height
// Fields, 1996). Built greedily (Akeley, Haeberli and Burns, tomesh, 1990): a strip begins at the first triangle of the cut that
// has none, goes on to the neighbour with the fewest neighbours left, the earlier in the cut if there are two, and ends where
// there is none.
class Strips {
  public:
    // Cost O(triangles); no memory but the greatest cut's. The same cut gives the same strips.
    void build(const terrain::Cut& cut, const StripOptions& options);

    // The triangles in the order in which they are sent, [n], and where each strip begins among them, [strips + 1].
    std::span<const uint32_t> triangles() const { return order_; }
    std::span<const uint32_t> begins() const { return begins_; }
    size_t strip_count() const { return begins_.empty() ? 0 : begins_.size() - 1; }
    // Vertices sent: three for a strip's first triangle, one for each other, one more for each turn.
    uint64_t vertex_count() const { return vertex_count_; }

    // Takes the sprite from every triangle of a strip that has any without it. is_visible: [n], of the cut's triangles in its own
    // order. Returns how many lost it.
    uint64_t take_from_mixed(std::span<uint8_t> is_visible) const;

  private:
    static constexpr uint32_t kNone = ~0u;
    void find_neighbours(const terrain::Cut& cut);
    uint32_t neighbours_left(uint32_t triangle) const;
    void use(uint32_t triangle);
    uint32_t best_next(uint32_t triangle) const;
    uint32_t side_towards(uint32_t from, uint32_t to) const;

    std::vector<uint32_t> neighbours_;  // [3n] across the edge that begins at each corner
    std::vector<uint8_t> is_used_;
    std::vector<uint32_t> order_, begins_;
    uint64_t vertex_count_ = 0;
    TripleTable edges_;
};

}  // namespace overlook::lod_sprite::paper
