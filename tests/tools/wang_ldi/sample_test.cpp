// What is sampled lies on the surfaces, is seen from the cell, and is all of it that the estimate says.
#include "tools/bake/wang_ldi/sample.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/tools/wang_ldi/plants.h"
#include "tools/bake/wang_ldi/assemble.h"

namespace overlook::wang_ldi {
namespace {

TraceStage staged(const Models& models, std::vector<rays::Copy> copies) {
    auto stage = stage_of(models, std::move(copies), uint64_t(1) << 32);
    EXPECT_TRUE(stage) << stage.error().message;
    return std::move(*stage);
}
rays::Copy at(uint32_t model, float x, float y) {
    return {model, glm::mat4x3({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {x, y, 0})};
}

struct Field {
    Models models = plants::models();
    Planting planting = plants::planting(3);
    std::vector<TraceStage> stages;
    ImageSet set = plants::image_set();

    Field() { stages.push_back(staged(models, copies_of(plants::one_tile(), planting, {0, 0, 0, 0, 0, 0, 0, 0, 0}))); }
};

TEST(Samples, LieWithinACubeOfTheSurfaceThatTheyWereMetOn) {
    Models models;
    models.meshes = {plants::ball(0.8f, 1, 40)}, models.skins = {Skin{}};
    std::vector<TraceStage> stages;
    stages.push_back(staged(models, {at(0, 2, 2)}));
    ImageSet set = plants::image_set();
    set.high_m = 2;
    Sampled all = sampled(models, stages, wedge_of(set, 0, 1), {});
    ASSERT_GT(all.samples.size(), 2000u);
    double pixel_m = 4.0 / 160;
    for (const Sample& sample : all.samples) {
        glm::dvec3 middle((sample.pixel % 160 + 0.5) * pixel_m, (sample.pixel / 160 + 0.5) * pixel_m, double(sample.height_m));
        EXPECT_NEAR(glm::distance(middle, glm::dvec3(2, 2, 1)), 0.8, 0.75 * pixel_m + 0.004);
        EXPECT_GT(glm::dot(sample.normal, glm::normalize(glm::vec3(middle) - glm::vec3(2, 2, 1))), 0.9f);
    }
}

// Eyes fill the distances and the headings that the set states for an image, its fades with them, and none is beyond.
TEST(Samples, ComeFromAllEyesThatAnImageIsDrawnForInItsFades) {
    ImageSet set = plants::image_set();
    set.level_fade = 0.05f, set.direction_fade = 0.1f;
    for (uint32_t level : {0u, 1u}) {
        Wedge wedge = wedge_of(set, level, 1);
        double nearest = INFINITY, farthest = 0, widest_deg = 0;
        Eye eye;
        for (uint64_t index = 0; index < 4000; ++index) {
            set_eye(wedge, 5, index, 16, eye);
            glm::dvec2 from_middle = glm::dvec2(eye.at_m) - 2.0;
            ASSERT_TRUE(is_sampled_for(set, level, 1, from_middle, double(eye.at_m.z)));
            nearest = std::min(nearest, glm::length(from_middle)), farthest = std::max(farthest, glm::length(from_middle));
            double heading_deg = std::atan2(from_middle.x, from_middle.y) * 180 / M_PI;
            widest_deg = std::max(widest_deg, std::abs(heading_deg - 90));
        }
        EXPECT_NEAR(nearest, 0.95 * (level == 0 ? 6 : 12), 0.01);
        EXPECT_NEAR(farthest, 1.05 * (level == 0 ? 12 : 60), 0.05);
        EXPECT_NEAR(widest_deg, 0.6 * 90, 0.05);
    }
}

TEST(Samples, AreWhatTheEstimateSaysOfHeldOutRays) {
    Field field;
    for (double goal : {0.2, 0.05, 0.02}) {
        SampleOptions options;
        options.unseen_goal = goal, options.rays_per_eye = 4096;
        Wedge wedge = wedge_of(field.set, 0, 2);
        Sampled all = sampled(field.models, field.stages, wedge, options);
        EXPECT_LE(all.unseen_share, goal);
        double held_out = unseen_of_held_out(field.stages, wedge, all, 300'000, 99);
        EXPECT_NEAR(held_out, all.unseen_share, 0.35 * all.unseen_share + 0.002) << goal;
    }
}

// Balls that touch hide much of each other, and eyes in the clefts between them see what no other does.
TEST(Samples, OfPackedBallsLackNoMoreThanTheEstimateSaysOfAMillionRays) {
    Models models;
    models.meshes = {plants::ball(0.25f, 0.25f, 12)}, models.skins = {Skin{}};
    std::vector<rays::Copy> copies;
    for (int i = 0; i < 64; ++i) copies.push_back(at(0, 0.25f + 0.5f * float(i % 8), 0.25f + 0.5f * float(i / 8)));
    std::vector<TraceStage> stages;
    stages.push_back(staged(models, copies));
    ImageSet set = plants::image_set();
    set.high_m = 0.5, set.levels[0].side_px = 90;
    double estimates = 0, all_held_out = 0;
    for (uint32_t directions : {1u, 3u, 8u})
        for (uint64_t seed : {1u, 2u}) {
            set.direction_count = directions;
            SampleOptions options;
            options.seed = seed;
            Wedge wedge = wedge_of(set, 0, 1 % directions);
            Sampled all = sampled(models, stages, wedge, options);
            EXPECT_LE(all.unseen_share, 0.02);
            double held_out = unseen_of_held_out(stages, wedge, all, 1'000'000, 99);
            EXPECT_LE(held_out, 1.2 * all.unseen_share) << directions << " " << seed;
            estimates += all.unseen_share, all_held_out += held_out;
        }
    // Eyes are spread evenly: one that is left out is farther from the others than one anywhere.
    EXPECT_LE(estimates, 2 * all_held_out);
}

// A blade 2 cm wide in a tile of 30 m is met by a ray in ten thousand.
TEST(Samples, OfABladeInAWideTileAreNotTakenForAllAfterAFewHits) {
    Models models;
    models.meshes = {rays::Mesh()}, models.skins = {Skin{}};
    plants::add_triangle(models.meshes[0], {-0.01f, 0, 0}, {0.01f, 0, 0}, {0.01f, 0, 1.2f});
    plants::add_triangle(models.meshes[0], {-0.01f, 0, 0}, {0.01f, 0, 1.2f}, {-0.01f, 0, 1.2f});
    std::vector<TraceStage> stages;
    stages.push_back(staged(models, {at(0, 15, 15)}));
    ImageSet set = plants::image_set();
    set.tile_m = 30, set.high_m = 1.3, set.cell.nearest_m = 75, set.cell.farthest_m = 110;
    set.levels = {{346, 75, 0.02f, 1}};
    Wedge wedge = wedge_of(set, 0, 0);
    for (uint64_t seed = 1; seed <= 4; ++seed) {
        SampleOptions options;
        options.seed = seed;
        Sampled all = sampled(models, stages, wedge, options);
        EXPECT_GE(all.hits, 200u);
        EXPECT_LE(unseen_of_held_out(stages, wedge, all, 6'000'000, 99), 0.1) << seed << ": of " << all.rays;
    }
}

TEST(Samples, StopAfterTheRaysThatThePaperShoots) {
    Field field;
    SampleOptions options;
    options.fixed_rays = 50'000, options.rays_per_eye = 4096;
    Sampled all = sampled(field.models, field.stages, wedge_of(field.set, 1, 0), options);
    EXPECT_GE(all.rays, 50'000u);
    EXPECT_LT(all.rays, 56'000u);
    EXPECT_LE(all.hits, all.rays);
}

TEST(Samples, OfAnEmptyTileAreNone) {
    Models models = plants::models();
    std::vector<TraceStage> stages;
    stages.push_back(staged(models, {}));
    Sampled all = sampled(models, stages, wedge_of(plants::image_set(), 0, 0), {});
    EXPECT_EQ(all.samples.size(), 0u);
    EXPECT_LT(all.eyes, 100u);
    EXPECT_EQ(all.unseen_share, 0);
}

TEST(Samples, ShowNoWallsFromBehindAndNothingThatNeighboursHide) {
    // A wall along x in the middle of the tile, two boxes of colour; behind it, to the north, a ball.
    Models models;
    models.meshes = {rays::Mesh(), plants::ball(0.3f, 0.4f, 16)};
    plants::add_triangle(models.meshes[0], {0, 0, -1}, {8, 0, -1}, {0, 0, 8});
    models.skins = {Skin{}, Skin{}};
    ImageSet set = plants::image_set();
    auto copies_met = [&](std::vector<rays::Copy> copies, uint32_t direction) {
        std::vector<TraceStage> stages;
        stages.push_back(staged(models, std::move(copies)));
        std::set<uint32_t> met;
        for (const Sample& sample : sampled(models, stages, wedge_of(set, 0, direction), {}).samples) met.insert(sample.hit.copy);
        return met;
    };
    // Direction 0 is for eyes in the north, 2 in the south. The wall from x = -6 to 2, up to 8 m high at its west end, hides the
    // ball from the south, as a part of the tile or standing in its southern neighbour.
    EXPECT_EQ(copies_met({at(0, 0, 2), at(1, 1, 3)}, 0).count(1), 1u);
    EXPECT_EQ(copies_met({at(0, -20, 2), at(1, 1, 3)}, 2), (std::set<uint32_t>{1}));
    rays::Copy wide{0, glm::mat4x3({10, 0, 0}, {0, 1, 0}, {0, 0, 10}, {-40, -1, 0})};
    EXPECT_EQ(copies_met({wide, at(1, 2, 2)}, 2), std::set<uint32_t>{});
    EXPECT_EQ(copies_met({wide, at(1, 2, 2)}, 0), std::set<uint32_t>{1});
}

// A post with a face of another colour on each side: the image for an eye shows the face that is turned to it.
TEST(Samples, OfADirectionShowTheSidesThatItsEyesSee) {
    Models models;
    models.meshes = {rays::Mesh()}, models.skins = {Skin{}};
    // North, east, south, west: whose heading is 0, 90, 180, 270 degrees.
    std::array<glm::vec3, 4> outward{glm::vec3(0, 1, 0), {1, 0, 0}, {0, -1, 0}, {-1, 0, 0}};
    std::array<glm::vec3, 4> colours{glm::vec3(1, 0, 0), {0, 1, 0}, {0, 0, 1}, {1, 1, 0}};
    models.skins[0].looks.clear();
    for (uint32_t side = 0; side < 4; ++side) {
        glm::vec3 along(outward[side].y, -outward[side].x, 0), foot = outward[side] * 0.3f, up(0, 0, 3);
        plants::add_triangle(models.meshes[0], foot - along * 0.3f, foot + along * 0.3f, foot + along * 0.3f + up);
        plants::add_triangle(models.meshes[0], foot - along * 0.3f, foot + along * 0.3f + up, foot - along * 0.3f + up);
        models.skins[0].looks.push_back({colours[side], rays::kNone, 0});
        models.skins[0].looks_of.insert(models.skins[0].looks_of.end(), {side, side});
    }
    std::vector<TraceStage> stages;
    stages.push_back(staged(models, {at(0, 2, 2)}));
    ImageSet set = plants::image_set();
    set.high_m = 3, set.direction_count = 16;
    for (double heading_deg : {0.0, 80.0, 95.0, 180.0, 268.0}) {
        double heading = heading_deg * M_PI / 180;
        uint32_t direction = direction_for(set, 9.0 * glm::dvec2(std::sin(heading), std::cos(heading)));
        std::array<size_t, 4> seen{};
        for (const Sample& sample : sampled(models, stages, wedge_of(set, 0, direction), {}).samples)
            for (size_t side = 0; side < 4; ++side) seen[side] += sample.albedo == colours[side];
        size_t turned = size_t(std::lround(heading_deg / 90)) % 4;
        EXPECT_EQ(size_t(std::max_element(seen.begin(), seen.end()) - seen.begin()), turned) << heading_deg;
        EXPECT_EQ(seen[(turned + 2) % 4], 0u) << heading_deg;
    }
}

TEST(Neighbours, FitEdgeByEdge) {
    TileSet set;
    set.horizontal.resize(2), set.vertical.resize(2);
    for (uint8_t i = 0; i < 16; ++i)
        set.tiles.push_back({uint8_t(i & 1), uint8_t(i >> 1 & 1), uint8_t(i >> 2 & 1), uint8_t(i >> 3)});
    std::set<std::array<int, 9>> all;
    for (uint64_t seed = 0; seed < 50; ++seed) {
        auto tiles = neighbourhood(set, seed % 16, seed);
        all.insert(tiles);
        EXPECT_EQ(tiles[4], int(seed % 16));
        auto tile = [&](int place) { return set.tiles[size_t(tiles[size_t(place)])]; };
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column) {
                int place = 3 * row + column;
                EXPECT_TRUE(column == 2 || tile(place).east == tile(place + 1).west);
                EXPECT_TRUE(row == 2 || tile(place).north == tile(place + 3).south);
            }
    }
    EXPECT_GT(all.size(), 40u);
}

}  // namespace
}  // namespace overlook::wang_ldi
