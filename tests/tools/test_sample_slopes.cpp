#include "tools/make_sample/sample_slopes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>

#include "runtime/view/flight.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::sample {
namespace {

const std::string kSamples = OVERLOOK_SOURCE_DIR "/samples/";

std::string file_text(const std::string& path) {
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), {}};
}

// Rise over a whole wave, on the western side of each ridge.
TEST(SampleSlopes, RiseAtTheAnglesStated) {
    for (size_t i = 0; i < kSlopes_deg.size(); ++i) {
        double crest_m = 520 + 760 * double(i), mean_deg = 0;
        for (double south_m : {300.0, 1234.0, 2000.0}) {
            double low_m = slope_height_m(crest_m - 220, south_m), high_m = slope_height_m(crest_m - 110, south_m);
            mean_deg = std::atan2(high_m - low_m, 110) * 180 / std::numbers::pi;
            EXPECT_NEAR(mean_deg, kSlopes_deg[i], 0.01) << south_m;
        }
        EXPECT_NEAR(slope_height_m(crest_m + 100, 700), slope_height_m(crest_m - 100, 700), 1e-9);
    }
    EXPECT_EQ(slope_height_m(100, 900), 0);
}

TEST(SampleSlopes, AreNotPlane) {
    double least_m = 1e9, most_m = -1e9;
    for (double south_m = 0; south_m < 340; south_m += 10) {
        least_m = std::min(least_m, slope_height_m(1067.5, south_m));
        most_m = std::max(most_m, slope_height_m(1067.5, south_m));
    }
    EXPECT_GT(most_m - least_m, 5);
}

TEST(SampleSlopes, AreWrittenTheSameEveryTimeWithTheirScene) {
    ScratchFolder folder;
    Result<std::vector<std::string>> first = make_slopes(folder / "a"), second = make_slopes(folder / "b");
    ASSERT_TRUE(first && second);
    ASSERT_EQ(first->size(), 2u);
    for (size_t i = 0; i < 2; ++i) EXPECT_EQ(file_text((*first)[i]), file_text((*second)[i]));
    Result<scene::Scene> scene = scene::read_scene((*first)[1]);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->layers[0].asset, "slopes.ovl");
}

TEST(SampleSlopes, AreFlownOverByCaseS11) {
    EXPECT_EQ(scene::json_from_flight(slopes_flight()), file_text(kSamples + "flights/s11.json"));
    scene::Flight flight = slopes_flight();
    for (uint32_t frame = 0; frame < scene::frame_count(flight); ++frame) {
        glm::dvec3 at_m = view::camera_at(flight, scene::frame_time_s(flight, frame), {}).position_m;
        bool is_over = at_m.y <= 0 && at_m.y >= -kSlopesCell_m * (kSlopesSide - 1);
        EXPECT_GE(at_m.z, (is_over ? slope_height_m(at_m.x, -at_m.y) : 0) + 50) << frame;
    }
}

}  // namespace
}  // namespace overlook::sample
