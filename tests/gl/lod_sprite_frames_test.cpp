// LOD-sprite frame by frame, as the player and measure draw it.
#include "runtime/lod_sprite/draw_frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runtime/lod_sprite/draw_on_terrain.h"
#include "runtime/lod_sprite/draw_paper_frames.h"
#include "tests/gl/fixture.h"

namespace overlook {
namespace {

using lod_sprite::Cause;
using lod_sprite::FrameCounts;
using lod_sprite::FrameDrawer;
using lod_sprite::FrameOptions;
using lod_sprite::KeyMode;

// A hilly terrain on the card, and a way over it.
struct Stage {
    terrain::Terrain terrain = test::hilly_terrain(257);
    terrain::Refiner refiner{terrain};
    std::optional<terrain::Drawing> ground;
    terrain::DrawOptions look;

    Stage() {
        Result<terrain::Drawing> made = terrain::Drawing::make(terrain);
        EXPECT_TRUE(made) << made.error().message;
        ground = std::move(*made);
    }
    std::unique_ptr<lod_sprite::DrawnGeometry> thing() {
        return std::make_unique<lod_sprite::DrawnTerrain>(refiner, *ground, look);
    }
    std::unique_ptr<FrameDrawer> frames(const FrameOptions& options = {}) {
        auto made = FrameDrawer::make(thing(), options);
        EXPECT_TRUE(made) << made.error().message;
        return std::move(*made);
    }
    view::Camera camera(uint32_t frame, uint32_t width_px = 96, uint32_t height_px = 64) const {
        view::Camera camera = test::from_south(terrain, width_px, height_px);
        camera.position_m.y += 4.0 * frame;
        camera.heading_deg += 0.1 * frame;
        return camera;
    }
};

// Keys of more triangles than one slice has.
FrameOptions fine_options() {
    FrameOptions options;
    lod_sprite::set(options, "error-px", 0.01);
    lod_sprite::set(options, "texel-share", 0);
    return options;
}

gl::Target target_of(uint32_t width_px = 96, uint32_t height_px = 64) {
    return std::move(*gl::Target::make(width_px, height_px, 1));
}

template <class Frames>
FrameCounts draw(Frames& frames, const view::Camera& camera, const gl::Target& target) {
    frames.decide(camera);
    Result<FrameCounts> drawn = frames.draw(target);
    EXPECT_TRUE(drawn) << drawn.error().message;
    return drawn.value_or(FrameCounts{});
}

// Of the picture, the share of pixels that fit.
template <class Fits>
double share_of(const ImageRgb8& image, Fits fits) {
    uint32_t count = 0;
    for (uint32_t y = 0; y < image.height; ++y)
        for (uint32_t x = 0; x < image.width; ++x) count += fits(test::pixel(image, x, y));
    return double(count) / (image.width * image.height);
}
bool is_grey(const test::Rgb& c) {
    return std::abs(c.red - c.green) <= 2 && std::abs(c.green - c.blue) <= 2;
}
bool is_red(const test::Rgb& c) {
    return c.red > c.green + 25 && c.red > c.blue + 25;
}

TEST(LodSpriteFrames, BeginWithoutAKeyAndSayWhenOneTakesOver) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Stage stage;
    auto frames = stage.frames(fine_options());
    gl::Target target = target_of();
    uint64_t key_triangles = 0;
    uint32_t first_keyed = 0;
    for (uint32_t frame = 0; frame < 60; ++frame) {
        FrameCounts counts = draw(*frames, stage.camera(frame), target);
        EXPECT_GT(counts.triangle_count, counts.key_triangle_count);
        EXPECT_LE(counts.used_key_count, counts.live_key_count);
        key_triangles += counts.key_triangle_count;
        if (counts.live_key_count == 0) {
            EXPECT_EQ(counts.rekeyed, Cause::none);
            EXPECT_EQ(counts.lost_share, 1);
        } else if (first_keyed == 0) {
            first_keyed = frame;
            EXPECT_EQ(counts.rekeyed, Cause::first);
        } else {
            EXPECT_NE(counts.rekeyed, Cause::first);
        }
    }
    EXPECT_GT(first_keyed, 0u);
    EXPECT_GT(key_triangles, 0u);
}

TEST(LodSpriteFrames, AreTheSameWhetherPreparedOrNot) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Stage stage;
    auto prepared = stage.frames(fine_options()), fresh = stage.frames(fine_options());
    gl::Target one = target_of(), other = target_of();
    ASSERT_TRUE(prepared->prepare(stage.camera(7), one));
    uint32_t with_two = 0;
    for (uint32_t frame = 0; frame < 60; ++frame) {
        FrameCounts a = draw(*prepared, stage.camera(frame), one), b = draw(*fresh, stage.camera(frame), other);
        ASSERT_EQ(one.read().pixels, other.read().pixels) << frame;
        ASSERT_EQ(a.triangle_count, b.triangle_count) << frame;
        with_two += a.used_key_count == 2;
    }
    EXPECT_GT(with_two, 0u);
}

