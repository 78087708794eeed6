// What counts as turned, on surfaces whose answer is known.
#include "tools/bake/caveclod/turned_faces.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/tools/caveclod/test_meshes.h"
#include "tools/bake/caveclod/distances.h"
#include "tools/bake/caveclod/source_parts.h"

namespace overlook::caveclod {
namespace {

constexpr double kSlack_m = 1e-9;

TriangleTree tree_of(const mesh::Mesh& mesh) {
    return TriangleTree(test::triangles_of(mesh.positions_m, mesh.faces));
}

Triangle back_of(const Triangle& t) {
    return {t[0], t[2], t[1]};
}

TEST(TurnedFaces, AreThoseThatLookAway) {
    TriangleTree sphere = tree_of(test::sphere(20, 10, 0.02));
    for (const Triangle& t : sphere.triangles()) {
        EXPECT_FALSE(is_turned(sphere, t, kSlack_m));
        EXPECT_TRUE(is_turned(sphere, back_of(t), kSlack_m));
    }
}

TEST(TurnedFaces, AreNoneOfASheetThatLiesOnAnother) {
    std::vector<Triangle> both = test::triangles_of(test::grid(4, 4, [](double, double) { return 0.0; }).positions_m,
                                                    test::grid(4, 4, [](double, double) { return 0.0; }).faces);
    for (size_t i = 0, count = both.size(); i < count; ++i) both.push_back(back_of(both[i]));
    TriangleTree source(both);
    for (const Triangle& t : both) EXPECT_FALSE(is_turned(source, t, kSlack_m));
}

TEST(TurnedFaces, AreJudgedByWhatLiesNearest) {
    mesh::Mesh up = test::grid(4, 4, [](double, double) { return 0.0; }),
               down = test::grid(4, 4, [](double, double) { return 0.5; });
    std::vector<Triangle> both = test::triangles_of(up.positions_m, up.faces);
    for (const Triangle& t : test::triangles_of(down.positions_m, down.faces)) both.push_back(back_of(t));
    TriangleTree source(both);
    for (double height_m : {-1.0, 0.0, 0.2, 0.3, 0.5, 2.0}) {
        Triangle face{glm::dvec3(0.2, 0.2, height_m), glm::dvec3(0.8, 0.2, height_m), glm::dvec3(0.2, 0.8, height_m)};
        EXPECT_EQ(is_turned(source, face, kSlack_m), height_m > 0.25) << height_m;
    }
}

// The quick answer must be the slow one, whatever the faces.
TEST(TurnedFaces, AreTheSameHoweverTheyAreLookedFor) {
    TriangleTree source = tree_of(test::sphere(40, 20, 0.2));
    std::mt19937 random(3);
    auto share = [&] { return double(random()) / 4294967296.0; };
    size_t turned = 0;
    for (int i = 0; i < 3000; ++i) {
        const Triangle& near = source.triangle(uint32_t(random() % source.triangles().size()));
        double size_m = 0.5 * share() * share();
        Triangle face;
        for (glm::dvec3& p : face) p = near[0] + (glm::dvec3(share(), share(), share()) - 0.5) * size_m;
        bool is = is_turned(source, face, kSlack_m);
        EXPECT_EQ(first_turned(source, std::span(&face, 1), 3 * size_m, kSlack_m), is ? 0u : 1u);
        uint32_t guess = uint32_t(random() % source.triangles().size());
        EXPECT_EQ(is_turned(source, face, kSlack_m, guess), is) << guess;
        turned += is;
    }
    EXPECT_GT(turned, 500u);
    EXPECT_LT(turned, 2500u);
}

// Two sheets that face each other: whose a face is, is what counts, and not which of the two is nearer.
TEST(SourceParts, JudgeAFaceByItsOwnHoweverFarItIs) {
    mesh::Mesh both = test::facing_sheets(6, 0.5);
    SourceParts parts(both.positions_m, both.faces);
    ASSERT_EQ(parts.count(), 2u);
    uint32_t lower = 7, upper = uint32_t(both.faces.size()) - 7;
    for (double height_m : {-30.0, -1.0, 0.0, 0.2, 0.3, 0.5, 0.8, 40.0}) {
        Triangle face{glm::dvec3(0.2, 0.2, height_m), glm::dvec3(0.8, 0.2, height_m), glm::dvec3(0.2, 0.8, height_m)};
        EXPECT_FALSE(parts.is_turned(face, kSlack_m, lower)) << height_m;
        EXPECT_TRUE(parts.is_turned(face, kSlack_m, upper)) << height_m;
        EXPECT_TRUE(parts.is_turned(back_of(face), kSlack_m, lower)) << height_m;
        EXPECT_FALSE(parts.is_turned(back_of(face), kSlack_m, upper)) << height_m;
    }
}

TEST(SourceParts, FindWhatIsTurnedWithNobodysWordForHowFarItIs) {
    mesh::Mesh mesh = test::sphere(40, 20, 0.2);
    SourceParts parts(mesh.positions_m, mesh.faces);
    TriangleTree source = tree_of(mesh);
    std::mt19937 random(6);
    auto share = [&] { return double(random()) / 4294967296.0; };
    size_t turned = 0;
    for (int i = 0; i < 3000; ++i) {
        uint32_t guess = uint32_t(random() % mesh.faces.size());
        double size_m = share() * share();
        Triangle face;
        for (glm::dvec3& p : face) p = source.triangle(guess)[0] + (glm::dvec3(share(), share(), share()) - 0.5) * size_m;
        bool is = is_turned(source, face, kSlack_m);
        EXPECT_EQ(parts.is_turned(face, kSlack_m, guess), is);
        turned += is;
    }
    EXPECT_GT(turned, 500u);
    EXPECT_LT(turned, 2500u);
}

// All triangles looked at, one after the other.
double facing_of_all(const TriangleTree& tree, const glm::dvec3& p, const glm::dvec3& direction, double slack_m) {
    auto away_m = [&](const Triangle& t) { return std::sqrt(distance2_to_triangle(p, probe_of(t[0], t[1], t[2]))); };
    double least_m = 1e300, best = -1;
    for (const Triangle& t : tree.triangles()) least_m = std::min(least_m, away_m(t));
    for (const Triangle& t : tree.triangles())
        if (away_m(t) <= least_m * (1 + 1e-6) + slack_m)
            best = std::max(best, glm::dot(glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0])), direction));
    return best;
}

