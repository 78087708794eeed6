// The judge judged: check_cut accepts a mesh that is right by hand, and finds each kind of mistake.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/cli/check_cut/check.h"
#include "tests/cli/inputs.h"
#include "tests/cli/run_command.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::cli {
namespace {

constexpr uint32_t kSide = 5;
constexpr int kVoidColumn = 3, kVoidRow = 1;

struct Mesh {
    std::vector<std::array<float, 3>> vertices;
    std::vector<std::array<int32_t, 3>> triangles;
};

int height_m(uint32_t column, uint32_t row) {
    return int(100 + 3 * column * column + 5 * row + column * row);
}

// 5 x 5 samples, the one at column 3, row 1 void.
int height_or_void_m(uint32_t column, uint32_t row) {
    return column == kVoidColumn && row == kVoidRow ? -32768 : height_m(column, row);
}

// Every finest triangle that has no void corner.
Mesh finest_mesh() {
    Mesh mesh;
    for (uint32_t row = 0; row < kSide; ++row)
        for (uint32_t column = 0; column < kSide; ++column)
            mesh.vertices.push_back({float(column), float(row), float(height_m(column, row))});
    auto add = [&](int32_t a, int32_t b, int32_t c) {
        constexpr int32_t kVoid = kVoidRow * int32_t(kSide) + kVoidColumn;
        if (a != kVoid && b != kVoid && c != kVoid) mesh.triangles.push_back({a, b, c});
    };
    for (int32_t row = 0; row < 4; ++row)
        for (int32_t column = 0; column < 4; ++column) {
            int32_t a = row * 5 + column, b = a + 1, d = a + 5, c = d + 1;
            if ((row + column) % 2 == 0)
                add(a, b, c), add(a, c, d);
            else
                add(a, b, d), add(b, c, d);
        }
    return mesh;
}

void write_ply(const std::string& path, const Mesh& mesh) {
    std::string out = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.vertices.size()) +
                      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                      std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const auto& vertex : mesh.vertices) out.append(reinterpret_cast<const char*>(vertex.data()), 12);
    for (const auto& triangle : mesh.triangles) out += char(3), out.append(reinterpret_cast<const char*>(triangle.data()), 12);
    write_text(path, out);
}

check_cut::Report judge(const Mesh& mesh, double tolerance_m) {
    check_cut::Raster raster{kSide, kSide, {}};
    for (uint32_t i = 0; i < kSide * kSide; ++i) {
        int height = height_or_void_m(i % kSide, i / kSide);
        raster.heights_m.push_back(height == -32768 ? std::nan("") : height);
    }
    check_cut::Mesh same;
    for (const auto& v : mesh.vertices) same.vertices.push_back({v[0], v[1], v[2]});
    for (const auto& t : mesh.triangles) same.triangles.push_back({uint32_t(t[0]), uint32_t(t[1]), uint32_t(t[2])});
    return check_cut::check(same, raster, tolerance_m);
}

// The same by the program.
Ran judge_files(const Mesh& mesh, const char* tolerance_m) {
    ScratchFolder folder;
    write_hgt(folder / "dem.hgt", kSide, height_or_void_m);
    write_ply(folder / "cut.ply", mesh);
    return run({"check_cut", folder / "cut.ply", folder / "dem.hgt", "--tolerance-m", tolerance_m});
}

// The samples north and east of the void have no triangle without it.
TEST(CheckCut, AcceptsTheFinestTriangulation) {
    Ran ran = judge_files(finest_mesh(), "0");
    EXPECT_EQ(ran.exit, 0) << ran.out << ran.err;
    EXPECT_EQ(ran.out.rfind("{\"sound\": true, \"triangles\": 24, \"samples_covered\": 21, \"valid_samples_uncovered\": 3, ", 0),
              0u)
        << ran.out;
    EXPECT_EQ(ran.out, check_cut::to_json(judge(finest_mesh(), 0)) + "\n");
}

TEST(CheckCut, EndsWithOneWhereTheCutIsNotSound) {
    Mesh mesh = finest_mesh();
    mesh.vertices[12][2] += 0.51f;
    Ran ran = judge_files(mesh, "0.5");
    EXPECT_EQ(ran.exit, 1);
    EXPECT_EQ(ran.out.rfind("{\"sound\": false, ", 0), 0u) << ran.out;
}

