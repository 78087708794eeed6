// The two-sided (Hausdorff) distance between two sets of triangles, from below and from above.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace overlook::caveclod {

using Triangle = std::array<glm::dvec3, 3>;

// Triangles that the nearest can be found in. Holds copies.
class TriangleTree {
  public:
    explicit TriangleTree(std::span<const Triangle> triangles);

    // Index of a nearest triangle and its distance; `below_m`: nothing farther is of interest (then index kNobody and below_m).
    struct Nearest {
        uint32_t triangle = 0xffffffff;
        double distance_m = 0;
    };
    Nearest nearest(const glm::dvec3& p, double below_m = 1e300) const;
    const Triangle& triangle(uint32_t i) const { return triangles_[i]; }
    std::span<const Triangle> triangles() const { return triangles_; }

  private:
    struct Node {
        glm::dvec3 low{1e300}, high{-1e300};
        uint32_t first = 0, count = 0;  // of triangles in a leaf; count 0: children at first and first + 1
    };
    void build(uint32_t node, uint32_t begin, uint32_t end);

    std::vector<Triangle> triangles_;
    std::vector<uint32_t> order_;
    std::vector<Node> nodes_;
};

struct Distance {
    double least_m = 0;  // some point is this far away
    double most_m = 0;   // none is farther
};

// The greatest distance of any point of `from` to `to`. Stops when most_m <= least_m * (1 + gap) + floor_m, or after most_steps
// halvings (least and most still hold then). The distance to one triangle is convex, so its maximum over a piece is at a corner;
// pieces are halved where that is not tight enough (M. Guthe, P. Borodin, R. Klein, Fast and Accurate Hausdorff Distance
// Calculation between Meshes, 2005, with the same bounds).
Distance one_sided_distance(const TriangleTree& from, const TriangleTree& to, double gap, double floor_m, uint64_t most_steps);

// The greater of both ways.
Distance two_sided_distance(const TriangleTree& a, const TriangleTree& b, double gap, double floor_m, uint64_t most_steps);

}  // namespace overlook::caveclod
