// Bad input: one clear line, or a right result.
#include <cmath>

#include "tests/tools/mesh_test_files.h"

namespace overlook::mesh::test {
namespace {

TEST(BrokenMesh, EmptyMissingAndUnknownFilesAreRefusedInALine) {
    const ScratchFolder folder;
    for (const char* name : {"a.obj", "a.ply", "a.off", "a.stl", "a.glb", "a.gltf"})
        expect_refused(write_file(folder, name, ""), Exit::bad_input, "is empty");
    expect_refused(folder / "gone.obj", Exit::bad_input, "No such file");
    expect_refused(write_file(folder, "a.txt", "hello\n"), Exit::bad_input, "is no mesh of a known form");
}

TEST(BrokenMesh, FilesWithoutFacesAreRefusedInEveryForm) {
    const ScratchFolder folder;
    expect_refused(write_file(folder, "a.obj", "v 0 0 0\nv 1 0 0\n"), Exit::bad_input, "has no faces");
    expect_refused(write_file(folder, "b.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n"), Exit::bad_input,
                   "has no faces, only points or lines");
    expect_refused(write_file(folder, "a.off", "OFF\n1 0 0\n0 0 0\n"), Exit::bad_input, "has no faces");
    expect_refused(write_file(folder, "a.stl", "solid a\nendsolid a\n"), Exit::bad_input, "has no faces");
    expect_refused(
        write_file(
            folder, "a.ply",
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n"),
        Exit::bad_input, "has no faces");
    expect_refused(write_file(folder, "a.gltf", R"({"asset":{"version":"2.0"}})"), Exit::bad_input, "has no faces");
}

TEST(BrokenMesh, PositionsThatAreNowhereTakeTheirFacesWithThemAndNothingElse) {
    const ScratchFolder folder;
    const MeshFile mesh =
        open_whole(write_file(folder, "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 0\nv 1e999 0 0\nf 1 2 3\nf 1 2 4\nf 1 2 5\n"));
    EXPECT_EQ(mesh.report.face_count, 1u);
    EXPECT_EQ(mesh.report.dropped_count(DropReason::not_finite), 2u);
    expect_refused(write_file(folder, "b.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), Exit::bad_input,
                   "none of its 1 faces can be drawn: 1 not_finite");
}

TEST(BrokenMesh, PolygonsOfFewerThanThreeCornersAreReported) {
    const ScratchFolder folder;
    const MeshFile mesh = open_whole(write_file(folder, "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\nf 1 2 3\nf 3\n"));
    EXPECT_EQ(mesh.report.triangle_count, 3u);
    EXPECT_EQ(mesh.report.dropped_count(DropReason::too_few_corners), 2u);
    EXPECT_EQ(mesh.mesh.face_source, (std::vector<uint32_t>{1}));
}

TEST(BrokenMesh, FarFromZeroAMillimetreIsStillAMillimetre) {
    const ScratchFolder folder;
    const MeshFile mesh = open_whole(
        write_file(folder, "a.obj", "v 500000 4000000 1000\nv 500000.001 4000000 1000\nv 500000 4000000.001 1000\nf 1 2 3\n"));
    ASSERT_EQ(mesh.report.face_count, 1u);
    EXPECT_LT(mesh.report.rounding_m, 1e-9);
    EXPECT_NEAR(area_of(mesh.mesh), 0.5e-6, 1e-11);
    EXPECT_NEAR(mesh.mesh.origin_m.x + corner_m(mesh.mesh, 0, 1).x, 500000.001, 1e-9);
}

TEST(BrokenMesh, BeyondAllMeasureIsRefusedAndAUnitHelps) {
    const ScratchFolder folder;
    const std::string path = write_file(folder, "a.obj", "v 0 0 0\nv 1e300 0 0\nv 0 1e300 0\nf 1 2 3\n");
    expect_refused(path, Exit::bad_input, "at most 1e+12 m are read; give the unit");
    EXPECT_EQ(open_whole(path, {.metres_per_unit = 1e-299}).report.face_count, 1u);
    EXPECT_EQ(open_mesh(path, {.metres_per_unit = 0}).error().exit, Exit::bad_command);
    EXPECT_EQ(open_mesh(path, {.metres_per_unit = NAN}).error().exit, Exit::bad_command);
}

TEST(BrokenMesh, OneTriangleIsAMesh) {
    const ScratchFolder folder;
    const MeshFile mesh = open_whole(write_file(folder, "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3"));
    EXPECT_EQ(mesh.report.border_edge_count, 3u);
    EXPECT_EQ(mesh.report.closed_component_count, 0u);
}

TEST(BrokenMesh, EveryTruncationOfATextGivesALineOrAWholeMesh) {
    const ScratchFolder folder;
    const std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1e-3 0\nvt 0 1\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1 4/1/1\nf -4 -3 -1\n";
    for (size_t length = 0; length < text.size(); ++length) {
        const Result<MeshFile> file = open_mesh(write_file(folder, "a.obj", text.substr(0, length)));
        if (file)
            expect_whole(*file);
        else
            EXPECT_EQ(file.error().exit, Exit::bad_input) << file.error().message;
    }
}

TEST(BrokenMesh, AttributesThatAreNoNumbersAreMissingAndCounted) {
    const ScratchFolder folder;
    const MeshFile mesh = open_whole(
        write_file(folder, "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt nan 0\nvt 0 0\nvn 0 0 0\nvn 0 0 1\nf 1/1/1 2/2/2 3/2/2\n"));
    EXPECT_EQ(mesh.report.bad_normal_count, 1u);
    EXPECT_EQ(mesh.report.bad_uv_count, 1u);
    EXPECT_EQ(mesh.mesh.face_uvs[0], (Corners{kNone, 0, 0}));
}

TEST(MeshReport, SaysInWordsWhatWasDone) {
    const ScratchFolder folder;
    const MeshFile mesh = open_whole(write_file(folder, "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 2 3 1\n"));
    const std::vector<std::string> lines = text_of(mesh.report);
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_EQ(lines[0], "a.obj (OBJ): 2 triangles, 3 positions");
    EXPECT_EQ(lines[1], "mesh: 1 faces, 3 positions, 1 pieces, 3 edges of border");
    EXPECT_EQ(lines[2], "dropped: 1 faces: duplicate");
}

}  // namespace
}  // namespace overlook::mesh::test
