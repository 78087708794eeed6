// OpenMesh's half-edges as arrays by corner: it finds the edges, and refuses what is not a surface.
#include <algorithm>

#include "tools/bake/caveclod/topology.h"

// OpenMesh's own headers do not pass the warnings of this house.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wextra"
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#pragma GCC diagnostic pop

namespace overlook::caveclod {
namespace {

using Surface = OpenMesh::TriMesh_ArrayKernelT<>;

tl::expected<Surface, NoSurface> surface_of(size_t position_count, std::span<const mesh::Corners> faces) {
    Surface surface;
    surface.reserve(position_count, faces.size() * 3 / 2, faces.size());
    for (size_t p = 0; p < position_count; ++p) surface.new_vertex();
    for (size_t f = 0; f < faces.size(); ++f) {
        auto corner = [&](int c) { return OpenMesh::VertexHandle(int(faces[f][size_t(c)])); };
        if (!surface.add_face(corner(0), corner(1), corner(2)).is_valid())
            return tl::unexpected(NoSurface{
                uint32_t(f), "cannot be added: an edge of it has two faces already, or the faces at a corner are no fan"});
    }
    return surface;
}

// The corner of `face` that the half-edge from -> to does not touch.
uint32_t corner_facing(std::span<const mesh::Corners> faces, uint32_t face, int from, int to) {
    uint32_t corner = 0;
    while (int(faces[face][corner]) == from || int(faces[face][corner]) == to) ++corner;
    return face * kCorners + corner;
}

}  // namespace

tl::expected<Topology, NoSurface> find_topology(size_t position_count, std::span<const mesh::Corners> faces) {
    auto surface = surface_of(position_count, faces);
    if (!surface) return tl::unexpected(surface.error());
    Topology topology;
    topology.edge.assign(faces.size() * kCorners, kNobody);
    topology.opposite = topology.edge;
    topology.edge_corners.reserve(surface->n_edges());
    for (uint32_t e = 0; e < surface->n_edges(); ++e) {
        std::array<uint32_t, 2> corners{kNobody, kNobody};
        for (uint32_t side = 0; side < 2; ++side) {
            auto halfedge = surface->halfedge_handle(OpenMesh::EdgeHandle(int(e)), side);
            if (surface->is_boundary(halfedge)) continue;
            int from = surface->from_vertex_handle(halfedge).idx(), to = surface->to_vertex_handle(halfedge).idx();
            corners[side] = corner_facing(faces, uint32_t(surface->face_handle(halfedge).idx()), from, to);
            topology.edge[corners[side]] = e;
        }
        if (corners[0] == kNobody) std::swap(corners[0], corners[1]);
        topology.opposite[corners[0]] = corners[1];
        if (corners[1] != kNobody) topology.opposite[corners[1]] = corners[0];
        topology.edge_corners.push_back(corners);
    }
    return topology;
}

}  // namespace overlook::caveclod
