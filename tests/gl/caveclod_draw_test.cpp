// Refined meshes as pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runtime/caveclod/draw.h"
#include "runtime/gl/png.h"
#include "tests/caveclod/flights.h"
#include "tests/caveclod/synthetic_hierarchy.h"
#include "tests/formats/scratch_folder.h"
#include "tests/gl/fixture.h"

namespace overlook {
namespace {

using caveclod::CameraBuffers;
using caveclod::Drawing;
using caveclod::Hierarchy;
using caveclod::Mesh;
using caveclod::Refinement;
using caveclod::Settings;
namespace synthetic = caveclod::synthetic;

using caveclod::flights::kFrame_s;

view::Camera camera_at(double x, double y, double z, double heading_deg, double pitch_deg) {
    return caveclod::flights::camera_at(x, y, z, heading_deg, pitch_deg, 320, 240);
}

ImageRgb8 picture(const Drawing& drawing, const CameraBuffers& buffers, const view::Camera& camera) {
    auto target = gl::Target::make(camera.width_px, camera.height_px, 1);
    if (!target) return {};
    drawing.draw(*target, buffers, camera, {});
    return target->read();
}

// A picture for the eye, in the folder of tests' temporary files.
void keep(const std::string& name, const ImageRgb8& image) {
    EXPECT_TRUE(write_png(testing::TempDir() + name, image));
}

size_t differing(const ImageRgb8& a, const ImageRgb8& b) {
    size_t count = 0;
    for (size_t i = 0; i < a.pixels.size(); i += 3) count += !std::equal(&a.pixels[i], &a.pixels[i] + 3, &b.pixels[i]);
    return count;
}

TEST(MeshDrawing, CoversTheDiscOfASphere) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hierarchy hierarchy = synthetic::bake(synthetic::sphere(32));
    auto mesh = Mesh::make(hierarchy);
    ASSERT_TRUE(mesh);
    auto drawing = Drawing::make(*mesh);
    ASSERT_TRUE(drawing) << drawing.error().message;
    view::Camera camera = camera_at(0, -40, 0, 0, 0);
    Refinement refinement(*mesh);
    Settings settings;
    settings.glide_s = 0;
    refinement.refine(camera, settings, kFrame_s);
    CameraBuffers buffers(*mesh);
    buffers.take(refinement);
    EXPECT_EQ(buffers.triangle_count(), refinement.faces().face_count());
    ImageRgb8 image = picture(*drawing, buffers, camera);
    keep("caveclod_sphere.png", image);
    ImageRgb8 empty = picture(*drawing, CameraBuffers(*mesh), camera);
    double radius_px = view::focal_px(camera) * 10 / std::sqrt(40.0 * 40 - 10 * 10);
    for (uint32_t y = 0; y < 240; ++y) {
        for (uint32_t x = 0; x < 320; ++x) {
            double away_px = std::hypot(x + 0.5 - 160, y + 0.5 - 120);
            bool is_drawn = !(test::pixel(image, x, y) == test::pixel(empty, x, y));
            if (away_px < radius_px - 3) {
                ASSERT_TRUE(is_drawn) << x << " " << y;
            }
            if (away_px > radius_px + 1.5) {
                ASSERT_FALSE(is_drawn) << x << " " << y;
            }
        }
    }
}

// Through turns, splits, collapses and glides, what was uploaded piece by piece is what is there.
TEST(MeshDrawing, IsThatOfAWholeUploadAfterAnyNumberOfPieces) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hierarchy hierarchy = synthetic::bake(synthetic::hills(48, 48, 3));
    auto mesh = Mesh::make(hierarchy);
    ASSERT_TRUE(mesh);
    auto drawing = Drawing::make(*mesh);
    ASSERT_TRUE(drawing) << drawing.error().message;
    Refinement refinement(*mesh);
    CameraBuffers buffers(*mesh);
    Settings settings;
    settings.error_px = 1.5;
    uint64_t uploaded = 0, whole = 0;
    uint32_t gliding = 0;
    for (int frame = 0; frame < 40; ++frame) {
        view::Camera camera = camera_at(24 + frame, -20 + 0.8 * frame, 14, -1.5 * frame, -30);
        gliding += refinement.refine(camera, settings, kFrame_s).gliding_count;
        buffers.take(refinement);
        if (frame > 0) uploaded += buffers.uploaded_bytes(), whole += 12 * buffers.triangle_count();
        if (frame % 8 != 7) continue;
        CameraBuffers anew(*mesh);
        anew.take(refinement);
        ImageRgb8 image = picture(*drawing, buffers, camera);
        EXPECT_EQ(differing(image, picture(*drawing, anew, camera)), 0u);
        keep(fmt::format("caveclod_hills_{}.png", frame), image);
    }
    EXPECT_GT(gliding, 20u);
    EXPECT_LT(uploaded * 2, whole);
}

