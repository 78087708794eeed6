// Surface groups and classes of meshes whose answer is known by hand.
#include <gtest/gtest.h>

#include <ctime>
#include <set>

#include "tests/tools/caveclod_meshes.h"
#include "tools/bake/caveclod/groups.h"

namespace overlook::caveclod {
namespace {

Groups groups_of(const mesh::Mesh& mesh, const GroupOptions& options = {}) {
    Result<Groups> groups = find_groups(mesh, options);
    EXPECT_TRUE(groups.has_value()) << (groups ? "" : groups.error().message);
    return groups ? *groups : Groups{};
}

// free, sharp, rigid
std::array<uint64_t, 3> counts(const Groups& groups) {
    return {groups.free_count, groups.sharp_count, groups.rigid_count};
}
using Counts = std::array<uint64_t, 3>;

uint64_t count_of(const Groups& groups, FeatureKind kind) {
    return uint64_t(std::count_if(groups.features.begin(), groups.features.end(),
                                  [&](const FeatureEdge& feature) { return feature.kind == kind; }));
}

TEST(SurfaceGroups, FlatCubeHasSixAndAllItsCornersStay) {
    mesh::Mesh mesh = cube();
    shade_flat(mesh);
    Groups groups = groups_of(mesh);
    EXPECT_EQ(groups.group_surface.size(), 6u);
    EXPECT_EQ(counts(groups), (Counts{0, 0, 8}));
    EXPECT_EQ(groups.features.size(), 12u);
    EXPECT_EQ(count_of(groups, FeatureKind::between), 12u);
    EXPECT_EQ(groups.vertices.size(), 24u);
    EXPECT_EQ(groups.ambiguous_count, 0u);
    // Opposite sides share no position: three ids, and three sides do at every corner.
    EXPECT_EQ(groups.packed_count, 3u);
    EXPECT_EQ(groups.clique_bound, 3u);
    EXPECT_DOUBLE_EQ(groups.dense_population, 1);
    EXPECT_EQ(groups.dense_bytes, 4u * 3 * 8);
    EXPECT_EQ(groups.rows_bytes, 4u * 9 + 4 * 24);
    EXPECT_EQ(groups.fixed_face_count, 12u);
    EXPECT_EQ(groups.floor_face_estimate, 12u);
}

TEST(SurfaceGroups, CreaseAngleMakesTheCubesSidesAndNoneMakesOne) {
    Groups creased = groups_of(cube(), {.crease_deg = 60});
    EXPECT_EQ(creased.group_surface.size(), 6u);
    EXPECT_EQ(creased.vertices.size(), 24u);
    Groups just_smooth = groups_of(cube(), {.crease_deg = 90});
    EXPECT_EQ(just_smooth.group_surface.size(), 1u);
    Groups smooth = groups_of(cube());
    EXPECT_EQ(smooth.group_surface.size(), 1u);
    EXPECT_EQ(counts(smooth), (Counts{8, 0, 0}));
    EXPECT_EQ(smooth.vertices.size(), 8u);
    EXPECT_EQ(smooth.floor_face_estimate, 4u);  // a tetrahedron
    // By symmetry a corner's made normal lies on the diagonal, however its sides are split.
    for (const RenderVertex& vertex : smooth.vertices) {
        glm::vec3 diagonal = glm::normalize(mesh::Mesh(cube()).positions_m[vertex.position] - glm::vec3(0.5f));
        EXPECT_NEAR(glm::dot(diagonal, vertex.normal), 1, 1e-6);
    }
}

// Along two edges of the cube, 0-1 and 1-3, whose middle alone has two looks: sharp, and the ends stay.
TEST(SurfaceGroups, SeamInsideAGroupKeepsItsEndsAndBothSides) {
    mesh::Mesh mesh = cube();
    set_uvs(mesh, [&](uint32_t face, uint32_t corner) {
        bool is_other_side = mesh.faces[face][corner] == 1 && (face / 2 == 2 || face / 2 == 5);
        return glm::vec2(is_other_side ? 1 : 0, 0);
    });
    Groups groups = groups_of(mesh);
    EXPECT_EQ(groups.group_surface.size(), 1u);
    EXPECT_EQ(counts(groups), (Counts{5, 1, 2}));
    EXPECT_EQ(groups.kind[0], PositionKind::rigid);
    EXPECT_EQ(groups.kind[1], PositionKind::sharp);
    EXPECT_EQ(groups.kind[3], PositionKind::rigid);
    EXPECT_EQ(count_of(groups, FeatureKind::seam), 2u);
    EXPECT_EQ(groups.vertices.size(), 9u);
    EXPECT_EQ(groups.vertex_begin[2] - groups.vertex_begin[1], 2u);
    EXPECT_EQ(groups.ambiguous_count, 1u);
    EXPECT_EQ(groups.packed_count, 1u);
    // Without texture coordinates nothing is left of the seam.
    EXPECT_EQ(counts(groups_of(mesh, {.ignores_uv = true})), (Counts{8, 0, 0}));
}

TEST(SurfaceGroups, UnwrappedCylinderTouchesItself) {
    Groups groups = groups_of(unwrapped_cylinder(8, 5));
    EXPECT_EQ(groups.group_surface.size(), 1u);
    // The seam's two ends lie on borders; the rest of it and of the borders is sharp.
    EXPECT_EQ(counts(groups), (Counts{4 * 7, 4 + 2 * 7, 2}));
    EXPECT_EQ(count_of(groups, FeatureKind::seam), 5u);
    EXPECT_EQ(count_of(groups, FeatureKind::border), 16u);
    EXPECT_EQ(groups.vertices.size(), 48u + 6);
    EXPECT_EQ(groups.ambiguous_count, 6u);
    EXPECT_EQ(groups.packed_count, 1u);
    EXPECT_DOUBLE_EQ(groups.dense_population, 1);
    // A triangular prism's side; the two positions of the seam alone have no face.
    EXPECT_EQ(groups.floor_face_estimate, 6u);
    EXPECT_EQ(groups.fixed_face_count, 0u);
}

TEST(SurfaceGroups, PlaneIsOneWhoseBorderIsOneCurve) {
    Groups groups = groups_of(plane(6, 4));
    EXPECT_EQ(groups.group_surface.size(), 1u);
    // Its corners too lie on that one boundary: the paper's classes know no angles.
    EXPECT_EQ(counts(groups), (Counts{5 * 3, 20, 0}));
    EXPECT_EQ(groups.vertices.size(), 35u);
    EXPECT_EQ(groups.floor_face_estimate, 1u);
    for (const RenderVertex& vertex : groups.vertices) EXPECT_EQ(vertex.normal, glm::vec3(0, 0, 1));
}

TEST(SurfaceGroups, TextureBorderOfAPlaneIsSharpAndEndsRigid) {
    mesh::Mesh mesh = plane(6, 4);
    mesh.surfaces.resize(2);
    for (uint32_t face = 0; face < mesh.faces.size(); ++face) mesh.face_surface[face] = face / 2 % 6 >= 2;
    Groups groups = groups_of(mesh);
    EXPECT_EQ(groups.group_surface, (std::vector<uint32_t>{0, 1}));
    EXPECT_EQ(counts(groups), (Counts{4 * 3, 3 + 18, 2}));
    EXPECT_EQ(count_of(groups, FeatureKind::between), 4u);
    EXPECT_EQ(groups.vertices.size(), 35u + 5);
    EXPECT_EQ(groups.ambiguous_count, 0u);
    EXPECT_EQ(groups.packed_count, 2u);
    EXPECT_DOUBLE_EQ(groups.dense_population, 40.0 / 70);
    EXPECT_EQ(groups.feature_ends[groups.feature_begin[2]], 1u);
    EXPECT_EQ(groups.feature_begin[3] - groups.feature_begin[2], 3u);
    // Two triangles on an edge.
    EXPECT_EQ(groups.floor_face_estimate, 2u);
}

// A slit of the texture from the border's position 3 up to position 17, two cells inside.
TEST(SurfaceGroups, DartEndsInARigidTip) {
    mesh::Mesh mesh = plane(6, 4);
    set_uvs(mesh, [&](uint32_t face, uint32_t corner) {
        uint32_t position = mesh.faces[face][corner];
        bool is_right_of_slit = face / 2 % 6 >= 3 && (position == 3 || position == 10);
        return glm::vec2(float(position % 7) + (is_right_of_slit ? 0.25f : 0.0f), float(position / 7));
    });
    Groups groups = groups_of(mesh);
    EXPECT_EQ(groups.group_surface.size(), 1u);
    EXPECT_EQ(groups.kind[3], PositionKind::rigid);
    EXPECT_EQ(groups.kind[10], PositionKind::sharp);
    EXPECT_EQ(groups.kind[17], PositionKind::rigid);
    EXPECT_EQ(counts(groups), (Counts{15 - 2, 19 + 1, 2}));
    EXPECT_EQ(count_of(groups, FeatureKind::seam), 2u);
    EXPECT_EQ(groups.vertex_begin[18] - groups.vertex_begin[17], 1u);  // one look at the tip
    EXPECT_EQ(groups.ambiguous_count, 2u);
}

TEST(SurfaceGroups, TwoTrianglesAreAllBorder) {
    Groups groups = groups_of(plane(1, 1));
    EXPECT_EQ(counts(groups), (Counts{0, 4, 0}));
    Groups one = groups_of(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
    EXPECT_EQ(counts(one), (Counts{0, 3, 0}));
    EXPECT_EQ(one.floor_face_estimate, 1u);
}

TEST(SurfaceGroups, TrianglesThatTouchInAPointStayThere) {
    Groups groups = groups_of(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}));
    EXPECT_EQ(groups.kind[0], PositionKind::rigid);
    EXPECT_EQ(counts(groups), (Counts{0, 4, 1}));
    EXPECT_EQ(groups.group_surface.size(), 2u);
    EXPECT_EQ(groups.packed_count, 2u);
    EXPECT_EQ(groups.floor_face_estimate, 2u);
}

TEST(SurfaceGroups, EdgesOfManyFacesAndOfTwoThatDisagreeAreBorders) {
    // Three faces on the edge 0-1.
    Groups three =
        groups_of(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
    EXPECT_EQ(three.group_surface.size(), 3u);
    EXPECT_EQ(counts(three), (Counts{0, 3, 2}));
    EXPECT_EQ(three.features.size(), 7u);
    // Two that run along it the same way.
    Groups turned = groups_of(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 1, 3}}));
    EXPECT_EQ(turned.group_surface.size(), 2u);
    EXPECT_EQ(counts(turned), (Counts{0, 2, 2}));
}