TEST(LodSpriteFrames, CountWhatEveryPassSubmits) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Stage stage;
    FrameOptions options = fine_options();
    lod_sprite::set(options, "near", 0);
    auto frames = stage.frames(options);
    gl::Target target = target_of();
    uint32_t with_keys = 0;
    for (uint32_t frame = 0; frame < 60; ++frame) {
        FrameCounts counts = draw(*frames, stage.camera(frame), target);
        if (counts.key_triangle_count > 0) continue;
        // Beside the sky: its own colours; and with keys what all, then what some show, which fades twice.
        uint64_t passes = counts.draw_call_count - 1;
        EXPECT_EQ(counts.vertex_reference_count, 3 * passes * counts.triangle_count) << frame;
        if (counts.used_key_count == 0) {
            EXPECT_EQ(passes, 1u) << frame;
        } else {
            ++with_keys;
            EXPECT_GE(passes, 3u) << frame;
            EXPECT_LE(passes, 4u) << frame;
        }
    }
    EXPECT_GT(with_keys, 0u);
    frames->forget();
    FrameCounts first = draw(*frames, stage.camera(0), target);
    EXPECT_EQ(first.used_key_count, 0u);
    EXPECT_GT(first.vertex_reference_count, 3 * first.key_triangle_count);
}

FrameOptions thread_options() {
    FrameOptions options = fine_options();
    options.decide.mode = KeyMode::thread;
    return options;
}

TEST(LodSpriteFrames, GetAThreadsKeyInTheFrameThatIsStated) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Stage stage;
    auto frames = stage.frames(thread_options());
    gl::Target target = target_of();
    for (uint32_t frame = 0; frame <= lod_sprite::kThreadFrames; ++frame) {
        FrameCounts counts = draw(*frames, stage.camera(frame), target);
        bool is_back = frame == lod_sprite::kThreadFrames;
        EXPECT_EQ(counts.key_pixel_count > 0, frame == 0) << frame;
        EXPECT_EQ(counts.key_triangle_count > 0, is_back) << frame;
        EXPECT_EQ(counts.live_key_count, is_back ? 1u : 0u) << frame;
        EXPECT_EQ(counts.rekeyed, is_back ? Cause::first : Cause::none) << frame;
    }
}

TEST(LodSpriteFrames, FromAThreadsKeysAreTheSameOnEveryRun) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Stage stage;
    auto one = stage.frames(thread_options()), other = stage.frames(thread_options());
    gl::Target target = target_of();
    uint32_t keyed = 0;
    for (uint32_t frame = 0; frame < 60; ++frame) {
        FrameCounts counts = draw(*one, stage.camera(frame), target);
        std::vector<uint8_t> pixels = target.read().pixels;
        FrameCounts expected = draw(*other, stage.camera(frame), target);
        ASSERT_EQ(pixels, target.read().pixels) << "frame " << frame;
        EXPECT_EQ(counts.triangle_count, expected.triangle_count);
        EXPECT_EQ(counts.key_triangle_count, expected.key_triangle_count);
        EXPECT_EQ(counts.rekeyed, expected.rekeyed);
        keyed += counts.rekeyed != Cause::none;
    }
    EXPECT_GE(keyed, 1u);
}

