// The reference put together from parts: the same picture as drawn at once.
#include "tools/measure/reference.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/gl/fixture.h"

namespace overlook::measure {
namespace {

World world_of(terrain::Terrain terrain) {
    World world;
    world.terrain = std::make_unique<terrain::Terrain>(std::move(terrain));
    world.refiner.emplace(*world.terrain);
    EXPECT_TRUE(upload(world));
    return world;
}

Frame reference(World& world, const gl::Renderer& renderer, const view::Camera& camera, uint32_t part_px) {
    auto made = ReferenceRenderer::make(world, renderer, camera.width_px, camera.height_px, "", part_px);
    if (!made) return {};
    auto frame = made->frame(camera);
    return frame ? std::move(*frame) : Frame();
}

struct Difference {
    size_t count = 0;  // channels of pixels that differ
    int greatest = 0;  // of 255
};
Difference difference(const Frame& a, const Frame& b) {
    Difference found;
    EXPECT_EQ(a.rgb.size(), b.rgb.size());
    for (size_t i = 0; i < std::min(a.rgb.size(), b.rgb.size()); ++i) {
        int step = std::abs(int(a.rgb[i]) - int(b.rgb[i]));
        found.count += step != 0;
        found.greatest = std::max(found.greatest, step);
    }
    return found;
}

// The picture one pixel to the left.
Frame moved(Frame frame) {
    std::rotate(frame.rgb.begin(), frame.rgb.begin() + 3, frame.rgb.end());
    return frame;
}

TEST(Reference, FromPartsIsThePictureDrawnAtOnce) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    World world = world_of(test::flat_terrain(65));
    world.look.haze = 0;  // one colour a quarter and the sky round them: nothing that the last bit of a distance could change
    view::Camera camera = test::from_above(*world.terrain, 800, 157, 83);
    Frame whole = reference(world, context->renderer(), camera, 157);
    EXPECT_GT(difference(whole, moved(whole)).count, 100u);
    for (uint32_t part_px : {156u, 64u, 30u, 7u}) {
        Frame parts = reference(world, context->renderer(), camera, part_px);
        EXPECT_EQ(parts.rgb, whole.rgb) << part_px;
        EXPECT_EQ(parts.depth_m, whole.depth_m) << part_px;
    }
}

TEST(Reference, FromPartsDiffersByRoundingAlone) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    for (bool has_texture : {true, false}) {
        terrain::Terrain hills = test::hilly_terrain(129);
        if (!has_texture) hills.texture = {};
        World world = world_of(std::move(hills));
        view::Camera camera = test::from_south(*world.terrain, 157, 83);
        Frame whole = reference(world, context->renderer(), camera, 157);
        size_t channels = whole.rgb.size();
        EXPECT_GT(difference(whole, moved(whole)).count, channels / 20);
        for (uint32_t part_px : {156u, 64u, 30u}) {
            Difference found = difference(whole, reference(world, context->renderer(), camera, part_px));
            EXPECT_LE(found.count, channels / 1000) << part_px;
            EXPECT_LE(found.greatest, 4) << part_px;
        }
    }
}

TEST(Reference, IsDrawnWhereItsSamplesAreMoreThanARendererDrawsAtOnce) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    GLint most_px = 0;
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &most_px);
    uint32_t width_px = uint32_t(most_px) / kSupersampling + 100;
    World world = world_of(test::flat_terrain(65));
    view::Camera camera = test::from_above(*world.terrain, 400, width_px, 4);
    camera.fov_y_deg = 1;  // the row reaches from one side of the square to beyond the other
    Frame frame = reference(world, context->renderer(), camera, kReferencePartPx);
    ASSERT_EQ(frame.width, width_px);
    EXPECT_FALSE(gl::Target::make(width_px * kSupersampling, 4 * kSupersampling, 1));
    Frame finer = reference(world, context->renderer(), camera, 500);
    Difference found = difference(frame, finer);
    EXPECT_LE(found.count, frame.rgb.size() / 1000);
    EXPECT_GT(difference(frame, moved(frame)).count, 0u);
}

}  // namespace
}  // namespace overlook::measure
