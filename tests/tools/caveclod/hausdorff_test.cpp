// An independent judge of the stated error: CGAL's Hausdorff distance with a bounded error.
#include <gtest/gtest.h>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wextra"
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Surface_mesh.h>
#pragma GCC diagnostic pop

#include "tests/tools/caveclod/test_meshes.h"
#include "tools/bake/caveclod/cut.h"

namespace overlook::caveclod {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

Surface surface_of(std::span<const glm::vec3> positions_m, std::span<const std::array<uint32_t, 3>> faces) {
    Surface surface;
    std::vector<Surface::Vertex_index> made(positions_m.size());
    std::vector<bool> is_made(positions_m.size(), false);
    for (const auto& f : faces) {
        for (uint32_t p : f)
            if (!is_made[p]) {
                made[p] = surface.add_vertex(
                    Kernel::Point_3(double(positions_m[p].x), double(positions_m[p].y), double(positions_m[p].z)));
                is_made[p] = true;
            }
        EXPECT_NE(surface.add_face(made[f[0]], made[f[1]], made[f[2]]), Surface::null_face());
    }
    return surface;
}

TEST(StatedError, IsNotBelowTheHausdorffDistanceOfCgal) {
    // No straight extrusions: where the greatest distance is reached along whole lines, CGAL's search takes minutes and gigabytes.
    std::vector<mesh::Mesh> meshes{test::sphere(24, 12, 0.05), test::grid(20, 20, test::rough_m), test::torus(24, 12, 1, 0.4),
                                   test::sphere(18, 10, 0.03), test::grid(16, 30, test::rough_m)};
    for (const mesh::Mesh& mesh : meshes) {
        auto groups = find_groups(mesh, {});
        auto h = build_hierarchy(mesh, *groups, {});
        Surface source = surface_of(mesh.positions_m, mesh.faces);
        for (uint64_t seed : {1u, 2u}) {
            Applied applied = random_cut(*h, mesh.faces.size() / (seed == 1 ? 4 : 12), seed);
            Surface cut = surface_of(h->positions_m, faces_of(*h, applied).positions);
            double stated_m = stated_error_m(*h, applied), bound_m = stated_m / 100;
            double measured_m = CGAL::Polygon_mesh_processing::bounded_error_symmetric_Hausdorff_distance<CGAL::Sequential_tag>(
                source, cut, bound_m);
            EXPECT_LE(measured_m - bound_m, stated_m) << seed;
            EXPECT_GE(measured_m + bound_m, stated_m / 1.5) << seed;
        }
    }
}

}  // namespace
}  // namespace overlook::caveclod
