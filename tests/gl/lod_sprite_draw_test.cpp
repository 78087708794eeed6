// Novel frames against full geometry: what a key shows stands where it should, and nowhere else.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <optional>

#include "runtime/lod_sprite/draw.h"
#include "runtime/terrain/draw.h"
#include "tests/gl/fixture.h"
#include "tests/gl/lod_sprite_scene.h"
#include "tools/measure/numbers/picture.h"
#include "tools/measure/numbers/silhouette.h"

namespace overlook {
namespace {

using namespace lod_sprite;
using test::SpriteScene;

int difference_at(const ImageRgb8& a, const ImageRgb8& b, size_t pixel) {
    int most = 0;
    for (size_t c = 3 * pixel; c < 3 * pixel + 3; ++c) most = std::max(most, std::abs(a.pixels[c] - b.pixels[c]));
    return most;
}

double share_beyond(const ImageRgb8& a, const ImageRgb8& b, int steps) {
    size_t count = 0, pixels = size_t(a.width) * a.height;
    for (size_t i = 0; i < pixels; ++i) count += difference_at(a, b, i) > steps;
    return double(count) / double(pixels);
}

double psnr_db(const ImageRgb8& a, const ImageRgb8& b) {
    return measure::psnr_db({a.width, a.height, a.pixels}, {b.width, b.height, b.pixels});
}

// Of each column the first row that is not what the empty sky shows there; the height where all is sky.
std::vector<uint32_t> skyline(const ImageRgb8& image, const ImageRgb8& sky) {
    std::vector<uint32_t> rows;
    for (uint32_t x = 0; x < image.width; ++x) {
        uint32_t y = 0;
        while (y < image.height && difference_at(image, sky, size_t(y) * image.width + x) <= 6) ++y;
        rows.push_back(y);
    }
    return rows;
}

class SpriteDrawing : public testing::TestWithParam<uint32_t> {};  // samples a pixel

TEST_P(SpriteDrawing, ShowsFullGeometryAtTheKeysOwnPose) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    for (uint32_t side : {129u, 128u}) {
        SpriteScene scene(test::hilly_terrain(side), GetParam());
        view::Camera at = scene.pose(0);
        scene.make_key(0, at, 1.0, 1);
        ImageRgb8 full = scene.full(at), novel = scene.novel(at), low = scene.low(at);
        double beyond = share_beyond(novel, full, 2);
        RecordProperty("share_beyond_2_steps", std::to_string(beyond));
        EXPECT_LT(beyond, GetParam() == 1 ? 0.01 : 0.03) << side;  // outlines and creases
        EXPECT_GT(share_beyond(low, full, 2), 3 * beyond) << side;
    }
}

TEST_P(SpriteDrawing, IsNearerToFullGeometryThanTheCoarseCutAfterASideStep) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    SpriteScene scene(test::hilly_terrain(129), GetParam());
    scene.make_key(0, scene.pose(0), 1.15, 2);
    for (double step_m : {5.0, 15.0}) {
        view::Camera at = scene.pose(step_m);
        ImageRgb8 full = scene.full(at);
        double novel_db = psnr_db(scene.novel(at), full), low_db = psnr_db(scene.low(at), full);
        RecordProperty("psnr_db", std::to_string(novel_db) + " against " + std::to_string(low_db));
        EXPECT_GT(novel_db, low_db + 6) << step_m;
        EXPECT_GT(novel_db, 30) << step_m;
    }
}

TEST(SpriteFrame, HasNoHolesAfterASideStep) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    SpriteScene scene(test::hilly_terrain(129), 1);
    scene.make_key(0, scene.pose(0), 1.15, 1);
    for (double step_m : {0.0, 5.0, 15.0, 40.0}) {
        view::Camera at = scene.pose(step_m);
        measure::Frame full = scene.frame_of(scene.full(at), at), novel = scene.frame_of(scene.novel(at), at);
        measure::HolePixels holes = measure::hole_pixels(novel, full, 1, {1.0, nullptr});
        EXPECT_EQ(holes.background, 0u) << step_m;
        if (step_m < 20) {  // farther off ground comes into view that the key did not see
            EXPECT_EQ(holes.count, 0u) << step_m;
        }
    }
}

TEST(SpriteFrame, KeepsTheSkylineOnlyIfItRaisesTheCoarseSurface) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    SpriteScene scene(test::hilly_terrain(129), 1);
    scene.make_key(0, scene.pose(0), 1.15, 1);
    for (double step_m : {0.0, 8.0}) {
        view::Camera at = scene.pose(step_m);
        measure::Frame full = scene.frame_of(scene.full(at), at);
        measure::SilhouetteError raised = silhouette_error(scene.frame_of(scene.novel(at), at), full);
        scene.options.raises = false;
        measure::SilhouetteError as_it_is = silhouette_error(scene.frame_of(scene.novel(at), at), full);
        EXPECT_LE(raised.p95_px, 1) << step_m;
        EXPECT_LT(raised.max_px, 1.5) << step_m;  // the next pixel, be it diagonally
        EXPECT_GT(as_it_is.p95_px, 2) << step_m;
        EXPECT_GT(as_it_is.max_px, 3) << step_m;
        scene.options.raises = true;
    }
}

