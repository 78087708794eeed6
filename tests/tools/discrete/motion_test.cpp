// Rigid nodes that a glTF file animates become parts of a chain that move as the file says, and every bound holds over the clip.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "tests/formats/scratch_folder.h"
#include "tests/tools/discrete/shapes_for_tests.h"
#include "tests/tools/mesh_gltf_maker.h"
#include "tools/bake/discrete/from_levels.h"
#include "tools/bake/discrete/from_mesh.h"
#include "tools/make_sample/windmill.h"

namespace overlook::discrete {
namespace {

using mesh::test::GltfMaker;

std::string written(const ScratchFolder& folder, const std::string& name, const std::string& bytes) {
    std::ofstream(folder / name, std::ios::binary) << bytes;
    return folder / name;
}

// One triangle under a node, under a parent, animated by `animation` ({0} times, {1} turns, {2} moves, {3} two times, {4} their
// moves by cubics: tangent in, value, tangent out).
Result<mesh::MeshFile> animated(const ScratchFolder& folder, const std::string& nodes, const std::string& channels,
                                const std::string& samplers) {
    GltfMaker maker;
    int positions = maker.floats({1, 0, 0, 2, 0, 0, 1, 1, 0}, "VEC3", 3);
    float half = std::sqrt(0.5f);
    int times = maker.floats({0, 1, 2}, "SCALAR", 1);
    int turns = maker.floats({0, 0, 0, 1, 0, 0, half, half, 0, 0, 1, 0}, "VEC4", 4);  // about z: 0, 90, 180 degrees
    int moves = maker.floats({0, 0, 0, 0, 2, 0, 0, 2, 4}, "VEC3", 3);
    int span = maker.floats({0, 1}, "SCALAR", 1);
    int eased = maker.floats({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0}, "VEC3", 3);
    std::string filled = fmt::format(fmt::runtime(samplers), times, turns, moves, span, eased);
    return mesh::open_mesh(
        written(folder, "a.glb",
                maker.glb(fmt::format(R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":{}}}}}]}}],"nodes":{},"scene":0,
            "scenes":[{{"nodes":[0]}}],"animations":[{{"channels":{},"samplers":[{}]}}])",
                                      positions, nodes, channels, filled))),
        test::with_motion());
}

// Where a place of the file's own axes (y up) is drawn at a time, in the mesh's axes (z up) turned back.
glm::dvec3 drawn(const std::vector<Part>& parts, size_t part, double clip_s, double at_s, const glm::dvec3& at) {
    Pose pose = pose_at(parts[part], clip_s, at_s);
    glm::vec3 placed = pose.turn * glm::vec3(at.x, -at.z, at.y) + pose.move_m;
    return {placed.x, placed.z, -placed.y};
}

constexpr const char* kTurn = R"({{"input":{0},"output":{1}}})";
constexpr const char* kTurnChannel = R"([{"sampler":0,"target":{"node":0,"path":"rotation"}}])";

TEST(Motion, TurnsAsTheFileSays) {
    ScratchFolder folder;
    auto file = animated(folder, R"([{"name":"arm","mesh":0}])", kTurnChannel, kTurn);
    ASSERT_TRUE(file) << file.error().message;
    ASSERT_EQ(file->motion.parts.size(), 1u);
    EXPECT_EQ(file->motion.clip_s, 2);
    std::vector<Part> parts = parts_of(file->motion);
    EXPECT_EQ(parts[1].name, "arm");
    for (double at_s : {0.0, 0.3, 1.0, 1.9}) {
        double angle = std::numbers::pi / 2 * at_s;
        EXPECT_LT(glm::distance(drawn(parts, 1, 2, at_s, {1, 0, 0}), {std::cos(angle), std::sin(angle), 0}), 1e-5) << at_s;
    }
}
TEST(Motion, TurnsAboutTheNodesOwnPlaceAndMovesWithItsParents) {
    ScratchFolder folder;
    // The parent moves along y and then z, the child turns about its own place at (10, 0, 0).
    auto file = animated(
        folder, R"([{"name":"cart","children":[1]},{"name":"wheel","mesh":0,"translation":[10,0,0]}])",
        R"([{"sampler":0,"target":{"node":1,"path":"rotation"}},{"sampler":1,"target":{"node":0,"path":"translation"}}])",
        R"({{"input":{0},"output":{1}}},{{"input":{0},"output":{2}}})");
    ASSERT_TRUE(file) << file.error().message;
    std::vector<Part> parts = parts_of(file->motion);
    uint32_t wheel = file->motion.part_of(0);
    EXPECT_EQ(parts[wheel].name, "wheel");
    for (double at_s : {0.0, 0.25, 0.5, 1.5}) {
        double angle = std::numbers::pi / 2 * at_s, up = std::min(2.0, 2 * at_s), along = std::max(0.0, 4 * (at_s - 1));
        glm::dvec3 wanted(10 + std::cos(angle), up + std::sin(angle), along);
        EXPECT_LT(glm::distance(drawn(parts, wheel, 2, at_s, {11, 0, 0}), wanted), 2e-3) << at_s;
    }
}
// A cubic without tangents is in the middle where the straight way is, and nowhere else.
TEST(Motion, EasesAsTheFileSays) {
    ScratchFolder folder;
    auto file = animated(folder, R"([{"name":"lift","mesh":0}])", R"([{"sampler":0,"target":{"node":0,"path":"translation"}}])",
                         R"({{"input":{3},"output":{4},"interpolation":"CUBICSPLINE"}})");
    ASSERT_TRUE(file) << file.error().message;
    std::vector<Part> parts = parts_of(file->motion);
    for (double t = 0; t < 1; t += 0.03)
        EXPECT_LT(glm::distance(drawn(parts, 1, 1, t, {0, 0, 0}), {3 * t * t - 2 * t * t * t, 0, 0}), 2e-3) << t;
}
TEST(Motion, IsReadWhereItIsAskedForAlone) {
    ScratchFolder folder;
    auto broken = animated(folder, R"([{"mesh":0}])", kTurnChannel, R"({{"input":{1},"output":{0}}})");
    EXPECT_FALSE(broken);
    auto still = mesh::open_mesh(folder / "a.glb");
    ASSERT_TRUE(still) << still.error().message;
    EXPECT_TRUE(still->motion.is_empty());
}
TEST(Motion, NamesArePrintable) {
    ScratchFolder folder;
    auto file = animated(folder, R"([{"name":"arm\n\u0007","mesh":0}])", kTurnChannel, kTurn);
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(file->motion.parts[0].name, "arm  ");
}
TEST(Motion, OfAScaledNodeIsRigidAndIsInMetres) {
    ScratchFolder folder;
    auto file = animated(folder, R"([{"mesh":0,"scale":[3,3,3],"translation":[0,5,0]}])", kTurnChannel, kTurn);
    ASSERT_TRUE(file) << file.error().message;
    ASSERT_EQ(file->motion.parts.size(), 1u);
    EXPECT_LT(glm::distance(file->motion.parts[0].pivot_m, {0, 0, 5}), 1e-9);
}
TEST(Motion, OfASkewedNodeIsLeftOutWithANote) {
    ScratchFolder folder;
    auto file = animated(folder, R"([{"scale":[3,1,1],"children":[1]},{"name":"skewed","mesh":0}])",
                         R"([{"sampler":0,"target":{"node":1,"path":"rotation"}}])", kTurn);
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_TRUE(file->motion.is_empty());
    ASSERT_EQ(file->report.notes.size(), 1u);
    EXPECT_NE(file->report.notes[0].find("skewed"), std::string::npos);
}
TEST(Motion, OfBrokenAnimationsIsRefused) {
    ScratchFolder folder;
    auto swapped = animated(folder, R"([{"mesh":0}])", kTurnChannel, R"({{"input":{1},"output":{0}}})");
    ASSERT_FALSE(swapped);
    EXPECT_EQ(swapped.error().exit, Exit::bad_input);
    auto missing = animated(folder, R"([{"mesh":0}])", R"([{"sampler":3,"target":{"node":0,"path":"rotation"}}])", kTurn);
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().exit, Exit::bad_input);
}

