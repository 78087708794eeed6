// Thin things keep as many samples as cover what they do, walls keep theirs.
#include "tools/bake/wang_ldi/covering.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/tools/wang_ldi/plants.h"
#include "tools/bake/wang_ldi/assemble.h"
#include "tools/bake/wang_ldi/judge.h"

namespace overlook::wang_ldi {
namespace {

void add_board(rays::Mesh& mesh, const glm::vec3& at, const glm::vec3& side, float height) {
    glm::vec3 up(0, 0, height);
    plants::add_triangle(mesh, at, at + side, at + side + up), plants::add_triangle(mesh, at, at + side + up, at + up);
}

struct Stand {
    Models models;
    std::vector<TraceStage> stages;
    ImageSet set = plants::image_set();

    // directions: 1: all sides in one image.
    explicit Stand(const rays::Mesh& mesh, uint32_t directions = 4) {
        set.direction_count = directions;
        models.meshes = {mesh}, models.skins = {plants::skin_of({0.5f, 0.5f, 0.5f})};
        set.high_m = 1.01, set.has_normals = true;  // so that its colour is its own
        auto stage = stage_of(models, {{0, glm::mat4x3(1)}}, uint64_t(1) << 30);
        EXPECT_TRUE(stage);
        stages.push_back(std::move(*stage));
    }
    Sampled all(uint32_t level) const { return sampled(models, stages, wedge_of(set, level, 0), {}); }
    Sampled kept(uint32_t level, const Sampled& of, uint64_t seed = 1) const {
        return covering(stages, wedge_of(set, level, 0), set.cell.focal_px, of, seed);
    }
    Judgement judgement(uint32_t level, const Sampled& of) const {
        std::vector<glm::vec3> colours(of.samples.size(), glm::vec3(0.5f));
        Judging judging;
        judging.views = 24;
        return judged(models, stages[0], set, {0, 0, level, 0}, assembled(set, level, of, colours), {}, judging);
    }
};

// Blades of a few millimetres, a quarter of a pixel of the image, turned any way.
rays::Mesh blades() {
    rays::Mesh mesh;
    Random random(7);
    for (int blade = 0; blade < 500; ++blade) {
        float x = 0.1f + 3.8f * float(random.next_unit()), y = 0.1f + 3.8f * float(random.next_unit());
        float turn = float(M_PI * random.next_unit());
        add_board(mesh, {x, y, 0}, 0.006f * glm::vec3(std::cos(turn), std::sin(turn), 0), 1);
    }
    return mesh;
}

class CoveringOf : public testing::TestWithParam<uint32_t> {};

TEST_P(CoveringOf, DrawsBladesAboutAsWideAsTheyAre) {
    Stand stand(blades(), GetParam());
    for (uint32_t level : {0u, 1u}) {
        Sampled all = stand.all(level), kept = stand.kept(level, all);
        Judgement by_all = stand.judgement(level, all), by_kept = stand.judgement(level, kept);
        ASSERT_GT(by_all.covered, 2000u);
        EXPECT_GT(by_all.covered_times(), 2) << level;
        EXPECT_GT(by_kept.covered_times(), 0.7) << level;
        EXPECT_LT(by_kept.covered_times(), 1.4) << level;
        EXPECT_LT(by_kept.mean_unfilled_error(), by_all.mean_unfilled_error()) << level;
        EXPECT_LT(2 * kept.samples.size(), all.samples.size());
    }
}

TEST_P(CoveringOf, KeepsAllOfAWallButItsRim) {
    rays::Mesh wall;
    add_board(wall, {0.5f, 2.01f, 0}, {3, 0, 0}, 1);
    Stand stand(wall, GetParam());
    Sampled all = stand.all(0), kept = stand.kept(0, all);
    double pixel_m = stand.set.tile_m / stand.set.levels[0].side_px;
    auto inside = [&](const Sampled& of) {
        return std::count_if(of.samples.begin(), of.samples.end(), [&](const Sample& sample) {
            double x = (sample.pixel % stand.set.levels[0].side_px + 0.5) * pixel_m, z = double(sample.height_m);
            return std::min(x - 0.5, 3.5 - x) > 2 * pixel_m && std::min(z, 1 - z) > 2 * pixel_m;
        });
    };
    ASSERT_GT(inside(all), 2000);
    EXPECT_EQ(inside(kept), inside(all));
    Judgement by_all = stand.judgement(0, all), by_kept = stand.judgement(0, kept);
    ASSERT_GT(by_all.pixels, 20000u);
    EXPECT_NEAR(double(by_kept.holes_left), double(by_all.holes_left), 0.001 * double(by_all.pixels));
    EXPECT_NEAR(by_kept.covered_times(), by_all.covered_times(), 0.02);
}

INSTANTIATE_TEST_SUITE_P(Directions, CoveringOf, testing::Values(1, 4));

TEST(Covering, KeepsTheSameSamplesOfThoseThereAre) {
    Stand stand(blades());
    Sampled all = stand.all(0), kept = stand.kept(0, all), again = stand.kept(0, all), other = stand.kept(0, all, 2);
    auto cubes = [](const Sampled& of) {
        std::vector<std::pair<uint32_t, uint32_t>> places;
        for (const Sample& sample : of.samples) places.emplace_back(sample.pixel, sample.layer);
        return places;
    };
    auto all_cubes = cubes(all), kept_cubes = cubes(kept);
    EXPECT_EQ(kept_cubes, cubes(again));
    EXPECT_NE(kept_cubes, cubes(other));
    EXPECT_TRUE(std::includes(all_cubes.begin(), all_cubes.end(), kept_cubes.begin(), kept_cubes.end()));
    EXPECT_EQ(kept.unseen_share, all.unseen_share);
    EXPECT_TRUE(stand.kept(0, Sampled{}).samples.empty());
}

TEST(ShareCovering, CoversWhatIsWanted) {
    EXPECT_NEAR(share_covering(0.3, std::array<uint32_t, 2>{0, 25}, 0), 0.3, 1e-3);
    EXPECT_NEAR(share_covering(0.36, std::array<uint32_t, 3>{0, 0, 25}, 0), 0.2, 1e-3);
    EXPECT_NEAR(share_covering(0.5, std::array<uint32_t, 2>{5, 10}, 10), 0.25, 1e-3);
    EXPECT_EQ(share_covering(0.5, std::array<uint32_t, 2>{20, 5}, 0), 1);   // as much as there is
    EXPECT_EQ(share_covering(0.2, std::array<uint32_t, 2>{10, 5}, 10), 0);  // more is covered without
}

}  // namespace
}  // namespace overlook::wang_ldi
