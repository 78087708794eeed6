// What is closed has no holes, nearer things hide farther ones, and threads change nothing.
#include "runtime/wang_ldi/plant_raster.h"

#include <gtest/gtest.h>

#include <random>

#include "formats/parallel.h"
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
    PlantRaster().draw(from, stand.shapes, {}, plant_lists(stand.forms, places, from, 1), picture);
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
    PlantRaster().draw(from, stand.shapes, {},
                       plant_lists(stand.forms, std::vector<PlantPlaces>{{{{{0, 9, 0}}, {{0.9, 5, 0}}}, {1, 1}}}, from, 1), held);
    EXPECT_EQ(held.depth_m[32 * 64 + 40], drawn(stand, {{{{{0.9, 5, 0}}}, {1}}}, from).depth_m[32 * 64 + 40]);
    EXPECT_EQ(held.colours[32 * 64 + 20], 0xff123456);
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
