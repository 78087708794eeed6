// Repair on meshes whose answer is known: what it may change, and what it must not.
#include <cmath>
#include <ctime>

#include "tests/tools/mesh_test_files.h"
#include "tools/bake/mesh/exact.h"
#include "tools/bake/mesh_repair.h"

namespace overlook::mesh::test {
namespace {

struct Repaired {
    Mesh mesh;
    MeshReport report;
};

Repaired repaired(const std::vector<glm::vec3>& positions, const std::vector<Corners>& faces) {
    Repaired r;
    r.mesh.positions_m = positions;
    r.mesh.faces = faces;
    r.mesh.surfaces.resize(1);
    r.mesh.face_surface.assign(faces.size(), 0);
    for (uint32_t f = 0; f < faces.size(); ++f) r.mesh.face_source.push_back(f);
    r.report.triangle_count = faces.size();
    repair(r.mesh, r.report);
    expect_whole({r.mesh, r.report, {}});
    return r;
}

const std::vector<glm::vec3> kTetrahedron = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const std::vector<Corners> kTetrahedronFaces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

// A grid of n x m quads over a rectangle of (u, v) in [0, 1]^2; the last row and column are joined to the first ones by `joined`.
template <class Joined, class Place>
Repaired surface(uint32_t n, uint32_t m, const Joined& joined, const Place& place) {
    std::vector<glm::vec3> positions((n + 1) * (m + 1));
    std::vector<Corners> faces;
    for (uint32_t i = 0; i <= n; ++i)
        for (uint32_t j = 0; j <= m; ++j) positions[i * (m + 1) + j] = place(double(i) / n, double(j) / m);
    for (uint32_t i = 0; i < n; ++i)
        for (uint32_t j = 0; j < m; ++j) {
            const uint32_t a = joined(i, j), b = joined(i + 1, j), c = joined(i + 1, j + 1), d = joined(i, j + 1);
            faces.push_back({a, b, c});
            faces.push_back({a, c, d});
        }
    return repaired(positions, faces);
}

TEST(MeshRepair, LeavesAGoodMeshAsItIs) {
    const Repaired r = repaired(kTetrahedron, kTetrahedronFaces);
    EXPECT_EQ(r.mesh.faces, kTetrahedronFaces);
    EXPECT_EQ(r.mesh.positions_m, kTetrahedron);
    EXPECT_TRUE(r.mesh.link.empty());
    EXPECT_EQ(r.report.closed_component_count, 1u);
}

TEST(MeshRepair, KeepsAnInsideOutMeshThatIsConsistent) {
    std::vector<Corners> room = kTetrahedronFaces;
    for (Corners& face : room) std::swap(face[1], face[2]);
    EXPECT_EQ(repaired(kTetrahedron, room).mesh.faces, room);
}

TEST(MeshRepair, TurnsAnyOneFaceThatIsWoundAgainstTheOthers) {
    for (size_t f = 0; f < 4; ++f) {
        std::vector<Corners> faces = kTetrahedronFaces;
        std::swap(faces[f][1], faces[f][2]);
        const Repaired r = repaired(kTetrahedron, faces);
        EXPECT_EQ(r.report.flipped_face_count, 1u);
        EXPECT_EQ(r.mesh.faces, kTetrahedronFaces);
    }
}

TEST(MeshRepair, TurnsAClosedPieceOutwardWhereTheFileIsUndecided) {
    std::vector<Corners> faces = kTetrahedronFaces;
    std::swap(faces[0][1], faces[0][2]);
    std::swap(faces[3][1], faces[3][2]);
    EXPECT_EQ(repaired(kTetrahedron, faces).mesh.faces, kTetrahedronFaces);
}

TEST(MeshRepair, NeverTurnsFacesThatAgreeWithTheirOwnNormals) {
    const ScratchFolder folder;
    const MeshFile mesh = open_whole(write_file(folder, "a.obj",
                                                "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvn 0 0 1\nvn 0 0 -1\n"
                                                "f 1//1 2//1 3//1\nf 2//2 3//2 4//2\n"));
    EXPECT_EQ(mesh.report.flipped_face_count, 0u);
    EXPECT_EQ(mesh.report.contradicting_edge_count, 1u);
    EXPECT_EQ(mesh.report.component_count, 2u);
    EXPECT_EQ(mesh.report.split_position_count, 2u);
}

TEST(MeshRepair, DropsAndReportsDuplicatesRepeatsAndFacesWithoutArea) {
    const Repaired r =
        repaired({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}}, {{0, 1, 2}, {1, 2, 0}, {0, 0, 1}, {0, 1, 3}, {1, 3, 2}});
    EXPECT_EQ(r.mesh.face_source, (std::vector<uint32_t>{0, 4}));
    ASSERT_EQ(r.report.dropped.size(), 3u);
    EXPECT_EQ(r.report.dropped[0].reason, DropReason::duplicate);
    EXPECT_EQ(r.report.dropped[0].twin, 0u);
    EXPECT_EQ(r.report.dropped[1].reason, DropReason::repeated_position);
    EXPECT_EQ(r.report.dropped[2].reason, DropReason::no_area);
}

TEST(MeshRepair, KeepsBackSidesOnSheetsOfTheirOwn) {
    const Repaired r = repaired({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}, {0, 2, 1}, {1, 2, 3}});
    EXPECT_EQ(r.report.back_side_count, 2u);
    EXPECT_EQ(r.report.face_count, 4u);
    EXPECT_EQ(r.report.component_count, 2u);
    EXPECT_EQ(r.report.position_count, 8u);
    EXPECT_TRUE(r.mesh.link.empty());
}

