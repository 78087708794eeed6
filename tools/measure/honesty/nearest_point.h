// The nearest point of many triangles; the measuring side's own, so that no baker judges itself.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace overlook::measure {

// A tree of boxes, halved at the middle of the longest side. Build O(n log n), one query about O(log n) where it is near.
class NearestPoint {
  public:
    // corners_m: three a triangle; at least one triangle.
    explicit NearestPoint(std::span<const glm::dvec3> corners_m);

    glm::dvec3 operator()(const glm::dvec3& place_m) const;

  private:
    struct Node {
        glm::dvec3 low{0}, high{0};
        uint32_t first = 0, count = 0;  // of triangles in a leaf; count 0: children at first and first + 1
    };
    void build(uint32_t node, uint32_t begin, uint32_t end);

    std::vector<glm::dvec3> corners_m_;
    std::vector<uint32_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace overlook::measure
