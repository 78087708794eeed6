// Chains of levels come back as they were written, no chain is written that a reader would refuse, and parts move as their keys
// say.
#include "formats/discrete.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/corrupt/discrete_fixtures.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::discrete {
namespace {

Result<void> written(const std::string& path, const Chain& chain) {
    auto writer = container::Writer::create(path, kKind);
    if (!writer) return tl::unexpected(writer.error());
    if (auto ok = write(*writer, chain); !ok) return ok;
    auto bytes = writer->commit();
    return bytes ? Result<void>() : tl::unexpected(bytes.error());
}

// A wavy sheet of n x n squares, its vertices all different, on two surfaces.
Level sheet(uint32_t n) {
    Level level;
    for (uint32_t y = 0; y <= n; ++y)
        for (uint32_t x = 0; x <= n; ++x) {
            Vertex vertex;
            vertex.position = {uint16_t(x * 400), uint16_t(y * 400), uint16_t(1000 + 37 * x % 11 * y)};
            vertex.normal = {int16_t(x * 30), int16_t(-int(y) * 30)}, vertex.uv = {uint16_t(x), uint16_t(y)};
            vertex.colour = {uint8_t(x), uint8_t(y), 7, 255};
            level.vertices.push_back(vertex);
        }
    for (uint32_t y = 0; y < n; ++y)
        for (uint32_t x = 0; x < n; ++x) {
            uint32_t a = y * (n + 1) + x, b = a + 1, c = a + n + 1, d = c + 1;
            for (uint32_t i : {a, b, d, a, d, c}) level.indices.push_back(i);
        }
    auto half = uint32_t(level.indices.size() / 6 * 3);
    level.draws = {{0, 0, half}, {1, half, uint32_t(level.indices.size()) - half}};
    return level;
}

Chain sheets() {
    Chain chain = fixtures::pyramid();
    chain.levels = {sheet(100), sheet(30), sheet(1)};
    chain.levels[1].error_m = 0.5f, chain.levels[2].error_m = 0.5f, chain.levels[2].lost_area_share = 0.125f;
    chain.attributes = {true, true, true};
    chain.surfaces[1].texture = "leaf.png", chain.surfaces[1].is_alpha_masked = true;
    chain.surfaces[1].texture_bytes = {std::byte(1), std::byte(2)};
    chain.finest_error_m = 0.001, chain.middle_m = {18, 18, 0}, chain.radius_m = 40;
    chain.visibility.assign(2, chain.visibility[0]);
    return chain;
}

// The three corners of each triangle, the least first: the same triangle, the same way round.
std::vector<std::array<uint32_t, 3>> turned(const Level& level) {
    std::vector<std::array<uint32_t, 3>> all;
    for (size_t i = 0; i < level.indices.size(); i += 3) {
        std::array<uint32_t, 3> t{level.indices[i], level.indices[i + 1], level.indices[i + 2]};
        while (t[0] > t[1] || t[0] > t[2]) t = {t[1], t[2], t[0]};
        all.push_back(t);
    }
    return all;
}

TEST(Chain, ComesBackAsItWasWritten) {
    ScratchFolder folder;
    Chain chain = sheets();
    ASSERT_TRUE(written(folder / "a.ovl", chain));
    Result<Chain> back = read(folder / "a.ovl");
    ASSERT_TRUE(back) << back.error().message;
    ASSERT_EQ(back->levels.size(), 3u);
    for (size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(back->levels[k].vertices, chain.levels[k].vertices);
        EXPECT_EQ(turned(back->levels[k]), turned(chain.levels[k]));
        EXPECT_EQ(back->levels[k].draws, chain.levels[k].draws);
        EXPECT_EQ(back->levels[k].error_m, chain.levels[k].error_m);
        EXPECT_EQ(back->levels[k].lost_area_share, chain.levels[k].lost_area_share);
    }
    EXPECT_EQ(back->surfaces, chain.surfaces);
    EXPECT_EQ(back->parts, chain.parts);
    EXPECT_EQ(back->visibility, chain.visibility);
    EXPECT_EQ(back->attributes, chain.attributes);
    EXPECT_EQ(back->origin_m, chain.origin_m);
    EXPECT_EQ(back->finest_error_m, chain.finest_error_m);
    EXPECT_EQ(back->clip_s, chain.clip_s);
}

TEST(Chain, IsSmallerThanItsVerticesAndIndices) {
    ScratchFolder folder;
    Chain chain = sheets();
    ASSERT_TRUE(written(folder / "a.ovl", chain));
    uint64_t plain = 0;
    for (const Level& level : chain.levels) plain += 20 * level.vertices.size() + 4 * level.indices.size();
    EXPECT_LT(std::filesystem::file_size(folder / "a.ovl"), plain / 4);
}

TEST(Chain, IsWrittenAsTheSameBytesWhenItIsReadAndWrittenAgain) {
    ScratchFolder folder;
    ASSERT_TRUE(written(folder / "a.ovl", sheets()));
    ASSERT_TRUE(written(folder / "b.ovl", *read(folder / "a.ovl")));
    ASSERT_TRUE(written(folder / "c.ovl", *read(folder / "b.ovl")));
    EXPECT_EQ(text_of_file(folder / "b.ovl"), text_of_file(folder / "c.ovl"));
}

TEST(Chain, IsNotWrittenWhereAReaderWouldRefuseIt) {
    ScratchFolder folder;
    auto refused = [&](void (*change)(Chain&)) {
        Chain chain = sheets();
        change(chain);
        Result<void> result = written(folder / "a.ovl", chain);
        return !result && result.error().exit == Exit::our_bug && result.error().message.starts_with("a chain to write has ");
    };
    EXPECT_FALSE(refused([](Chain&) {}));
    EXPECT_TRUE(refused([](Chain& chain) { chain.levels.clear(); }));
    EXPECT_TRUE(refused([](Chain& chain) { chain.levels[1].indices.clear(); }));
    EXPECT_TRUE(refused([](Chain& chain) { chain.levels[1].error_m = 9; }));
    EXPECT_TRUE(refused([](Chain& chain) { chain.levels[0].indices[5] = 1 << 20; }));
    EXPECT_TRUE(refused([](Chain& chain) { chain.levels[0].draws.pop_back(); }));
    EXPECT_TRUE(refused([](Chain& chain) { chain.parts[0].at_s = {0}; }));
    EXPECT_TRUE(refused([](Chain& chain) { chain.parts[1].at_s[1] = 3; }));
    EXPECT_TRUE(refused([](Chain& chain) { chain.radius_m = 1; }));
    EXPECT_TRUE(refused([](Chain& chain) { chain.position_step_m = 0; }));
    EXPECT_TRUE(refused([](Chain& chain) { chain.visibility[0].values.pop_back(); }));
    EXPECT_TRUE(refused([](Chain& chain) { chain.visibility.resize(5, chain.visibility[0]); }));
}

glm::dvec3 placed(const Pose& pose, const glm::dvec3& at) {
    return glm::dvec3(pose.turn * glm::vec3(at) + pose.move_m);
}

TEST(Pose, TurnsAboutThePivotThatStays) {
    Part vane = fixtures::pyramid().parts[1];
    vane.pivot_m = {10, 20, 30};
    for (double at_s : {0.0, 0.25, 1.0, 1.7, 3.99}) {
        Pose pose = pose_at(vane, 4, at_s);
        EXPECT_LT(glm::distance(placed(pose, {10, 20, 30}), {10, 20, 30}), 1e-4) << at_s;
        double angle = at_s / 4 * 2 * std::numbers::pi;
        EXPECT_LT(glm::distance(placed(pose, {11, 20, 30}), {10 + std::cos(angle), 20 + std::sin(angle), 30}), 1e-4) << at_s;
    }
}
TEST(Pose, RepeatsWithTheClipForwardAndBack) {
    Part vane = fixtures::pyramid().parts[1];
    for (double at_s : {0.5, 1.25, 2.5, 3.75})
        for (double clips : {-3.0, -1.0, 1.0, 1000.0}) {
            Pose once = pose_at(vane, 4, at_s), later = pose_at(vane, 4, at_s + 4 * clips);
            EXPECT_LT(glm::distance(placed(once, {1, 2, 3}), placed(later, {1, 2, 3})), 1e-4);
        }
}
TEST(Pose, MovesEvenlyBetweenKeysAndStaysWhereThereAreNone) {
    Part lift;
    lift.at_s = {0, 1, 3}, lift.poses.resize(3);
    lift.poses[1].move_m = {0, 0, 2}, lift.poses[2].move_m = {0, 0, 0};
    EXPECT_NEAR(double(pose_at(lift, 3, 0.5).move_m.z), 1, 1e-6);
    EXPECT_NEAR(double(pose_at(lift, 3, 2).move_m.z), 1, 1e-6);
    EXPECT_EQ(pose_at(Part{}, 0, 17), Pose{});
}
TEST(Pose, GoesAlongTheShorterArc) {
    Part part;
    part.at_s = {0, 1};
    part.poses = {{glm::quat(1, 0, 0, 0), {}}, {glm::quat(-std::cos(0.2f), 0, 0, -std::sin(0.2f)), {}}};
    EXPECT_NEAR(placed(pose_at(part, 1, 0.5), {1, 0, 0}).x, std::cos(0.2), 1e-5);
}

}  // namespace
}  // namespace overlook::discrete
