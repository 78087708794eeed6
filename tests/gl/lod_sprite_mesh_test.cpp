// LOD-sprite on a mesh, frame by frame.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runtime/caveclod/static_levels.h"
#include "runtime/gl/png.h"
#include "runtime/lod_sprite/draw_frames.h"
#include "runtime/lod_sprite/draw_on_mesh.h"
#include "tests/caveclod/flights.h"
#include "tests/caveclod/synthetic_hierarchy.h"
#include "tests/gl/fixture.h"

namespace overlook {
namespace {

namespace synthetic = caveclod::synthetic;
using lod_sprite::FrameCounts;
using lod_sprite::FrameDrawer;
using lod_sprite::FrameOptions;

constexpr uint32_t kWidth = 160, kHeight = 120;

struct Stage {
    caveclod::Hierarchy hierarchy;
    caveclod::Mesh mesh;
    caveclod::Drawing drawing;

    explicit Stage(const synthetic::Source& source)
        : hierarchy(synthetic::bake(source)), mesh(*caveclod::Mesh::make(hierarchy)), drawing(*caveclod::Drawing::make(mesh)) {}

    std::unique_ptr<FrameDrawer> frames(const FrameOptions& options = {}) const {
        auto thing = std::make_unique<lod_sprite::DrawnMesh>(mesh, drawing, caveclod::DrawOptions());
        auto made = FrameDrawer::make(std::move(thing), options);
        EXPECT_TRUE(made) << made.error().message;
        return std::move(*made);
    }
    // The whole of it.
    ImageRgb8 full(const view::Camera& camera) const {
        caveclod::CameraBuffers buffers(mesh);
        buffers.take(caveclod::faces_within(mesh, 0).by_surface);
        gl::Target target = std::move(*gl::Target::make(kWidth, kHeight, 1));
        drawing.draw(target, buffers, camera, {});
        return target.read();
    }
    ImageRgb8 background(const view::Camera& camera) const {
        gl::Target target = std::move(*gl::Target::make(kWidth, kHeight, 1));
        drawing.draw(target, caveclod::CameraBuffers(mesh), camera, {});
        return target.read();
    }
};

// Round the sphere, a third of a degree a frame.
view::Camera round_sphere(double frame) {
    double angle = 0.006 * frame;
    view::Camera camera = caveclod::flights::camera_at(32 * std::sin(angle), -32 * std::cos(angle), 6, -angle * 180 / 3.14159265,
                                                       -10, kWidth, kHeight);
    camera.fov_y_deg = 50;
    return camera;
}

struct Shown {
    ImageRgb8 picture;
    FrameCounts counts;
};

Shown draw(FrameDrawer& frames, const view::Camera& camera) {
    gl::Target target = std::move(*gl::Target::make(kWidth, kHeight, 1));
    frames.decide(camera);
    Result<FrameCounts> drawn = frames.draw(target);
    EXPECT_TRUE(drawn) << drawn.error().message;
    return {target.read(), drawn ? *drawn : FrameCounts{}};
}

// Of the pixels: where one picture shows the mesh and the other what is behind it; and the mean difference of their levels.
struct Difference {
    double outline_share = 0, mean_levels = 0;
};
Difference difference(const ImageRgb8& a, const ImageRgb8& b, const ImageRgb8& behind) {
    Difference found;
    for (size_t i = 0; i < a.pixels.size(); i += 3) {
        auto is_behind = [&](const ImageRgb8& image) {
            return std::equal(&image.pixels[i], &image.pixels[i] + 3, &behind.pixels[i]);
        };
        found.outline_share += is_behind(a) != is_behind(b);
        for (size_t k = i; k < i + 3; ++k) found.mean_levels += std::abs(int(a.pixels[k]) - int(b.pixels[k])) / 3.0;
    }
    found.outline_share *= 3.0 / double(a.pixels.size());
    found.mean_levels *= 3.0 / double(a.pixels.size());
    return found;
}

// The coarse cut alone is far coarser; what is shown on it is the whole mesh all the same, inside and along its outline.
TEST(LodSpriteOnMesh, ShowsTheFineMeshOnACoarseOne) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Stage stage(synthetic::sphere(64));
    auto frames = stage.frames();
    uint32_t with_keys = 0, made = 0;
    for (uint32_t frame = 0; frame < 90; ++frame) {
        view::Camera camera = round_sphere(frame);
        Shown shown = draw(*frames, camera);
        made += shown.counts.rekeyed != lod_sprite::Cause::none;
        if (shown.counts.used_key_count == 0) continue;
        ++with_keys;
        if (frame % 10 != 0) continue;
        ImageRgb8 full = stage.full(camera);
        if (frame == 60) {
            EXPECT_TRUE(write_png(testing::TempDir() + "lod_sprite_mesh.png", shown.picture));
        }
        Difference is = difference(shown.picture, full, stage.background(camera));
        EXPECT_LT(is.outline_share, 0.006) << frame;
        EXPECT_LT(is.mean_levels, 0.5) << frame;
    }
    EXPECT_GT(with_keys, 30u);
    EXPECT_GE(made, 2u);
}

// That test can fail: the coarse cut in its own colours is another picture.
TEST(LodSpriteOnMesh, WouldBeTold) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Stage stage(synthetic::sphere(64));
    view::Camera camera = round_sphere(60);
    caveclod::Settings settings;
    settings.error_px = 16, settings.glide_s = 0;
    caveclod::Refinement coarse(stage.mesh);
    coarse.refine(camera, settings, 0);
    caveclod::CameraBuffers buffers(stage.mesh);
    buffers.take(coarse);
    gl::Target target = std::move(*gl::Target::make(kWidth, kHeight, 1));
    stage.drawing.draw(target, buffers, camera, {});
    Difference is = difference(target.read(), stage.full(camera), stage.background(camera));
    EXPECT_GT(is.outline_share, 0.012);
    EXPECT_GT(is.mean_levels, 0.8);
}

