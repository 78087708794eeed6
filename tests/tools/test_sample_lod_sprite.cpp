#include "tools/make_sample/sample_lod_sprite.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "runtime/terrain/refine.h"
#include "runtime/view/flight.h"
#include "tests/formats/scratch_folder.h"
#include "tools/bake/terrain.h"
#include "tools/make_sample/sample_flight.h"

namespace overlook::sample {
namespace {

constexpr double kHighTolerance = 0.01, kLowTolerance = 0.05;  // of the paper's counts

const Landscape& landscape() {
    static const Landscape kLandscape = make_landscape(lod_sprite_landscape({}));
    return kLandscape;
}

double cell_size_m() {
    return lod_sprite_landscape({}).cell_size_m;
}

std::string text_of(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

view::Camera camera_at_frame(uint32_t frame) {
    scene::Flight flight = lod_sprite_flight();
    view::Camera base;
    base.width_px = base.height_px = 512;
    return view::camera_at(flight, scene::frame_time_s(flight, frame), base);
}

TEST(LodSpriteSample, HasThePapersTrianglesInTheViewsOfFiguresSixAndSeven) {
    dem::Raster dem;
    dem.width = dem.height = landscape().side;
    dem.samples = landscape().height_m;
    dem.frame.metres_per_column = dem.frame.metres_per_row = cell_size_m();
    Result<terrain::Terrain> baked = terrain::bake(dem, {}, [](double) {});
    ASSERT_TRUE(baked) << baked.error().message;
    terrain::Refiner refiner(*baked);
    terrain::Cut cut;
    for (const FigureView& view : kLodSpriteViews) {
        scene::Flight flight = lod_sprite_flight();
        view::Camera camera = camera_at_frame(uint32_t(view.time_s / flight.step_s));
        refiner.cut_by_pixels(camera, kLodSpriteHigh_px, cut);
        EXPECT_NEAR(double(cut.triangle_count()), double(view.high_triangle_count),
                    kHighTolerance * double(view.high_triangle_count))
            << "figure " << view.figure;
        refiner.cut_by_pixels(camera, kLodSpriteLow_px, cut);
        EXPECT_NEAR(double(cut.triangle_count()), double(view.low_triangle_count),
                    kLowTolerance * double(view.low_triangle_count))
            << "figure " << view.figure;
    }
}

TEST(LodSpriteSample, IsFlownFromAwayOverPlainRangeAndPlain) {
    scene::Flight flight = lod_sprite_flight();
    ASSERT_EQ(scene::frame_count(flight), 600u);
    EXPECT_LT(camera_at_frame(0).position_m.y, -kLodSpriteExtent_m - 10'000) << "begins beside the terrain";
    EXPECT_GE(least_clearance_m(flight, landscape(), cell_size_m()), 10 * kLeastClearance_m);

    // The highest ground within a kilometre of the way, frame by frame: low, high, low.
    std::vector<double> ground;
    for (uint32_t frame = 0; frame < 600; ++frame) {
        glm::dvec3 at_m = camera_at_frame(frame).position_m;
        if (at_m.y < -kLodSpriteExtent_m) continue;
        double highest_m = 0;
        for (double dx_m = -1000; dx_m <= 1000; dx_m += 100)
            highest_m = std::max(highest_m, ground_m(landscape(), cell_size_m(), at_m.x + dx_m, at_m.y));
        ground.push_back(highest_m);
    }
    ASSERT_GT(ground.size(), 300u);
    double top_m = *std::max_element(ground.begin(), ground.end());
    EXPECT_GT(top_m, 2000);
    EXPECT_LT(ground.front(), 900);
    EXPECT_LT(ground.back(), 900);
}

TEST(LodSpriteSample, IsTheSameWayForAnyNumberOfFrames) {
    scene::Flight flight = lod_sprite_flight();
    double length_s = flight.keys.back().time_s;
    for (uint32_t frames : {75u, 150u, 2400u}) {
        scene::Flight other = flight;
        other.step_s = length_s / (frames - 1);
        EXPECT_EQ(scene::frame_count(other), frames);
        view::Camera last = view::camera_at(other, scene::frame_time_s(other, frames - 1), {});
        EXPECT_NEAR(glm::distance(last.position_m, camera_at_frame(599).position_m), 0, 1e-6);
    }
}

TEST(LodSpriteSample, WritesWhatTheRunNeeds) {
    ScratchFolder folder;
    LodSpriteOptions options{1, 65};
    Result<LodSpriteReport> report = make_lod_sprite(options, folder.path());
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->files.size(), 6u);
    std::string texture = text_of(folder / "texture.ppm"), head = "P6\n65 65\n255\n";
    EXPECT_TRUE(texture.starts_with(head));
    EXPECT_EQ(texture.size(), head.size() + 65 * 65 * 3);
    EXPECT_TRUE(scene::read_scene(folder / "scene.json"));
    EXPECT_TRUE(scene::read_flight(folder / "flight.json"));

    ScratchFolder again;
    ASSERT_TRUE(make_lod_sprite(options, again.path()));
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        std::string name = entry.path().filename().string();
        EXPECT_EQ(text_of(folder / name), text_of(again / name)) << name;
    }
}

TEST(LodSpriteSample, RefusesASizeItCannotMake) {
    Result<LodSpriteReport> report = make_lod_sprite({1, 20}, "never-made");
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().exit, Exit::bad_command);
    EXPECT_EQ(report.error().message, "--size 20 is outside 33..4097");
    EXPECT_FALSE(std::filesystem::exists("never-made"));
}

}  // namespace
}  // namespace overlook::sample
