#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "runtime/lod_sprite/draw_paper.h"
#include "runtime/lod_sprite/paper_sprite.h"
#include "tests/gl/fixture.h"
#include "tools/bake/relief.h"
#include "tools/bake/terrain.h"
#include "tools/make_sample/landscape.h"

namespace overlook {
namespace {

using namespace lod_sprite;

constexpr uint32_t kWidth = 640, kHeight = 360;
constexpr double kHigh_px = 0.5, kLow_px = 12;

terrain::Terrain made_landscape() {
    sample::LandscapeOptions options;
    options.side = 257;
    sample::Landscape landscape = sample::make_landscape(options);
    dem::Raster dem;
    dem.width = dem.height = options.side;
    dem.frame.metres_per_column = dem.frame.metres_per_row = options.cell_size_m;
    dem.samples = landscape.height_m;
    dem.source_name = "landscape";
    dem.source_hash = std::string(32, '0');
    terrain::Terrain terrain = *terrain::bake(dem, {}, [](double) {});
    terrain.texture = shade_relief(dem, {});
    return terrain;
}

terrain::Terrain sample_landscape() {
    static const terrain::Terrain kMade = made_landscape();
    return kMade;
}

// Everything to fly a sprite over a terrain.
struct Flight {
    explicit Flight(terrain::Terrain flown_over, uint32_t samples = 1)
        : terrain(std::move(flown_over)),
          refiner(terrain),
          target(*gl::Target::make(kWidth, kHeight, samples)),
          ground(*terrain::Drawing::make(terrain)),
          drawing(*paper::Drawing::make(ground, kWidth, kHeight)) {}

    view::Camera camera(double forward_m) const {
        view::Camera made;
        made.width_px = kWidth, made.height_px = kHeight;
        made.position_m = {4200, -6500 + forward_m, refiner.highest_m() * 0.75 + 250};
        made.heading_deg = -25, made.pitch_deg = -12;
        return made;
    }
    terrain::Cut cut(const view::Camera& at, double error_px) const {
        terrain::Cut made;
        refiner.cut_by_pixels(at, error_px, made);
        return made;
    }
    ImageRgb8 geometry(const terrain::Cut& drawn, const view::Camera& at) {
        ground.draw(target, drawn, at, look);
        return target.read();
    }
    std::vector<float> depth(const terrain::Cut& drawn, const view::Camera& at) {
        gl::Target middles = *gl::Target::make(kWidth, kHeight, 1);
        ground.draw(middles, drawn, at, look);
        return middles.read_depth();
    }
    ImageRgb8 key(const view::Camera& at, std::vector<float>& depth) {
        EXPECT_TRUE(drawing.draw_key(target, cut(at, kHigh_px), at, look, depth).has_value());
        return target.read();
    }
    ImageRgb8 novel(const terrain::Cut& low, std::span<const uint8_t> flags, const view::Camera& key_camera,
                    const view::Camera& at, paper::Coordinates coordinates = paper::Coordinates::homogeneous) {
        drawing.draw_novel(target, low, flags, key_camera, at, look, coordinates);
        return target.read();
    }

    terrain::Terrain terrain;
    terrain::Refiner refiner;
    gl::Target target;
    terrain::Drawing ground;
    paper::Drawing drawing;
    paper::Options options;
    terrain::DrawOptions look;
};

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

double mean_difference(const ImageRgb8& a, const ImageRgb8& b) {
    double sum = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) sum += std::abs(a.pixels[i] - b.pixels[i]);
    return sum / double(a.pixels.size());
}

// Pixels in which both pictures show ground.
std::vector<size_t> ground_in_both(const std::vector<float>& a, const std::vector<float>& b) {
    std::vector<size_t> pixels;
    for (size_t i = 0; i < a.size(); ++i)
        if (a[i] > 0 && b[i] > 0) pixels.push_back(i);
    return pixels;
}

TEST(PaperDrawing, KeepsThePictureAndItsDepths) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    std::vector<float> depths[2];
    for (uint32_t samples : {1u, 4u}) {
        Flight flight(sample_landscape(), samples);
        view::Camera at = flight.camera(0);
        ImageRgb8 key = flight.key(at, depths[samples / 4]);
        EXPECT_EQ(key.pixels, flight.geometry(flight.cut(at, kHigh_px), at).pixels);
    }
    EXPECT_EQ(depths[0], depths[1]);
    EXPECT_GT(std::count_if(depths[0].begin(), depths[0].end(), [](float d) { return d > 0; }), kWidth * kHeight / 2);
}

