// Levels cut from a mesh: each within its bound of the finest, each much cheaper than the one before, foliage thinned as a whole.
#include "tools/bake/discrete/from_mesh.h"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "formats/parallel.h"
#include "tests/tools/discrete/shapes_for_tests.h"
#include "tools/bake/discrete/from_levels.h"

namespace overlook::discrete {
namespace {

MeshChainOptions budgeted() {
    MeshChainOptions options;
    options.bake.simplify.seams.moves = true;
    return options;
}

Chain chain_of(const mesh::MeshFile& file, const MeshChainOptions& options, MeshChainReport& report) {
    auto chain = chain_from_mesh(file, options, report, [](double) {});
    EXPECT_TRUE(chain) << chain.error().message;
    return chain ? *chain : Chain{};
}

// Every level's measured distance to level 0 is within what it states, which is no wild guess either.
void expect_bounded(const Chain& chain, double least_share_of_promise) {
    LevelsChainOptions options;
    for (size_t k = 1; k < chain.levels.size(); ++k) {
        caveclod::Distance off = distance_of_levels(chain, chain.levels[0], chain.levels[k], options);
        double stated_m = double(chain.levels[k].error_m);
        EXPECT_LE(off.least_m, stated_m) << "level " << k;
        EXPECT_GE(off.most_m, stated_m * least_share_of_promise) << "level " << k;
        EXPECT_GE(stated_m, double(chain.levels[k - 1].error_m));
        EXPECT_GE(chain.levels[k].lost_area_share, chain.levels[k - 1].lost_area_share);
    }
}

mesh::MeshFile ball(uint32_t rings, uint32_t sides) {
    sample::ShapeMaker shapes({mesh::Surface()});
    test::add_ball(shapes, 0, rings, sides, 1, 0.08);
    return test::file_of(shapes.take());
}

// Cards in no order, none of which touches another: what stands one after the other in a level stands near each other.
TEST(LevelOrder, KeepsNeighboursTogetherWhereNothingConnectsThem) {
    Shape shape;
    uint32_t seed = 1;
    auto number = [&] { return double((seed = seed * 1664525u + 1013904223u) >> 8) / double(1 << 24); };
    for (uint32_t f = 0; f < 4000; ++f) {
        glm::dvec3 at_m(number(), number(), number());
        for (int corner = 0; corner < 3; ++corner)
            shape.vertices.push_back(
                {at_m + 0.01 * glm::dvec3(corner == 1, corner == 2, 0), 0, {0, 0, 1}, {0, 0}, {9, 9, 9, 255}});
        shape.faces.push_back({3 * f, 3 * f + 1, 3 * f + 2});
        shape.face_surface.push_back(0);
    }
    Grid grid = grid_of(std::span(&shape, 1));
    double rounding_m = 0;
    Level level = level_of(shape, grid, rounding_m);
    ASSERT_EQ(level.indices.size(), 12000u);
    double sum_m = 0;
    auto corner_m = [&](size_t i) {
        const auto& at = level.vertices[level.indices[i]].position;
        return grid.position_step_m * glm::dvec3(at[0], at[1], at[2]);
    };
    for (size_t i = 3; i < level.indices.size(); i += 3) sum_m += glm::distance(corner_m(i), corner_m(i - 3));
    // In the order in which they come 0.66; 0.06 is about the distance of neighbours.
    EXPECT_LT(sum_m / 4000, 0.12);
}

TEST(ChainFromMesh, KeepsEveryBoundAndSavesAsMuchAsAsked) {
    MeshChainReport report;
    Chain chain = chain_of(ball(60, 80), budgeted(), report);
    ASSERT_GE(chain.levels.size(), 5u);
    EXPECT_EQ(chain.levels[0].triangle_count(), 60u * 80 * 2 + 160);
    for (size_t k = 1; k < chain.levels.size(); ++k)
        EXPECT_GE(double(chain.levels[k - 1].triangle_count()) / double(chain.levels[k].triangle_count()), 1.4);
    EXPECT_LE(chain.levels.back().triangle_count(), 60u);
    expect_bounded(chain, 0.3);
    EXPECT_LT(chain.finest_error_m, 1e-4);
}
TEST(ChainFromMesh, SaysOfEveryLevelTriedWhyItIsThere) {
    MeshChainReport report;
    MeshChainOptions options = budgeted();
    options.ladder.factor = 1.2;
    Chain chain = chain_of(ball(30, 40), options, report);
    size_t kept = 0;
    for (const TriedLevel& tried : report.tried) {
        kept += tried.verdict.is_kept;
        EXPECT_FALSE(tried.verdict.why.empty());
    }
    EXPECT_EQ(kept, chain.levels.size());
    EXPECT_GT(report.tried.size(), kept);
}
TEST(ChainFromMesh, HoldsEverythingInItsSphere) {
    MeshChainReport report;
    Chain chain = chain_of(ball(30, 40), budgeted(), report);
    for (const Level& level : chain.levels)
        for (const Vertex& v : level.vertices) EXPECT_LE(glm::distance(position_m(chain, v), chain.middle_m), chain.radius_m);
}
TEST(ChainFromMesh, MakesLevelsPlainThatAreSeenFromAfar) {
    MeshChainOptions options = budgeted();
    MeshChainReport report;
    for (const Level& level : chain_of(ball(30, 40), options, report).levels) EXPECT_FALSE(level.is_plain);
    options.plain_px = 40;
    Chain chain = chain_of(ball(30, 40), options, report);
    size_t plain = 0;
    for (const Level& level : chain.levels) {
        // The ball's sphere is 2.16 m to 3.75 m wide (of its box).
        double wide_px = options.ladder.view.focal_px() / options.ladder.view.distance_m(double(level.error_m));
        if (wide_px * 2.1 > 40) {
            EXPECT_FALSE(level.is_plain);
        }
        if (wide_px * 3.8 < 40) {
            EXPECT_TRUE(level.is_plain);
        }
        plain += level.is_plain;
    }
    EXPECT_GE(plain, 1u);
    EXPECT_LT(plain, chain.levels.size());
    // With masks they would be drawn without their holes.
    for (const Level& level : chain_of(test::file_of(test::bush(300)), options, report).levels) EXPECT_FALSE(level.is_plain);
}
TEST(ChainFromMesh, IsTheSameForAnyNumberOfThreads) {
    std::vector<Chain> chains;
    for (unsigned threads : {1u, 4u}) {
        set_thread_count(threads);
        MeshChainReport report;
        chains.push_back(chain_of(test::file_of(test::bush(300)), budgeted(), report));
    }
    set_thread_count(0);
    EXPECT_EQ(chains[0].levels, chains[1].levels);
}

TEST(ChainOfFoliage, LosesWholeCardsWithinItsBoundAndStatesTheAreaThatIsGone) {
    MeshChainReport report;
    mesh::MeshFile file = test::file_of(test::bush(1500));
    MeshChainOptions options = budgeted();
    options.grows_foliage = false;
    Chain chain = chain_of(file, options, report);
    EXPECT_EQ(report.card_count, 1500u);
    EXPECT_EQ(report.card_triangle_count, 3000u);
    ASSERT_GE(chain.levels.size(), 4u);
    expect_bounded(chain, 0.3);
    double finest_m2 = 0, finest_leaves_m2 = 0;
    for (const Level& level : chain.levels) {
        uint64_t card_triangles = 0;
        double area_m2 = 0, leaves_m2 = 0;
        std::vector<caveclod::Triangle> all = triangles_of(chain, level);
        for (const Draw& draw : level.draws) {
            bool is_leaves = chain.surfaces[draw.surface].name == "leaves";
            if (is_leaves) card_triangles = draw.index_count / 3;
            for (uint32_t i = draw.first_index / 3; i < (draw.first_index + draw.index_count) / 3; ++i) {
                double one_m2 = glm::length(glm::cross(all[i][1] - all[i][0], all[i][2] - all[i][0])) / 2;
                area_m2 += one_m2, leaves_m2 += is_leaves ? one_m2 : 0;
            }
        }
        EXPECT_EQ(card_triangles % 2, 0u);
        if (&level == &chain.levels[0]) finest_m2 = area_m2, finest_leaves_m2 = leaves_m2;
        EXPECT_GE(double(level.lost_area_share), (finest_leaves_m2 - leaves_m2) / finest_m2 - 1e-3);
        // The bark loses area too, but that is told by its distance.
        EXPECT_LE(double(level.lost_area_share), 1 - area_m2 / finest_m2 + 1e-3);
    }
    EXPECT_GT(chain.levels.back().lost_area_share, 0.3f);
}
TEST(ChainOfFoliage, GrowsWhatStaysToKeepTheArea) {
    mesh::MeshFile file = test::file_of(test::bush(1500));
    MeshChainReport thin_report, grown_report;
    MeshChainOptions thin = budgeted();
    thin.grows_foliage = false;
    Chain thinned = chain_of(file, thin, thin_report), grown = chain_of(file, budgeted(), grown_report);
    expect_bounded(grown, 0.2);
    ASSERT_EQ(thin_report.tried.size(), grown_report.tried.size());
    double lost_thin = 0, lost_grown = 0;
    for (size_t i = 1; i < thin_report.tried.size(); ++i)
        lost_thin += thin_report.tried[i].lost_area_share, lost_grown += grown_report.tried[i].lost_area_share;
    EXPECT_LT(lost_grown, 0.5 * lost_thin);
}
TEST(ChainOfFoliage, KeepsAllCardsWhereThatIsAsked) {
    MeshChainReport report;
    MeshChainOptions options = budgeted();
    options.thins_foliage = false;
    Chain chain = chain_of(test::file_of(test::bush(500)), options, report);
    EXPECT_EQ(report.card_count, 0u);
    EXPECT_GE(chain.levels.back().triangle_count(), 500u);
    EXPECT_EQ(chain.levels.back().lost_area_share, 0);
}
TEST(Foliage, LosesTheSmallestOfNeighboursFirst) {
    sample::ShapeMaker shapes({test::leaves()});
    for (int i = 0; i < 64; ++i)
        shapes.add_card(0, glm::dvec3(i, 0, 0), glm::dvec3(i % 2 == 0 ? 0.2 : 0.1, 0, 0), glm::dvec3(0, 0, 0.1), {0, -1, 0});
    mesh::Mesh mesh = shapes.take();
    Shape shape;
    for (const glm::vec3& p : mesh.positions_m)
        shape.vertices.push_back({glm::dvec3(p), 0, {0, 0, 1}, {0, 0}, {255, 255, 255, 255}});
    for (const mesh::Corners& f : mesh.faces) shape.faces.push_back(f), shape.face_surface.push_back(0);
    Foliage foliage(shape);
    ASSERT_EQ(foliage.card_count(), 64u);
    std::vector<uint32_t> half(32);
    std::iota(half.begin(), half.end(), 0u);
    std::set<int> kept;
    for (const ShapeVertex& v : foliage.thinned(half, 0).shape.vertices) kept.insert(int(std::lround(v.at_m.x)));
    for (int i : kept) EXPECT_EQ(i % 2, 0);
    EXPECT_EQ(kept.size(), 32u);
    // Every lost card has its larger neighbour 1 m away; from its far corner to that one's edge it is 0.9 m at the most.
    EXPECT_NEAR(foliage.thinned(half, 0).error_m, 0.9, 1e-6);
}

TEST(Foliage, KeepsACardThatStandsAloneHoweverSmallItIs) {
    sample::ShapeMaker shapes({test::leaves()});
    for (int i = 0; i < 64; ++i) shapes.add_card(0, glm::dvec3(0.13 * i, 0, 0), {0.1, 0, 0}, {0, 0, 0.1}, {0, -1, 0});
    shapes.add_card(0, glm::dvec3(3, 20, 0), {0.01, 0, 0}, {0, 0, 0.01}, {0, -1, 0});
    mesh::Mesh mesh = shapes.take();
    Shape shape;
    for (const glm::vec3& p : mesh.positions_m)
        shape.vertices.push_back({glm::dvec3(p), 0, {0, 0, 1}, {0, 0}, {255, 255, 255, 255}});
    for (const mesh::Corners& f : mesh.faces) shape.faces.push_back(f), shape.face_surface.push_back(0);
    Foliage foliage(shape);
    for (double limit_m : {0.3, 1.0, 3.0}) {
        Foliage::Thinned thinned = foliage.thinned(foliage.kept_within(limit_m), 0);
        EXPECT_LE(thinned.error_m, limit_m);
        EXPECT_LT(thinned.shape.faces.size(), 64u);
        double farthest_m = 0;
        for (const ShapeVertex& v : thinned.shape.vertices) farthest_m = std::max(farthest_m, v.at_m.y);
        EXPECT_EQ(farthest_m, 20);
    }
}

}  // namespace
}  // namespace overlook::discrete
