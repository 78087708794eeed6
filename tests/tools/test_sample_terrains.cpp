// The CAVECLOD paper's three terrains: counted as the paper counts them, and grounds that one can fly over.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>

#include "formats/parallel.h"
#include "tests/formats/scratch_folder.h"
#include "tools/bake/caveclod/groups.h"
#include "tools/bake/mesh_input.h"
#include "tools/make_sample/flight_lift.h"
#include "tools/make_sample/ground_textures.h"
#include "tools/make_sample/noise.h"
#include "tools/make_sample/sample_terrains.h"

namespace overlook::sample {
namespace {

struct Terrain {
    PaperTerrain paper;
    MeshSample sample;
    caveclod::Groups groups;
};

Terrain made(const PaperTerrain& paper, Result<MeshSample> sample) {
    EXPECT_TRUE(sample.has_value()) << sample.error().message;
    Result<caveclod::Groups> groups = caveclod::find_groups(sample->mesh, {});
    EXPECT_TRUE(groups.has_value());
    return {paper, std::move(*sample), std::move(*groups)};
}

// Made when a test first asks for it: each test is a process of its own.
const Terrain& terrain(size_t i) {
    static std::array<std::optional<Terrain>, 3> terrains;
    if (!terrains[i])
        terrains[i] = i == 0 ? made(kThreeLakes, three_lakes(1)) : i == 1 ? made(kCliff, cliff(1)) : made(kCanyon, canyon(1, ""));
    return *terrains[i];
}

class PaperTerrains : public testing::TestWithParam<size_t> {};
std::string name_of_case(const testing::TestParamInfo<size_t>& of) {
    constexpr const char* kNames[] = {"three_lakes", "cliff", "canyon"};
    return kNames[of.param];
}
INSTANTIATE_TEST_SUITE_P(Sample, PaperTerrains, testing::Values(0u, 1u, 2u), name_of_case);

TEST_P(PaperTerrains, HaveThePapersPolygonsAndTextures) {
    constexpr std::array<size_t, 3> kPolygons = {80'000, 107'184, 126'480}, kPositions = {40'401, 54'056, 63'783};
    const auto& [paper, sample, groups] = terrain(GetParam());
    EXPECT_EQ(sample.mesh.faces.size(), kPolygons[GetParam()]);
    EXPECT_EQ(sample.mesh.positions_m.size(), kPositions[GetParam()]);
    std::set<uint32_t> used(sample.mesh.face_surface.begin(), sample.mesh.face_surface.end());
    EXPECT_EQ(used.size(), paper.texture_count);
    EXPECT_EQ(sample.mesh.surfaces.size(), paper.texture_count);
    EXPECT_EQ(groups.ambiguous_count, 0u);
}

TEST_P(PaperTerrains, NeedThePapersIdsAndFillItsArrayAsMuch) {
    constexpr std::array<double, 3> kPrinted = {0.21, 0.26, 1};
    const auto& [paper, sample, groups] = terrain(GetParam());
    EXPECT_EQ(groups.packed_count, paper.packed_count);
    EXPECT_EQ(groups.clique_bound, paper.packed_count);
    EXPECT_NEAR(groups.dense_population, paper.dense_population, 0.01);
    EXPECT_NEAR(groups.dense_population, kPrinted[GetParam()], 0.01);
    RecordProperty("vertices", int(groups.vertices.size()));
    RecordProperty("papers_vertices", int(paper.vertex_count()));
}

TEST_P(PaperTerrains, FillTheirExtentWithFacesThatLookUp) {
    const auto& [paper, sample, groups] = terrain(GetParam());
    glm::vec3 low = sample.mesh.positions_m.front(), high = low;
    for (const glm::vec3& at : sample.mesh.positions_m) {
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    EXPECT_EQ(high.x - low.x, float(paper.width_m));
    EXPECT_EQ(high.y - low.y, float(paper.height_m));
    EXPECT_GT(high.z - low.z, 900);
    for (const auto& f : sample.mesh.faces) {
        glm::dvec3 a(sample.mesh.positions_m[f[0]]), b(sample.mesh.positions_m[f[1]]), c(sample.mesh.positions_m[f[2]]);
        ASSERT_GT(glm::cross(b - a, c - a).z, 0);
    }
}

TEST_P(PaperTerrains, AreFlownOverForTwoMinutesByFourCameras) {
    const auto& [paper, sample, groups] = terrain(GetParam());
    MeshGrid grid{paper.columns, paper.rows, {}};
    for (const glm::vec3& at : sample.mesh.positions_m) grid.positions_m.emplace_back(at);
    std::set<std::array<double, 3>> beginnings;
    for (const scene::Flight& flight : sample.flights) {
        EXPECT_EQ(flight.keys.back().time_s, 120);
        EXPECT_EQ(scene::frame_count(flight), 120u * 32 + 1);
        double clear_m = least_clearance_m(flight, [&](double x_m, double y_m) { return height_m(grid, x_m, y_m); });
        EXPECT_GE(clear_m, kMeshClearance_m - 0.1);  // heights rounded to floats
        for (const scene::Key& key : flight.keys) {
            EXPECT_GT(key.position_m[0], 0);
            EXPECT_LT(key.position_m[0], paper.width_m);
            EXPECT_LT(key.position_m[1], 0);
            EXPECT_GT(key.position_m[1], -paper.height_m);
            EXPECT_LT(key.position_m[2], 6000);
        }
        beginnings.insert(flight.keys.front().position_m);
    }
    EXPECT_EQ(beginnings.size(), 4u);
}

TEST_P(PaperTerrains, AreReadBackFromTheirFilesAsTheyWereMade) {
    const auto& [paper, sample, groups] = terrain(GetParam());
    ScratchFolder folder;
    Result<MeshSampleReport> report = write_mesh_sample(sample, folder.path());
    ASSERT_TRUE(report.has_value()) << report.error().message;
    EXPECT_EQ(report->files.size(), 8 + paper.texture_count);
    Result<mesh::MeshFile> file = mesh::open_mesh(folder / (std::string(paper.name) + ".obj"));
    ASSERT_TRUE(file.has_value()) << file.error().message;
    EXPECT_EQ(file->mesh.faces.size(), sample.mesh.faces.size());
    EXPECT_EQ(file->mesh.positions_m.size(), sample.mesh.positions_m.size());
    EXPECT_TRUE(file->mesh.link.empty());
    for (const mesh::Surface& surface : file->mesh.surfaces) EXPECT_GT(surface.texture_bytes.size(), 1000u) << surface.texture;

    Result<caveclod::Groups> read = caveclod::find_groups(file->mesh, {});
    ASSERT_TRUE(read.has_value());
    EXPECT_EQ(read->group_surface.size(), groups.group_surface.size());
    EXPECT_EQ(read->packed_count, groups.packed_count);
    EXPECT_EQ(read->vertices.size(), groups.vertices.size());
    EXPECT_EQ(read->rigid_count, groups.rigid_count);
    EXPECT_TRUE(scene::read_scene(folder / "scene.json"));
    for (const char* flight : {"flight-a.json", "flight-b.json", "flight-c.json", "flight-d.json"})
        EXPECT_TRUE(scene::read_flight(folder / flight)) << flight;
}

TEST(ThreeLakes, AreThreeAndLevel) {
    const mesh::Mesh& mesh = terrain(0).sample.mesh;
    std::map<uint32_t, std::set<float>> levels;
    std::map<uint32_t, double> areas_km2;
    for (size_t face = 0; face < mesh.faces.size(); ++face) {
        std::string_view ground = mesh.surfaces[mesh.face_surface[face]].name;
        if (ground.find("water") == std::string_view::npos) continue;
        areas_km2[mesh.face_surface[face]] += 0.35 * 0.35 / 2;
        for (uint32_t corner : mesh.faces[face]) levels[mesh.face_surface[face]].insert(mesh.positions_m[corner].z);
    }
    EXPECT_EQ(levels.size(), 3u);
    for (const auto& [lake, heights] : levels) EXPECT_EQ(heights.size(), 1u);
    for (const auto& [lake, area_km2] : areas_km2) EXPECT_GT(area_km2, 10);
}

TEST(ThreeLakes, HaveAPlaceWhereFiveGroupsMeet) {
    const caveclod::Groups& groups = terrain(0).groups;
    size_t most = 0;
    for (size_t i = 0; i + 1 < groups.vertex_begin.size(); ++i) {
        std::set<uint32_t> here(groups.vertex_group.begin() + groups.vertex_begin[i],
                                groups.vertex_group.begin() + groups.vertex_begin[i + 1]);
        most = std::max(most, here.size());
    }
    EXPECT_EQ(most, 5u);
}

// Boundaries between two groups of one surface: there normals alone break, and they are the cliff's rim.
TEST(Cliff, NormalsBreakAlongItsRim) {
    const auto& [paper, sample, groups] = terrain(1);
    std::map<std::pair<uint32_t, uint32_t>, std::vector<uint32_t>> faces_on;
    for (uint32_t face = 0; face < sample.mesh.faces.size(); ++face)
        for (uint32_t corner = 0; corner < 3; ++corner)
            faces_on[std::minmax(sample.mesh.faces[face][corner], sample.mesh.faces[face][(corner + 1) % 3])].push_back(face);
    std::set<uint32_t> rim_rows, rim_columns;
    for (const caveclod::FeatureEdge& feature : groups.features) {
        if (feature.kind != caveclod::FeatureKind::between) continue;
        const std::vector<uint32_t>& on = faces_on.at({feature.a, feature.b});
        if (sample.mesh.face_surface[on[0]] != sample.mesh.face_surface[on[1]]) continue;
        rim_rows.insert({feature.a / paper.columns, feature.b / paper.columns});
        rim_columns.insert({feature.a % paper.columns, feature.b % paper.columns});
    }
    EXPECT_EQ(rim_rows.size(), 1u);
    EXPECT_EQ(rim_columns.size(), paper.columns);
    uint32_t rim = *rim_rows.begin();
    double fall_m = 0;
    for (uint32_t column = 0; column < paper.columns; ++column) {
        size_t top = size_t(rim) * paper.columns + column;
        fall_m += double(sample.mesh.positions_m[top].z - sample.mesh.positions_m[top + 4 * paper.columns].z) / paper.columns;
    }
    EXPECT_GT(fall_m, 700);
}

TEST(Canyon, IsOneGroup) {
    const caveclod::Groups& groups = terrain(2).groups;
    EXPECT_EQ(groups.group_surface.size(), 1u);
    EXPECT_EQ(groups.vertices.size(), 63'783u);
    EXPECT_EQ(groups.rigid_count, 0u);
}

TEST(Canyon, IsMadeFromTheGrandCanyonsPictures) {
    const char* data = std::getenv("OVERLOOK_DATA");
    if (data == nullptr) GTEST_SKIP() << "OVERLOOK_DATA names no folder";
    Result<MeshSample> sample = canyon(1, std::string(data) + "/canyon");
    ASSERT_TRUE(sample.has_value()) << sample.error().message;
    EXPECT_EQ(sample->mesh.faces.size(), 126'480u);
    float low = 1e9f, high = 0;
    for (const glm::vec3& at : sample->mesh.positions_m) {
        low = std::min(low, at.z);
        high = std::max(high, at.z);
    }
    EXPECT_NEAR(low, 35 * 15, 60);
    EXPECT_NEAR(high, 187 * 15, 60);
    // Mirrored about its middle.
    for (uint32_t column = 0; column < 186; ++column)
        EXPECT_EQ(sample->mesh.positions_m[80 * 373 + column].z, sample->mesh.positions_m[80 * 373 + 372 - column].z);
    Result<caveclod::Groups> groups = caveclod::find_groups(sample->mesh, {});
    ASSERT_TRUE(groups.has_value());
    EXPECT_EQ(groups->group_surface.size(), 1u);
}

TEST(Canyon, RefusesASourceThatIsNone) {
    ScratchFolder folder;
    Result<MeshSample> sample = canyon(1, folder.path());
    ASSERT_FALSE(sample.has_value());
    EXPECT_EQ(sample.error().exit, Exit::bad_input);
    EXPECT_NE(sample.error().message.find("elevation_1200_8bit.png"), std::string::npos);
}

TEST_P(PaperTerrains, AreTheSameWithAnyThreadCountAndOtherForAnotherSeed) {
    auto make = [&](uint64_t seed) {
        return GetParam() == 0 ? *three_lakes(seed) : GetParam() == 1 ? *cliff(seed) : *canyon(seed, "");
    };
    set_thread_count(1);
    MeshSample one = make(2);
    set_thread_count(3);
    MeshSample three = make(2);
    set_thread_count(0);
    EXPECT_EQ(obj_text(one.mesh, "a"), obj_text(three.mesh, "a"));
    for (size_t i = 0; i < one.mesh.surfaces.size(); ++i)
        EXPECT_EQ(one.mesh.surfaces[i].texture_bytes, three.mesh.surfaces[i].texture_bytes);
    EXPECT_NE(obj_text(one.mesh, "a"), obj_text(terrain(GetParam()).sample.mesh, "a"));
}

TEST(MeshGridHeight, IsThatOfTheTriangles) {
    MeshGrid grid{9, 7, {}};
    for (uint32_t row = 0; row < 7; ++row)
        for (uint32_t column = 0; column < 9; ++column) {
            double bend = 1.7 * gradient_noise(3, column / 4.0, 0.5);
            grid.positions_m.emplace_back(column,
                                          row == 0 || row == 6 ? -6.0 * row / 6 : -double(row) + 0.5 * bend * (row % 6) / 6,
                                          column * column + 3 * row);
        }
    for (const glm::dvec3& at : grid.positions_m) EXPECT_NEAR(height_m(grid, at.x, at.y), at.z, 1e-9);
    for (uint32_t face = 0; face < grid.face_count(); ++face) {
        glm::dvec3 centre = grid.centre_m(face);
        EXPECT_NEAR(height_m(grid, centre.x, centre.y), centre.z, 1e-9);
        for (int64_t other : faces_beside(grid, face)) {
            if (other < 0) continue;
            size_t shared = 0;
            for (uint32_t a : grid.face(face))
                for (uint32_t b : grid.face(uint32_t(other))) shared += a == b;
            EXPECT_EQ(shared, 2u);
        }
    }
}

// Side by side two textures differ no more at the seam than elsewhere.
TEST(GroundTextures, GoOnWhereTheyEnd) {
    const uint32_t side = 128;
    for (size_t kind = 0; kind <= size_t(GroundKind::scree); ++kind) {
        ImageRgb8 image = ground_texture(GroundKind(kind), side, 5);
        auto step = [&](uint32_t a, uint32_t b, bool down) {
            double sum = 0;
            for (uint32_t i = 0; i < side; ++i) {
                size_t at = 3 * (down ? a * side + i : i * side + a), next = 3 * (down ? b * side + i : i * side + b);
                sum += std::abs(int(image.pixels[at + 1]) - int(image.pixels[next + 1]));
            }
            return sum / side;
        };
        for (bool down : {false, true}) {
            double greatest = 0;
            for (uint32_t i = 0; i + 1 < side; ++i) greatest = std::max(greatest, step(i, i + 1, down));
            EXPECT_LE(step(side - 1, 0, down), 1.25 * greatest) << name_of(GroundKind(kind));
            EXPECT_GT(greatest, 0.3) << name_of(GroundKind(kind));
        }
    }
}

TEST(TiledNoise, ReturnsAfterItsPeriodAndIsGradientNoiseWithin) {
    for (int i = 0; i < 200; ++i) {
        double x = 0.137 * i, y = 0.071 * i + 0.3;
        EXPECT_NEAR(tiled_noise(9, x, y, 5), tiled_noise(9, x + 5, y - 10, 5), 1e-9);
        if (x < 4 && y < 4) {
            EXPECT_EQ(tiled_noise(9, x, y, 5), gradient_noise(9, x, y));
        }
    }
}

}  // namespace
}  // namespace overlook::sample
