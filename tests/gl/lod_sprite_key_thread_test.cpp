// Keys that another thread draws.
#include "runtime/lod_sprite/draw_key_thread.h"

#include <gtest/gtest.h>

#include "runtime/lod_sprite/draw_on_terrain.h"
#include "tests/gl/lod_sprite_scene.h"

namespace overlook {
namespace {

using lod_sprite::KeyPicture;
using lod_sprite::KeyThread;
using test::SpriteScene;

constexpr uint32_t kScale = 2;
constexpr double kError_px = 0.25;

struct Texels {
    std::vector<uint8_t> rgba;
    std::vector<float> depth;
    bool operator==(const Texels&) const = default;
};

Texels texels_of(const KeyPicture& picture) {
    size_t count = size_t(picture.drawn_camera.width_px) * picture.drawn_camera.height_px;
    Texels texels{std::vector<uint8_t>(4 * count), std::vector<float>(count)};
    glGetTextureImage(picture.colour, 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(4 * count), texels.rgba.data());
    glGetTextureImage(picture.depth, 0, GL_DEPTH_COMPONENT, GL_FLOAT, GLsizei(4 * count), texels.depth.data());
    return texels;
}

struct Stage {
    SpriteScene scene{test::walled_terrain(129), 1};
    lod_sprite::DrawnTerrain thing{scene.refiner, scene.ground, scene.look};
    std::unique_ptr<KeyThread> thread = *KeyThread::start(thing, gl::second_context);

    view::Camera key(double right_m) const { return lod_sprite::key_camera(scene.pose(right_m), 1.15); }
    // Drawn here, slice by slice.
    Texels sliced(uint32_t slot, const view::Camera& camera) {
        KeyPicture picture = *scene.painter.reserve_key(slot, camera, kScale);
        EXPECT_TRUE(scene.painter.begin_key(slot, camera, kScale));
        terrain::SlicedCut cut(scene.refiner, camera, kError_px);
        terrain::Cut slice;
        while (!cut.is_done()) {
            cut.next(500, slice);
            scene.surface.take(slice);
            scene.painter.draw_into_key(slot, scene.surface);
        }
        scene.painter.finish_key(slot, scene.surface);
        return texels_of(picture);
    }
    KeyPicture begin(uint32_t slot, const view::Camera& camera) {
        KeyPicture picture = *scene.painter.reserve_key(slot, camera, kScale);
        thread->begin({picture, kError_px, 8});
        return picture;
    }
};

TEST(LodSpriteKeyThread, DrawsThePictureThatSlicesDraw) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Stage stage;
    for (double right_m : {0.0, 300.0, -450.0}) {
        Texels sliced = stage.sliced(0, stage.key(right_m));
        KeyPicture picture = stage.begin(1, stage.key(right_m));
        Result<KeyThread::Done> done = stage.thread->wait();
        ASSERT_TRUE(done) << done.error().message;
        EXPECT_TRUE(texels_of(picture) == sliced) << right_m;
        EXPECT_EQ(done->depths.depth_m, stage.scene.painter.read_depth(0, 8).depth_m);
        terrain::Cut whole;
        stage.scene.refiner.cut_by_pixels(picture.camera, kError_px, whole);
        EXPECT_EQ(done->count.triangle_count, whole.triangle_count());
    }
}

TEST(LodSpriteKeyThread, LeavesFramesDrawnMeanwhileAsTheyAre) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Stage stage;
    std::vector<uint8_t> alone = stage.scene.full(stage.scene.pose(0)).pixels;
    Texels key = stage.sliced(0, stage.key(200));
    for (int turn = 0; turn < 5; ++turn) {
        KeyPicture picture = stage.begin(1, stage.key(200));
        EXPECT_EQ(stage.scene.full(stage.scene.pose(0)).pixels, alone) << turn;
        ASSERT_TRUE(stage.thread->wait());
        EXPECT_TRUE(texels_of(picture) == key) << turn;
    }
}

TEST(LodSpriteKeyThread, DropsAKeyAndDrawsTheNext) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Stage stage;
    Texels expected = stage.sliced(0, stage.key(100));
    stage.thread->drop();  // nothing was begun
    stage.begin(1, stage.key(-300));
    stage.thread->drop();
    KeyPicture picture = stage.begin(1, stage.key(100));
    ASSERT_TRUE(stage.thread->wait());
    EXPECT_TRUE(texels_of(picture) == expected);
    stage.begin(2, stage.key(0));  // and is ended with one under way
}

TEST(SecondContext, IsRefusedWhereNoneIsCurrent) {
    Result<std::unique_ptr<gl::SecondContext>> made = gl::second_context();
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().exit, Exit::impossible);
    EXPECT_EQ(made.error().message, "this renderer has no second context: EGL's is not the current one");
}

}  // namespace
}  // namespace overlook
