// The warper shows what plane geometry says, and drawing back to front is as good as testing depths.
#include "runtime/wang_ldi/warp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace overlook::wang_ldi {
namespace {

constexpr double kTile_m = 2;
constexpr uint32_t kSide = 64;
constexpr double kPixel_m = kTile_m / kSide;

ImageSet set_of(float splat_px) {
    ImageSet set;
    set.tile_m = kTile_m, set.low_m = 0, set.high_m = 2, set.tile_count = set.direction_count = 1;
    set.levels = {{kSide, 1, 1.0f / 256, splat_px}};
    return set;
}

// Columns of one colour each: the steps that heights_at gives for the middle of a pixel, ascending.
Ldi ldi_of(const std::function<std::vector<uint16_t>(double x, double y)>& heights_at,
           const std::function<uint8_t(double x, double y)>& colour_at) {
    Ldi ldi;
    ldi.side_px = kSide, ldi.first = {0};
    for (uint32_t j = 0; j < kSide; ++j)
        for (uint32_t i = 0; i < kSide; ++i) {
            double x = (i + 0.5) * kPixel_m, y = (j + 0.5) * kPixel_m;
            for (uint16_t step : heights_at(x, y)) ldi.heights.push_back(step), ldi.colours.push_back(colour_at(x, y));
            ldi.first.push_back(ldi.sample_count());
        }
    for (int c = 0; c < 256; ++c) ldi.palette.push_back({uint8_t(c), uint8_t(255 - c), uint8_t(c / 2)});
    return ldi;
}

view::Camera looking_at(const glm::dvec3& eye, const glm::dvec3& at, uint32_t size_px = 200) {
    view::Camera camera;
    glm::dvec3 along = at - eye;
    camera.position_m = eye, camera.width_px = camera.height_px = size_px, camera.near_m = 0.01;
    camera.heading_deg = std::atan2(along.x, along.y) * 180 / M_PI;
    camera.pitch_deg = std::atan2(along.z, std::hypot(along.x, along.y)) * 180 / M_PI;
    return camera;
}
glm::dvec3 ray_of(const view::Camera& camera, double x_px, double y_px) {
    view::Axes axes = view::axes_of(camera);
    double focal = view::focal_px(camera);
    return axes.forward + axes.right * ((x_px - camera.width_px * 0.5) / focal) +
           axes.up * ((camera.height_px * 0.5 - y_px) / focal);
}

// A plane that rises to the east: every pixel of it shows the colour and the depth where its ray meets the plane, within the
// splats' width.
TEST(Warp, ShowsASlantingPlaneWhereItIs) {
    ImageSet set = set_of(2);
    auto colour = [](double x, double y) { return uint8_t(std::floor(x / kTile_m * 16) * 16 + std::floor(y / kTile_m * 16)); };
    Ldi flat = ldi_of([](double, double) { return std::vector<uint16_t>{128}; }, colour);
    Drawn drawn{&flat, 0, {3, -1, 0.25}, {0.3, -0.1}};
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int view = 0; view < 20; ++view) {
        glm::dvec3 eye(4 + 8 * unit(random) - 4, 8 * unit(random) - 4, 3 + 2 * unit(random));
        view::Camera camera = looking_at(eye, {4, 0, 1});
        Warped picture;
        picture.clear(200, 200);
        warp(camera, set, std::span(&drawn, 1), Hiding::by_order, picture);
        int inside = 0;
        for (uint32_t p = 0; p < 200 * 200; ++p) {
            glm::dvec3 along = ray_of(camera, p % 200 + 0.5, p / 200 + 0.5), n(-0.3, 0.1, 1);
            double t = glm::dot(n, drawn.origin_m + glm::dvec3(0, 0, 0.5) - eye) / glm::dot(n, along);
            glm::dvec3 at = eye + t * along - drawn.origin_m;
            double margin = 3 * kPixel_m;
            if (at.x < margin || at.y < margin || at.x > kTile_m - margin || at.y > kTile_m - margin) continue;
            ++inside;
            ASSERT_NE(picture.colours[p], 0u) << "hole at " << p % 200 << ", " << p / 200;
            EXPECT_NEAR(double(picture.depth_m[p]), t, 4 * kPixel_m);
            double in_x = std::fmod(at.x, kTile_m / 16), in_y = std::fmod(at.y, kTile_m / 16);
            bool is_clear = std::min({in_x, in_y, kTile_m / 16 - in_x, kTile_m / 16 - in_y}) > 2.2 * kPixel_m;
            if (!is_clear) continue;
            EXPECT_EQ(picture.colours[p] & 0xff, colour(at.x, at.y));
        }
        EXPECT_GT(inside, 1000);
    }
}