TEST(ChainOfAWindmill, MovesRigidlyAndKeepsItsBoundsAllTheTime) {
    ScratchFolder folder;
    auto file = mesh::open_mesh(written(folder, "windmill.glb", sample::glb_text(sample::windmill(1), 8)), test::with_motion());
    ASSERT_TRUE(file) << file.error().message;
    MeshChainOptions options;
    options.bake.simplify.seams.moves = true;
    MeshChainReport report;
    auto chain = chain_from_mesh(*file, options, report, [](double) {});
    ASSERT_TRUE(chain) << chain.error().message;
    ASSERT_EQ(chain->parts.size(), 2u);
    EXPECT_EQ(chain->parts[1].name, "sails");
    EXPECT_EQ(chain->clip_s, 8);
    ASSERT_GE(chain->levels.size(), 4u);

    std::vector<std::vector<caveclod::Triangle>> moved(chain->levels.size());
    for (double at_s : {0.0, 1.3, 5.1}) {
        Pose pose = pose_at(chain->parts[1], chain->clip_s, at_s);
        for (size_t k = 0; k < chain->levels.size(); ++k) {
            moved[k] = triangles_of(*chain, chain->levels[k], 0);
            for (caveclod::Triangle t : triangles_of(*chain, chain->levels[k], 1)) {
                for (glm::dvec3& corner : t) {
                    corner = glm::dquat(pose.turn) * corner + glm::dvec3(pose.move_m);
                    EXPECT_LE(glm::distance(corner, chain->middle_m), chain->radius_m + 1e-4);
                }
                moved[k].push_back(t);
            }
            caveclod::Distance off = caveclod::two_sided_distance(caveclod::TriangleTree(moved[0]),
                                                                  caveclod::TriangleTree(moved[k]), 0.05, 1e-3, 1 << 16);
            EXPECT_LE(off.least_m, double(chain->levels[k].error_m) + 1e-4) << "level " << k << " at " << at_s;
        }
    }
}

}  // namespace
}  // namespace overlook::discrete
