// The real meshes of the shared test data, good and bad: the counts that are known of each, and that every one comes out whole.
#include "tests/tools/mesh_test_files.h"

namespace overlook::mesh::test {
namespace {

// What the data's own README says of a file, where it says it: -1 elsewhere.
struct Known {
    const char* file;
    uint64_t triangles;
    int64_t complex_edges, surfaces, pieces, duplicates;
};

MeshFile expect_known(const Known& known) {
    const std::string path = data_file(std::string("mesh/") + known.file);
    MeshFile mesh = open_whole(path);
    const MeshReport& report = mesh.report;
    EXPECT_EQ(report.triangle_count, known.triangles);
    EXPECT_EQ(report.triangle_count,
              report.face_count + report.dropped_count(DropReason::duplicate) + report.dropped_count(DropReason::no_area));
    const auto expect = [](uint64_t found, int64_t wanted, const char* what) {
        if (wanted >= 0) {
            EXPECT_EQ(found, uint64_t(wanted)) << what;
        }
    };
    expect(report.complex_edge_count, known.complex_edges, "edges of more than two faces");
    expect(mesh.mesh.surfaces.size(), known.surfaces, "surfaces");
    expect(report.component_count, known.pieces, "pieces");
    expect(report.back_side_count + report.dropped_count(DropReason::duplicate), known.duplicates, "duplicates");
    return mesh;
}

#define OVERLOOK_NEED_MESHES() OVERLOOK_NEED_DATA(data_file("mesh"))

TEST(RealMesh, ArmadilloIsCleanAndClosed) {
    OVERLOOK_NEED_MESHES();
    EXPECT_EQ(expect_known({"armadillo.obj", 86482, 0, 1, 1, 0}).report.closed_component_count, 1u);
}
TEST(RealMesh, IgeaIsReadFromItsStrips) {
    OVERLOOK_NEED_MESHES();
    EXPECT_EQ(expect_known({"igea_tristrips.ply", 268686, 0, 1, 1, 0}).report.face_count, 268686u);
}
TEST(RealMesh, DuckHasItsTexture) {
    OVERLOOK_NEED_MESHES();
    const MeshFile duck = expect_known({"duck.glb", 4212, 0, 1, 1, 0});
    EXPECT_EQ(duck.mesh.surfaces[0].texture_bytes.size(), 16302u);
    EXPECT_EQ(duck.mesh.face_uvs.size(), 4212u);
}
// 243 positions are written twice, for the two sides of a seam.
TEST(RealMesh, CamelIsWeldedAlongItsSeam) {
    OVERLOOK_NEED_MESHES();
    EXPECT_EQ(expect_known({"camel_b.obj", 3576, 0, 1, 1, 0}).report.welded_position_count, 243u);
}
TEST(RealMesh, ShaderballHasSeams) {
    OVERLOOK_NEED_MESHES();
    EXPECT_FALSE(expect_known({"shaderball.glb", 63856, 0, -1, -1, 0}).mesh.uvs.empty());
}
// The README counts 4,397 edges of more than two faces: here two of them are such only by a back side.
TEST(RealMesh, DreamApartmentHasItsMaterialsAndComplexEdges) {
    OVERLOOK_NEED_MESHES();
    (void)expect_known({"dream_apartment.glb", 177934, 4395, 67, -1, -1});
}
TEST(RealMesh, CityAndSpaceComeOutWhole) {
    OVERLOOK_NEED_MESHES();
    (void)expect_known({"city_diorama.glb", 102822, -1, 24, -1, -1});
    (void)expect_known({"lowpoly_space.glb", 50003, -1, 1, -1, -1});
}
TEST(RealMesh, CubeOfTetrahedraLosesNothing) {
    OVERLOOK_NEED_MESHES();
    EXPECT_EQ(expect_known({"cube_tets.obj", 96000, 55580, 1, -1, 8000}).report.face_count, 96000u);
}
// 112 parts before edges of more than two faces are cut.
TEST(RealMesh, CycloidalKeepsAllFacesOfItsParts) {
    OVERLOOK_NEED_MESHES();
    EXPECT_EQ(expect_known({"cycloidal.ply", 43368, 242, 1, 115, 0}).report.face_count, 43368u);
}
TEST(RealMesh, ChairKeepsItsBackSides) {
    OVERLOOK_NEED_MESHES();
    const MeshFile chair = expect_known({"chair_model.obj", 12756, -1, -1, -1, -1});
    EXPECT_EQ(chair.report.back_side_count, 6374u);  // half of the 12,748 that stand there once
    EXPECT_EQ(chair.report.face_count, 12748u);
    ASSERT_EQ(chair.report.notes.size(), 1u);
    EXPECT_NE(chair.report.notes[0].find("model.mtl"), std::string::npos);
}
TEST(RealMesh, BunnyAngleBlockAndUnitCasesComeOutWhole) {
    OVERLOOK_NEED_MESHES();
    (void)expect_known({"bunny_nonmanifold.ply", 16301, -1, 1, -1, -1});
    (void)expect_known({"angle_block.STL", 704, 0, 1, 1, 0});
    (void)expect_known({"hour_glass.off", 512, 0, 1, 2, 0});
    EXPECT_EQ(expect_known({"edge_with_four_triangles.off", 4, 1, 1, 2, 0}).report.face_count, 4u);
}

}  // namespace
}  // namespace overlook::mesh::test
