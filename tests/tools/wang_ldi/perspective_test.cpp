// One perspective image of a ground keeps what rays of its eyes meet, once each, and from its own place shows what rays see
// there.
#include "tools/bake/wang_ldi/perspective.h"

#include <gtest/gtest.h>

#include <cmath>

#include "formats/parallel.h"
#include "runtime/view/picture_rays.h"
#include "runtime/wang_ldi/perspective_warp.h"
#include "tests/tools/wang_ldi/plants.h"
#include "tools/bake/wang_ldi/bake_scene.h"

namespace overlook::wang_ldi {
namespace {

void nothing(double) {}

Light quick_light() {
    Light light;
    light.sun_rays = 2, light.sky_rays = 4;
    return light;
}

class Perspective : public testing::Test {
  protected:
    Models models_ = plants::models();
    Planting planting_ = plants::planting(3);
    std::vector<uint8_t> tiles_ = std::vector<uint8_t>(9, 0);
    TraceStage stage_ = *stage_of(models_, copies_of_ground(planting_, tiles_, 3), 1u << 30);
    PerspectiveView view_{{6, 1, 1.3}, 10, -12, 60, 96, 72, 0.2, 40};

    PerspectiveMade made(const PerspectiveOptions& options) {
        auto one = perspective_of(models_, stage_, view_, options, quick_light(), nothing);
        EXPECT_TRUE(one) << one.error().message;
        return std::move(*one);
    }
};

TEST_F(Perspective, GroundHasEveryObjectOfEveryTileInItsPlace) {
    std::vector<rays::Copy> copies = copies_of_ground(planting_, tiles_, 3);
    ASSERT_EQ(copies.size(), 9 * planting_.tiles[0].size());
    const Planted& object = planting_.tiles[0][7];
    const rays::Copy& copy = copies[5 * planting_.tiles[0].size() + 7];  // column 2, row 1
    EXPECT_FLOAT_EQ(copy.place[3].x, object.x_m + 8);
    EXPECT_FLOAT_EQ(copy.place[3].y, object.y_m + 4);
}

// One eye: a sample where a ray through the middle of a pixel meets something, as deep as it does, and no normals.
TEST_F(Perspective, PictureIsWhatItsOwnRaysMeet) {
    PerspectiveOptions one;
    one.eyes = 1;
    PerspectiveMade picture = made(one);
    view::PictureRays rays(camera_of(view_));
    uint64_t shown = 0;
    for (uint32_t p = 0; p < 96 * 72; ++p) {
        glm::dvec3 along = rays.through_pixel(p % 96, p / 96);
        rays::Ray ray{glm::vec3(rays.eye_m), glm::vec3(along), 0.2f, 40};
        std::vector<rays::Hit> hits = stage_.scene.all_hits(ray);
        uint32_t count = picture.image.first[p + 1] - picture.image.first[p];
        ASSERT_EQ(count, hits.empty() ? 0u : 1u) << p;
        if (hits.empty()) continue;
        ++shown;
        double depth_m = depth_of_code(view_, picture.image.depths[picture.image.first[p]]);
        EXPECT_NEAR(depth_m, double(hits[0].distance), 1e-4 * depth_m);
    }
    EXPECT_GT(shown, 1500u);
    EXPECT_TRUE(picture.image.normals.empty());
    EXPECT_EQ(picture.image.cell_m, 0);
}

// The reference picture stays as it is, whatever other eyes add: warped back it is the picture by rays, pixel for pixel.
TEST_F(Perspective, WarpedBackIsThePictureByRaysPixelForPixel) {
    PerspectiveOptions one, many;
    one.eyes = 1, many.eyes = 12, many.cell_m = 0.2;
    PerspectiveMade picture = made(one), image = made(many);
    EXPECT_GT(image.image.sample_count(), picture.image.sample_count() * 11 / 10) << "eyes beside it see more";
    EXPECT_GT(most_layers(image.image), 2u);
    EXPECT_EQ(image.rays, 12u * 96 * 72);
    Warped by_rays, warped;
    by_rays.clear(96, 72), warped.clear(96, 72);
    PerspectiveWarper(picture.image).warp(camera_of(view_), Hiding::by_order, by_rays);
    PerspectiveWarper(image.image).warp(camera_of(view_), Hiding::by_order, warped);
    EXPECT_TRUE(by_rays.colours == warped.colours);
    EXPECT_TRUE(by_rays.depth_m == warped.depth_m);
}

// Eyes aside of it see behind things: the more of them put theirs in, the fewer holes from there.
TEST_F(Perspective, OfMoreEyesHasFewerHolesAmongThemAndSaysHowMuchIsUnseen) {
    auto holes = [&](const PerspectiveLdi& image) {
        uint64_t all = 0;
        for (double aside_m : {-0.15, 0.15}) {
            PerspectiveView there = view_;
            there.position_m.x += aside_m;
            PerspectiveOptions one;
            one.eyes = 1;
            auto truth = perspective_of(models_, stage_, there, one, quick_light(), nothing);
            Warped drawn;
            drawn.clear(96, 72);
            PerspectiveWarper(image).warp(camera_of(there), Hiding::by_order, drawn);
            for (uint32_t p = 0; p < 96 * 72; ++p) {
                bool is_seen = truth->image.first[p + 1] > truth->image.first[p];
                all += is_seen && p % 96 > 12 && p % 96 < 84 && drawn.colours[p] == 0;
            }
        }
        return all;
    };
    PerspectiveOptions few, many;
    few.eyes = 1, many.eyes = 24, few.cell_m = many.cell_m = 0.2;
    PerspectiveMade one = made(few), all = made(many);
    EXPECT_LT(2 * holes(all.image), holes(one.image));
    few.eyes = 3;
    EXPECT_LT(all.image.unseen_share, made(few).image.unseen_share);
    EXPECT_GT(all.image.unseen_share, 0);
}

TEST_F(Perspective, OfAllLayersHasEverySurfaceAlongEachRayOnce) {
    PerspectiveOptions options;
    options.layers = Layers::all, options.merge_share = 1e-3, options.is_unlit = true;
    PerspectiveMade all = made(options);
    view::PictureRays rays(camera_of(view_));
    for (uint32_t p = 0; p < 96 * 72; p += 7) {
        rays::Ray ray{glm::vec3(rays.eye_m), glm::vec3(rays.through_pixel(p % 96, p / 96)), 0.2f, 40};
        std::vector<double> depths;
        for (const rays::Hit& hit : stage_.scene.all_hits(ray))
            if (depths.empty() || double(hit.distance) > depths.back() * 1.001) depths.push_back(double(hit.distance));
        uint32_t first = all.image.first[p];
        ASSERT_EQ(all.image.first[p + 1] - first, depths.size()) << p;
        for (size_t k = 0; k < depths.size(); ++k)
            EXPECT_NEAR(depth_of_code(view_, all.image.depths[first + k]), depths[k], 1e-4 * depths[k]);
    }
    EXPECT_TRUE(all.image.is_unlit);
    EXPECT_GT(most_layers(all.image), 10u);
    EXPECT_EQ(all.image.normals.size(), all.image.sample_count());
}

TEST_F(Perspective, MergesWhatIsAboutAsDeepAndMoreOfItWhereMoreIsLet) {
    PerspectiveOptions options;
    options.eyes = 8, options.cell_m = 0.2;
    uint32_t before = 0;
    for (double share : {0.3, 0.03, 0.003}) {
        options.merge_share = share;
        PerspectiveMade image = made(options);
        for (size_t p = 0; p + 1 < image.image.first.size(); ++p)
            for (uint32_t s = image.image.first[p] + 1; s < image.image.first[p + 1]; ++s)
                EXPECT_GT(depth_of_code(view_, image.image.depths[s]),
                          (1 + 0.95 * share) * depth_of_code(view_, image.image.depths[s - 1]));
        EXPECT_GT(image.image.sample_count(), before);
        before = image.image.sample_count();
    }
}

TEST_F(Perspective, IsTheSameWithAnyNumberOfThreads) {
    PerspectiveOptions options;
    options.eyes = 5;
    PerspectiveLdi before;
    for (unsigned threads : {1u, 2u, 3u}) {
        set_thread_count(threads);
        PerspectiveMade image = made(options);
        if (threads > 1) {
            EXPECT_TRUE(image.image == before);
        }
        before = std::move(image.image);
    }
    set_thread_count(0);
}

TEST(SceneBakes, HaveAPictureFromTheirOwnPlaceAndSoManyAtEachDistance) {
    Models models = plants::models();
    PlantedTiles ground{plants::one_tile(), plants::planting(4)};
    SceneBake bake;
    bake.side_tiles = 5, bake.directions = 3, bake.light = quick_light();
    bake.view = {{0.5, -1, 1.4}, 25, -8, 60, 64, 48, 0.1, 0}, bake.image.eyes = 4;
    auto made = bake_scene(ground, models, bake, nothing);
    ASSERT_TRUE(made) << made.error().message;
    const Scene& scene = made->scene;
    EXPECT_EQ(scene.tiles.size(), 25u);
    EXPECT_EQ(made->objects, 25 * ground.planting.tiles[0].size());
    EXPECT_EQ(scene.image.view.position_m, glm::dvec3(10.5, 9, 1.4));
    EXPECT_NEAR(scene.image.view.far_m, std::hypot(10.5, 11) + 1.4, 1e-9) << "the farthest corner";
    ASSERT_EQ(scene.pictures.size(), 1 + 3 * std::size(kPictureDistances_m));
    EXPECT_TRUE(scene.pictures[0].view == scene.image.view);
    for (size_t p = 1; p < scene.pictures.size(); ++p) {
        glm::dvec3 off = scene.pictures[p].view.position_m - scene.image.view.position_m;
        EXPECT_NEAR(glm::length(off), kPictureDistances_m[(p - 1) / 3], 1e-9);
        EXPECT_EQ(off.z, 0);
        double heading = std::atan2(off.x, off.y) * 180 / M_PI;
        EXPECT_NEAR(std::cos((heading - 25 - 90 - 120.0 * double((p - 1) % 3)) * M_PI / 180), 1, 1e-9);
    }
    bake.view.position_m.x = 11;
    auto outside = bake_scene(ground, models, bake, nothing);
    ASSERT_FALSE(outside);
    EXPECT_EQ(outside.error().exit, Exit::bad_command);
    EXPECT_EQ(outside.error().message, "--scene-camera: the eye stands outside of the ground, which is 20 m wide");
}

}  // namespace
}  // namespace overlook::wang_ldi