// A sphere: the depth of every pixel within its outline, and nothing beyond it.
TEST(Warp, ShowsASphereAsDeepAsItIs) {
    ImageSet set = set_of(2);
    glm::dvec3 middle(1, 1, 1);
    double radius = 0.7;
    auto shell = [&](double x, double y) {
        std::vector<uint16_t> steps;
        if (std::hypot(x - 1, y - 1) > radius + 0.7 * kPixel_m) return steps;
        // The walls between this column and the next are steep at the rim: fill the height that the pixel's square spans.
        for (int sign : {-1, 1}) {
            double least = 2, most = 0;
            for (int i = 0; i <= 4; ++i)
                for (int j = 0; j <= 4; ++j) {
                    double dx = x - 1 + (i / 4.0 - 0.5) * kPixel_m, dy = y - 1 + (j / 4.0 - 0.5) * kPixel_m;
                    double z = 1 + sign * std::sqrt(std::max(0.0, radius * radius - dx * dx - dy * dy));
                    least = std::min(least, z), most = std::max(most, z);
                }
            for (double z = least; z <= most + 1e-9; z += kPixel_m)
                if (auto step = uint16_t(std::lround(z * 256)); steps.empty() || step > steps.back()) steps.push_back(step);
        }
        return steps;
    };
    Ldi ball = ldi_of(shell, [](double, double) { return uint8_t(9); });
    Drawn drawn{&ball, 0, glm::dvec3(0), glm::dvec2(0)};
    for (double heading = 0; heading < 6.28; heading += 0.7) {
        glm::dvec3 eye = middle + glm::dvec3(3 * std::sin(heading), 3 * std::cos(heading), 0.4 + heading / 5);
        view::Camera camera = looking_at(eye, middle);
        Warped picture;
        picture.clear(200, 200);
        warp(camera, set, std::span(&drawn, 1), Hiding::by_order, picture);
        int wrong = 0, inside = 0;
        for (uint32_t p = 0; p < 200 * 200; ++p) {
            glm::dvec3 along = ray_of(camera, p % 200 + 0.5, p / 200 + 0.5);
            glm::dvec3 unit = glm::normalize(along);
            double along_middle = glm::dot(middle - eye, unit),
                   off = std::sqrt(glm::dot(middle - eye, middle - eye) - along_middle * along_middle);
            if (off > radius + 3 * kPixel_m) {
                EXPECT_EQ(picture.colours[p], 0u);
            }
            if (off > radius - 3 * kPixel_m) continue;  // the rim is steep
            double t = (along_middle - std::sqrt(radius * radius - off * off)) / glm::length(along);
            ++inside, wrong += std::abs(double(picture.depth_m[p]) - t) > 5 * kPixel_m;
        }
        EXPECT_GT(inside, 3000);
        EXPECT_EQ(wrong, 0) << heading;
    }
}

// Scattered columns of up to six samples.
Ldi thicket(uint32_t seed) {
    std::mt19937 random(seed);
    auto heights = [&](double, double) {
        std::vector<uint16_t> steps;
        if (random() % 3 != 0) return steps;
        uint16_t step = uint16_t(random() % 100);
        for (uint32_t left = uint32_t(1 + random() % 6); left > 0; --left, step = uint16_t(step + 1 + random() % 70))
            steps.push_back(step);
        return steps;
    };
    return ldi_of(heights, [&](double, double) { return uint8_t(random() % 256); });
}

