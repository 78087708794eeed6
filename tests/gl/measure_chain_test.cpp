// Chains of levels measured: what every variant draws beside the finest level of everything.
#include <gtest/gtest.h>

#include <algorithm>

#include "formats/atomic_file.h"
#include "tests/formats/scratch_folder.h"
#include "tests/gl/fixture.h"
#include "tests/gl/measure_chain.h"

namespace overlook::measure {
namespace {

const std::vector<std::string> kEvery = {"discrete@samples=1",       "discrete:fsi-paper@samples=1", "discrete:switch@samples=1",
                                         "discrete:blend@samples=1", "discrete:dither@samples=1",    "discrete:late@samples=1"};

CourseResult fly(World& world, const gl::Renderer& renderer, const std::vector<std::string>& methods, uint32_t frames) {
    Course course;
    course.specs = *specs_from(methods, {});
    EXPECT_TRUE(check_draws(course.specs, world));
    add_floors(course.specs);
    course.cameras = dolly(frames, 160, 120);
    Result<CourseResult> result = run_course(world, course, renderer, "", [](double) {});
    EXPECT_TRUE(result) << result.error().message;
    return result ? std::move(*result) : CourseResult{};
}

uint64_t sum(const RunResult& run, uint64_t Counters::*counter) {
    uint64_t all = 0;
    for (const FrameRecord& frame : run.frames) all += frame.counters.*counter;
    return all;
}

// Each level of each instance against its own bound; a chain that states a quarter of its errors is found out.
TEST(MeasuredChain, IsHonest) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    for (bool is_honest_chain : {true, false}) {
        discrete::Chain chain = discrete::made::sphere_chain();
        for (discrete::Level& level : chain.levels) level.error_m *= is_honest_chain ? 1.0f : 0.25f;
        World world = world_of_chain("spheres", std::move(chain), field_of(6, 3));
        CourseResult result = fly(world, context->renderer(), {"discrete:switch@samples=1", "discrete@samples=1"}, 4);
        for (size_t run : {0, 1}) {
            Honesty g = result.runs[run].g.all();
            EXPECT_GT(g.count, 100u);
            EXPECT_EQ(is_honest(g), is_honest_chain) << g.ratio_max << " " << g.ratio_median;
            EXPECT_EQ(g.ratio_max <= 1, is_honest_chain) << g.ratio_max;
        }
    }
}

TEST(MeasuredChain, IsDrawnByEveryVariant) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    World world = world_of_chain("spheres", discrete::made::sphere_chain(), field_of(6, 3));
    CourseResult result = fly(world, context->renderer(), kEvery, 24);
    const RunResult& full = result.runs.back();
    ASSERT_TRUE(is_floor(full.spec));
    for (const RunResult& run : result.runs) {
        SCOPED_TRACE(run.label);
        for (const FrameRecord& frame : run.frames) {
            EXPECT_GT(frame.counters.triangle_count, 0u);
            if (run.spec.variant != "fsi-paper") {  // which leaves holes where it looks up the wrong place
                EXPECT_EQ(*frame.numbers.hole_count, 0) << frame.frame;
            }
            if (is_floor(run.spec)) continue;
            EXPECT_LE(frame.counters.predicted_error_px, 1.2) << frame.frame;
            EXPECT_LT(frame.counters.triangle_count, full.frames[frame.frame].counters.triangle_count);
        }
    }
    const RunResult &fsi = result.runs[0], &at_once = result.runs[2], &blend = result.runs[3], &late = result.runs[5];
    EXPECT_GT(sum(fsi, &Counters::event_count), 0u);
    EXPECT_GT(sum(fsi, &Counters::transition_count), sum(fsi, &Counters::event_count));
    EXPECT_EQ(sum(at_once, &Counters::transition_count), 0u);
    EXPECT_GT(sum(late, &Counters::triangle_count), sum(at_once, &Counters::triangle_count));
    EXPECT_GT(sum(blend, &Counters::triangle_count), sum(fsi, &Counters::triangle_count));
    EXPECT_GT(fsi.frames[0].counters.resident_bytes, at_once.frames[0].counters.resident_bytes + 2 * 16 * 160 * 120 - 1);
}

// The paper's promise, and what its remedies add.
TEST(MeasuredChain, PopsLessByTurnsThanAtOnce) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    World world = world_of_chain("spheres", discrete::made::simple_chain(), field_of(4, 3));
    CourseResult result =
        fly(world, context->renderer(), {"discrete@error-px=5@samples=4", "discrete:switch@error-px=5@samples=4"}, 24);
    EXPECT_GT(sum(result.runs[1], &Counters::event_count), 0u);
    EXPECT_LT(result.runs[0].pop.index, result.runs[1].pop.index);
}

TEST(MeasuredChain, IsTheSameEveryTime) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    World world = world_of_chain("spheres", discrete::made::sphere_chain(), field_of(4, 3));
    CourseResult once = fly(world, context->renderer(), {"discrete@samples=1"}, 8);
    CourseResult again = fly(world, context->renderer(), {"discrete@samples=1"}, 8);
    for (size_t frame = 0; frame < 8; ++frame) {
        EXPECT_EQ(once.runs[0].frames[frame].counters, again.runs[0].frames[frame].counters);
        EXPECT_EQ(once.runs[0].frames[frame].numbers.psnr_db, again.runs[0].frames[frame].numbers.psnr_db);
    }
}