TEST(SurfaceGroups, CutKleinBottleStaysLinkedWhereItWasCut) {
    Groups groups = groups_of(cut_klein_bottle(8, 6));
    EXPECT_EQ(groups.group_surface.size(), 1u);
    EXPECT_EQ(counts(groups), (Counts{5 * 8, 0, 16}));
    EXPECT_EQ(count_of(groups, FeatureKind::border), 16u);
}

TEST(SurfaceGroups, CutTetrahedraMoveNowhereButAtTheirOwnTips) {
    Groups groups = groups_of(cut_tetrahedra(5));
    EXPECT_EQ(groups.group_surface.size(), 5u);
    EXPECT_EQ(counts(groups), (Counts{5, 0, 15}));
    EXPECT_EQ(groups.packed_count, 1u);  // cut apart they share no position
    EXPECT_EQ(groups.fixed_face_count, 5u);
    EXPECT_EQ(groups.floor_face_estimate, 20u);
}

TEST(SurfaceGroups, PositionsWithoutFacesStay) {
    mesh::Mesh mesh = plane(2, 2);
    mesh.positions_m.emplace_back(9, 9, 9);
    Groups groups = groups_of(mesh);
    EXPECT_EQ(groups.kind.back(), PositionKind::rigid);
    EXPECT_EQ(groups.vertex_begin[10] - groups.vertex_begin[9], 0u);
    Groups none = groups_of(mesh_of({}, {}));
    EXPECT_EQ(none.vertices.size(), 0u);
    EXPECT_EQ(none.packed_count, 0u);
    EXPECT_EQ(none.dense_population, 0);
}

