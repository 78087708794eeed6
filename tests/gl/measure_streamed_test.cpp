// What streams, measured beside the same thing whole.
#include <gtest/gtest.h>

#include "formats/container.h"
#include "formats/terrain_tiles.h"
#include "tests/formats/scratch_folder.h"
#include "tests/gl/fixture.h"
#include "tests/gl/measure_torus.h"
#include "tests/tools/synthetic_dem.h"
#include "tools/bake/terrain.h"

namespace overlook::measure {
namespace {

constexpr uint32_t kFrames = 12;

struct Flown {
    Course course;
    CourseResult result;

    // As read from `path`.
    Flown(const std::string& path, const std::vector<std::string>& methods, const view::Camera& from, double ahead_m,
          const gl::Renderer& renderer) {
        Result<World> world = read_world(path);
        EXPECT_TRUE(world) << world.error().message;
        course.specs = *specs_from(methods, {});
        EXPECT_TRUE(check_draws(course.specs, *world));
        EXPECT_TRUE(upload(*world));
        add_floors(course.specs);
        for (uint32_t frame = 0; frame < kFrames; ++frame) {
            view::Camera camera = from;
            camera.position_m += ahead_m * frame * view::axes_of(from).forward;
            course.cameras.push_back(camera);
        }
        Result<CourseResult> ran = run_course(*world, course, renderer, "", [](double) {});
        EXPECT_TRUE(ran) << ran.error().message;
        if (ran) result = std::move(*ran);
    }
    const std::vector<FrameRecord>& frames(size_t run) const { return result.runs[run].frames; }
};

std::string torus_file(const ScratchFolder& folder) {
    std::string path = folder / "torus.ovl";
    Result<container::Writer> writer = container::Writer::create(path, caveclod::kKind);
    EXPECT_TRUE(writer && caveclod::write(*writer, torus_hierarchy()) && writer->commit());
    return path;
}

view::Camera before_torus() {
    view::Camera camera;
    camera.heading_deg = 20, camera.pitch_deg = -25, camera.near_m = 0.01;
    camera.width_px = 160, camera.height_px = 120;
    camera.position_m = -view::axes_of(camera).forward * 20.0;
    return camera;
}

// The same once its blocks are there; and before that, what it says of itself holds.
void expect_catches_up(const Flown& flown) {
    const FrameRecord &whole = flown.frames(0).back(), &parts = flown.frames(1).back(), &first = flown.frames(1).front();
    EXPECT_GT(first.counters.predicted_error_px, 1);
    EXPECT_LT(first.counters.streamed_bytes, parts.counters.streamed_bytes);
    EXPECT_EQ(parts.counters.triangle_count, whole.counters.triangle_count);
    EXPECT_EQ(parts.counters.predicted_error_px, whole.counters.predicted_error_px);
    EXPECT_EQ(parts.numbers.psnr_db, whole.numbers.psnr_db);
    EXPECT_GT(flown.result.runs[1].g.all().count, 0u);
    EXPECT_LE(flown.result.runs[1].g.all().ratio_max, 1);
}

TEST(MeasuredStreams, MeshIsTheWholeOneOnceItsBlocksAreThere) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    ScratchFolder folder;
    Flown flown(torus_file(folder), {"caveclod@samples=1@glide-s=0", "caveclod:streamed@samples=1@glide-s=0"}, before_torus(), 0,
                context->renderer());
    expect_catches_up(flown);
}

TEST(MeasuredStreams, MeshWithTooLittleRoomKeepsItsBudgetAndSaysWhatIsMissing) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    ScratchFolder folder;
    Flown flown(torus_file(folder), {"caveclod@error-px=0.2@samples=1", "caveclod:streamed@error-px=0.2@memory-mib=1@samples=1"},
                before_torus(), 0.05, context->renderer());
    for (const FrameRecord& frame : flown.frames(1)) {
        EXPECT_LE(frame.counters.streamed_bytes, 1u << 20);
        EXPECT_GT(frame.counters.predicted_error_px, 0.2);
        if (frame.frame > 2) {  // the coarsest cut, which is there first, is a few triangles
            EXPECT_EQ(*frame.numbers.hole_count, 0) << frame.frame;
        }
    }
    EXPECT_LE(flown.result.runs[1].g.all().ratio_max, 1);
    auto error_of = [&](size_t run) { return *flown.frames(run)[10].numbers.e_mean; };
    EXPECT_GT(error_of(1), error_of(0));
}

TEST(MeasuredStreams, TerrainIsTheWholeOneOnceItsTilesAreThere) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    ScratchFolder folder;
    auto terrain = terrain::bake(test::make_hills(390, 300, 3, 0.01), {}, [](double) {});
    ASSERT_TRUE(terrain);
    Result<container::Writer> writer = container::Writer::create(folder / "hills.ovl", terrain::kKind);
    ASSERT_TRUE(writer && terrain::write(*writer, *terrain) && terrain::write_tiles(*writer, *terrain) && writer->commit());
    view::Camera camera = test::from_south(*terrain, 160, 100);
    camera.position_m.z = terrain::Refiner(*terrain).highest_m() + 100;
    Flown flown(folder / "hills.ovl", {"terrain@samples=1", "terrain:streamed@samples=1"}, camera, 0, context->renderer());
    expect_catches_up(flown);
}

TEST(MeasuredStreams, TerrainWithoutTilesIsRefused) {
    ScratchFolder folder;
    auto terrain = terrain::bake(test::make_hills(33, 33, 3, 0.01), {}, [](double) {});
    ASSERT_TRUE(terrain);
    Result<container::Writer> writer = container::Writer::create(folder / "hills.ovl", terrain::kKind);
    ASSERT_TRUE(writer && terrain::write(*writer, *terrain) && writer->commit());
    Result<World> world = read_world(folder / "hills.ovl");
    ASSERT_TRUE(world);
    std::vector<MethodSpec> specs = {*parse_method("terrain:streamed")};
    Result<void> checked = check_draws(specs, *world);
    ASSERT_FALSE(checked);
    EXPECT_EQ(checked.error().message, folder / "hills.ovl" + ": holds no tiles to stream; bake it again with --streamed");
}

}  // namespace
}  // namespace overlook::measure
