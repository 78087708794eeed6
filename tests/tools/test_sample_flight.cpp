#include "tools/make_sample/sample_flight.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace overlook::sample {
namespace {

const std::string kSamples = OVERLOOK_SOURCE_DIR "/samples/";

const Landscape& default_landscape() {
    static const Landscape kLandscape = make_landscape({});
    return kLandscape;
}
std::string file_text(const std::string& name) {
    std::ifstream in(kSamples + name);
    return {std::istreambuf_iterator<char>(in), {}};
}

// Of the stability suite's chains of levels, which stand on nothing, or over a planting's own land: test_sample_plants.cpp.
bool is_elsewhere(const std::filesystem::directory_entry& entry) {
    std::string name = entry.path().filename().string();
    return name.starts_with("chain-") || name.starts_with("planting-");
}

TEST(SampleFlights, AreWhatTheLandscapeMakes) {
    double cell_m = LandscapeOptions{}.cell_size_m;
    EXPECT_EQ(scene::json_from_flight(overview_flight(default_landscape(), cell_m)), file_text("flights/overview.json"));
    size_t count = 4;  // s11 is of the slopes, s09 and s10 of the vase and the masts
    for (const auto& [name, flight] : suite_flights(default_landscape(), cell_m)) {
        EXPECT_EQ(scene::json_from_flight(flight), file_text("flights/" + name + ".json")) << name;
        ++count;
    }
    size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(kSamples + "flights")) files += is_elsewhere(entry) ? 0 : 1;
    EXPECT_EQ(files, count);
}

TEST(SampleFlights, NeverGoUnderTheGround) {
    for (const auto& entry : std::filesystem::directory_iterator(kSamples + "flights")) {
        Result<scene::Flight> flight = scene::read_flight(entry.path().string());
        ASSERT_TRUE(flight) << flight.error().message;
        if (is_elsewhere(entry)) continue;
        std::string name = entry.path().stem().string();
        if (name == "s11") continue;                   // over the slopes
        if (name == "s09" || name == "s10") continue;  // round the vase, along the masts: test_sample_objects.cpp
        if (name == "s06") continue;                   // beside its row of samples the cell may be higher; see below
        double least_m = name == "s07" ? 30 : kLeastClearance_m;
        EXPECT_GE(least_clearance_m(*flight, default_landscape(), LandscapeOptions{}.cell_size_m), least_m) << name;
    }
}

TEST(SampleFlights, SkimTheGroundAtTwelveTenthsOfTheNearPlane) {
    const Landscape& landscape = default_landscape();
    Result<scene::Flight> flight = scene::read_flight(kSamples + "flights/s06.json");
    ASSERT_TRUE(flight);
    for (const scene::Key& key : flight->keys) {
        size_t column = size_t(key.position_m[0] / 30), row = size_t(-key.position_m[1] / 30);
        EXPECT_NEAR(key.position_m[2] - landscape.height_m[row * landscape.side + column], 0.6, 1e-9);
    }
}

TEST(SampleFlights, OfTheOverviewHaveSixHundredFramesOverAnyLandscape) {
    for (uint64_t seed : {1, 7}) {
        for (double cell_m : {5.0, 30.0, 400.0}) {
            Landscape landscape = make_landscape({seed, 129, cell_m});
            scene::Flight flight = overview_flight(landscape, cell_m);
            EXPECT_EQ(scene::frame_count(flight), 600u);
            EXPECT_GE(least_clearance_m(flight, landscape, cell_m), kLeastClearance_m) << seed << " " << cell_m;
        }
    }
}

TEST(SampleScene, IsThatOfTheMadeLandscape) {
    Result<scene::Scene> scene = scene::read_scene(kSamples + "scenes/sample.json");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_TRUE(scene->layers[0].asset.ends_with("/" + sample_scene().layers[0].asset));
    scene->layers[0].asset = sample_scene().layers[0].asset;
    EXPECT_EQ(scene::json_from_scene(*scene), scene::json_from_scene(sample_scene()));
}

}  // namespace
}  // namespace overlook::sample
