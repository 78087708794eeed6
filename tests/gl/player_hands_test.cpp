// What hands do to the player: keys, flying, and recording a flight.
#include <gtest/gtest.h>

#include <filesystem>

#include "runtime/player/controls.h"
#include "runtime/player/flight.h"
#include "runtime/player/record.h"
#include "runtime/player/scene.h"
#include "runtime/view/flight.h"
#include "tests/gl/fixture.h"

namespace overlook {
namespace {

TEST(PressedKeys, GoThroughTheMethodsOfMeshes) {
    player::FrameStyle style;
    style.method = player::Method::caveclod;
    style.thing = player::Thing::mesh;
    player::Presses press;
    press.method = 1, press.toggles_wireframe = true;
    for (player::Method then : {player::Method::caveclod_paper, player::Method::caveclod_shared, player::Method::discrete,
                                player::Method::lod_sprite, player::Method::caveclod}) {
        player::press(style, press);
        EXPECT_EQ(style.method, then);
    }
    EXPECT_EQ(style.look.look, terrain::Look::shaded);  // four times
}

TEST(PressedKeys, GoThroughTheMethodsOfChains) {
    player::FrameStyle style;
    style.method = player::default_method(player::Thing::chain);
    style.thing = player::Thing::chain;
    player::Presses press;
    press.method = 1;
    using enum player::Method;
    EXPECT_EQ(style.method, discrete);
    for (player::Method then : {discrete_fsi_paper, discrete_switch, discrete_blend, discrete_dither, discrete_late, discrete}) {
        player::press(style, press);
        EXPECT_EQ(style.method, then);
    }
}

TEST(PressedKeys, ChangeTheMethodAndWhatItShows) {
    player::FrameStyle style;
    player::Presses wireframe, sources, method;
    wireframe.toggles_wireframe = sources.toggles_sources = true;
    method.method = 1;
    player::press(style, sources);
    EXPECT_FALSE(style.shows_sources);  // terrain has none
    player::press(style, wireframe);
    EXPECT_EQ(style.look.look, terrain::Look::wireframe);
    player::press(style, method);
    EXPECT_EQ(style.method, player::Method::lod_sprite);
    player::press(style, sources);
    EXPECT_TRUE(style.shows_sources);
    player::press(style, wireframe);
    EXPECT_EQ(style.look.look, terrain::Look::wireframe);  // nothing of lod-sprite
    player::press(style, method);
    EXPECT_EQ(style.method, player::Method::lod_sprite_paper);
    player::press(style, method);
    EXPECT_EQ(style.method, player::Method::terrain);
}

TEST(WatchedKeys, TellWhenTheLastCameAndWhy) {
    using lod_sprite::Cause;
    player::KeyWatch keys;
    player::FrameRecord frame;
    frame.sprite.emplace();
    player::watch(keys, frame);
    EXPECT_EQ(keys.cause, Cause::none);
    frame.sprite->live_key_count = 1;
    frame.sprite->rekeyed = Cause::turned;
    player::watch(keys, frame);
    frame.sprite->rekeyed = Cause::none;
    for (int i = 0; i < 3; ++i) player::watch(keys, frame);
    EXPECT_EQ(keys.cause, Cause::turned);
    EXPECT_EQ(keys.frames_ago, 3u);
    player::watch(keys, {});  // by terrain
    EXPECT_EQ(keys.cause, Cause::none);
}

TEST(LodSpriteError, CarriesTheOtherPromisesAlong) {
    lod_sprite::FrameOptions options;
    lod_sprite::set(options, "low-error-px", 12);
    options = player::with_error(options, 2);
    EXPECT_EQ(options.decide.error_px, 2);
    EXPECT_EQ(options.decide.low_error_px, 24);
    EXPECT_EQ(options.decide.key_error_px, 2);
}

// A flight by hand, at an uneven frame rate: turns over north, stops, climbs.
std::vector<scene::Key> by_hand() {
    player::Recording recording{100, {}};
    view::Camera camera;
    for (int i = 0; i < 2000; ++i) {
        double t = i / 60.0 + 0.004 * (i % 3);
        camera.position_m = {300 * std::sin(t / 3), 40 * std::min(t, 12.0), 200 + std::max(0.0, t - 20) * 15};
        camera.heading_deg = 30 * std::sin(t / 2);
        camera.pitch_deg = -20 + 10 * std::cos(t);
        EXPECT_TRUE(player::add_sample(recording, camera, 100 + t));
        EXPECT_TRUE(player::add_sample(recording, camera, 100 + t));  // the same time again is left out
    }
    EXPECT_EQ(recording.samples.size(), 2000u);
    return recording.samples;
}

TEST(RecordedFlight, IsReproducedWithinItsToleranceByFewKeys) {
    std::vector<scene::Key> samples = by_hand();
    scene::Flight flight = player::thinned(samples, player::kRecordTolerance_m, player::kRecordTolerance_deg);
    EXPECT_LT(flight.keys.size(), samples.size() / 8);
    EXPECT_GT(flight.keys.size(), 8u);
    for (const scene::Key& sample : samples) {
        view::Camera camera = view::camera_at(flight, sample.time_s, {});
        const auto& [x, y, z] = sample.position_m;
        ASSERT_LE(glm::distance(camera.position_m, glm::dvec3(x, y, z)), player::kRecordTolerance_m) << sample.time_s;
        ASSERT_LE(std::abs(std::remainder(camera.heading_deg - sample.heading_deg, 360.0)), player::kRecordTolerance_deg);
        ASSERT_LE(std::abs(camera.pitch_deg - sample.pitch_deg), player::kRecordTolerance_deg);
    }
}

TEST(RecordedFlight, IsReadAgainAsItWasThinned) {
    player::Recording recording{0, by_hand()};
    std::string path = testing::TempDir() + "recorded.flight.json";
    Result<std::string> written = player::write_recording(recording, path);
    ASSERT_TRUE(written) << written.error().message;
    Result<scene::Flight> flight = scene::read_flight(path);
    ASSERT_TRUE(flight) << flight.error().message;
    EXPECT_EQ(
        scene::json_from_flight(*flight),
        scene::json_from_flight(player::thinned(recording.samples, player::kRecordTolerance_m, player::kRecordTolerance_deg)));
    recording.samples.resize(1);
    EXPECT_TRUE(player::write_recording(recording, path));
    EXPECT_EQ(scene::read_flight(path)->keys.size(), 1u);
    recording.samples[0].position_m[0] = 1e12;
    Result<std::string> refused = player::write_recording(recording, path);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().exit, Exit::impossible);
    std::filesystem::remove(path);
}

TEST(Flying, NeverGoesUnderTheGround) {
    terrain::Terrain terrain = test::hilly_terrain(65);
    view::Camera camera = test::from_south(terrain, 64, 48);
    camera.position_m = {100, -600, 400};
    player::Flyer flyer;
    player::Input input;
    input.up = -1;
    input.forward = 1;
    input.is_fast = true;
    bool touched = false;
    for (int frame = 0; frame < 600; ++frame) {
        player::fly(camera, flyer, input, 1.0 / 30, player::TerrainGround(terrain));
        std::optional<double> ground = player::ground_m(terrain, camera.position_m.x, camera.position_m.y);
        if (!ground) continue;
        ASSERT_GE(camera.position_m.z, *ground + player::kLeastHeight_m) << "frame " << frame;
        touched = touched || camera.position_m.z < *ground + player::kLeastHeight_m + 1;
    }
    EXPECT_TRUE(touched);
}

}  // namespace
}  // namespace overlook