TEST(LodSpriteFrames, ForgetAKeyThatIsStillBeingDrawn) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Stage stage;
    auto flown = stage.frames(thread_options()), fresh = stage.frames(thread_options());
    gl::Target target = target_of();
    for (uint32_t frame = 0; frame < 3; ++frame) draw(*flown, stage.camera(frame), target);
    flown->forget();
    for (uint32_t frame = 3; frame < 30; ++frame) {
        draw(*flown, stage.camera(frame), target);
        std::vector<uint8_t> forgotten = target.read().pixels;
        draw(*fresh, stage.camera(frame), target);
        ASSERT_EQ(forgotten, target.read().pixels) << "frame " << frame;
    }
    draw(*flown, stage.camera(0, 160, 100), target_of(160, 100));  // a key is under way as it ends
}

TEST(LodSpriteFrames, SayThatThereIsNoSecondContext) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Stage stage;
    auto none = []() -> Result<std::unique_ptr<gl::SecondContext>> { return impossible("none here"); };
    auto made = FrameDrawer::make(stage.thing(), thread_options(), none);
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().exit, Exit::impossible);
    EXPECT_EQ(made.error().message, "none here");
    EXPECT_TRUE(FrameDrawer::make(stage.thing(), fine_options(), none));
}

TEST(LodSpriteFrames, DrawTheSamePictureAgain) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Stage stage;
    auto frames = stage.frames();
    gl::Target target = target_of(), other = target_of();
    for (uint32_t frame = 0; frame < 30; ++frame) {
        FrameCounts counts = draw(*frames, stage.camera(frame), target);
        Result<FrameCounts> again = frames->draw(other);
        ASSERT_TRUE(again);
        EXPECT_EQ(target.read().pixels, other.read().pixels) << frame;
        EXPECT_EQ(counts.triangle_count, again->triangle_count);
        EXPECT_EQ(counts.rekeyed, again->rekeyed);
    }
}

// Draws these frames of another size twice: by one that has flown before in the first size, and by a fresh one.
template <class Frames>
void expect_fresh_after_resize(const Stage& stage, Frames& flown, Frames& fresh) {
    gl::Target small = target_of(), large = target_of(160, 100);
    uint32_t keys_before = 0;
    for (uint32_t frame = 0; frame < 50; ++frame) keys_before = draw(flown, stage.camera(frame), small).live_key_count;
    ASSERT_GT(keys_before, 0u);
    uint32_t keys_after = 0;
    for (uint32_t frame = 50; frame < 100; ++frame) {
        FrameCounts counts = draw(flown, stage.camera(frame, 160, 100), large);
        std::vector<uint8_t> resized = large.read().pixels;
        FrameCounts expected = draw(fresh, stage.camera(frame, 160, 100), large);
        EXPECT_EQ(resized, large.read().pixels) << "frame " << frame;
        EXPECT_EQ(counts.key_triangle_count, expected.key_triangle_count);
        EXPECT_EQ(counts.rekeyed, expected.rekeyed);
        keys_after = counts.live_key_count;
    }
    EXPECT_GT(keys_after, 0u);
}

TEST(LodSpriteFrames, OfAnotherSizeAreThoseOfAFreshStart) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Stage stage;
    for (KeyMode mode : {KeyMode::sliced, KeyMode::thread, KeyMode::at_once}) {
        FrameOptions options = fine_options();
        options.decide.mode = mode;
        expect_fresh_after_resize(stage, *stage.frames(options), *stage.frames(options));
    }
}

TEST(LodSpritePaperFrames, OfAnotherSizeAreThoseOfAFreshStart) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Stage stage;
    lod_sprite::paper::FrameDrawer flown(stage.terrain, stage.refiner, *stage.ground, {});
    lod_sprite::paper::FrameDrawer fresh(stage.terrain, stage.refiner, *stage.ground, {});
    expect_fresh_after_resize(stage, flown, fresh);
}