// Whether a splat shown by order alone stands behind another only where their squares overlap though neither is before the other:
// rare, and far rarer than in a wrong order of tiles.
TEST(Warp, DrawnBackToFrontIsAsGoodAsTestedByDepthExceptWhereSplatsOverlap) {
    ImageSet set = set_of(1);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Ldi> thickets;
    for (uint32_t i = 0; i < 9; ++i) thickets.push_back(thicket(i));
    size_t shown = 0, behind = 0, behind_in_wrong_order = 0;
    for (int view = 0; view < 40; ++view) {
        glm::dvec3 eye(6 * unit(random) - 2, 6 * unit(random) - 2, 3 * unit(random));
        view::Camera camera = looking_at(eye, glm::dvec3(2 * unit(random), 2 * unit(random), unit(random)), 400);
        std::vector<Drawn> drawn;
        for (int t = 0; t < 9; ++t)
            drawn.push_back({&thickets[size_t(t)], 0, {kTile_m * (t % 3 - 1), kTile_m * (t / 3 - 1), 0}, {0.2, 0.1}});
        order_of_tiles(eye, kTile_m, drawn);
        Warped by_order, by_depth, wrong;
        for (Warped* picture : {&by_order, &by_depth, &wrong}) picture->clear(400, 400);
        warp(camera, set, drawn, Hiding::by_order, by_order);
        warp(camera, set, drawn, Hiding::by_depth, by_depth);
        std::reverse(drawn.begin(), drawn.end());
        warp(camera, set, drawn, Hiding::by_order, wrong);
        for (uint32_t p = 0; p < 400 * 400; ++p) {
            ASSERT_EQ(by_order.colours[p] == 0, by_depth.colours[p] == 0);
            if (by_order.colours[p] == 0) continue;
            ASSERT_GE(by_order.depth_m[p], by_depth.depth_m[p]);
            double splats_m = 2 * (kPixel_m + double(by_depth.depth_m[p]) / view::focal_px(camera));
            ++shown, behind += double(by_order.depth_m[p] - by_depth.depth_m[p]) > splats_m;
            behind_in_wrong_order += double(wrong.depth_m[p] - by_depth.depth_m[p]) > splats_m;
        }
    }
    EXPECT_GT(shown, 1000000u);
    EXPECT_LT(double(behind), 0.01 * double(shown)) << shown << " " << behind << " " << behind_in_wrong_order;
    EXPECT_GT(double(behind_in_wrong_order), 10 * double(behind));
}

// Of two samples whose squares on the ground a ray from the eye passes one after the other, the nearer is shown: in one tile and
// across tiles, whatever the heights, eye and slope. (Columns of all heights stand on both, so that they meet on the screen.)
TEST(Warp, ANearerColumnHidesAFartherOneThatTheSameRayPasses) {
    ImageSet set = set_of(1.5f);  // a square's diagonal, so that a ray through a corner meets the splat
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    int across = 0, near_seen = 0, far_seen = 0;
    for (int pair = 0; pair < 400; ++pair) {
        glm::dvec3 eye(8 * unit(random) - 3, 8 * unit(random) - 3, 2.5 * unit(random));
        glm::dvec2 far(4 * unit(random), 2 * unit(random)), ground = far - glm::dvec2(eye);
        if (glm::length(ground) < 1) continue;
        glm::dvec2 near = glm::dvec2(eye) + ground * (0.3 + 0.6 * unit(random));
        auto index = [](double at) { return int(std::floor(at / kPixel_m)); };
        if (near.x < 0 || near.y < 0 || near.x >= 4 || near.y >= 2 || glm::length(far - near) < 3 * kPixel_m) continue;
        // The square of the far one's middle is passed again: the ray to it, not to the random place.
        glm::dvec2 middle((index(far.x) + 0.5) * kPixel_m, (index(far.y) + 0.5) * kPixel_m);
        near = glm::dvec2(eye) + (middle - glm::dvec2(eye)) * (glm::length(near - glm::dvec2(eye)) / glm::length(ground));
        if (near.x < 0 || near.y < 0 || near.x >= 4 || near.y >= 2) continue;
        glm::ivec2 a(index(middle.x), index(middle.y)), b(index(near.x), index(near.y));
        if (a == b) continue;
        bool is_across = a.x / int(kSide) != b.x / int(kSide);
        across += is_across;

        std::vector<Ldi> ldis(2);
        for (int tile = 0; tile < 2; ++tile) {
            auto at = [&](double x, double y) { return glm::ivec2(index(x) + tile * int(kSide), index(y)); };
            ldis[size_t(tile)] = ldi_of(
                [&](double x, double y) {
                    std::vector<uint16_t> steps;
                    if (at(x, y) == a || at(x, y) == b)
                        for (uint16_t step = 0; step < 512; step += 4) steps.push_back(step);
                    return steps;
                },
                [&](double x, double y) { return uint8_t(at(x, y) == a ? 1 : 2); });
        }
        std::vector<Drawn> drawn{{&ldis[0], 0, {0, 0, 0}, {0.1, 0}}, {&ldis[1], 0, {2, 0, 0.2}, {0.1, 0}}};
        order_of_tiles(eye, kTile_m, drawn);
        double height = eye.z + (1 + 0.1 * middle.x - eye.z) * 0.5;
        view::Camera camera = looking_at(eye, {middle, height}, 101);
        Warped picture;
        picture.clear(101, 101);
        warp(camera, set, drawn, Hiding::by_order, picture);
        // On the column of the picture where the far one's middle is, wherever the near one is at all, it hides the far one.
        glm::dvec3 along = ray_of(camera, 50.5, 50.5);
        ASSERT_NEAR(along.x * ground.y, along.y * ground.x, 1.0);
        int near_first = 101, near_last = -1;
        for (int y = 0; y < 101; ++y)
            if ((picture.colours[size_t(y * 101 + 50)] & 0xff) == 2) near_first = std::min(near_first, y), near_last = y;
        near_seen += std::max(0, near_last - near_first + 1);
        for (int y = 0; y < 101; ++y) far_seen += (picture.colours[size_t(y * 101 + 50)] & 0xff) == 1;
        for (int y = near_first; y <= near_last; ++y)
            EXPECT_EQ(picture.colours[size_t(y * 101 + 50)] & 0xff, 2u) << "pair " << pair << " at " << y;
    }
    EXPECT_GT(across, 20);
    EXPECT_GT(near_seen, 2000);  // so that something was asked
    EXPECT_GT(far_seen, 100);
}

