// PLY: the same mesh in each of its forms, strips, and every truncation.
#include "tests/tools/mesh_test_files.h"

namespace overlook::mesh::test {
namespace {

const char* const kRest =
    "comment a tetrahedron\nelement vertex 4\nproperty float x\nproperty float y\nproperty double z\nproperty uchar red\n"
    "property uchar green\nproperty uchar blue\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n";

struct Vertex {
    float x, y;
    double z;
    uint8_t red, green, blue;
};
constexpr Vertex kVertices[] = {{0, 0, 0, 255, 0, 0}, {1.5f, 0, 0, 0, 255, 0}, {0, 1, 0, 0, 0, 255}, {0, 0, 1e-3, 9, 8, 7}};
constexpr int kFaces[][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

std::string ascii_tetrahedron() {
    std::string text = std::string("ply\nformat ascii 1.0\n") + kRest;
    for (const Vertex& v : kVertices) text += fmt::format("{} {} {} {} {} {}\n", v.x, v.y, v.z, v.red, v.green, v.blue);
    for (const auto& f : kFaces) text += fmt::format("3 {} {} {}\n", f[0], f[1], f[2]);
    return text;
}

std::string binary_tetrahedron(bool is_big) {
    std::string bytes = std::string("ply\nformat binary_") + (is_big ? "big" : "little") + "_endian 1.0\n" + kRest;
    for (const Vertex& v : kVertices)
        bytes +=
            bytes_of(v.x, is_big) + bytes_of(v.y, is_big) + bytes_of(v.z, is_big) + char(v.red) + char(v.green) + char(v.blue);
    for (const auto& f : kFaces) {
        bytes += char(3);
        for (const int i : f) bytes += bytes_of(int32_t(i), is_big);
    }
    return bytes;
}

TEST(PlyMesh, AllThreeFormsGiveTheSameMesh) {
    const ScratchFolder folder;
    const MeshFile ascii = open_whole(write_file(folder, "a.ply", ascii_tetrahedron()));
    EXPECT_EQ(ascii.report.face_count, 4u);
    EXPECT_EQ(ascii.report.closed_component_count, 1u);
    EXPECT_EQ(ascii.mesh.colours.size(), 4u);
    for (const bool is_big : {false, true}) {
        const MeshFile binary = open_whole(write_file(folder, "b.ply", binary_tetrahedron(is_big)));
        EXPECT_EQ(binary.mesh.positions_m, ascii.mesh.positions_m);
        EXPECT_EQ(binary.mesh.faces, ascii.mesh.faces);
        EXPECT_EQ(binary.mesh.colours, ascii.mesh.colours);
        EXPECT_EQ(binary.mesh.face_colours, ascii.mesh.face_colours);
    }
}

TEST(PlyMesh, RefusesEveryTruncationOfABinaryFile) {
    const ScratchFolder folder;
    const std::string whole = binary_tetrahedron(false);
    for (size_t length = 0; length < whole.size(); ++length)
        expect_refused(write_file(folder, "a.ply", whole.substr(0, length)), Exit::bad_input, "");
}

TEST(PlyMesh, StripsAreWoundAlikeRestartAndSkipTheirGlue) {
    const ScratchFolder folder;
    // A strip of three triangles whose middle one is entered over a repeated index, then a restart and one more triangle.
    const MeshFile mesh = open_whole(write_file(folder, "a.ply",
                                                "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\n"
                                                "property float z\nelement tristrips 1\nproperty list int int vertex_indices\n"
                                                "end_header\n0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n5 0 0\n6 0 0\n5 1 0\n"
                                                "13 0 2 1 3 -1 2 4 3 3 -1 5 6 7\n"));
    EXPECT_EQ(mesh.report.triangle_count, 4u);
    EXPECT_EQ(mesh.report.strip_glue_count, 1u);
    EXPECT_EQ(mesh.report.flipped_face_count, 0u);
    EXPECT_EQ(mesh.report.component_count, 2u);
    EXPECT_EQ(area_of(mesh.mesh), 2);
}

TEST(PlyMesh, FacesMayComeBeforeVerticesAndBePolygonsWithTextureCoordinates) {
    const ScratchFolder folder;
    const MeshFile mesh =
        open_whole(write_file(folder, "a.ply",
                              "ply\nformat ascii 1.0\ncomment TextureFile a.png\nelement face 1\n"
                              "property list uchar int vertex_index\nproperty list uchar float texcoord\n"
                              "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
                              "4 0 1 2 3 8 0 0 1 0 1 1 0 1\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"));
    EXPECT_EQ(mesh.report.face_count, 2u);
    EXPECT_EQ(mesh.mesh.uvs.size(), 4u);
    EXPECT_EQ(mesh.mesh.uvs[mesh.mesh.face_uvs[0][0]], glm::vec2(0, 1));
    EXPECT_EQ(mesh.mesh.surfaces[0].texture, "a.png");
}

TEST(PlyMesh, UnusedVerticesMayBeNowhereAndFacesThatUseThemAreReported) {
    const ScratchFolder folder;
    const MeshFile mesh =
        open_whole(write_file(folder, "a.ply",
                              "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
                              "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
                              "0 0 0\n1 0 0\n0 1 0\nnan 0 0\ninf 0 0\n3 0 1 2\n3 0 1 3\n"));
    EXPECT_EQ(mesh.report.face_count, 1u);
    ASSERT_EQ(mesh.report.dropped.size(), 1u);
    EXPECT_EQ(mesh.report.dropped[0].source, 1u);
    EXPECT_EQ(mesh.report.dropped[0].reason, DropReason::not_finite);
}

TEST(PlyMesh, NamesThePlaceOfEachMistake) {
    const ScratchFolder folder;
    const std::string head =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n";
    const struct {
        std::string text;
        const char* words;
    } cases[] = {
        {head + "0 0 0\n1 0\n0 1 0\n3 0 1 2\n", "vertex 1: line 11: holds fewer values"},
        {head + "0 0 0\n1 0 0 0\n0 1 0\n3 0 1 2\n", "vertex 1: line 11: holds more values"},
        {head + "0 0 0\n1 0 x\n0 1 0\n3 0 1 2\n", "vertex 1: line 11: holds something that is no number"},
        {head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "face 0: vertex 3 does not exist, there are 3"},
        {head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -2\n", "face 0: vertex -2 does not exist"},
        {head + "0 0 0\n1 0 0\n0 1 0\n999 0 1 2\n", "a list is longer than the rest of the file"},
        {"ply\nformat ascii 1.0\nelement vertex 99999999999\nproperty float x\nend_header\n0\n", "99999999999 rows of vertex"},
        {"ply\nformat ascii 2.0\nend_header\n", ":2: only PLY 1.0 is read"},
        {"ply\nfromat ascii 1.0\nend_header\n", ":2: is no line of a PLY header"},
        {"ply\nformat ascii 1.0\nelement vertex 1\nproperty flota x\nend_header\n", ":4: the type of a property"},
        {"ply\nformat ascii 1.0\n", "ends within its header"}};
    for (const auto& c : cases) expect_refused(write_file(folder, "a.ply", c.text), Exit::bad_input, c.words);
}

}  // namespace
}  // namespace overlook::mesh::test
