// Meshes measured: what every variant draws beside the whole mesh.
#include <gtest/gtest.h>

#include "tests/gl/fixture.h"
#include "tests/gl/measure_torus.h"

namespace overlook::measure {
namespace {

// Round a torus of 16,384 triangles, a part of a degree a frame.
struct Torus {
    World world = torus_world();
    Course course;

    explicit Torus(const std::vector<std::string>& methods) {
        course.specs = *specs_from(methods, {});
        EXPECT_TRUE(check_draws(course.specs, world));
        add_floors(course.specs);
        for (uint32_t frame = 0; frame < 6; ++frame) {
            view::Camera camera;
            camera.heading_deg = 20 + 0.4 * frame, camera.pitch_deg = -25, camera.near_m = 0.01;
            camera.width_px = 128, camera.height_px = 96;
            camera.position_m = -view::axes_of(camera).forward * (26.0 - 0.05 * frame);
            course.cameras.push_back(camera);
        }
    }
    CourseResult run(const gl::Renderer& renderer) {
        Result<CourseResult> result = run_course(world, course, renderer, "", [](double) {});
        EXPECT_TRUE(result) << result.error().message;
        return result ? std::move(*result) : CourseResult{};
    }
};

uint64_t operations(const RunResult& run) {
    uint64_t sum = 0;
    for (const FrameRecord& frame : run.frames) sum += frame.frame > 0 ? frame.counters.operation_count : 0;
    return sum;
}

TEST(MeasuredMesh, KeepsItsPromisesInEveryVariant) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Torus torus({"caveclod@samples=1", "caveclod:paper@samples=1", "caveclod:shared@samples=1", "discrete@samples=1"});
    CourseResult result = torus.run(context->renderer());
    const RunResult& full = result.runs.back();
    ASSERT_TRUE(is_floor(full.spec));
    for (const RunResult& run : result.runs) {
        SCOPED_TRACE(run.label);
        for (const FrameRecord& frame : run.frames) {
            EXPECT_EQ(*frame.numbers.hole_count, 0) << frame.frame;
            EXPECT_GT(frame.counters.triangle_count, 0u);
            EXPECT_LE(frame.counters.predicted_error_px, 1) << frame.frame;
            EXPECT_EQ(frame.counters.wrong_corner_count, 0u);
            if (!is_floor(run.spec)) {
                EXPECT_LT(2 * frame.counters.triangle_count, full.frames[0].counters.triangle_count);
            }
        }
        EXPECT_EQ(run.g.all().count > 0, !is_floor(run.spec));
        if (run.spec.variant != "paper") {  // which draws what nobody measured
            EXPECT_LE(run.g.all().ratio_max, 1);
        }
    }
}

// Keys show the mesh as finely as its own triangles do, on a cut that by itself would be seen to be far coarser.
TEST(MeasuredMesh, IsShownBySpritesAsWell) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Torus torus({"lod-sprite@keyframe=at-once@samples=1", "caveclod@samples=1", "caveclod@error-px=16@samples=1"});
    CourseResult result = torus.run(context->renderer());
    const RunResult& sprite = result.runs[0];
    ASSERT_EQ(sprite.frames.size(), 6u);
    auto error_of = [&](size_t run) { return *result.runs[run].frames[0].numbers.e_mean; };
    EXPECT_LT(error_of(0), 1.5 * error_of(1));
    EXPECT_GT(error_of(2), 2 * error_of(1));
    for (const FrameRecord& frame : sprite.frames) {
        SCOPED_TRACE(frame.frame);
        EXPECT_EQ(*frame.numbers.hole_count, 0);
        EXPECT_GT(frame.counters.resident_bytes, result.runs[1].frames[0].counters.resident_bytes);  // keys
    }
    EXPECT_GT(sprite.frames[0].counters.key_triangle_count, 0u);
    EXPECT_EQ(sprite.frames[5].counters.key_triangle_count, 0u);
    EXPECT_LT(2 * sprite.frames[5].counters.triangle_count, sprite.frames[0].counters.triangle_count);
}

// The paper's point: what cameras refine for themselves they need not refine again for each other.
TEST(MeasuredMesh, CamerasOfTheirOwnSplitFarLessThanOnesThatShare) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Torus torus({"caveclod@samples=1", "caveclod@cameras=4@samples=1", "caveclod:shared@cameras=4@samples=1"});
    for (view::Camera& camera : torus.course.cameras) camera.position_m *= 0.4;  // amid it: each of the four sees another part
    CourseResult result = torus.run(context->renderer());
    EXPECT_GT(operations(result.runs[2]), 10 * operations(result.runs[1]));
    for (size_t frame = 0; frame < torus.course.cameras.size(); ++frame) {  // what is drawn does not know of the others
        EXPECT_EQ(result.runs[0].frames[frame].counters.triangle_count, result.runs[1].frames[frame].counters.triangle_count);
        EXPECT_EQ(result.runs[0].frames[frame].numbers.psnr_db, result.runs[1].frames[frame].numbers.psnr_db);
    }
}

TEST(MeasuredMesh, BudgetOfTrianglesIsKept) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Torus torus({"caveclod@error-px=0.25@triangles=1500@samples=1"});
    CourseResult result = torus.run(context->renderer());
    for (const FrameRecord& frame : result.runs[0].frames) EXPECT_LE(frame.counters.triangle_count, 1500u);
}

TEST(MeasuredMesh, IsTheSameEveryTime) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Torus torus({"caveclod@samples=1"});
    CourseResult once = torus.run(context->renderer()), again = torus.run(context->renderer());
    for (size_t frame = 0; frame < torus.course.cameras.size(); ++frame) {
        EXPECT_EQ(once.runs[0].frames[frame].counters, again.runs[0].frames[frame].counters);
        EXPECT_EQ(once.runs[0].frames[frame].numbers.psnr_db, again.runs[0].frames[frame].numbers.psnr_db);
    }
}

TEST(MeasuredMesh, IsNotForMethodsOfTerrains) {
    World terrain, mesh;
    terrain.name = "valley.json", mesh.name = "duck.ovl";
    mesh.mesh.emplace();
    std::vector<MethodSpec> caveclod = {*parse_method("caveclod")}, sprite = {floor_spec(4), *parse_method("lod-sprite:paper")};
    EXPECT_TRUE(check_draws(caveclod, mesh));
    EXPECT_TRUE(check_draws(sprite, terrain));
    EXPECT_EQ(check_draws(caveclod, terrain).error().message,
              "--method caveclod: it draws meshes, and valley.json holds a terrain");
    EXPECT_EQ(check_draws(sprite, mesh).error().message,
              "--method lod-sprite:paper: it draws terrains, and duck.ovl holds a mesh");
}

}  // namespace
}  // namespace overlook::measure
