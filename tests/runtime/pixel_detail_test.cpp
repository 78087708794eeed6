#include "runtime/view/pixel_detail.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace overlook::view {
namespace {

class Dice {
  public:
    explicit Dice(uint32_t seed) : engine_(seed) {}
    double operator()(double low, double high) { return low + (high - low) * double(engine_()) / 4294967295.0; }
    glm::dvec3 in_ball() {
        while (true) {
            glm::dvec3 at((*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1));
            if (glm::length(at) <= 1) return at;
        }
    }

  private:
    std::mt19937 engine_;
};

Camera random_camera(Dice& dice) {
    Camera camera;
    camera.position_m = 20.0 * dice.in_ball();
    camera.heading_deg = dice(-180, 180), camera.pitch_deg = dice(-80, 80), camera.fov_y_deg = dice(20, 100);
    camera.width_px = 160, camera.height_px = 120, camera.near_m = 0.1;
    return camera;
}

PictureMask random_mask(Dice& dice) {
    std::vector<uint8_t> marked(12 * 8);
    for (uint8_t& mark : marked) mark = dice(0, 1) < 0.1;
    return {12, 8, marked};
}

// By the definition, of one place that is in the frame.
bool is_finer(const Camera& camera, const PixelDetail& detail, const glm::dvec3& place_m) {
    Axes axes = axes_of(camera);
    glm::dvec3 away_m = place_m - camera.position_m;
    double depth_m = glm::dot(away_m, axes.forward);
    if (depth_m < detail.near_depth_m) return true;
    if (detail.seen_by) {
        glm::dvec3 from_other = place_m - detail.seen_by->position_m;
        for (const glm::dvec3& side : sides_of(*detail.seen_by))
            if (glm::dot(side, from_other) < 0) return true;
    }
    double x = 0.5 + focal_px(camera) / camera.width_px * glm::dot(away_m, axes.right) / depth_m;
    double y = 0.5 - focal_px(camera) / camera.height_px * glm::dot(away_m, axes.up) / depth_m;
    return detail.finer_in.is_touched(x, x, y, y);
}

bool is_in_frame(const Camera& camera, const glm::dvec3& place_m) {
    glm::dvec3 away_m = place_m - camera.position_m;
    auto sides = sides_of(camera);
    return glm::dot(away_m, axes_of(camera).forward) > camera.near_m &&
           std::all_of(sides.begin(), sides.end(), [&](const glm::dvec3& side) { return glm::dot(side, away_m) >= 0; });
}

TEST(SidesOfACamera, AreWhereThePictureEnds) {
    Dice dice(1);
    for (int i = 0; i < 200; ++i) {
        Camera camera = random_camera(dice);
        Axes axes = axes_of(camera);
        double x = dice(-1.2, 1.2), y = dice(-1.2, 1.2), focal = focal_px(camera);  // 1: the picture's border
        glm::dvec3 ray = axes.forward + x * camera.width_px / (2 * focal) * axes.right + y * camera.height_px / (2 * focal) * axes.up;
        auto sides = sides_of(camera);
        EXPECT_EQ(glm::dot(sides[0], ray) >= 0, x >= -1);
        EXPECT_EQ(glm::dot(sides[1], ray) >= 0, x <= 1);
        EXPECT_EQ(glm::dot(sides[2], ray) >= 0, y >= -1);
        EXPECT_EQ(glm::dot(sides[3], ray) >= 0, y <= 1);
    }
}

// Of all that a sphere holds in the frame: nothing finer is missed, and what a sphere within another touches the other touches.
TEST(FinerParts, TouchWhateverHoldsAPlaceOfThem) {
    Dice dice(2);
    int touched = 0, untouched = 0, finer = 0;
    for (int i = 0; i < 3000; ++i) {
        Camera camera = random_camera(dice);
        PixelDetail detail{16, 0, 0, 1, {}, {}, false};
        if (i % 3 == 0) detail.near_depth_m = dice(0, 20);
        if (i % 3 == 1) {
            detail.seen_by = camera;
            detail.seen_by->heading_deg += dice(-20, 20);
            detail.seen_by->position_m += dice.in_ball();
        }
        if (i % 3 == 2) detail.finer_in = random_mask(dice);
        FinerParts parts(camera, detail);
        SphereErrorBound bound(camera);
        Axes axes = axes_of(camera);
        glm::dvec3 middle_m = camera.position_m + dice(1, 40) * axes.forward + 10.0 * dice.in_ball();
        double radius_m = dice(0, 4);
        bool is_touched = parts.touch(bound.place_of(middle_m - camera.position_m), radius_m);
        ++(is_touched ? touched : untouched);
        for (int k = 0; k < 40; ++k) {
            glm::dvec3 place_m = middle_m + radius_m * dice.in_ball();
            if (is_in_frame(camera, place_m) && is_finer(camera, detail, place_m)) {
                ++finer;
                ASSERT_TRUE(is_touched) << i;
            }
            double inner_m = 0.999 * (radius_m - glm::distance(place_m, middle_m));
            if (inner_m > 0 && parts.touch(bound.place_of(place_m - camera.position_m), inner_m)) {
                ASSERT_TRUE(is_touched) << i;
            }
        }
    }
    EXPECT_GT(touched, 300);
    EXPECT_GT(untouched, 300);
    EXPECT_GT(finer, 3000);
}

TEST(FinerParts, AreNoneWhereNothingIsAsked) {
    Camera camera;
    EXPECT_TRUE(FinerParts(camera, {}).is_empty());
    PixelDetail near;
    near.near_depth_m = 1;
    EXPECT_FALSE(FinerParts(camera, near).is_empty());
}

}  // namespace
}  // namespace overlook::view
