// The scenes of the frame-sequential interpolation paper are as large as it says, and read as they were made.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "formats/scene.h"
#include "tests/formats/scratch_folder.h"
#include "tools/bake/mesh_input.h"
#include "tools/make_sample/sample_instances.h"
#include "tools/make_sample/tree.h"
#include "tools/make_sample/windmill.h"

namespace overlook::sample {
namespace {

std::vector<std::string> made(const std::string& name, const ScratchFolder& folder, uint32_t count, uint64_t seed = 1) {
    auto paths = make_instances(name, {seed, count}, folder.path());
    EXPECT_TRUE(paths) << paths.error().message;
    return paths ? *paths : std::vector<std::string>{};
}

mesh::MeshFile opened(const std::string& path) {
    mesh::Options options;
    options.reads_motion = true;
    auto file = mesh::open_mesh(path, options);
    EXPECT_TRUE(file) << file.error().message;
    return file ? *file : mesh::MeshFile{};
}

TEST(SampleTrees, HaveTheTrianglesOfThePaper) {
    std::vector<size_t> counts;
    for (int level = 0; level < kTreeLevels; ++level) counts.push_back(tree_mesh(1, tree_detail(level))->faces.size());
    EXPECT_NEAR(double(counts.front()), 93'000, 1'000);
    EXPECT_NEAR(double(counts.back()), 5'000, 250);
    for (size_t i = 1; i < counts.size(); ++i) EXPECT_LT(double(counts[i]), 0.72 * double(counts[i - 1]));
}
TEST(SampleTrees, AreOneTreeInMaskedLeaves) {
    ScratchFolder folder;
    made("trees", folder, 10);
    mesh::MeshFile fine = opened(folder / "tree-0.glb"), coarse = opened(folder / "tree-4.glb");
    EXPECT_EQ(fine.report.dropped.size(), 0u);
    EXPECT_EQ(fine.report.flipped_face_count, 0u);
    ASSERT_EQ(fine.mesh.surfaces.size(), 2u);
    EXPECT_TRUE(fine.mesh.surfaces[1].is_alpha_masked && fine.mesh.surfaces[1].is_two_sided);
    EXPECT_GT(fine.mesh.surfaces[1].texture_bytes.size(), 1000u);
    auto top_m = [](const mesh::MeshFile& file) {
        float top = 0;
        for (const glm::vec3& p : file.mesh.positions_m) top = std::max(top, p.z);
        return top;
    };
    EXPECT_NEAR(top_m(fine), top_m(coarse), 0.5f);
    EXPECT_NEAR(top_m(fine), 9, 1.5);
}
TEST(SampleWindmills, HaveTheTrianglesOfThePaperAndTurn) {
    ScratchFolder folder;
    made("windmills", folder, 10);
    mesh::MeshFile fine = opened(folder / "windmill-0.glb");
    EXPECT_NEAR(double(fine.mesh.faces.size()), 18'000, 500);
    EXPECT_NEAR(double(opened(folder / "windmill-3.glb").mesh.faces.size()), 100, 20);
    ASSERT_EQ(fine.motion.parts.size(), 1u);
    EXPECT_EQ(fine.motion.parts[0].name, "sails");
    EXPECT_DOUBLE_EQ(fine.motion.clip_s, kWindmillTurn_s);
    EXPECT_LT(glm::distance(fine.motion.parts[0].pivot_m, {0, -3.2, 13.9}), 1e-5);
    EXPECT_EQ(fine.report.dropped.size(), 0u);
}
TEST(SampleSimple, IsARedBallAndABlueCube) {
    ScratchFolder folder;
    made("simple", folder, 10);
    mesh::MeshFile ball = opened(folder / "simple-0.glb"), cube = opened(folder / "simple-1.glb");
    EXPECT_EQ(cube.mesh.faces.size(), 12u);
    for (const glm::vec3& p : ball.mesh.positions_m) EXPECT_LT(glm::length(p), 1.0001f);
    EXPECT_GT(ball.mesh.surfaces[0].base_colour.r, 0.8f);
    EXPECT_GT(cube.mesh.surfaces[0].base_colour.b, 0.8f);
}
TEST(SampleInstances, StandScatteredAndApart) {
    for (const char* name : {"trees", "windmills", "simple"}) {
        ScratchFolder folder;
        made(name, folder, 4000);
        auto scene = nlohmann::json::parse(text_of_file(folder / "scene.json"));
        const auto& instances = scene["layers"][1]["instances"];
        ASSERT_EQ(instances.size(), 4000u) << name;
        double least_m = 1e9;
        for (size_t i = 0; i < 200; ++i)
            for (size_t k = 0; k < i; ++k) {
                const auto &a = instances[i]["translation_m"], &b = instances[k]["translation_m"];
                least_m = std::min(least_m,
                                   std::hypot(a[0].get<double>() - b[0].get<double>(), a[1].get<double>() - b[1].get<double>()));
            }
        EXPECT_GT(least_m, 2) << name;
        EXPECT_TRUE(scene::read_flight(folder / "flight.json")) << name;
    }
}
TEST(SampleInstances, FollowTheSeed) {
    ScratchFolder folder;
    made("trees", folder, 50, 1);
    std::string first = text_of_file(folder / "scene.json"), tree = text_of_file(folder / "tree-4.glb");
    made("trees", folder, 50, 1);
    EXPECT_EQ(text_of_file(folder / "scene.json"), first);
    EXPECT_EQ(text_of_file(folder / "tree-4.glb"), tree);
    made("trees", folder, 50, 2);
    EXPECT_NE(text_of_file(folder / "scene.json"), first);
    EXPECT_NE(text_of_file(folder / "tree-4.glb"), tree);
}

}  // namespace
}  // namespace overlook::sample
