// OBJ, OFF and STL: each feature on a mesh whose answer is known by hand.
#include <glm/geometric.hpp>

#include "tests/tools/mesh_test_files.h"

namespace overlook::mesh::test {
namespace {

const char* const kCube =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

TEST(ObjMesh, CubeOfQuadsIsClosedAndHasItsArea) {
    const ScratchFolder folder;
    const MeshFile cube = open_whole(write_file(folder, "cube.obj", kCube));
    EXPECT_EQ(cube.report.polygon_count, 6u);
    EXPECT_EQ(cube.report.face_count, 12u);
    EXPECT_EQ(cube.report.position_count, 8u);
    EXPECT_EQ(cube.report.component_count, 1u);
    EXPECT_EQ(cube.report.closed_component_count, 1u);
    EXPECT_EQ(cube.report.flipped_face_count, 0u);
    EXPECT_EQ(area_of(cube.mesh), 6);
    EXPECT_TRUE(cube.mesh.link.empty());
}

TEST(ObjMesh, NegativeIndicesCountBackFromTheLastVertexRead) {
    const ScratchFolder folder;
    const MeshFile mesh = open_whole(write_file(folder, "a.obj", "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\n"));
    ASSERT_EQ(mesh.mesh.faces.size(), 1u);
    EXPECT_EQ(corner_m(mesh.mesh, 0, 0), glm::vec3(0, 0, 0));
    EXPECT_EQ(corner_m(mesh.mesh, 0, 2), glm::vec3(0, 1, 0));
    EXPECT_EQ(mesh.report.unused_position_count, 2u);
}

// An L: a fan from its first corner would cover area outside it.
TEST(ObjMesh, ConcavePolygonKeepsItsAreaWhereverItBegins) {
    const ScratchFolder folder;
    const std::string vertices = "v 0 0 7\nv 2 0 7\nv 2 1 7\nv 1 1 7\nv 1 2 7\nv 0 2 7\n";
    for (int begin = 0; begin < 6; ++begin) {
        std::string face = "f";
        for (int i = 0; i < 6; ++i) face += " " + std::to_string((begin + i) % 6 + 1);
        const MeshFile mesh = open_whole(write_file(folder, "l.obj", vertices + face + "\n"));
        EXPECT_EQ(mesh.report.face_count, 4u);
        EXPECT_EQ(area_of(mesh.mesh), 3) << "from corner " << begin;
        for (size_t f = 0; f < mesh.mesh.faces.size(); ++f) {
            const glm::vec3 a = corner_m(mesh.mesh, f, 0), b = corner_m(mesh.mesh, f, 1), c = corner_m(mesh.mesh, f, 2);
            EXPECT_GT(glm::cross(b - a, c - a).z, 0);
        }
    }
}

// A square with a square hole, joined to it by an edge that is walked twice.
TEST(ObjMesh, PolygonWithABridgedHoleKeepsTheHole) {
    const ScratchFolder folder;
    const MeshFile mesh = open_whole(write_file(folder, "hole.obj",
                                                "v 0 0 0\nv 3 0 0\nv 3 3 0\nv 0 3 0\nv 1 1 0\nv 1 2 0\nv 2 2 0\nv 2 1 0\n"
                                                "f 1 2 3 4 1 5 6 7 8 5\n"));
    EXPECT_EQ(area_of(mesh.mesh), 8);
}

TEST(ObjMesh, CornersKeepTheirOwnAttributes) {
    const ScratchFolder folder;
    const MeshFile mesh = open_whole(write_file(folder, "a.obj",
                                                "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n"
                                                "vt 0.25 0.75\nvt 0.5 0.5\nvt 0.25 0.75\nvn 0 0 2\nvn 0 0 1\n"
                                                "f 1/1/1 2/2/2 3/3/1\nf 2//1 4//2 3//1\n"));
    ASSERT_EQ(mesh.mesh.faces.size(), 2u);
    ASSERT_EQ(mesh.mesh.uvs.size(), 2u);      // the first and the third are one value
    ASSERT_EQ(mesh.mesh.normals.size(), 1u);  // of length 1 both are one
    EXPECT_EQ(mesh.mesh.uvs[mesh.mesh.face_uvs[0][0]], glm::vec2(0.25f, 0.25f));
    EXPECT_EQ(mesh.mesh.face_uvs[0][0], mesh.mesh.face_uvs[0][2]);
    EXPECT_EQ(mesh.mesh.face_uvs[1], (Corners{kNone, kNone, kNone}));
    EXPECT_EQ(mesh.mesh.face_normals[1], (Corners{0, 0, 0}));
}

TEST(ObjMesh, ColoursByVertexAreRead) {
    const ScratchFolder folder;
    const MeshFile mesh = open_whole(write_file(folder, "a.obj", "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 0.5\nf 1 2 3\n"));
    ASSERT_EQ(mesh.mesh.colours.size(), 3u);
    EXPECT_EQ(mesh.mesh.colours[mesh.mesh.face_colours[0][0]], (std::array<uint8_t, 4>{255, 0, 0, 255}));
    EXPECT_EQ(mesh.mesh.colours[mesh.mesh.face_colours[0][2]], (std::array<uint8_t, 4>{0, 0, 128, 255}));
}

TEST(ObjMesh, MaterialsComeFromTheirLibraryWithTextureOptionsAndSpaces) {
    const ScratchFolder folder;
    write_file(folder, "my bricks.png", "not looked into");
    write_file(folder, "a.mtl",
               "newmtl red\nKd 1 0 0.5\nd 0.25\nnewmtl brick\nmap_Kd -s 2 2 -clamp on textures\\my bricks.png\n");
    const MeshFile mesh = open_whole(write_file(folder, "a.obj",
                                                "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n"
                                                "usemtl red\nf 1 2 3\ng other\nusemtl brick\nf 2 4 3\n"));
    ASSERT_EQ(mesh.mesh.surfaces.size(), 2u);
    EXPECT_EQ(mesh.mesh.face_surface, (std::vector<uint32_t>{0, 1}));
    EXPECT_EQ(mesh.mesh.surfaces[0].base_colour, glm::vec4(1, 0, 0.5f, 0.25f));
    EXPECT_EQ(mesh.mesh.surfaces[1].texture, "my bricks.png");
    EXPECT_EQ(mesh.mesh.surfaces[1].texture_bytes.size(), 15u);
    EXPECT_TRUE(mesh.report.notes.empty());
}

TEST(ObjMesh, MissingLibraryAndMissingTextureAreNotedInALineEach) {
    const ScratchFolder folder;
    write_file(folder, "there.mtl", "newmtl a\nmap_Kd gone.png\n");
    const MeshFile mesh =
        open_whole(write_file(folder, "a.obj", "mtllib gone.mtl there.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n"));
    ASSERT_EQ(mesh.report.notes.size(), 2u);
    EXPECT_NE(mesh.report.notes[0].find("gone.mtl cannot be read"), std::string::npos);
    EXPECT_NE(mesh.report.notes[1].find("gone.png cannot be read"), std::string::npos);
}

TEST(ObjMesh, LibraryOutsideTheFolderIsNotOpened) {
    const ScratchFolder folder;
    std::filesystem::create_directory(folder / "in");
    write_file(folder, "secret.mtl", "newmtl a\nKd 0 0 0\n");
    const MeshFile mesh =
        open_whole(write_file(folder, "in/a.obj", "mtllib ../secret.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n"));
    EXPECT_EQ(mesh.mesh.surfaces[0].base_colour, glm::vec4(1));
}

TEST(ObjMesh, CommentsMayEndALineAndBackslashesJoinLines) {
    const ScratchFolder folder;
    const MeshFile mesh =
        open_whole(write_file(folder, "a.obj", "v 0 0 0 # one\r\nv 1 \\\n0 0\nv 0 1 0\nf 1 2 \\\n3 # a face\n"));
    EXPECT_EQ(mesh.report.face_count, 1u);
}

TEST(ObjMesh, NamesTheLineOfEachMistake) {
    const ScratchFolder folder;
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    const struct {
        const char *text, *words;
    } cases[] = {{"f 1 2 4\n", ":4: vertex 4 does not exist, there are 3"},
                 {"f 1 2 0\n", ":4: corner 3 of a face"},
                 {"f 1 2 -4\n", ":4: corner 3 of a face"},
                 {"f 1 2 x\n", ":4: corner 3 of a face is not v"},
                 {"f 1/1 2/2 3/3\n", "texture coordinate 3, there are 0"},
                 {"f 1//1 2//1 3//9\n", "normal 9, there are 0"},
                 {"v 1 2\n", ":4: a vertex is three numbers"},
                 {"f 1 2 99999999999\n", ":4: corner 3"}};
    for (const auto& c : cases) expect_refused(write_file(folder, "a.obj", vertices + c.text), Exit::bad_input, c.words);
}

TEST(OffMesh, ReadsNormalsColoursCommentsAndPolygons) {
    const ScratchFolder folder;
    const MeshFile mesh =
        open_whole(write_file(folder, "a.off",
                              "CNOFF # colours and normals\n4 1 0\n0 0 0 0 0 1 255 0 0 255\n\n1 0 0 0 0 1 0 255 0 255\n"
                              "# between\n1 1 0 0 0 1 0 0 255 255\n0 1 0 0 0 1 9 9 9 255\n4 0 1 2 3 0.5 0.5 0.5\n"));
    EXPECT_EQ(mesh.report.face_count, 2u);
    EXPECT_EQ(mesh.mesh.normals.size(), 1u);
    EXPECT_EQ(mesh.mesh.colours.size(), 4u);
    EXPECT_EQ(area_of(mesh.mesh), 1);
}

TEST(OffMesh, CountsMayStandOnTheFirstLineAndFacesMayHaveColours) {
    const ScratchFolder folder;
    const MeshFile mesh = open_whole(write_file(folder, "a.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 1.0 0.0 0.0\n"));
    ASSERT_EQ(mesh.mesh.colours.size(), 1u);
    EXPECT_EQ(mesh.mesh.colours[0], (std::array<uint8_t, 4>{255, 0, 0, 255}));
}

TEST(OffMesh, NamesTheLineOfEachMistake) {
    const ScratchFolder folder;
    const struct {
        const char *text, *words;
    } cases[] = {{"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", ":6: vertex 3 does not exist, there are 3"},
                 {"OFF\n3 1 0\n0 0 0\n1 0 0\n", "ends after 2 of 3 vertices"},
                 {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n", "ends after 0 of 1 faces"},
                 {"OFF\n99999999 1 0\n0 0 0\n", "do not fit"},
                 {"OFF BINARY\n", "binary OFF is not read"},
                 {"4OFF\n1 1 0\n", "four or of n dimensions"},
                 {"OFF\n3 1 0\n0 0 0 7\n1 0 0\n0 1 0\n3 0 1 2\n", ":3: a vertex has 1 numbers too many"}};
    for (const auto& c : cases) expect_refused(write_file(folder, "a.off", c.text), Exit::bad_input, c.words);
}

std::string binary_stl(const std::vector<std::array<glm::vec3, 3>>& facets, const std::string& header) {
    std::string bytes = header + std::string(80 - header.size(), ' ') + bytes_of(uint32_t(facets.size()));
    for (const auto& facet : facets) {
        bytes += std::string(12, '\0');
        for (const glm::vec3& p : facet) bytes += bytes_of(p.x) + bytes_of(p.y) + bytes_of(p.z);
        bytes += std::string(2, '\0');
    }
    return bytes;
}

TEST(StlMesh, BinaryIsKnownByItsLengthEvenIfItBeginsWithSolidAndEqualsAscii) {
    const ScratchFolder folder;
    const MeshFile binary = open_whole(write_file(
        folder, "a.stl",
        binary_stl({{{{0, 0, 0}, {0.1f, 0, 0}, {0, 1, 0}}}, {{{0.1f, 0, 0}, {1, 1, 0}, {0, 1, 0}}}}, "solid a facet")));
    const MeshFile ascii =
        open_whole(write_file(folder, "b.stl",
                              "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0.1 0 0\nvertex 0 1 0\n"
                              "endloop\nendfacet\nfacet normal 0 0 1\n outer loop\nvertex +0.1 0 0\nvertex 1 1e0 0\n"
                              "vertex 0 1 -0\nendloop\nendfacet\nendsolid a\n"));
    EXPECT_EQ(binary.report.form, "STL binary");
    EXPECT_EQ(ascii.report.form, "STL ascii");
    EXPECT_EQ(binary.report.welded_position_count, 2u);
    EXPECT_EQ(binary.mesh.positions_m, ascii.mesh.positions_m);
    EXPECT_EQ(binary.mesh.faces, ascii.mesh.faces);
}

TEST(StlMesh, RefusesEveryTruncationOfABinaryFile) {
    const ScratchFolder folder;
    const std::string whole = binary_stl({{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}}, "two");
    for (size_t length = 0; length < whole.size(); ++length)
        expect_refused(write_file(folder, "a.stl", whole.substr(0, length)), Exit::bad_input, "");
}

TEST(StlMesh, AsciiMayBeInCapitals) {
    const ScratchFolder folder;
    EXPECT_EQ(open_whole(write_file(folder, "a.stl",
                                    "SOLID A\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\nVERTEX 0 1 0\nENDLOOP\n"
                                    "ENDFACET\nENDSOLID\n"))
                  .report.face_count,
              1u);
}

TEST(StlMesh, AsciiThatEndsWithinAFacetIsRefused) {
    const ScratchFolder folder;
    expect_refused(write_file(folder, "a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"),
                   Exit::bad_input, "ends within a facet");
    expect_refused(write_file(folder, "a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n"), Exit::bad_input,
                   ":4: a vertex is three numbers");
}

}  // namespace
}  // namespace overlook::mesh::test