// However keys come about, a camera that stands still is shown the same in the end.
TEST(LodSpriteOnMesh, ShowsTheSameByEveryKindOfKey) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Stage stage(synthetic::hills(48, 48, 3));  // of three surfaces
    view::Camera camera = caveclod::flights::camera_at(24, -20, 14, 0, -22, kWidth, kHeight);
    std::vector<ImageRgb8> settled;
    for (lod_sprite::KeyMode mode : {lod_sprite::KeyMode::sliced, lod_sprite::KeyMode::thread, lod_sprite::KeyMode::at_once}) {
        FrameOptions options;
        options.decide.mode = mode;
        auto frames = stage.frames(options);
        Shown shown;
        for (uint32_t frame = 0; frame < 60; ++frame) shown = draw(*frames, camera);
        EXPECT_GT(shown.counts.used_key_count, 0u);
        EXPECT_EQ(shown.counts.draw_call_count - 1, 3 * 3u);  // three passes of three surfaces before the background
        settled.push_back(shown.picture);
    }
    EXPECT_EQ(settled[1].pixels, settled[0].pixels);
    EXPECT_EQ(settled[2].pixels, settled[0].pixels);
}

TEST(LodSpriteOnMesh, DrawsTheSameFramesAgain) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Stage stage(synthetic::sphere(48));
    auto first = stage.frames(), second = stage.frames();
    for (uint32_t frame = 0; frame < 40; ++frame) {
        Shown a = draw(*first, round_sphere(frame)), b = draw(*second, round_sphere(frame));
        ASSERT_EQ(a.picture.pixels, b.picture.pixels) << frame;
        ASSERT_EQ(a.counts.triangle_count, b.counts.triangle_count) << frame;
    }
}

// Drawn into another target it is the same picture, whoever drew the mesh between.
TEST(LodSpriteOnMesh, DrawsAFrameTwiceAlike) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Stage stage(synthetic::sphere(48));
    auto frames = stage.frames();
    for (uint32_t frame = 0; frame < 30; ++frame) draw(*frames, round_sphere(frame));
    gl::Target one = std::move(*gl::Target::make(kWidth, kHeight, 1)), other = std::move(*gl::Target::make(kWidth, kHeight, 1));
    frames->decide(round_sphere(30));
    ASSERT_TRUE(frames->draw(one));
    static_cast<void>(stage.full(round_sphere(5)));
    ASSERT_TRUE(frames->draw(other));
    EXPECT_EQ(one.read().pixels, other.read().pixels);
}

}  // namespace
}  // namespace overlook
