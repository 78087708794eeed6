// Polygons of a file, kept until every position is known, then cut into triangles.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "tools/bake/mesh/polygon.h"
#include "tools/bake/mesh/soup.h"

namespace overlook::mesh {

// Rows of corners. The attributes by corner and by face are either empty or as long as the corners and the rows.
struct Polygons {
    std::vector<uint64_t> begin{0};   // [n+1]
    std::vector<uint32_t> positions;  // in range, corner by corner
    std::vector<glm::vec2> uvs;       // by corner
    std::vector<uint32_t> colours;    // by face: index of the soup's pool, or kNone
    std::vector<uint32_t> surfaces;   // by face

    size_t size() const { return begin.size() - 1; }
    void end_polygon() { begin.push_back(positions.size()); }
};

// Adds the polygons' triangles to the soup in their order. Triangles get kNone for attributes that no polygon has but the soup's
// other triangles do. Fails as count_triangles, and where PolygonCutter gives up.
Result<void> add_polygons(const Polygons& polygons, const std::string& path, Soup& soup);

}  // namespace overlook::mesh
