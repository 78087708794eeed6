#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "runtime/terrain/draw.h"
#include "tests/gl/fixture.h"

namespace overlook {
namespace {

constexpr test::Rgb kRed{220, 30, 30}, kGreen{30, 200, 30}, kBlue{30, 30, 220}, kYellow{220, 210, 40};

ImageRgb8 picture(const terrain::Terrain& terrain, const terrain::Cut& cut, const view::Camera& camera,
                  const terrain::DrawOptions& options) {
    auto target = gl::Target::make(camera.width_px, camera.height_px, 1);
    auto drawing = terrain::Drawing::make(terrain);
    if (!target || !drawing) return {};
    drawing->draw(*target, cut, camera, options);
    return target->read();
}

terrain::DrawOptions clear_air() {
    terrain::DrawOptions options;
    options.haze = 0;
    return options;
}

double share_that_differs(const ImageRgb8& a, const ImageRgb8& b) {
    size_t count = 0, pixels = size_t(a.width) * a.height;
    for (size_t i = 0; i < pixels; ++i) {
        if (!std::equal(&a.pixels[3 * i], &a.pixels[3 * i] + 3, &b.pixels[3 * i])) ++count;
    }
    return double(count) / double(pixels);
}

TEST(TerrainDrawing, ShowsNorthUpAndEastRight) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    terrain::Terrain terrain = test::flat_terrain(65);
    ImageRgb8 image = picture(terrain, test::everything(terrain), test::from_above(terrain, 400, 200, 200), clear_air());
    ASSERT_FALSE(image.pixels.empty());
    EXPECT_TRUE(test::is_near(test::pixel(image, 50, 50), kRed, 2));
    EXPECT_TRUE(test::is_near(test::pixel(image, 150, 50), kGreen, 2));
    EXPECT_TRUE(test::is_near(test::pixel(image, 50, 150), kBlue, 2));
    EXPECT_TRUE(test::is_near(test::pixel(image, 150, 150), kYellow, 2));
}

TEST(TerrainDrawing, CoversExactlyThePixelsOfItsSquare) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    terrain::Terrain terrain = test::flat_terrain(65);  // 640 m
    view::Camera camera = test::from_above(terrain, 1000, 400, 400);
    ImageRgb8 image = picture(terrain, test::everything(terrain), camera, clear_air());
    double half_px = view::focal_px(camera) * 320 / 1000;
    auto is_ground = [&](uint32_t x, uint32_t y) {
        test::Rgb colour = test::pixel(image, x, y);
        for (const test::Rgb& own : {kRed, kGreen, kBlue, kYellow}) {
            if (test::is_near(colour, own, 2)) return true;
        }
        return false;
    };
    uint32_t first = uint32_t(std::ceil(200 - half_px - 0.5)), last = uint32_t(std::floor(200 + half_px - 0.5));
    for (uint32_t along : {120u, 280u}) {
        EXPECT_TRUE(is_ground(first, along) && is_ground(last, along) && is_ground(along, first) && is_ground(along, last));
        EXPECT_FALSE(is_ground(first - 1, along) || is_ground(last + 1, along));
        EXPECT_FALSE(is_ground(along, first - 1) || is_ground(along, last + 1));
    }
}

TEST(TerrainDrawing, HidesFarBehindNearInAnyOrderOfTriangles) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    terrain::Terrain terrain = test::hilly_terrain(65);
    view::Camera camera = test::from_south(terrain, 320, 180);
    camera.position_m.z = 230;
    camera.pitch_deg = -6;
    terrain::Cut cut = test::everything(terrain);
    ImageRgb8 forwards = picture(terrain, cut, camera, clear_air());
    std::reverse(cut.indices.begin(), cut.indices.end());
    ImageRgb8 backwards = picture(terrain, cut, camera, clear_air());
    EXPECT_LE(share_that_differs(forwards, backwards), 0.0002);

    // A wall across the middle, seen from the south, hides all the north behind it.
    for (uint32_t column = 0; column < 65; ++column) terrain.heights[40 * 65 + column] += 2000;
    ImageRgb8 walled = picture(terrain, test::everything(terrain), camera, clear_air());
    bool shows_north = false;
    for (uint32_t y = 0; y < 180; ++y) {
        test::Rgb colour = test::pixel(walled, 160, y);
        if (test::is_near(colour, kRed, 2) || test::is_near(colour, kGreen, 2)) shows_north = true;
    }
    EXPECT_FALSE(shows_north);
}