TEST(MeshRepair, JoinsTheFlattestPairAtAnEdgeOfThreeFacesAndLinksTheOther) {
    const Repaired r =
        repaired({{0, 0, 0}, {1, 0, 0}, {0.5f, 1, 0}, {0.5f, -1, 0}, {0.5f, 0.1f, 1}}, {{0, 1, 2}, {1, 0, 3}, {1, 0, 4}});
    EXPECT_EQ(r.report.complex_edge_count, 1u);
    EXPECT_EQ(r.report.cut_edge_count, 1u);
    EXPECT_EQ(r.report.component_count, 2u);
    EXPECT_EQ(r.report.position_count, 7u);
    EXPECT_EQ(r.mesh.faces[0], (Corners{0, 1, 2}));
    EXPECT_EQ(r.mesh.faces[1], (Corners{1, 0, 3}));
    EXPECT_EQ(r.mesh.link[r.mesh.faces[2][0]], 1u);
    EXPECT_EQ(r.mesh.link[r.mesh.faces[2][1]], 0u);
}

TEST(MeshRepair, SplitsAPositionWhereTwoConesTouch) {
    const Repaired r = repaired({{0, 0, 0}, {1, 0, 1}, {0, 1, 1}, {-1, -1, 1}, {1, 0, -1}, {0, 1, -1}, {-1, -1, -1}},
                                {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {0, 5, 4}, {0, 6, 5}, {0, 4, 6}});
    EXPECT_EQ(r.report.split_position_count, 1u);
    EXPECT_EQ(r.mesh.link.back(), 0u);
}

TEST(MeshRepair, CutsAMoebiusBandOnce) {
    const uint32_t n = 24, m = 4;
    const Repaired r = surface(
        n, m, [&](uint32_t i, uint32_t j) { return i == n ? m - j : i * (m + 1) + j; },
        [](double u, double v) {
            const double a = 2 * M_PI * u, w = v - 0.5;
            return glm::vec3((2 + w * std::cos(a / 2)) * std::cos(a), (2 + w * std::cos(a / 2)) * std::sin(a),
                             w * std::sin(a / 2));
        });
    EXPECT_GT(r.report.unorientable_edge_count, 0u);
    EXPECT_EQ(r.report.face_count, 2 * n * m);
    EXPECT_EQ(r.report.component_count, 1u);
    EXPECT_EQ(r.report.closed_component_count, 0u);
}

TEST(MeshRepair, CutsAKleinBottleAndLosesNoFace) {
    const uint32_t n = 24, m = 12;
    const Repaired r = surface(
        n, m, [&](uint32_t i, uint32_t j) { return i == n ? (m - j) % m : i * (m + 1) + j % m; },
        [](double u, double v) {  // the figure-8 immersion
            const double a = 2 * M_PI * u, b = 2 * M_PI * v;
            const double x = 3 + std::cos(a / 2) * std::sin(b) - std::sin(a / 2) * std::sin(2 * b);
            return glm::vec3(x * std::cos(a), x * std::sin(a), std::sin(a / 2) * std::sin(b) + std::cos(a / 2) * std::sin(2 * b));
        });
    EXPECT_GT(r.report.unorientable_edge_count, 0u);
    EXPECT_EQ(r.report.face_count, 2 * n * m);
    EXPECT_TRUE(r.report.dropped.empty());
}

