// The one source file that knows CGAL.
#include "tools/bake/cgal/self_intersections.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <boost/iterator/function_output_iterator.hpp>
#include <cassert>

namespace overlook::mesh {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Topology = CGAL::Surface_mesh<Kernel::Point_3>;

Topology topology_of(const Mesh& mesh) {
    Topology topology;
    std::vector<Topology::Vertex_index> vertices;
    for (const glm::vec3& p : mesh.positions_m) vertices.push_back(topology.add_vertex({p.x, p.y, p.z}));
    for (const Corners& face : mesh.faces) {
        [[maybe_unused]] const auto added = topology.add_face(vertices[face[0]], vertices[face[1]], vertices[face[2]]);
        assert(added != Topology::null_face());  // what repair promises
    }
    return topology;
}

// Whether two faces touch at a point that repair split: there they were neighbours.
bool were_neighbours(const Mesh& mesh, size_t f, size_t g) {
    if (mesh.link.empty()) return false;
    const Corners &a = mesh.faces[f], &b = mesh.faces[g];
    return std::any_of(a.begin(), a.end(), [&](uint32_t p) {
        return std::any_of(b.begin(), b.end(), [&](uint32_t q) { return p != q && mesh.link[p] == mesh.link[q]; });
    });
}

}  // namespace

uint64_t self_intersection_count(const Mesh& mesh) {
    const Topology topology = topology_of(mesh);
    uint64_t count = 0;
    const auto note = [&](const std::pair<Topology::Face_index, Topology::Face_index>& pair) {
        count += !were_neighbours(mesh, size_t(pair.first), size_t(pair.second));
    };
    CGAL::Polygon_mesh_processing::self_intersections<CGAL::Sequential_tag>(topology, boost::make_function_output_iterator(note));
    return count;
}

}  // namespace overlook::mesh