TEST(LodSpriteFrames, TellSourcesByColour) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Stage stage;
    FrameOptions options = fine_options();
    lod_sprite::set(options, "fade-frames", 0);
    stage.look.haze = 0;
    auto frames = stage.frames(options);
    gl::Target target = target_of();
    frames->show_sources(true);
    draw(*frames, stage.camera(0), target);
    EXPECT_GT(share_of(target.read(), is_red), 0.2);
    double sky_share = share_of(target.read(), is_grey);

    FrameCounts counts;
    for (uint32_t frame = 0; frame < 40; ++frame) counts = draw(*frames, stage.camera(0), target);
    ASSERT_GT(counts.used_key_count, 0u);
    EXPECT_GT(share_of(target.read(), is_grey), sky_share + 0.2);
    EXPECT_LT(share_of(target.read(), is_red), 0.02);

    frames->show_sources(false);
    EXPECT_EQ(draw(*frames, stage.camera(0), target).live_key_count, counts.live_key_count);
    EXPECT_LT(share_of(target.read(), is_grey), sky_share + 0.1);
}

TEST(LodSpriteFrames, WithOtherSettingsAreThoseOfAFreshStart) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Stage stage;
    FrameOptions coarse;
    lod_sprite::set(coarse, "low-error-px", 32);
    lod_sprite::set(coarse, "error-px", 2);
    lod_sprite::set(coarse, "key-error-px", 2);
    auto flown = stage.frames(), fresh = stage.frames(coarse);
    gl::Target target = target_of();
    for (uint32_t frame = 0; frame < 40; ++frame) draw(*flown, stage.camera(frame), target);
    flown->change(coarse);
    for (uint32_t frame = 40; frame < 70; ++frame) {
        draw(*flown, stage.camera(frame), target);
        std::vector<uint8_t> changed = target.read().pixels;
        draw(*fresh, stage.camera(frame), target);
        EXPECT_EQ(changed, target.read().pixels) << "frame " << frame;
    }
}

TEST(LodSpriteFrames, RefuseKeysThatTheRendererCannotHold) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Stage stage;
    FrameOptions options;
    lod_sprite::set(options, "key-scale", 4);
    lod_sprite::set(options, "guard", 3);
    auto frames = stage.frames(options);
    gl::Target target = target_of(8192, 16);
    frames->decide(stage.camera(0, 8192, 16));
    Result<FrameCounts> drawn = frames->draw(target);
    ASSERT_FALSE(drawn);
    EXPECT_EQ(drawn.error().exit, Exit::impossible);
}

TEST(LodSpriteSettings, AreTheStructsOwnDefaultsByName) {
    FrameOptions options, untouched;
    for (const SettingKind& kind : lod_sprite::setting_kinds()) {
        EXPECT_LE(kind.least, kind.otherwise) << kind.name;
        EXPECT_GE(kind.most, kind.otherwise) << kind.name;
        lod_sprite::set(options, kind.name, kind.otherwise);
    }
    EXPECT_EQ(options.decide.low_error_px, untouched.decide.low_error_px);
    EXPECT_EQ(options.decide.slots, untouched.decide.slots);
    EXPECT_EQ(options.decide.mode, untouched.decide.mode);
    EXPECT_EQ(options.draw.tolerance_px, untouched.draw.tolerance_px);
    lod_sprite::set(options, "slots", 7);
    lod_sprite::set(options, "keyframe", 0);
    lod_sprite::set(options, "slab-test", 0);
    EXPECT_EQ(options.decide.slots, 7u);
    EXPECT_EQ(options.decide.mode, lod_sprite::KeyMode::at_once);
    EXPECT_FALSE(options.draw.tests_slab);
    lod_sprite::set(options, "keyframe", 1);
    EXPECT_EQ(options.decide.mode, KeyMode::thread);
}

}  // namespace
}  // namespace overlook
