// Hierarchies made in code: a grid over hills or a sphere, collapsed in passes of a simple legal order.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "formats/caveclod.h"

namespace overlook::caveclod::synthetic {

// Faces with corners at positions; each position has one wedge for each group that meets there.
struct Source {
    std::vector<glm::vec3> positions_m;
    std::vector<std::array<uint32_t, 3>> faces;
    std::vector<uint32_t> face_group;
    std::vector<uint32_t> group_surface;
    Attributes attributes{true, true, false};
};

// (columns + 1) * (rows + 1) positions a metre apart over hills `height_m` high, in group_columns * 1 groups side by side, each
// of a surface of its own.
Source hills(uint32_t columns, uint32_t rows, uint32_t group_columns = 1, double height_m = 4);
// Closed: a sphere of radius 10 m, `rings` from pole to pole and twice as many meridians.
Source sphere(uint32_t rings);

// Collapses until a pass finds nothing more; quantised, complete, its errors heights of what a collapse cuts off, saturated.
Hierarchy bake(const Source& source, const Precision& precision = {});

// A cut as triangles: positions and render vertices of each corner, by walking up from the base through the splits that are
// applied.
struct Triangle {
    uint32_t face = 0;
    std::array<uint32_t, 3> positions{}, vertices{};

    auto operator<=>(const Triangle&) const = default;
};
// is_applied: [S], closed under needs. In order of faces.
std::vector<Triangle> triangles_of(const Hierarchy& hierarchy, const std::vector<bool>& is_applied);

}  // namespace overlook::caveclod::synthetic
