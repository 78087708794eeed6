// An independent judge of the stated error: CGAL's Hausdorff distance with a bounded error.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

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

// OVERLOOK_EXACT_CUTS of them, where that is set.
uint64_t cut_count() {
    const char* count = std::getenv("OVERLOOK_EXACT_CUTS");
    return count != nullptr ? std::strtoull(count, nullptr, 10) : 10;
}

// Random legal cuts, log-uniform from 0.1 to 50 % of the triangles, in turn of meshes of several kinds.
TEST(StatedError, IsNotBelowTheHausdorffDistanceOfCgal) {
    // No straight extrusions: where the greatest distance is reached along whole lines, CGAL's search takes minutes and
    // gigabytes.
    std::vector<mesh::Mesh> meshes{test::sphere(24, 12, 0.05), test::grid(20, 20, test::rough_m), test::torus(24, 12, 1, 0.4),
                                   test::sphere(18, 10, 0.03), test::grid(16, 30, test::rough_m)};
    std::vector<Hierarchy> hierarchies;
    for (const mesh::Mesh& mesh : meshes) hierarchies.push_back(*build_hierarchy(mesh, *find_groups(mesh, {}), {}));
    std::vector<double> stated_over_measured;
    size_t broken_count = 0;
    for (uint64_t i = 0; i < cut_count(); ++i) {
        const mesh::Mesh& mesh = meshes[i % meshes.size()];
        const Hierarchy& h = hierarchies[i % meshes.size()];
        double place = std::fmod(double(i + 1) * 0.6180339887498949, 1.0), share = 0.001 * std::pow(500.0, place);
        Applied applied = random_cut(h, uint64_t(share * double(mesh.faces.size())) + 1, i + 1);
        Surface source = surface_of(mesh.positions_m, mesh.faces);
        Surface cut = surface_of(h.positions_m, faces_of(h, applied).positions);
        double stated_m = stated_error_m(h, applied), bound_m = stated_m / 100;
        double measured_m =
            CGAL::Polygon_mesh_processing::bounded_error_symmetric_Hausdorff_distance<CGAL::Sequential_tag>(source, cut, bound_m);
        EXPECT_LE(measured_m - bound_m, stated_m) << "cut " << i;
        broken_count += measured_m - bound_m > stated_m;
        stated_over_measured.push_back(stated_m / measured_m);
    }
    ASSERT_FALSE(stated_over_measured.empty());
    std::sort(stated_over_measured.begin(), stated_over_measured.end());
    double median = stated_over_measured[stated_over_measured.size() / 2];
    std::printf("%zu cuts by CGAL: %zu broken, stated over measured %.3f in the median, %.3f at the most\n",
                stated_over_measured.size(), broken_count, median, stated_over_measured.back());
    EXPECT_LE(median, 1.5);
}

}  // namespace
}  // namespace overlook::caveclod
