// Polygons cut into triangles.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "tools/bake/mesh.h"

namespace overlook::mesh {

// Cuts polygons, one after another, with buffers that it keeps.
class PolygonCutter {
  public:
    // Cuts a polygon of n >= 3 corners, which may be concave, not flat, and touch itself, into n - 2 triangles of corner numbers
    // 0..n-1, wound as the polygon is. Every corner is in a triangle. A convex polygon becomes a fan from corner 0, and
    // so does one that is not nearly flat and thus has no shape to keep. The view is
    // valid until the next call. Empty if the cutter's polygons together are so large and so jagged that it would take too long
    // (10^10 tests of a reflex corner against a triangle). Cost O(n + n r) for most, O(n^2 r) at worst, r reflex corners.
    // Method: ear clipping in the plane of the polygon's area vector. G. H. Meisters, "Polygons have ears", American Mathematical
    // Monthly 82(6), 1975; area vector after M. E. Newell (I. E. Sutherland, R. F. Sproull, R. A. Schumacker, "A Characterization
    // of Ten Hidden-Surface Algorithms", ACM Computing Surveys 6(1), 1974). Unlike them it takes a corner that is no ear where a
    // polygon that crosses itself has none.
    std::span<const Corners> cut(std::span<const glm::dvec3> corners);

  private:
    struct Point {
        double x, y;
    };
    void project(std::span<const glm::dvec3> corners, const glm::dvec3& area);
    void link(uint32_t count);
    bool clip_ears(uint32_t count);
    double turn(uint32_t a, uint32_t b, uint32_t c) const;
    bool is_ear(uint32_t corner);
    void clip(uint32_t corner);
    void fan(uint32_t count);

    std::vector<Point> points_;
    std::vector<uint32_t> previous_, next_;
    std::vector<uint8_t> is_reflex_;
    std::vector<uint32_t> reflex_;
    std::vector<Corners> triangles_;
    uint64_t tests_left_ = 10'000'000'000;
};

}  // namespace overlook::mesh
