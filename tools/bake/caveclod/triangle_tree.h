// Triangles that the nearest can be found in.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <utility>
#include <vector>

#include "tools/bake/caveclod/distances.h"

namespace overlook::caveclod {

using Triangle = std::array<glm::dvec3, 3>;

// x, y and z side by side, for instructions that take all at once; the fourth is 0.
using Lanes [[gnu::vector_size(16)]] = float;
inline Lanes lanes_of(const glm::vec3& v) {
    return Lanes{v.x, v.y, v.z, 0};
}

// A binary tree of boxes, split where the children's surface areas, weighted by how many triangles they hold, come out least (J.
// Goldsmith, J. Salmon, Automatic Creation of Object Hierarchies for Ray Tracing, 1987; by bins: I. Wald, 2007): a few large
// triangles among many small ones get nodes of their own, where a split at the median would stretch the boxes of all. Each node
// also bounds the directions that its triangles face. Holds copies.
class TriangleTree {
  public:
    explicit TriangleTree(std::span<const Triangle> triangles);

    // Index of a nearest triangle and its distance; `below_m`: nothing farther is of interest (then index kNobody and below_m).
    struct Nearest {
        uint32_t triangle = 0xffffffff;
        double distance_m = 0;
    };
    Nearest nearest(const glm::dvec3& p, double below_m = 1e300) const;

    // The greatest cosine between `direction` (unit) and the normals of all triangles that are as near to p as the nearest, give
    // or take slack_m and a millionth: where several are, as at an edge or where two sheets lie in one place, the best of them
    // counts. 0 for those that have no normal, and where there are no triangles. `guess`: a triangle that may be near, or
    // kNobody; becomes the nearest. The better it is, the less is looked at; the answer is the same.
    double facing_of_nearest(const glm::dvec3& p, const glm::dvec3& direction, double slack_m, uint32_t& guess) const;

    // Whether every triangle that might be as near to p as the one given (by index), give or take slack_m, has a normal within 90
    // degrees of the direction (unit). As with all_face, never yes where it is no.
    bool nearest_face(const glm::dvec3& p, const glm::dvec3& direction, double slack_m, uint32_t triangle) const;

    // Whether every triangle that might reach into the box has a normal within 90 degrees of every direction (unit). May say no
    // where the answer is yes, never yes where it is no.
    bool all_face(const glm::vec3& low, const glm::vec3& high, std::span<const glm::vec3> directions) const;

    // What is looked at along a ray.
    struct Ray {
        glm::dvec3 from, direction;  // the latter of length 1
        double slack_m = 0;          // what is nearer is passed over; what is missed by no more than that is hit
        double below_m = 1e300;      // nothing farther is of interest
    };
    // The nearest triangle on a ray that it leaves through: that looks ahead. Index kNobody and below_m where there is none; of
    // several in one place the least.
    Nearest ahead(const Ray& ray) const;

    const Triangle& triangle(uint32_t i) const { return triangles_[i]; }
    std::span<const Triangle> triangles() const { return triangles_; }

  private:
    struct alignas(64) Node {
        Lanes low = lanes_of(glm::vec3(1e30f)), high = lanes_of(glm::vec3(-1e30f));
        glm::vec3 axis{0};
        float sine = 2;                 // of the greatest angle between axis and a normal; 2: 90 degrees or more
        uint32_t first = 0, count = 0;  // of triangles in a leaf; count 0: children at first and first + 1
    };
    struct Ball;
    struct Item {
        Lanes low, high;
        uint32_t triangle = 0;
    };
    void build(uint32_t node, std::span<Item> items, uint32_t begin, uint32_t depth);
    void put(uint32_t place, uint32_t triangle);
    void fit_leaf(Node& node) const;
    void fit_parent(Node& node) const;
    template <class Take>
    void visit_near(const glm::dvec3& p, const Ball& ball, const Take& take) const;
    double facing_within(const glm::dvec3& p, const glm::dvec3& direction, double limit_m) const;

    std::vector<Triangle> triangles_;
    std::vector<uint32_t> order_;        // of the leaves' triangles
    std::vector<TriangleProbe> probes_;  // in that order, their normals of length 1 (or 0)
    std::vector<uint32_t> place_;        // of each triangle in that order
    std::vector<Node> nodes_;
};

}  // namespace overlook::caveclod