TEST(SpriteFrame, KeepsTheSky) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    SpriteScene scene(test::hilly_terrain(129), 1);
    scene.make_key(0, scene.pose(0), 1.15, 1);
    view::Camera at = scene.pose(5);
    ImageRgb8 sky = scene.sky(at), full = scene.full(at), novel = scene.novel(at);
    std::vector<uint32_t> first_ground = skyline(full, sky);
    size_t sky_px = 0, other_px = 0;
    for (uint32_t x = 0; x < sky.width; ++x)
        for (uint32_t y = 0; y + 2 < first_ground[x]; ++y) {
            ++sky_px;
            other_px += difference_at(novel, sky, size_t(y) * sky.width + x) > 0;
        }
    EXPECT_GT(sky_px, size_t(sky.width) * sky.height / 10);
    EXPECT_EQ(other_px, 0u);
}

// A red wall before a green plain: what the key saw of the wall must not stay on the plain as the camera goes past it.
TEST(SpriteFrame, ShowsGhostsOnlyIfPlacesAreNotTested) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    SpriteScene scene(test::walled_terrain(129), 1);
    view::Camera at = scene.pose(120);
    scene.make_key(0, scene.pose(0), 1.15, 1);
    scene.options.tests_slab = false;
    scene.options.look_ups = 0;  // what is looked up is not mended either
    ImageRgb8 full = scene.full(at);
    auto ghosts = [&] {  // the wall's red where full geometry shows none, farther than a pixel from it
        ImageRgb8 novel = scene.novel(at);
        auto is_red = [](const ImageRgb8& image, uint32_t x, uint32_t y) {
            test::Rgb c = test::pixel(image, x, y);
            return c.red > 150 && c.green < 80 && c.blue < 80;
        };
        size_t count = 0;
        for (uint32_t y = 2; y + 2 < full.height; ++y)
            for (uint32_t x = 2; x + 2 < full.width; ++x) {
                bool is_wall = false;
                for (uint32_t dy = 0; dy <= 4; ++dy)
                    for (uint32_t dx = 0; dx <= 4; ++dx) is_wall |= is_red(full, x + dx - 2, y + dy - 2);
                count += !is_wall && is_red(novel, x, y);
            }
        return count;
    };
    size_t tested = ghosts();
    scene.options.tests_places = false;
    size_t untested = ghosts();
    RecordProperty("ghosts_tested", int(tested));
    RecordProperty("ghosts_untested", int(untested));
    EXPECT_LE(tested, 5u);
    EXPECT_GT(untested, 10 * tested + 50);
}

TEST(SpriteFrame, TellsItsSources) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    SpriteScene scene(test::hilly_terrain(129), 1);
    view::Camera at = scene.pose(0);
    scene.make_key(0, at, 1.0, 1);
    scene.options.shows_sources = true;
    auto shares = [&](const ImageRgb8& image) {
        std::array<double, 4> counts{};  // grey, yellow, blue, red
        for (size_t i = 0; i < image.pixels.size(); i += 3) {
            int r = image.pixels[i], g = image.pixels[i + 1], b = image.pixels[i + 2];
            if (std::abs(r - g) <= 2 && std::abs(g - b) <= 2 && r > 0) ++counts[0];
            if (r > 30 && g > r * 0.8 && g < r && b < r * 0.5) ++counts[1];
            if (b > r * 1.5 && b > g && g > r) ++counts[2];
            if (r > 30 && r > g * 1.5 && r > b * 1.5) ++counts[3];
        }
        for (double& count : counts) count /= double(image.pixels.size()) / 3;
        return counts;
    };
    double sky = shares(scene.sky(at))[2];
    std::array<double, 4> own = shares(scene.novel(at));
    EXPECT_GT(own[0], 0.4);
    EXPECT_LT(own[3], 0.02);
    // Turned, the edge has no key: red; a second key that looks there: yellow.
    view::Camera turned = at;
    turned.heading_deg += 20;
    std::array<double, 4> edge = shares(scene.novel(turned));
    EXPECT_GT(edge[3], 0.05);
    EXPECT_LT(edge[1], 0.001);
    scene.make_key(1, turned, 1.15, 1);
    scene.options.keys = {{0, 1}, {1, 1.0 / 1024}};
    std::array<double, 4> both = shares(scene.novel(turned));
    EXPECT_LT(both[3], 0.02);
    EXPECT_GT(both[1], 0.05);
    // All near: blue, no key.
    scene.options.near_depth_m = 1e6, scene.options.near_error_px = scene.options.low_error_px;
    std::array<double, 4> near = shares(scene.novel(at));
    EXPECT_LT(near[0], 0.01);
    EXPECT_GT(near[2], sky + 0.3);
}