// Of samples in one column, the nearest to the eye's height is what an eye straight before it sees last drawn: from above the
// top, from below the bottom.
TEST(Warp, DrawsAColumnTowardsTheEyesHeight) {
    ImageSet set = set_of(20);
    auto column = [](double x, double y) {
        bool is_middle = std::abs(x - 1) < kPixel_m && std::abs(y - 1) < kPixel_m;
        return is_middle ? std::vector<uint16_t>{100, 101, 102} : std::vector<uint16_t>{};
    };
    Ldi post = ldi_of(column, [](double, double) { return uint8_t(0); });
    for (size_t s = 0; s < post.colours.size(); ++s) post.colours[s] = uint8_t(s % 3 + 1);
    Drawn drawn{&post, 0, glm::dvec3(0), glm::dvec2(0)};
    auto seen_from = [&](double height) {
        Warped picture;
        picture.clear(200, 200);
        warp(looking_at({1, -1, height}, {1, 1, 101 / 256.0}), set, std::span(&drawn, 1), Hiding::by_order, picture);
        return picture.colours[100 * 200 + 100] & 0xff;
    };
    EXPECT_EQ(seen_from(2), 3u);
    EXPECT_EQ(seen_from(0), 1u);
}

TEST(Warp, DrawsNothingBehindTheEyeOrOutsideThePicture) {
    ImageSet set = set_of(60);
    Ldi flat = ldi_of([](double, double) { return std::vector<uint16_t>{256}; }, [](double, double) { return uint8_t(5); });
    Drawn drawn{&flat, 0, glm::dvec3(0), glm::dvec2(0)};
    Warped picture;
    picture.clear(50, 30);
    view::Camera camera = looking_at({1, 5, 1}, {1, 9, 1});
    camera.width_px = 50, camera.height_px = 30;
    warp(camera, set, std::span(&drawn, 1), Hiding::by_order, picture);
    EXPECT_EQ(std::count(picture.colours.begin(), picture.colours.end(), 0u), 1500);
    for (double x = -1; x < 3; x += 0.1) {
        camera = looking_at({x, 1, 1.0001}, {1, 3, 1});
        camera.width_px = 50, camera.height_px = 30, camera.near_m = 1e-9;
        warp(camera, set, std::span(&drawn, 1), Hiding::by_order, picture);
    }
    EXPECT_LT(std::count(picture.colours.begin(), picture.colours.end(), 0u), 1500);
}

}  // namespace
}  // namespace overlook::wang_ldi