TEST(SurfaceGroups, WeldedNormalsTurnNoCornerFurtherThanAsked) {
    mesh::Mesh mesh = unwrapped_cylinder(24, 3);
    mesh.face_uvs.clear();
    shade_flat(mesh);
    Groups flat = groups_of(mesh);
    EXPECT_EQ(flat.group_surface.size(), 24u);
    EXPECT_EQ(flat.packed_count, 2u);                                                // every other side
    EXPECT_EQ(groups_of(mesh, {.weld_normals_deg = 14}).group_surface.size(), 24u);  // the sides turn by 15 degrees
    Groups welded = groups_of(mesh, {.weld_normals_deg = 16});
    EXPECT_EQ(welded.group_surface.size(), 1u);
    EXPECT_EQ(welded.vertices.size(), 24u * 4);
    for (uint32_t face = 0; face < mesh.faces.size(); ++face)
        for (uint32_t corner = 0; corner < 3; ++corner) {
            glm::vec3 own = mesh.normals[mesh.face_normals[face][corner]];
            EXPECT_GT(glm::dot(own, welded.vertices[welded.face_vertices[face][corner]].normal), std::cos(16 * 3.14159265 / 180));
        }
    // Round a steep cone's tip each facet is near the next, but the mean far from all: it is left alone.
    std::vector<glm::vec3> positions = {{0, 0, 4}};
    std::vector<FaceCorners> faces;
    for (uint32_t i = 0; i < 24; ++i) {
        positions.emplace_back(std::cos(i * 0.2617993878), std::sin(i * 0.2617993878), 0);
        faces.push_back({0, 1 + i, 1 + (i + 1) % 24});
    }
    mesh::Mesh cone = mesh_of(positions, faces);
    shade_flat(cone);
    Groups tip = groups_of(cone, {.weld_normals_deg = 16});
    EXPECT_EQ(tip.vertex_begin[1], 24u);
    EXPECT_EQ(tip.vertices.size(), 24u + 48);
}