TEST(SpriteFrame, MixesTwoKeysByTheirWeights) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    SpriteScene scene(test::flat_terrain(65), 1);
    view::Camera at = test::from_above(scene.terrain, 300, 160, 120);
    scene.make_key(0, at, 1.0, 1);
    terrain::Terrain grey = scene.terrain;  // the second key is taken of the same ground in another colour
    std::fill(grey.texture.pixels.begin(), grey.texture.pixels.end(), uint8_t(100));
    terrain::Drawing grey_ground = *terrain::Drawing::make(grey);
    terrain::CutSurface grey_surface(grey_ground, scene.look);
    scene.make_key_of(1, grey_surface, at, 1.0, 1);
    gl::Target target = *gl::Target::make(at.width_px, at.height_px, 1);
    grey_ground.draw(target, test::everything(grey), at, scene.look);
    test::Rgb first = test::pixel(scene.full(at), 20, 20), second = test::pixel(target.read(), 20, 20);
    ASSERT_FALSE(test::is_near(first, second, 40));
    for (double weight : {0.0, 0.25, 0.5, 1.0}) {
        scene.options.keys = {{0, 1 - weight}, {1, weight}};
        test::Rgb mixed = test::pixel(scene.novel(at), 20, 20);
        auto between = [&](int from, int to) { return uint8_t(std::lround(from + weight * (to - from))); };
        test::Rgb wanted{between(first.red, second.red), between(first.green, second.green), between(first.blue, second.blue)};
        EXPECT_TRUE(test::is_near(mixed, wanted, 2)) << weight;
    }
}

TEST(SpriteFrame, IsDrawnWithoutAnOpenGLError) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    gl::ErrorCounter errors;
    for (uint32_t samples : {1u, 4u}) {
        SpriteScene scene(test::hilly_terrain(65), samples);
        scene.make_key(0, scene.pose(0), 1.15, 2);
        scene.make_key(1, scene.pose(3), 1.15, 2);
        scene.options.keys = {{0, 0.5}, {1, 0.5}};
        for (uint32_t look_ups : {0u, 1u, 2u, 4u}) {
            scene.options.look_ups = look_ups;
            scene.novel(scene.pose(6));
        }
        scene.options.keys.clear();
        EXPECT_EQ(scene.novel(scene.pose(6)).pixels, scene.low(scene.pose(6)).pixels);
    }
    EXPECT_EQ(errors.count(), 0u) << errors.first();
}

TEST(SpriteKey, GivesItsDepthsInTheMiddlesOfCells) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    SpriteScene scene(test::flat_terrain(129), 1);
    view::Camera at = test::from_above(scene.terrain, 300, 161, 119);
    at.pitch_deg = -70;
    scene.make_key(0, at, 1.0, 1);
    view::Axes axes = view::axes_of(at);
    for (uint32_t step : {1u, 7u, 20u}) {
        DepthGrid grid = scene.painter.read_depth(0, step);
        ASSERT_EQ(grid.width, (161 + step - 1) / step);
        ASSERT_EQ(grid.height, (119 + step - 1) / step);
        for (uint32_t y = 0; y < grid.height; ++y)
            for (uint32_t x = 0; x < grid.width; ++x) {
                double right = ((x + 0.5) / grid.width - 0.5) * 161 / view::focal_px(at);
                double up = (0.5 - (y + 0.5) / grid.height) * 119 / view::focal_px(at);
                double wanted_m = -300 / (axes.forward + right * axes.right + up * axes.up).z;
                // A texel's middle is at most half a texel from the cell's: 1.5 m along this slope.
                EXPECT_NEAR(grid.depth_m[size_t(y) * grid.width + x], wanted_m, 1.5) << step << ": " << x << ", " << y;
            }
    }
}

TEST(SpriteKey, TooLargeForTheRendererIsRefused) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    SpriteScene scene(test::flat_terrain(65), 1);
    view::Camera at = scene.pose(0);
    Result<void> begun = scene.painter.begin_key(0, at, 1000);
    ASSERT_FALSE(begun.has_value());
    EXPECT_EQ(begun.error().exit, Exit::impossible);
    EXPECT_NE(begun.error().message.find("is too large for this renderer"), std::string::npos);
}

std::string output_of(const std::string& command, int& status) {
    std::string output;
    FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) return output;
    char line[256];
    while (std::fgets(line, sizeof line, pipe) != nullptr) output += line;
    status = pclose(pipe);
    return output;
}

TEST(SpriteFrame, IsTheSameWithAnyNumberOfRendererThreads) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    std::string first;
    for (int threads : {0, 1, 2, 4}) {
        int status = -1;
        std::string command = "LP_NUM_THREADS=" + std::to_string(threads) + " " OVERLOOK_BINARY_DIR "/bin/lod_sprite_hash";
        std::string hashes = output_of(command, status);
        ASSERT_EQ(status, 0) << threads << " threads";
        ASSERT_EQ(hashes.size(), 66u);
        EXPECT_NE(hashes.substr(0, 33), hashes.substr(33));
        if (first.empty()) first = hashes;
        EXPECT_EQ(hashes, first) << threads << " threads";
    }
}

INSTANTIATE_TEST_SUITE_P(Samples, SpriteDrawing, testing::Values(1u, 4u));

}  // namespace
}  // namespace overlook