// At corners of a fan of two hundred too, which are nearer than any list of what was found holds.
TEST(TriangleTree, TellsTheBestFacingOfAllThatAreNearest) {
    mesh::Mesh mesh = test::grid(12, 12, test::rough_m);
    std::vector<Triangle> triangles = test::triangles_of(mesh.positions_m, mesh.faces);
    auto rim = [](int i) { return glm::dvec3(3 + std::cos(i * 0.0314), std::sin(i * 0.0314), 0.3 * std::sin(i * 0.7)); };
    for (int i = 0; i < 200; ++i) triangles.push_back({glm::dvec3(3, 0, 1), rim(i), rim(i + 1)});
    TriangleTree tree(triangles);
    std::mt19937 random(5);
    auto share = [&] { return double(random()) / 4294967296.0; };
    for (int i = 0; i < 400; ++i) {
        glm::dvec3 p(share() * 4, share() * 2 - 1, share() * 1.5),
            direction = glm::normalize(glm::dvec3(share(), share(), share()) - 0.5);
        if (i % 4 == 0) p = glm::dvec3(3, 0, 1 + share());
        if (i % 4 == 1) p = triangles[random() % triangles.size()][0];
        uint32_t guess = i % 3 == 0 ? kNoGuess : uint32_t(random() % triangles.size());
        double expected = facing_of_all(tree, p, direction, kSlack_m);
        bool is_ahead = guess != kNoGuess && tree.nearest_face(p, direction, kSlack_m, guess);
        EXPECT_TRUE(!is_ahead || expected > 0);
        EXPECT_NEAR(tree.facing_of_nearest(p, direction, kSlack_m, guess), expected, 1e-9);
    }
}

TEST(TriangleTree, FindsTheNearestAmongLargeAndSmall) {
    mesh::Mesh mesh = test::grid(30, 30, test::rough_m);
    std::vector<Triangle> triangles = test::triangles_of(mesh.positions_m, mesh.faces);
    for (int i = 0; i < 9; ++i) triangles.push_back({glm::dvec3(-50, -50, -i), glm::dvec3(50, -50, i), glm::dvec3(0, 70, -2)});
    TriangleTree tree(triangles);
    std::mt19937 random(4);
    auto share = [&] { return double(random()) / 4294967296.0; };
    for (int i = 0; i < 200; ++i) {
        glm::dvec3 p(share() * 2 - 0.5, share() * 2 - 0.5, share() - 0.5);
        double least2 = 1e300;
        for (const Triangle& t : triangles) least2 = std::min(least2, distance2_to_triangle(p, probe_of(t[0], t[1], t[2])));
        EXPECT_NEAR(tree.nearest(p).distance_m, std::sqrt(least2), 1e-9);
    }
}

TEST(TriangleTree, OfNothingHasNothingNear) {
    TriangleTree none{std::span<const Triangle>()};
    EXPECT_EQ(none.nearest({0, 0, 0}, 5).triangle, 0xffffffffu);
    uint32_t guess = kNoGuess;
    EXPECT_EQ(none.facing_of_nearest({0, 0, 0}, {0, 0, 1}, kSlack_m, guess), 0);
}

}  // namespace
}  // namespace overlook::caveclod