// Four cells far from the void as two triangles: right at a tolerance that the bulge of the ground allows, wrong below.
TEST(CheckCut, MeasuresACoarserPatch) {
    Mesh mesh = finest_mesh();
    auto is_in_patch = [](const std::array<int32_t, 3>& t) {
        for (int32_t i : t)
            if (i % 5 > 2 || i / 5 < 2) return false;
        return true;
    };
    std::erase_if(mesh.triangles, is_in_patch);
    mesh.triangles.push_back({10, 11, 16});  // its right and upper sides keep their corners
    mesh.triangles.push_back({11, 12, 16});
    mesh.triangles.push_back({12, 17, 16});
    mesh.triangles.push_back({17, 22, 16});
    mesh.triangles.push_back({22, 20, 16});  // the long sides on the raster's border skip 21 and 15
    mesh.triangles.push_back({20, 10, 16});
    EXPECT_TRUE(judge(mesh, 3.01).is_sound()) << check_cut::to_json(judge(mesh, 3.01));
    check_cut::Report report = judge(mesh, 2.99);
    EXPECT_FALSE(report.is_sound());
    EXPECT_DOUBLE_EQ(report.greatest_deviation_m, 3);
    EXPECT_EQ(report.samples_beyond_tolerance, 1u);
}

TEST(CheckCut, FindsAVertexMovedInHeight) {
    Mesh mesh = finest_mesh();
    mesh.vertices[12][2] += 0.51f;
    EXPECT_EQ(judge(mesh, 0.5).samples_beyond_tolerance, 6u);  // once in each of its triangles
    EXPECT_TRUE(judge(mesh, 0.52).is_sound());
}

TEST(CheckCut, FindsAVertexMovedAside) {
    Mesh mesh = finest_mesh();
    mesh.vertices[12][0] += 1;
    EXPECT_FALSE(judge(mesh, 1000).is_sound());
    mesh.vertices[12][0] -= 0.5f;
    EXPECT_EQ(judge(mesh, 1000).misplaced_corners, 6u);
}

TEST(CheckCut, FindsATriangleThatIsMissing) {
    for (size_t i = 0; i < finest_mesh().triangles.size(); ++i) {
        Mesh mesh = finest_mesh();
        mesh.triangles.erase(mesh.triangles.begin() + std::ptrdiff_t(i));
        check_cut::Report report = judge(mesh, 0);
        EXPECT_EQ(report.wrongly_covered_cells, 1u);
        EXPECT_GT(report.open_interior_edges + report.wrong_boundary_steps, 0u);
    }
}

TEST(CheckCut, FindsATriangleThatIsThereTwice) {
    for (size_t i = 0; i < finest_mesh().triangles.size(); ++i) {
        Mesh mesh = finest_mesh();
        mesh.triangles.push_back(mesh.triangles[i]);
        check_cut::Report report = judge(mesh, 0);
        EXPECT_EQ(report.wrongly_covered_cells, 1u);
        EXPECT_EQ(report.overused_edges, 3u);
    }
}

TEST(CheckCut, FindsATriangleOverAVoid) {
    Mesh mesh = finest_mesh();
    mesh.triangles.push_back({3, 8, 2});  // column 3, row 1 is a corner
    EXPECT_EQ(judge(mesh, 1000).voids_covered, 1u);
    EXPECT_EQ(judge(mesh, 1000).wrongly_covered_cells, 1u);
    mesh = finest_mesh();
    mesh.triangles.push_back({2, 4, 14});  // the void lies on its long side
    EXPECT_EQ(judge(mesh, 1000).voids_covered, 1u);
}

TEST(CheckCut, FindsATriangleTurnedOver) {
    Mesh mesh = finest_mesh();
    std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
    EXPECT_EQ(judge(mesh, 0).turned_triangles, 1u);
}

// Heights agree, so only the edges tell: triangles with a corner in the middle of their neighbour's side.
TEST(CheckCut, FindsACrackThatNoSampleShows) {
    check_cut::Raster flat{kSide, kSide, std::vector<double>(kSide * kSide, 7)};
    check_cut::Mesh mesh;
    for (uint32_t i = 0; i < kSide * kSide; ++i) mesh.vertices.push_back({double(i % kSide), double(i / kSide), 7});
    mesh.triangles = {{0, 4, 24}, {0, 24, 20}};
    EXPECT_TRUE(check_cut::check(mesh, flat, 0).is_sound());
    mesh.triangles = {{0, 4, 24}, {0, 12, 20}, {12, 24, 20}};
    check_cut::Report report = check_cut::check(mesh, flat, 0);
    EXPECT_EQ(report.open_interior_edges, 3u);
    EXPECT_EQ(report.wrongly_covered_cells, 0u);
    EXPECT_FALSE(report.is_sound());
}

TEST(CheckCut, CannotJudgeWhatItCannotRead) {
    Mesh mesh = finest_mesh();
    mesh.triangles[0][0] = 25;
    EXPECT_EQ(judge_files(mesh, "1").exit, 2);
    EXPECT_EQ(run({"check_cut", "missing.ply", "missing.hgt", "--tolerance-m", "1"}).exit, 2);
}

}  // namespace
}  // namespace overlook::cli