TEST(TerrainDrawing, IsTheSameFarFromTheOrigin) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    terrain::Terrain terrain = test::hilly_terrain(129);
    view::Camera camera = test::from_south(terrain, 640, 360);
    camera.position_m += glm::dvec3(3.37, 1.91, 0.73);
    terrain::DrawOptions options;
    ImageRgb8 here = picture(terrain, test::everything(terrain), camera, options);
    for (double offset_m : {1e5, 1e7}) {
        view::Camera moved = camera;
        options.origin_m = {offset_m, -offset_m, offset_m};
        moved.position_m += options.origin_m;
        ImageRgb8 there = picture(terrain, test::everything(terrain), moved, options);
        EXPECT_LE(share_that_differs(here, there), 0.0001) << "offset " << offset_m;
    }
    // The heights themselves may be far from zero as well.
    options.origin_m = {0, 0, 0};
    terrain.height_offset_m += 1e7;
    camera.position_m.z += 1e7;
    EXPECT_LE(share_that_differs(here, picture(terrain, test::everything(terrain), camera, options)), 0.0001);
}

TEST(TerrainDrawing, LeavesVoidsOpen) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    terrain::Terrain terrain = test::flat_terrain(65);
    terrain.heights[size_t(20) * 65 + 20] = terrain::kVoid;
    terrain::Cut whole = test::everything(terrain), cut;
    for (size_t i = 0; i < whole.indices.size(); i += 3) {
        auto is_void = [&](uint32_t index) { return terrain.heights[index] == terrain::kVoid; };
        if (std::none_of(&whole.indices[i], &whole.indices[i] + 3, is_void)) {
            cut.indices.insert(cut.indices.end(), &whole.indices[i], &whole.indices[i] + 3);
        }
    }
    view::Camera camera = test::from_above(terrain, 400, 400, 400);
    ImageRgb8 image = picture(terrain, cut, camera, clear_air());
    double px_per_cell = view::focal_px(camera) * 10 / 400;
    uint32_t hole = uint32_t(200 - 12 * px_per_cell);
    EXPECT_FALSE(test::is_near(test::pixel(image, hole, hole), kRed, 40));
    EXPECT_TRUE(test::is_near(test::pixel(image, hole - uint32_t(2 * px_per_cell), hole), kRed, 2));
}

TEST(TerrainDrawing, ReportsNoOpenGLError) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    gl::ErrorCounter errors;
    terrain::Terrain terrain = test::hilly_terrain(65);
    for (bool has_texture : {true, false}) {
        if (!has_texture) terrain.texture = {};
        for (uint32_t samples : {1u, 4u}) {
            auto target = gl::Target::make(160, 90, samples);
            auto drawing = terrain::Drawing::make(terrain);
            ASSERT_TRUE(target && drawing);
            for (terrain::Look look : {terrain::Look::shaded, terrain::Look::wireframe, terrain::Look::split}) {
                terrain::DrawOptions options;
                options.look = look;
                drawing->draw(*target, test::everything(terrain), test::from_south(terrain, 160, 90), options);
                drawing->draw(*target, terrain::Cut(), test::from_south(terrain, 160, 90), options);
                target->read();
            }
        }
    }
    EXPECT_EQ(errors.count(), 0u) << errors.first();
}

TEST(TerrainDrawing, SendsFourBytesAnIndex) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    terrain::Terrain terrain = test::flat_terrain(33);
    auto target = gl::Target::make(16, 16, 1);
    auto drawing = terrain::Drawing::make(terrain);
    ASSERT_TRUE(target && drawing);
    drawing->draw(*target, test::everything(terrain), test::from_above(terrain, 400, 16, 16), {});
    EXPECT_EQ(drawing->uploaded_bytes(), 32u * 32u * 2u * 3u * 4u);
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

TEST(TerrainDrawing, GivesTheSamePictureWithAnyNumberOfRendererThreads) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    std::string first;
    for (int threads : {0, 1, 2, 4}) {
        int status = -1;
        std::string hashes =
            output_of("LP_NUM_THREADS=" + std::to_string(threads) + " " OVERLOOK_BINARY_DIR "/bin/picture_hash", status);
        ASSERT_EQ(status, 0) << threads << " threads";
        ASSERT_EQ(hashes.size(), 66u);
        EXPECT_NE(hashes.substr(0, 33), hashes.substr(33));
        if (first.empty()) first = hashes;
        EXPECT_EQ(hashes, first) << threads << " threads";
    }
}

}  // namespace
}  // namespace overlook
