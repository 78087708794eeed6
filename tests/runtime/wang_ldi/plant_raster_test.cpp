// What is closed has no holes, nearer things hide farther ones, and threads change nothing.
#include "runtime/wang_ldi/plant_raster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "formats/parallel.h"
#include "runtime/wang_ldi/plant_cut.h"
#include "tests/runtime/discrete/chains.h"

namespace overlook::wang_ldi {
namespace {

struct Stand {
    discrete::Chain chain;
    std::vector<PlantForm> forms;
    std::vector<PlantShape> shapes;
};
Stand stand_of(discrete::Chain chain) {
    Stand made{std::move(chain), {}, {}};
    made.forms.push_back(form_of(made.chain));
    std::vector<Skin> skins;
    for (const caveclod::Surface& surface : made.chain.surfaces) skins.push_back(plain_skin(surface));
    made.shapes.push_back(shape_of(made.chain, std::move(skins)));
    return made;
}
view::Camera camera(uint32_t width_px, uint32_t height_px) {
    view::Camera camera;
    camera.width_px = width_px, camera.height_px = height_px, camera.near_m = 0.05;
    return camera;
}
Warped drawn(const Stand& stand, const std::vector<PlantPlaces>& places, const view::Camera& from) {
    Warped picture;
    picture.clear(from.width_px, from.height_px);
    PlantRaster raster;
    raster.draw(from, stand.shapes, {}, plant_lists(stand.forms, places, from, {1}));
    raster.lay_over(picture);
    return picture;
}

// Every pixel whose middle looks at a globe shows it, none that looks past it does, from afar and from near.
TEST(PlantRaster, ClosedThingsHaveNoHoles) {
    discrete::Chain globe = discrete::made::empty_chain(glm::dvec3(-1), 2);
    for (uint32_t rows : {150u, 40u, 12u}) {
        globe.levels.clear();
        discrete::made::end_level(globe, discrete::made::globe(globe, glm::dvec3(0), 1, rows, {210, 60, 50, 255}), 0);
        double inner_m = 1 - discrete::made::globe_error_m(1, rows) - 2 * globe.position_step_m;
        Stand stand = stand_of(globe);
        for (double away_m : {1.2, 2.0, 9.0, 60.0}) {
            view::Camera from = camera(211, 157);
            glm::dvec3 middle_m(0.17 * away_m, away_m, -0.11 * away_m);
            Warped picture = drawn(stand, {{{{middle_m, 0.6, 0.8, 1}}, {1}}}, from);
            size_t holes = 0, beyond = 0, shown = 0;
            for (uint32_t y = 0; y < from.height_px; ++y)
                for (uint32_t x = 0; x < from.width_px; ++x) {
                    glm::dvec3 ray = glm::normalize(
                        glm::dvec3((x + 0.5 - 105.5) / view::focal_px(from), 1, (78.5 - y - 0.5) / view::focal_px(from)));
                    double past_m = glm::length(glm::cross(ray, middle_m));
                    bool is_shown = picture.colours[size_t(y) * from.width_px + x] != 0;
                    double pixel_m = glm::length(middle_m) / view::focal_px(from) / 100;  // corners lie on steps of a pixel
                    holes += !is_shown && past_m < inner_m - pixel_m, beyond += is_shown && past_m > 1 + pixel_m;
                    shown += is_shown;
                }
            EXPECT_EQ(holes, 0u) << rows << " rows, " << away_m << " m";
            EXPECT_EQ(beyond, 0u) << rows << " rows, " << away_m << " m";
            EXPECT_GT(shown, 10u);
        }
    }
}

TEST(PlantRaster, NearerThingsHideFartherOnes) {
    Stand stand = stand_of(discrete::made::coplanar_chain());
    view::Camera from = camera(64, 64);
    Warped both = drawn(stand, {{{{{0, 9, 0}}, {{0, 5, 0}}}, {1, 1}}}, from), near = drawn(stand, {{{{{0, 5, 0}}}, {1}}}, from);
    EXPECT_TRUE(both.colours == near.colours);
    EXPECT_TRUE(both.depth_m == near.depth_m);
    // What the picture holds already is hidden and hides likewise.
    Warped held = near;
    for (size_t p = 0; p < held.colours.size(); ++p) held.colours[p] = 0xff123456, held.depth_m[p] = 7;
    PlantRaster raster;
    raster.draw(from, stand.shapes, {},
                plant_lists(stand.forms, std::vector<PlantPlaces>{{{{{0, 9, 0}}, {{0.9, 5, 0}}}, {1, 1}}}, from, {1}));
    raster.lay_over(held);
    EXPECT_EQ(held.depth_m[32 * 64 + 40], drawn(stand, {{{{{0.9, 5, 0}}}, {1}}}, from).depth_m[32 * 64 + 40]);
    EXPECT_EQ(held.colours[32 * 64 + 20], 0xff123456);
}

// A wall across the picture, red at its finest, blue in its coarser level.
discrete::Chain wall() {
    discrete::Chain chain = discrete::made::empty_chain(glm::dvec3(-5), 10);
    for (bool is_coarse : {false, true}) {
        discrete::Level level;
        discrete::made::add_quad(chain, level, {glm::dvec3{-4, 0, -4}, {4, 0, -4}, {4, 0, 4}, {-4, 0, 4}},
                                 is_coarse ? discrete::made::Colour{0, 0, 255, 255} : discrete::made::Colour{255, 0, 0, 255});
        discrete::made::end_level(chain, std::move(level), is_coarse ? 0.03 : 0);
    }
    return chain;
}

// And where the plant itself gives way to something else, as many pixels as its share are left to both.
TEST(PlantRaster, TwoLevelsOfAPlantFillAllPixelsTogether) {
    Stand stand = stand_of(wall());
    view::Camera from = camera(96, 64);
    from.fov_y_deg = 10;
    size_t mixed = 0;
    for (float share : {1.0f, 0.5f})
        for (double away_m = 5; away_m < 27; away_m += 0.7) {
            std::vector<PlantPlaces> places{{{{{0, away_m, 0}}}, {share}}};
            Warped picture;
            picture.clear(from.width_px, from.height_px);
            std::vector<PlantList> lists = plant_lists(stand.forms, places, from, {1, 0.5});
            PlantRaster raster;
            raster.draw(from, stand.shapes, {}, lists);
            raster.lay_over(picture);
            auto count = [&](uint32_t colour) {
                return double(std::count(picture.colours.begin(), picture.colours.end(), colour)) /
                       double(picture.colours.size());
            };
            double red = count(0xff0000ff), blue = count(0xffff0000);
            EXPECT_EQ(red + blue, double(share)) << away_m;
            for (const PlantList& list : lists)
                for (const discrete::Item& item : list.listed.frame.items) {
                    EXPECT_NEAR(item.level == 0 ? red : blue,
                                item.show == discrete::Show::dithered_out ? item.up_to - item.share : item.share, 1.0 / 64);
                    mixed += red > 0 && blue > 0;
                }
        }
    EXPECT_GT(mixed, 10u);
}

// Its corners are farther from the picture's middle than corners may lie.
TEST(PlantRaster, WhatCoversThePictureIsSeenHoweverFarItsCornersAre) {
    discrete::Chain chain = discrete::made::empty_chain(glm::dvec3(-1), 2);
    discrete::Level level;
    discrete::made::add_quad(chain, level, {glm::dvec3{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}}, {90, 200, 60, 255});
    discrete::made::end_level(chain, std::move(level), 0);
    view::Camera from = camera(320, 240);
    for (double fov_deg : {30.0, 1.0}) {
        from.fov_y_deg = fov_deg;
        Warped picture = drawn(stand_of(chain), {{{{{0, 0.5, 0}}}, {1}}}, from);
        EXPECT_EQ(std::count(picture.colours.begin(), picture.colours.end(), 0u), 0) << fov_deg;
        for (float depth_m : {picture.depth_m.front(), picture.depth_m.back()}) EXPECT_NEAR(depth_m, 0.5, 1e-3) << fov_deg;
    }
}

// Triangles as large as a planet's orbit, as files may have them. along_axis: each has an edge
// from as far behind its foot as before it, straight to the north.
discrete::Chain far_too_large(bool along_axis) {
    constexpr double kStep_m = 1e12 / 32768;
    constexpr uint16_t kMiddle = 32768, kSouth = 1, kNorth = 65535;
    discrete::Chain chain = discrete::made::empty_chain(glm::dvec3(-kStep_m * kMiddle), 65535 * kStep_m);
    chain.uv_low = {-1e30, 1e30}, chain.uv_step = 1e30;
    std::mt19937 random(7);
    discrete::Level level;
    for (uint32_t n = 0; n < 900; ++n) {
        discrete::Vertex vertex;
        for (auto& at : vertex.position) at = uint16_t(random() % 3 == 0 ? kMiddle - 1 + random() % 3 : random() % 65536);
        if (along_axis && n % 3 < 2) vertex.position = {kMiddle, n % 3 == 0 ? kSouth : kNorth, kMiddle};
        for (auto& at : vertex.uv) at = uint16_t(random() % 65536);
        vertex.normal = {int16_t(random() % 32767), 0}, vertex.colour = {200, 100, 50, 255};
        level.vertices.push_back(vertex), level.indices.push_back(n);
    }
    discrete::made::end_level(chain, std::move(level), 0);
    return chain;
}

TEST(PlantRaster, WhatIsFarTooLargeIsDrawnBeforeTheNearPlaneOrNotAtAll) {
    view::Camera from = camera(97, 61);
    for (bool along_axis : {false, true}) {
        Stand stand = stand_of(far_too_large(along_axis));
        stand.shapes[0].skins[0].levels = {{2, 2, std::vector<std::array<uint16_t, 4>>(4, {65535, 65535, 65535, 65535})}};
        size_t shown = 0;
        for (int n = 0; n < 60; ++n) {
            discrete::Placement at{{0.3 * n - 9, 0, 0.2 * (n % 7) - 0.7}, 1, 0, n % 3 == 0 ? 1e6 : 1};
            from.fov_y_deg = n % 2 == 0 ? 60 : 1;
            if (!along_axis) {
                from.heading_deg = 6.1 * n, from.pitch_deg = 20.0 * std::sin(n);
                at.translation_m = {0.3 * n, 1, 0.1}, at.cosine = 0.6, at.sine = 0.8;
            }
            Warped picture = drawn(stand, {{{at}, {1}}}, from);
            for (size_t p = 0; p < picture.colours.size(); ++p) {
                if (picture.colours[p] == 0) continue;
                ++shown;
                ASSERT_TRUE(std::isfinite(picture.depth_m[p]) && picture.depth_m[p] >= 0.999f * float(from.near_m)) << n;
            }
        }
        EXPECT_GT(shown, 10'000u);
        from.heading_deg = from.pitch_deg = 0;
    }
}

TEST(PlantCut, HasNoMoreCornersThanThereIsRoomFor) {
    Polygon polygon;
    for (int k = 0; k < 40; ++k) polygon.add({glm::vec3(k, k % 2 == 0 ? 1 : -1, 1)});
    EXPECT_EQ(polygon.count, 16);
    for (int again = 0; again < 3; ++again) {
        polygon = cut(polygon, [](const glm::vec3& p) { return p.y; });
        EXPECT_EQ(polygon.count, 16);
        for (int k = 0; k < polygon.count; ++k) EXPECT_GE(polygon.corners[size_t(k)].seen.y, 0);
        for (int k = 0; k < polygon.count; ++k) polygon.corners[size_t(k)].seen.y = k % 2 == 0 ? 1.0f : -1.0f;
    }
}

// Transparent red beside blue that is not.
TEST(Skin, HalvesArePlainMeans) {
    caveclod::Surface surface;
    std::vector<uint8_t> rgba;
    for (uint32_t p = 0; p < 5 * 3; ++p)
        for (int c : p % 5 < 2 ? std::array{255, 0, 0, 0} : std::array{0, 0, 255, 255}) rgba.push_back(uint8_t(c));
    Skin skin;
    skin.add_level(5, 3, rgba, surface);
    skin.add_halves();
    ASSERT_EQ(skin.levels.size(), 3u);
    EXPECT_EQ(skin.levels[1].width, 2u);
    EXPECT_EQ(skin.levels[1].height, 1u);
    // Of five columns the middle one is shared.
    std::array<float, 4> left{0.8f, 0, 0.2f, 0.2f}, both{0.4f, 0, 0.6f, 0.6f};
    for (size_t c = 0; c < 4; ++c) {
        EXPECT_NEAR(skin.levels[1].texels[0][c], 65535 * left[c], 1) << c;
        EXPECT_NEAR(skin.levels[2].texels[0][c], 65535 * both[c], 2) << c;
    }
}

TEST(Skin, HasNoLevelsThatAreTooLarge) {
    constexpr uint32_t kWide = 4100, kHigh = 2052;
    Skin skin;
    skin.add_level(kWide, kHigh, std::vector<uint8_t>(size_t(4) * kWide * kHigh, 255), {});
    EXPECT_EQ(skin.levels[0].width, kWide / 2);
    EXPECT_EQ(skin.levels[0].height, kHigh / 2);
    EXPECT_EQ(skin.levels[0].texels.back()[0], 65535);
}

TEST(PlantRaster, ThreadsChangeNothing) {
    Stand stand = stand_of(discrete::made::sphere_chain());
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<PlantPlaces> places(1);
    for (int n = 0; n < 80; ++n) {
        double turn = 6.28 * unit(random);
        glm::dvec3 at(8 * unit(random) - 4, 10 * unit(random) - 1, 2 * unit(random) - 1);
        places[0].placements.push_back({at, std::cos(turn), std::sin(turn), 0.2 + unit(random)});
        places[0].shares.push_back(n % 4 == 0 ? 0.5f : 1.0f);
    }
    view::Camera from = camera(331, 203);
    set_thread_count(1);
    Warped alone = drawn(stand, places, from);
    for (unsigned threads : {2u, 3u, 7u}) {
        set_thread_count(threads);
        Warped together = drawn(stand, places, from);
        EXPECT_TRUE(together.colours == alone.colours) << threads;
        EXPECT_TRUE(together.depth_m == alone.depth_m) << threads;
    }
    set_thread_count(0);
}

}  // namespace
}  // namespace overlook::wang_ldi
