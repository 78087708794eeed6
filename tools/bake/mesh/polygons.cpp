// Polygons into triangles of a soup.

#include "tools/bake/mesh/polygons.h"

namespace overlook::mesh {
namespace {

void add_triangle(const Polygons& polygons, size_t polygon, const Corners& corners, uint32_t source, Soup& soup) {
    const size_t begin = size_t(polygons.begin[polygon]);
    const size_t a = begin + corners[0], b = begin + corners[1], c = begin + corners[2];
    Mesh& mesh = soup.mesh;
    mesh.faces.push_back({polygons.positions[a], polygons.positions[b], polygons.positions[c]});
    mesh.face_source.push_back(source);
    mesh.face_surface.push_back(polygons.surfaces.empty() ? 0 : polygons.surfaces[polygon]);
    if (!polygons.uvs.empty()) {
        const uint32_t first = uint32_t(mesh.uvs.size());
        mesh.uvs.insert(mesh.uvs.end(), {polygons.uvs[a], polygons.uvs[b], polygons.uvs[c]});
        mesh.face_uvs.push_back({first, first + 1, first + 2});
    }
    if (!polygons.colours.empty()) {
        const uint32_t colour = polygons.colours[polygon];
        mesh.face_colours.push_back({colour, colour, colour});
    }
}

}  // namespace

Result<void> add_polygons(const Polygons& polygons, const std::string& path, Soup& soup) {
    PolygonCutter cutter;
    std::vector<glm::dvec3> points;
    for (size_t i = 0; i < polygons.size(); ++i) {
        const size_t begin = size_t(polygons.begin[i]), count = size_t(polygons.begin[i + 1]) - begin;
        if (count < 3) {
            if (auto r = drop_polygon(soup, path); !r) return r;
            continue;
        }
        points.clear();
        for (size_t k = 0; k < count; ++k) points.push_back(soup.positions[polygons.positions[begin + k]]);
        const std::span<const Corners> triangles = cutter.cut(points);
        if (triangles.empty())
            return impossible("{}: face {}: a polygon of {} corners is too jagged to be cut; cut it into triangles before", path,
                              i, count);
        const uint32_t first = uint32_t(soup.report.triangle_count);
        if (auto r = count_triangles(soup, triangles.size(), path); !r) return r;
        ++soup.report.polygon_count;
        for (size_t k = 0; k < triangles.size(); ++k) add_triangle(polygons, i, triangles[k], first + uint32_t(k), soup);
    }
    return {};
}

}  // namespace overlook::mesh