// A gliding picture goes from the one before to the one after.
TEST(MeshDrawing, GlidesFromTheCoarserPictureToTheFiner) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hierarchy hierarchy = synthetic::bake(synthetic::sphere(24));
    auto mesh = Mesh::make(hierarchy);
    ASSERT_TRUE(mesh);
    auto drawing = Drawing::make(*mesh);
    ASSERT_TRUE(drawing);
    Settings settings;
    settings.error_px = 2, settings.glide_s = 0.25;
    Refinement refinement(*mesh);
    view::Camera far = camera_at(0, -60, 0, 0, 0), near = camera_at(0, -52, 0, 0, 0);
    for (int frame = 0; frame < 30; ++frame) refinement.refine(far, settings, kFrame_s);
    CameraBuffers buffers(*mesh);
    buffers.take(refinement);
    ImageRgb8 before = picture(*drawing, buffers, near);
    uint32_t gliding = refinement.refine(near, settings, kFrame_s).gliding_count;
    ASSERT_GT(gliding, 0u);
    buffers.take(refinement);
    ImageRgb8 first = picture(*drawing, buffers, near);
    for (int frame = 0; frame < 30; ++frame) refinement.refine(near, settings, kFrame_s);
    buffers.take(refinement);
    ImageRgb8 after = picture(*drawing, buffers, near);
    EXPECT_LT(differing(first, before), differing(after, before));
    EXPECT_GT(differing(after, before), 0u);
}

TEST(MeshDrawing, ShowsItsPictures) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hierarchy hierarchy = synthetic::bake(synthetic::hills(16, 16, 1, 0));
    ScratchFolder folder;
    ASSERT_TRUE(write_png(folder / "red.png", ImageRgb8{1, 1, {255, 0, 0}}));
    std::string bytes = text_of_file(folder / "red.png");
    auto of = std::as_bytes(std::span(bytes));
    hierarchy.surfaces[0].colour = {255, 255, 255, 255};
    hierarchy.surfaces[0].texture = "red.png";
    hierarchy.surfaces[0].texture_bytes.assign(of.begin(), of.end());
    for (bool is_sound : {true, false}) {
        if (!is_sound) hierarchy.surfaces[0].texture_bytes.resize(20);
        auto mesh = Mesh::make(hierarchy);
        ASSERT_TRUE(mesh);
        auto drawing = Drawing::make(*mesh);
        ASSERT_TRUE(drawing);
        EXPECT_EQ(drawing->faults().size(), is_sound ? 0u : 1u);
        Refinement refinement(*mesh);
        CameraBuffers buffers(*mesh);
        buffers.take(refinement);
        test::Rgb middle = test::pixel(picture(*drawing, buffers, camera_at(8, 8, 12, 0, -90)), 160, 120);
        EXPECT_GT(middle.red, 150);
        EXPECT_EQ(middle.green < 40, is_sound);
    }
}

}  // namespace
}  // namespace overlook