TEST(PaperDrawing, ShowsTheKeyframeAgainFromItsOwnPlaceButForSilhouettes) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    for (uint32_t samples : {1u, 4u}) {
        Flight flight(sample_landscape(), samples);
        view::Camera at = flight.camera(0);
        std::vector<float> depth;
        ImageRgb8 key = flight.key(at, depth);
        terrain::Cut low = flight.cut(at, kLow_px);
        std::vector<uint8_t> all(low.triangle_count(), 1);
        ImageRgb8 novel = flight.novel(low, all, at, at);
        std::vector<size_t> ground = ground_in_both(depth, flight.depth(low, at));
        ASSERT_GT(ground.size(), depth.size() / 2);
        size_t differing = 0;
        for (size_t i : ground) differing += difference_at(key, novel, i) > 1;
        // With four samples a pixel on the rim of the low cut is part sky.
        EXPECT_LE(differing, samples == 1 ? 0 : ground.size() / 500);
        EXPECT_LT(share_beyond(key, novel, 1), 0.01);
        EXPECT_GT(share_beyond(key, flight.geometry(low, at), 1), 0.2);
    }
}

TEST(PaperDrawing, WearsTheSpriteOrItsOwnTextureInEveryPixel) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Flight flight(sample_landscape());
    view::Camera at = flight.camera(0);
    std::vector<float> depth;
    ImageRgb8 key = flight.key(at, depth);
    terrain::Cut low = flight.cut(at, kLow_px);
    paper::Sprite sprite(flight.terrain, flight.options);
    sprite.keep(at, depth, low);
    ImageRgb8 novel = flight.novel(low, sprite.flags(low), at, at), own = flight.geometry(low, at);
    std::vector<size_t> ground = ground_in_both(depth, flight.depth(low, at));
    size_t sprite_px = 0, other_px = 0;
    for (size_t i : ground) {
        bool is_sprite = difference_at(novel, key, i) <= 1;
        sprite_px += is_sprite;
        other_px += !is_sprite && difference_at(novel, own, i) > 1;
    }
    EXPECT_EQ(other_px, 0u);
    EXPECT_GT(double(sprite_px), 0.85 * double(ground.size()));
    EXPECT_LT(mean_difference(novel, key), 0.3 * mean_difference(own, key));

    std::vector<uint8_t> none(low.triangle_count());
    EXPECT_EQ(flight.novel(low, none, at, at).pixels, own.pixels);
}

TEST(PaperDrawing, IsNearerToTheHighCutThanTheLowCutIsAfterAMove) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    for (uint32_t samples : {1u, 4u}) {
        Flight flight(sample_landscape(), samples);
        view::Camera at = flight.camera(0), on = flight.camera(60);
        std::vector<float> depth;
        flight.key(at, depth);
        paper::Sprite sprite(flight.terrain, flight.options);
        sprite.keep(at, depth, flight.cut(at, kLow_px));
        terrain::Cut low = flight.cut(on, kLow_px);
        ImageRgb8 high = flight.geometry(flight.cut(on, kHigh_px), on), own = flight.geometry(low, on);
        ImageRgb8 novel = flight.novel(low, sprite.flags(low), at, on);
        EXPECT_LT(mean_difference(novel, high), 0.4 * mean_difference(own, high));
    }
}

TEST(PaperDrawing, BendsTheSpriteOnLongTrianglesIfPlaceIsPlain) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Flight flight(test::flat_terrain(65));
    // Flies low over the whole square, all of it in the frame.
    view::Camera at = test::from_south(flight.terrain, kWidth, kHeight);
    at.position_m.z = 150, at.position_m.y -= 300, at.pitch_deg = -5;
    std::vector<float> depth;
    ImageRgb8 key = flight.key(at, depth);
    terrain::Cut low;  // two triangles, from 450 m to 1090 m
    uint32_t nw = 0, ne = 64, sw = 64 * 65, se = sw + 64;
    low.indices = {ne, nw, se, sw, se, nw};
    std::vector<uint8_t> all(2, 1);
    EXPECT_LT(share_beyond(key, flight.novel(low, all, at, at), 1), 0.0005);
    EXPECT_GT(share_beyond(key, flight.novel(low, all, at, at, paper::Coordinates::plain), 1), 0.003);
}

TEST(PaperDrawing, FliesWithoutAnOpenGLError) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    gl::ErrorCounter errors;
    for (uint32_t samples : {1u, 4u}) {
        terrain::Terrain terrain = test::hilly_terrain(65);
        if (samples == 4) terrain.texture = {};
        Flight flight(std::move(terrain), samples);
        flight.options.strips = paper::StripOptions{};
        paper::Sprite sprite(flight.terrain, flight.options);
        view::Camera at = test::from_south(flight.terrain, kWidth, kHeight);
        std::vector<float> depth;
        int keys = 0;
        for (int frame = 0; frame < 20; ++frame, at.position_m.y += 10) {
            terrain::Cut low = flight.cut(at, kLow_px);
            if (sprite.decide(at, low).is_key()) {
                ++keys;
                flight.key(at, depth);
                sprite.keep(at, depth, low);
            } else {
                flight.novel(low, sprite.flags(low), sprite.key_camera(), at);
            }
        }
        EXPECT_GT(keys, 1);
        EXPECT_LT(keys, 20);
        EXPECT_TRUE(sprite.has_key());
        flight.novel({}, {}, at, at);
    }
    EXPECT_EQ(errors.count(), 0u) << errors.first();
}

}  // namespace
}  // namespace overlook
