// Levels made by hand: their distance is measured, from above; what moves, moves in all of them.
#include "tools/bake/discrete/from_levels.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/formats/scratch_folder.h"
#include "tests/tools/discrete/shapes_for_tests.h"
#include "tests/tools/mesh_gltf_maker.h"
#include "tools/make_sample/windmill.h"

namespace overlook::discrete {
namespace {

mesh::MeshFile ball(uint32_t rings, uint32_t sides, double radius_m) {
    sample::ShapeMaker shapes({mesh::Surface()});
    test::add_ball(shapes, 0, rings, sides, radius_m, 0);
    return test::file_of(shapes.take());
}

std::string written(const ScratchFolder& folder, const std::string& name, const std::string& bytes) {
    std::ofstream(folder / name, std::ios::binary) << bytes;
    return folder / name;
}

TEST(ChainFromLevels, BoundsAKnownDistanceFromAboveAndNotByMuch) {
    std::vector<mesh::MeshFile> files{ball(96, 128, 1), ball(96, 128, 1.1)};
    std::vector<MeasuredLevel> measured;
    auto chain = chain_from_levels(files, {}, measured, [](double) {});
    ASSERT_TRUE(chain) << chain.error().message;
    // Both are the same ball at two sizes: from a corner to the other's faces it is 0.1 m, or as much more as those are flatter.
    EXPECT_GE(double(chain->levels[1].error_m), 0.1 - 1e-4);
    EXPECT_LE(double(chain->levels[1].error_m), 0.1 * 1.03 + 0.002);
    EXPECT_LE(measured[1].least_m, measured[1].most_m);
    EXPECT_EQ(chain->levels[0].error_m, 0);
}
TEST(ChainFromLevels, StatesNoErrorBelowThatOfAFinerLevel) {
    std::vector<mesh::MeshFile> files{ball(48, 64, 1), ball(24, 32, 1.2), ball(48, 64, 1)};
    std::vector<MeasuredLevel> measured;
    auto chain = chain_from_levels(files, {}, measured, [](double) {});
    ASSERT_TRUE(chain);
    EXPECT_EQ(chain->levels[2].error_m, chain->levels[1].error_m);
    EXPECT_LT(measured[2].most_m, 1e-3);
}
TEST(ChainFromLevels, BoundsALevelWithoutAPartByTheWholeSphere) {
    ScratchFolder folder;
    auto whole = mesh::open_mesh(written(folder, "whole.glb", sample::glb_text(sample::windmill(2), 4)), test::with_motion());
    std::vector<sample::GlbNode> tower_alone = sample::windmill(2);
    tower_alone.pop_back();
    auto tower = mesh::open_mesh(written(folder, "tower.glb", sample::glb_text(tower_alone, 4)), test::with_motion());
    ASSERT_TRUE(whole && tower);
    std::vector<MeasuredLevel> measured;
    auto chain = chain_from_levels(std::vector<mesh::MeshFile>{*whole, *tower}, {}, measured, [](double) {});
    ASSERT_TRUE(chain) << chain.error().message;
    EXPECT_GE(double(chain->levels[1].error_m), 2 * chain->radius_m);
}
TEST(ChainFromLevels, KeepsPartsOfOneNameApart) {
    ScratchFolder folder;
    std::vector<sample::GlbNode> twins = sample::windmill(2);
    twins.push_back(twins[1]);
    twins[2].at_m = {40, -3.2, 13.9};
    auto file = mesh::open_mesh(written(folder, "twins.glb", sample::glb_text(twins, 4)), test::with_motion());
    ASSERT_TRUE(file);
    std::vector<MeasuredLevel> measured;
    auto chain = chain_from_levels(std::vector<mesh::MeshFile>{*file}, {}, measured, [](double) {});
    ASSERT_TRUE(chain) << chain.error().message;
    ASSERT_EQ(chain->parts.size(), 3u);
    EXPECT_EQ(chain->parts[1].name, chain->parts[2].name);
    for (const Vertex& vertex : chain->levels[0].vertices) {
        if (vertex.part > 0) {
            EXPECT_EQ(vertex.part == 2, position_m(*chain, vertex).x > 20);
        }
    }
}
TEST(ChainFromLevels, RefusesAPartThatTheFinestHasNot) {
    ScratchFolder folder;
    std::vector<sample::GlbNode> renamed = sample::windmill(2);
    renamed[1].name = "wings";
    auto first = mesh::open_mesh(written(folder, "first.glb", sample::glb_text(sample::windmill(1), 4)), test::with_motion());
    auto second = mesh::open_mesh(written(folder, "second.glb", sample::glb_text(renamed, 4)), test::with_motion());
    ASSERT_TRUE(first && second);
    std::vector<MeasuredLevel> measured;
    auto chain = chain_from_levels(std::vector<mesh::MeshFile>{*first, *second}, {}, measured, [](double) {});
    ASSERT_FALSE(chain);
    EXPECT_EQ(chain.error().exit, Exit::bad_input);
    EXPECT_EQ(chain.error().message, "second.glb: its part wings is not in first.glb");
}

TEST(MsftLod, GivesTheLevelsThatANodeNames) {
    ScratchFolder folder;
    mesh::test::GltfMaker maker;
    int positions = maker.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3", 3);
    int fine = maker.indices({0, 1, 2, 0, 2, 3}), coarse = maker.indices({0, 1, 2});
    std::string path = written(
        folder, "lods.glb",
        maker.glb(fmt::format(
            R"("extensionsUsed":["MSFT_lod"],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":{0}}},"indices":{1}}}]}},
            {{"primitives":[{{"attributes":{{"POSITION":{0}}},"indices":{2}}}]}}],
            "nodes":[{{"mesh":0,"extensions":{{"MSFT_lod":{{"ids":[1]}}}}}},{{"mesh":1}}],"scene":0,"scenes":[{{"nodes":[0]}}])",
            positions, fine, coarse)));
    for (auto [lod, triangles] : {std::pair(0u, 2u), std::pair(1u, 1u), std::pair(9u, 1u)}) {
        mesh::Options options;
        options.lod = lod;
        options.reads_motion = true;
        auto file = mesh::open_mesh(path, options);
        ASSERT_TRUE(file) << file.error().message;
        EXPECT_EQ(file->report.lod_count, 1u);
        EXPECT_EQ(file->mesh.faces.size(), triangles) << lod;
    }
}

}  // namespace
}  // namespace overlook::discrete
