// Rays hit what plane geometry says: flattened copies and instances alike, holes never, every surface once.
#include "tools/bake/rays.h"

#include <gtest/gtest.h>

#include <random>

namespace overlook::rays {
namespace {

// A square from (-1, -1, 0) to (1, 1, 0) of two triangles, uv 0..1 over it.
Mesh square() {
    Mesh mesh;
    mesh.positions_m = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}
// The same with a hole where u and v are both below a half.
Mesh square_with_hole() {
    Mesh mesh = square();
    mesh.uvs = {{glm::vec2(0, 0), {1, 0}, {1, 1}}, {glm::vec2(0, 0), {1, 1}, {0, 1}}};
    mesh.masks_of = {0, 0};
    mesh.masks = {{2, 2, {0, 255, 255, 255}, 128}};
    return mesh;
}
Copy at_height(uint32_t mesh, float z, float scale = 1) {
    return {mesh, glm::mat4x3({scale, 0, 0}, {0, scale, 0}, {0, 0, scale}, {0, 0, z})};
}

class Layouts : public testing::TestWithParam<Layout> {};

TEST_P(Layouts, HitTheHighestOfSquaresFromAboveWhereItIs) {
    std::vector<Mesh> meshes{square(), square_with_hole()};
    std::vector<Copy> copies{at_height(0, 1, 4), at_height(1, 3), at_height(0, 2, 0.5f)};
    auto scene = Scene::build(meshes, copies, GetParam());
    ASSERT_TRUE(scene) << scene.error().message;
    std::mt19937 random(7);
    std::uniform_real_distribution<float> place(-5, 5);
    std::vector<Ray> rays;
    for (int i = 0; i < 4000; ++i) {
        glm::vec3 from(place(random), place(random), 10);
        if (i % 2) from.x /= 4, from.y /= 4;
        rays.push_back({from, {0, 0, -1}});
    }
    std::vector<Hit> hits(rays.size());
    scene->first_hits(rays, hits);
    std::vector<uint8_t> blocked(rays.size());
    scene->are_blocked(rays, blocked);
    std::array<int, 4> seen{};
    for (size_t i = 0; i < rays.size(); ++i) {
        auto [x, y] = std::pair(rays[i].from_m.x, rays[i].from_m.y);
        auto within = [&](float half) { return std::abs(x) < half && std::abs(y) < half; };
        bool in_hole = x < 0 && y < 0;
        uint32_t expected = within(1) && !in_hole ? 1 : within(0.5f) ? 2 : within(4) ? 0 : kNone;
        ASSERT_EQ(hits[i].copy, expected) << x << " " << y;
        ASSERT_EQ(blocked[i] != 0, expected != kNone);
        ++seen[expected == kNone ? 3 : expected];
        if (expected == kNone) continue;
        ASSERT_NEAR(hits[i].distance, 10 - (expected == 1 ? 3 : expected == 2 ? 2 : 1), 1e-4);
    }
    for (int count : seen) EXPECT_GT(count, 20);
}

TEST_P(Layouts, MeetEverySurfaceOnceTheNearestFirst) {
    std::vector<Mesh> meshes{square(), square_with_hole()};
    std::vector<Copy> copies{at_height(0, 1), at_height(1, 3), at_height(0, 2), at_height(1, 4)};
    auto scene = Scene::build(meshes, copies, GetParam());
    ASSERT_TRUE(scene);
    auto copies_at = [&](float x, float y) {
        std::vector<uint32_t> met;
        for (const Hit& hit : scene->all_hits({{x, y, 10}, {0, 0, -1}})) met.push_back(hit.copy);
        return met;
    };
    EXPECT_EQ(copies_at(0.3f, 0.4f), (std::vector<uint32_t>{3, 1, 2, 0}));
    EXPECT_EQ(copies_at(-0.3f, -0.4f), (std::vector<uint32_t>{2, 0}));
    EXPECT_EQ(copies_at(3, 0), std::vector<uint32_t>{});
}

TEST_P(Layouts, StopAtTheRaysEnd) {
    std::vector<Mesh> meshes{square()};
    std::vector<Copy> copies{at_height(0, 1)};
    auto scene = Scene::build(meshes, copies, GetParam());
    ASSERT_TRUE(scene);
    std::vector<Ray> rays{{{0, 0.1f, 2}, {0, 0, -1}, 0, 0.5f}, {{0, 0.1f, 2}, {0, 0, -1}, 1.5f, 9}, {{0, 0.1f, 2}, {0, 0, -2}}};
    std::vector<Hit> hits(3);
    scene->first_hits(rays, hits);
    EXPECT_EQ(hits[0].copy, kNone);
    EXPECT_EQ(hits[1].copy, kNone);
    EXPECT_EQ(hits[2].distance, 0.5f);
}
INSTANTIATE_TEST_SUITE_P(Rays, Layouts, testing::Values(Layout::flattened, Layout::instances),
                         [](const auto& layout) { return layout.param == Layout::flattened ? "Flattened" : "Instances"; });

TEST(Rays, OfNothingHitNothing) {
    auto scene = Scene::build({}, {}, Layout::flattened);
    ASSERT_TRUE(scene);
    std::vector<Ray> rays{{{0, 0, 2}, {0, 0, -1}}};
    std::vector<Hit> hits(1);
    scene->first_hits(rays, hits);
    EXPECT_EQ(hits[0].copy, kNone);
}

TEST(Rays, FlattenedCopiesAreCountedInBytesByTriangle) {
    std::vector<Mesh> meshes{square()};
    std::vector<Copy> copies{at_height(0, 1), at_height(0, 2)};
    EXPECT_EQ(flattened_bytes(meshes, copies), 2u * (2 * 130 + 12 * 6));
}

}  // namespace
}  // namespace overlook::rays