TEST(SurfaceGroups, LeaveTheFilesNormalsAsTheyAreAndMakeWhatIsMissing) {
    mesh::Mesh mesh = plane(1, 1);
    mesh.normals = {{0.6f, 0, 0.8f}, {0, 0, 0}, {0, 3, 4}};
    mesh.face_normals = {{0, mesh::kNone, 1}, {0, 1, 2}};
    Groups groups = groups_of(mesh);
    auto normal = [&](uint32_t face, uint32_t corner) { return groups.vertices[groups.face_vertices[face][corner]].normal; };
    EXPECT_EQ(normal(0, 0), glm::vec3(0.6f, 0, 0.8f));
    EXPECT_EQ(normal(0, 1), glm::vec3(0, 0, 1));
    EXPECT_EQ(normal(0, 2), glm::vec3(0, 0, 1));
    EXPECT_EQ(normal(1, 2), glm::vec3(0, 0.6f, 0.8f));
}

TEST(SurfaceGroups, TellApartWhatSecondTextureCoordinatesDo) {
    mesh::Mesh mesh = plane(2, 1);
    mesh.uvs2 = {{0, 0}, {1, 1}};
    for (uint32_t face = 0; face < 4; ++face) mesh.face_uvs2.push_back(face < 2 ? FaceCorners{0, 0, 0} : FaceCorners{1, 1, 1});
    Groups groups = groups_of(mesh);
    EXPECT_EQ(groups.group_surface.size(), 2u);
    ASSERT_EQ(groups.vertex_uv2.size(), groups.vertices.size());
    EXPECT_EQ(groups.vertex_uv2[groups.face_vertices[3][0]], glm::vec2(1, 1));
}

TEST(SurfaceGroups, RefuseMoreAtOnePositionThanIdsTellApart) {
    const uint32_t count = 66'000;
    std::vector<glm::vec3> positions = {{0, 0, 1}};
    std::vector<FaceCorners> faces;
    for (uint32_t i = 0; i < count; ++i) {
        double angle = 6.283185307179586 * i / count;
        positions.emplace_back(1000 * std::cos(angle), 1000 * std::sin(angle), float(i % 2));
        faces.push_back({0, 1 + i, 1 + (i + 1) % count});
    }
    mesh::Mesh mesh = mesh_of(positions, faces);
    mesh.surfaces.resize(count);
    for (uint32_t i = 0; i < count; ++i) mesh.face_surface[i] = i;
    Result<Groups> groups = find_groups(mesh, {});
    ASSERT_FALSE(groups.has_value());
    EXPECT_EQ(groups.error().exit, Exit::impossible);
    EXPECT_NE(groups.error().message.find("--weld-normals"), std::string::npos) << groups.error().message;
}

// Four times the faces take about four times as long (time of the processor, the least of some runs), nowhere near sixteen.
TEST(SurfaceGroups, TakeTimeInProportionToFaces) {
    auto seconds = [](uint32_t side) {
        mesh::Mesh mesh = plane(side, side);
        mesh.surfaces.resize(4);
        for (uint32_t face = 0; face < mesh.faces.size(); ++face)
            mesh.face_surface[face] = face / 2 % side / 9 % 2 + 2 * (face / 2 / side / 9 % 2);
        double least = 1e9;
        for (int run = 0; run < 3; ++run) {
            std::clock_t begin = std::clock();
            Groups groups = groups_of(mesh);
            least = std::min(least, double(std::clock() - begin) / CLOCKS_PER_SEC);
            EXPECT_EQ(groups.packed_count, 4u);
        }
        return least;
    };
    double small = seconds(354), large = seconds(708);  // 250,632 and 1,002,528 faces
    EXPECT_LT(large, 9 * small);
    RecordProperty("million_faces_ms", int(large * 1000));
}

}  // namespace
}  // namespace overlook::caveclod