// What moves by itself is in the reference where it is in the picture.
TEST(MeasuredChain, MovesItsReferenceToo) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    World world = world_of_chain("mills", discrete::made::windmill_chain(), field_of(3, 4));
    CourseResult result = fly(world, context->renderer(), {"discrete:switch@error-px=0.01@samples=1"}, 5);
    for (const FrameRecord& frame : result.runs[0].frames) {
        EXPECT_EQ(*frame.numbers.psnr_db, *result.runs.back().frames[frame.frame].numbers.psnr_db);
        EXPECT_GT(*frame.numbers.psnr_db, 22) << frame.frame;
    }
}

void write_chain(const std::string& path, discrete::Chain chain) {
    chain.radius_m *= 1.001;  // over its corners as they are stored
    container::Writer writer = *container::Writer::create(path, discrete::kKind);
    Result<void> written = discrete::write(writer, chain);
    ASSERT_TRUE(written) << written.error().message;
    ASSERT_TRUE(writer.commit());
}

// Two layers, each moved as a whole: they stand in one picture where one layer's instances would.
TEST(MeasuredChain, StandsBesideOthersInOneScene) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    ScratchFolder folder;
    write_chain(folder / "cube.ovl", discrete::made::simple_chain());
    auto world_of = [&](const std::string& layers) {
        std::string text = R"({"version": 1, "layers": [)" + layers + R"(], "camera": {"near_m": 0.01}})";
        EXPECT_TRUE(write_file(folder / "a.scene.json", std::string_view(text)));
        Result<World> world = read_world(folder / "a.scene.json");
        EXPECT_TRUE(world) << world.error().message;
        if (!world) return World();
        EXPECT_TRUE(upload(*world));
        return std::move(*world);
    };
    World apart = world_of(R"({"asset": "cube.ovl", "method": "discrete", "instances": [{"translation_m": [0, 0, 0]}]},
        {"asset": "cube.ovl", "method": "discrete", "instances": [{"translation_m": [1, 0, 0]}],
         "transform": {"translation_m": [1, 2, 0], "rotation_z_deg": 90, "scale": 2}})");
    World together = world_of(R"({"asset": "cube.ovl", "method": "discrete", "instances": [{},
        {"translation_m": [1, 4, 0], "rotation_z_deg": 90, "scale": 2}]})");
    ASSERT_EQ(apart.chains.size(), 2u);
    CourseResult two = fly(apart, context->renderer(), kEvery, 3), one = fly(together, context->renderer(), kEvery, 3);
    for (size_t run = 0; run < one.runs.size(); ++run) {
        SCOPED_TRACE(one.runs[run].label);
        for (size_t frame = 0; frame < 3; ++frame) {
            const FrameRecord &a = two.runs[run].frames[frame], &b = one.runs[run].frames[frame];
            EXPECT_GT(a.counters.triangle_count, 0u);
            EXPECT_EQ(a.counters.triangle_count, b.counters.triangle_count);
            EXPECT_EQ(a.numbers.psnr_db, b.numbers.psnr_db);
        }
    }
    EXPECT_LT(*two.runs.back().frames[0].numbers.psnr_db, 99);  // something of it was seen
}

TEST(MeasuredChain, NamesTheLayerThatIsNone) {
    ScratchFolder folder;
    write_chain(folder / "cube.ovl", discrete::made::simple_chain());
    container::Writer writer = *container::Writer::create(folder / "valley.ovl", terrain::kKind);
    ASSERT_TRUE(writer.commit());
    EXPECT_TRUE(write_file(folder / "a.scene.json", std::string_view(R"({"version": 1, "layers": [
        {"asset": "cube.ovl", "method": "discrete"}, {"asset": "valley.ovl", "method": "terrain"}]})")));
    Result<World> world = read_world(folder / "a.scene.json");
    ASSERT_FALSE(world);
    EXPECT_EQ(world.error().exit, Exit::impossible);
    EXPECT_EQ(world.error().message, (folder / "a.scene.json") + ": /layers/1: " + (folder / "valley.ovl") +
                                         " is no chain of levels, and there are 2 layers; measure draws scenes of one terrain, "
                                         "one mesh or chains of levels");
}

TEST(MeasuredChain, IsNotForOtherMethods) {
    World chain, mesh, terrain;
    chain.name = "trees.json", mesh.name = "duck.ovl", terrain.name = "valley.json";
    chain.chains.emplace_back(), mesh.mesh.emplace();
    auto refusal = [](const char* method, const World& world) {
        std::vector<MethodSpec> specs = {*parse_method(method)};
        Result<void> checked = check_draws(specs, world);
        return checked ? std::string("(drawn)") : checked.error().message;
    };
    EXPECT_EQ(refusal("discrete", chain), "(drawn)");
    EXPECT_EQ(refusal("discrete:fsi", chain), "(drawn)");
    EXPECT_EQ(refusal("discrete@search=0", chain), "(drawn)");
    EXPECT_EQ(refusal("full", chain), "(drawn)");
    EXPECT_EQ(refusal("discrete@error-px=3", mesh), "(drawn)");
    EXPECT_EQ(refusal("terrain", chain), "--method terrain: it draws terrains, and trees.json holds a chain of levels");
    EXPECT_EQ(refusal("caveclod", chain), "--method caveclod: it draws meshes, and trees.json holds a chain of levels");
    EXPECT_EQ(refusal("discrete:switch", mesh), "--method discrete:switch: it draws chains of levels, and duck.ovl holds a mesh");
    EXPECT_EQ(refusal("discrete@search=0", mesh), "--method discrete: search is of chains of levels, and duck.ovl holds a mesh");
    EXPECT_EQ(refusal("discrete", terrain), "--method discrete: it draws meshes, and valley.json holds a terrain");
}

}  // namespace
}  // namespace overlook::measure