// The projective plane of six positions: no turning agrees, and cuts end in the middle of sheets.
TEST(MeshRepair, TakesTheProjectivePlaneApartWithoutLosingAFace) {
    const std::vector<Corners> faces = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1},
                                        {1, 2, 4}, {2, 3, 5}, {3, 4, 1}, {4, 5, 2}, {5, 1, 3}};
    const Repaired r = repaired({{0, 0, 5}, {1, 0, 0}, {0.3f, 1, 0}, {-0.8f, 0.6f, 1}, {-0.8f, -0.6f, 0}, {0.3f, -1, 2}}, faces);
    EXPECT_EQ(r.report.face_count, 10u);
}

TEST(MeshRepair, AnySoupOfTrianglesComesOutWhole) {
    uint64_t state = 1;
    const auto random = [&](uint32_t below) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return uint32_t((state >> 33) % below);
    };
    for (int round = 0; round < 300; ++round) {
        const uint32_t count = 4 + random(9);
        std::vector<glm::vec3> positions;
        for (uint32_t i = 0; i < count; ++i) positions.emplace_back(float(i), float(random(4)), float(random(4)));
        std::vector<Corners> faces;
        for (uint32_t i = 0; i < 1 + random(60); ++i) faces.push_back({random(count), random(count), random(count)});
        (void)repaired(positions, faces);
    }
}

TEST(MeshRepair, ManyFacesAtOneEdgeStayLinearAndWhole) {
    std::vector<glm::vec3> positions = {{0, 0, 0}, {1, 0, 0}};
    std::vector<Corners> faces;
    for (uint32_t i = 0; i < 20000; ++i) {
        positions.emplace_back(0.5f, std::cos(float(i)), std::sin(float(i)));
        faces.push_back(i % 2 == 0 ? Corners{0, 1, i + 2} : Corners{1, 0, i + 2});
    }
    const Repaired r = repaired(positions, faces);
    EXPECT_EQ(r.report.complex_edge_count, 1u);
    EXPECT_EQ(r.report.component_count, 10000u);
}

TEST(MeshRepair, AMillionComponentsTakeTimeInProportion) {
    const auto seconds_for = [](uint32_t count) {
        Repaired r;
        r.mesh.surfaces.resize(1);
        for (uint32_t i = 0; i < count; ++i) {
            const float x = float(i % 1000), y = float(i / 1000);
            r.mesh.positions_m.insert(r.mesh.positions_m.end(), {{x, y, 0}, {x + 0.5f, y, 0}, {x, y + 0.5f, 0}});
            r.mesh.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
            r.mesh.face_source.push_back(i);
        }
        r.mesh.face_surface.assign(count, 0);
        r.report.triangle_count = count;
        const std::clock_t begin = std::clock();  // of this process, whatever else the machine does
        repair(r.mesh, r.report);
        EXPECT_EQ(r.report.component_count, count);
        EXPECT_EQ(first_fault(r.mesh), "");
        return double(std::clock() - begin) / CLOCKS_PER_SEC;
    };
    const double tenth = seconds_for(100'000), whole = seconds_for(1'000'000);
    EXPECT_LT(whole, 40 * tenth);  // 10 if linear; 100 if quadratic
}

TEST(CollinearTest, IsExactWhereRoundingIsNot) {
    EXPECT_TRUE(are_on_one_line({0, 0, 0}, {1, 2, 3}, {3, 6, 9}));
    EXPECT_TRUE(are_on_one_line({1e-20f, 0, 0}, {1e20f, 0, 0}, {7, 0, 0}));
    EXPECT_TRUE(are_on_one_line({5, 5, 5}, {5, 5, 5}, {1, 2, 3}));
    EXPECT_FALSE(are_on_one_line({0, 0, 0}, {1, 1, 1}, {2, 2, std::nextafter(2.0f, 3.0f)}));
    // The cross product of these in doubles is lost in its rounding.
    EXPECT_FALSE(are_on_one_line({1e15f, 1e15f, 0}, {0, 1e-15f, 0}, {0, 0, 0}));
    EXPECT_FALSE(are_on_one_line({1e30f, 1e30f, 0}, {1e30f, 1e30f, 1e-30f}, {0, 0, 0}));
}

}  // namespace
}  // namespace overlook::mesh::test
