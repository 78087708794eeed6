// A perspective image shows from its own place what it is made of, from elsewhere what plane geometry says, and its order alone
// hides what depths hide.
#include "runtime/wang_ldi/perspective_warp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <random>

#include "formats/caveclod_octahedral.h"
#include "runtime/view/picture_rays.h"

namespace overlook::wang_ldi {
namespace {

PerspectiveView view_of(uint32_t width_px, uint32_t height_px) {
    PerspectiveView view;
    view.position_m = {10, 20, 1.7}, view.heading_deg = 25, view.pitch_deg = -6;
    view.width_px = width_px, view.height_px = height_px, view.near_m = 0.5, view.far_m = 60;
    return view;
}

struct Layer {
    double depth_m;
    std::array<uint8_t, 3> colour;
    glm::dvec3 normal;
};

PerspectiveLdi image_of(const PerspectiveView& view, bool has_normals,
                        const std::function<std::vector<Layer>(uint32_t column, uint32_t row)>& layers_at) {
    PerspectiveLdi image;
    image.view = view, image.first = {0};
    for (uint32_t row = 0; row < view.height_px; ++row)
        for (uint32_t column = 0; column < view.width_px; ++column) {
            std::map<uint16_t, Layer> sorted;
            for (const Layer& layer : layers_at(column, row)) sorted.emplace(code_of_depth(view, layer.depth_m), layer);
            for (const auto& [code, layer] : sorted) {
                image.depths.push_back(code), image.colours.push_back(layer.colour);
                glm::dvec2 at = glm::round(127.0 * caveclod::octahedral_of(layer.normal));
                if (has_normals) image.normals.push_back({int8_t(at.x), int8_t(at.y)});
            }
            image.first.push_back(image.sample_count());
        }
    return image;
}

std::array<uint8_t, 3> colour_of(uint32_t number) {
    return {uint8_t(number), uint8_t(number >> 8), uint8_t(number >> 16)};
}

// In a third of the pixels up to six samples anywhere, of whatever normal.
PerspectiveLdi thicket(const PerspectiveView& view, uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    uint32_t number = 0;
    return image_of(view, true, [&](uint32_t, uint32_t) {
        std::vector<Layer> layers;
        for (auto left = random() % 3 == 0 ? random() % 6 + 1 : 0; left > 0; --left)
            layers.push_back({0.6 * std::pow(90.0, unit(random)),
                              colour_of(++number),
                              {unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5}});
        return layers;
    });
}

view::Camera moved(const PerspectiveView& view, const glm::dvec3& by_m, double turned_deg = 0) {
    view::Camera camera = camera_of(view);
    camera.position_m += by_m, camera.heading_deg += turned_deg;
    return camera;
}

Warped warped(const PerspectiveLdi& image, const view::Camera& camera, Hiding hiding, const PatchRule& rule = {}) {
    Warped picture;
    picture.clear(camera.width_px, camera.height_px);
    PerspectiveWarper(image).warp(camera, hiding, picture, rule);
    return picture;
}

TEST(PerspectiveWarp, FromItsOwnPlaceShowsEachPixelsNearestSampleAndNothingElse) {
    for (uint32_t seed = 1; seed < 6; ++seed) {
        PerspectiveView view = view_of(91, 60);
        view.heading_deg = 71.0 * seed, view.pitch_deg = 12.0 * seed - 40, view.fov_y_deg = 20.0 * seed;
        PerspectiveLdi image = thicket(view, seed);
        for (Hiding hiding : {Hiding::by_order, Hiding::by_depth}) {
            Warped picture = warped(image, camera_of(view), hiding);
            for (size_t p = 0; p < picture.colours.size(); ++p) {
                bool is_empty = image.first[p] == image.first[p + 1];
                const auto& colour = is_empty ? colour_of(0) : image.colours[image.first[p]];
                uint32_t expected = uint32_t(colour[0]) | uint32_t(colour[1]) << 8 | uint32_t(colour[2]) << 16 | 0xff000000u;
                ASSERT_EQ(picture.colours[p], is_empty ? 0 : expected) << seed << " " << p;
                if (is_empty) continue;
                double depth_m = depth_of_code(view, image.depths[image.first[p]]);
                ASSERT_NEAR(double(picture.depth_m[p]), depth_m, 1e-5 * depth_m);
            }
        }
    }
}

// Samples that fall into a pixel of a finer picture lie on one line of sight, nearly: then whichever comes last is nearest.
TEST(PerspectiveWarp, ShowsByOrderAloneWhatDepthsLetBeSeen) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(-1, 1);
    uint64_t overdrawn = 0;
    for (int round = 0; round < 40; ++round) {
        PerspectiveView view = view_of(80, 60);
        PerspectiveLdi image = thicket(view, uint32_t(100 + round));
        glm::dvec3 by = round % 4 == 0 ? glm::dvec3(0.02 * unit(random), 0.02 * unit(random), 0.02 * unit(random))
                                       : glm::dvec3(3 * unit(random), 3 * unit(random), unit(random));
        view::Camera camera = moved(view, by, 40 * unit(random));
        camera.width_px *= 8, camera.height_px *= 8;
        PatchRule single{0, 0};  // of one pixel
        Warped by_order = warped(image, camera, Hiding::by_order, single),
               by_depth = warped(image, camera, Hiding::by_depth, single);
        WarpCounts counts = PerspectiveWarper(image).warp(camera, Hiding::by_order, by_order, single);
        overdrawn += counts.samples_drawn -
                     (by_order.colours.size() - size_t(std::count(by_order.colours.begin(), by_order.colours.end(), 0u)));
        EXPECT_TRUE(by_order.colours == by_depth.colours) << round;
        EXPECT_TRUE(by_order.depth_m == by_depth.depth_m) << round;
    }
    EXPECT_GT(overdrawn, 2000u) << "nothing hides anything here";
}

// The order itself: of two samples on one line of sight the nearer one comes later. Such are made by marching along lines.
TEST(Epipole, PutsWhatIsNearerOnALineOfSightLater) {
    PerspectiveView view = view_of(64, 48);
    view::PictureRays rays(camera_of(view));
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(-1, 1);
    auto place_of = [](uint32_t pixel, int64_t epipole, bool is_towards, uint32_t count) {
        for (uint32_t i = 0; i < count; ++i)
            if (in_order(i, epipole, is_towards, count) == pixel) return i;
        return count;
    };
    uint64_t pairs = 0;
    for (int round = 0; round < 400; ++round) {
        glm::dvec3 eye = view.position_m + glm::dvec3(unit(random), unit(random), unit(random)) * (round % 2 == 0 ? 5.0 : 0.1);
        if (round % 10 == 0) eye = view.position_m + rays.axes.right * unit(random);  // beside it
        if (round % 10 == 1) eye = view.position_m + rays.axes.up * unit(random);
        if (round % 10 == 2) eye = view.position_m + rays.axes.forward * unit(random);
        Epipole epipole = epipole_of(view, eye);
        glm::dvec3 along(unit(random), unit(random), unit(random));
        int64_t before = -1;
        for (double t = 40; t > 0.05; t *= 0.93) {  // from far to near
            glm::dvec3 seen = rays.seen(eye + t * along);
            if (!(seen.z > view.near_m && seen.x >= 0 && seen.y >= 0 && seen.x < 64 && seen.y < 48)) continue;
            uint32_t row = place_of(uint32_t(seen.y), epipole.row, epipole.is_towards, 48),
                     column = place_of(uint32_t(seen.x), epipole.column, epipole.is_towards, 64);
            int64_t now = int64_t(row) * 64 + column;
            ASSERT_GE(now, before) << round << " at " << t;
            pairs += now > before, before = now;
        }
    }
    EXPECT_GT(pairs, 1000u);
}

TEST(Epipole, OrderHasEveryPixelOnce) {
    for (int64_t epipole : {-1, 0, 3, 6, 7})
        for (bool is_towards : {false, true}) {
            std::vector<uint32_t> seen(7);
            for (uint32_t i = 0; i < 7; ++i) ++seen[in_order(i, epipole, is_towards, 7)];
            EXPECT_EQ(seen, std::vector<uint32_t>(7, 1));
        }
    EXPECT_EQ(in_order(0, 3, false, 7), 3u);
    EXPECT_EQ(in_order(6, 3, true, 7), 3u);
}

// A wall is seen as deep as it is, from the side and from nearer, as its patches grow by their planes; gaps are left only where
// they are stretched much one way, and more where sides are not rounded up.
TEST(PerspectiveWarp, ShowsAWallAsDeepAsItIsWithFewHoles) {
    PerspectiveView view = view_of(160, 120);
    view.pitch_deg = 0, view.heading_deg = 0;
    view::PictureRays rays(camera_of(view));
    glm::dvec3 normal = glm::normalize(glm::dvec3(0.4, -1, 0.1)), on = view.position_m + glm::dvec3(0, 8, 0);
    auto depth_along = [&](const view::PictureRays& of, const glm::dvec3& along) {
        return glm::dot(normal, on - of.eye_m) / glm::dot(normal, along);
    };
    PerspectiveLdi wall = image_of(view, true, [&](uint32_t column, uint32_t row) {
        return std::vector<Layer>{{depth_along(rays, rays.through_pixel(column, row)), colour_of(1 + column), normal}};
    });
    int narrow_holes = 0, all_holes = 0;
    for (glm::dvec3 by : {glm::dvec3(1, 0, 0), {-1.5, 1, 0.3}, {0.3, 3, 0}, {0, -4, 0}}) {
        view::Camera camera = moved(view, by);
        view::PictureRays there(camera);
        Warped picture = warped(wall, camera, Hiding::by_order), narrow = warped(wall, camera, Hiding::by_order, {1, 0});
        int inside = 0, holes = 0;
        for (uint32_t p = 0; p < 160 * 120; ++p) {
            glm::dvec3 along = there.through_pixel(p % 160, p / 160);
            double depth_m = depth_along(there, along);
            glm::dvec3 own = rays.seen(camera.position_m + depth_m * along);
            if (!(own.x > 3 && own.y > 3 && own.x < 157 && own.y < 117)) continue;
            ++inside;
            holes += picture.colours[p] == 0, narrow_holes += narrow.colours[p] == 0;
            if (picture.colours[p] == 0) continue;
            EXPECT_NEAR(double(picture.depth_m[p]), depth_m, 0.04 * depth_m);
            EXPECT_NEAR(double(picture.colours[p] & 0xff), own.x + 0.5, 3);
        }
        EXPECT_GT(inside, 3000);
        EXPECT_LT(holes, inside / 20);
        all_holes += holes;
    }
    EXPECT_GT(narrow_holes, 4 * all_holes);
}

// A patch that turns away from the eye becomes narrower, by its plane: the pixels that are painted are about those of its area.
TEST(PerspectiveWarp, SplatsArePatchesOfPlanes) {
    PerspectiveView view = view_of(9, 9);
    view.heading_deg = view.pitch_deg = 0, view.fov_y_deg = 10;
    auto pixels = [&](const glm::dvec3& normal, const glm::dvec3& by) {
        PerspectiveLdi one = image_of(view, true, [&](uint32_t column, uint32_t row) {
            return column == 4 && row == 4 ? std::vector<Layer>{{10, colour_of(9), normal}} : std::vector<Layer>();
        });
        view::Camera camera = moved(view, by);
        camera.width_px = camera.height_px = 36 * 9;
        glm::dvec3 along = glm::dvec3(0, 10, 0) - by;
        camera.heading_deg = std::atan2(along.x, along.y) * 180 / M_PI;
        Warped picture;
        picture.clear(camera.width_px, camera.height_px);
        return PerspectiveWarper(one).warp(camera, Hiding::by_order, picture, {1, 0}).pixels_written;
    };
    glm::dvec3 facing(0, -1, 0);
    EXPECT_EQ(pixels(facing, {0, 0, 0}), 36u * 36);
    EXPECT_EQ(pixels(facing, {0, 5, 0}), 64u * 64) << "no more than 64 a side";
    EXPECT_EQ(pixels(facing, {0, -10, 0}), 18u * 18);
    double turned = 10 * std::sin(M_PI / 3), back = 10 - 10 * std::cos(M_PI / 3);
    auto side = std::sqrt(double(pixels(facing, {turned, back, 0})));
    EXPECT_NEAR(side, 36 * std::sqrt(0.5), 1) << "seen by 60 degrees from aside it is half as large";
    side = std::sqrt(double(pixels({-std::sin(M_PI / 3), -std::cos(M_PI / 3), 0}, {-turned, back, 0})));
    EXPECT_NEAR(side, 36 * std::sqrt(2.0), 1) << "one that lay aslant is twice as large where it faces the eye";
}

}  // namespace
}  // namespace overlook::wang_ldi
