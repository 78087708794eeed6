// Self-intersections, where CGAL is built in.
#include "tests/tools/mesh_test_files.h"
#include "tools/bake/cgal/self_intersections.h"

namespace overlook::mesh::test {
namespace {

TEST(SelfIntersection, CountsCrossingPairsAndNoNeighbours) {
    const ScratchFolder folder;
    const std::string corner = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n";
    EXPECT_EQ(self_intersection_count(open_whole(write_file(folder, "a.obj", corner)).mesh), 0u);
    // A triangle upright through both faces.
    const std::string pierced = corner + "v 0.1 0.1 -1\nv 0.9 0.9 -1\nv 0.5 0.5 1\nf 5 6 7\n";
    EXPECT_EQ(self_intersection_count(open_whole(write_file(folder, "b.obj", pierced)).mesh), 2u);
}

TEST(SelfIntersection, FacesThatRepairCutApartAreNeighboursStill) {
    const ScratchFolder folder;
    const MeshFile fan = open_whole(
        write_file(folder, "a.obj", "v 0 0 0\nv 1 0 0\nv 0.5 1 0\nv 0.5 -1 0\nv 0.5 0 1\nf 1 2 3\nf 2 1 4\nf 2 1 5\n"));
    EXPECT_EQ(fan.report.complex_edge_count, 1u);
    EXPECT_EQ(self_intersection_count(fan.mesh), 0u);
}

TEST(SelfIntersection, RealMeshesHaveTheirs) {
    OVERLOOK_NEED_DATA(data_file("mesh"));
    EXPECT_EQ(self_intersection_count(open_whole(data_file("mesh/armadillo.obj")).mesh), 0u);
    // The data's README has 64,765 pairs, counted by another tool in the mesh as it stands in the file.
    const uint64_t count = self_intersection_count(open_whole(data_file("mesh/cycloidal.ply")).mesh);
    EXPECT_GT(count, 50'000u);
    EXPECT_LE(count, 64'765u);
}

}  // namespace
}  // namespace overlook::mesh::test
