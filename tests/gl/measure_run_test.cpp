// A whole run, tiny: the same pictures, counters and numbers every time.
#include "tools/measure/run.h"

#include <gtest/gtest.h>

#include <cmath>

#include "formats/container.h"
#include "tests/formats/scratch_folder.h"
#include "tests/gl/fixture.h"
#include "tools/measure/capture.h"
#include "tools/measure/figures.h"
#include "tools/measure/judge.h"
#include "tools/measure/methods.h"
#include "tools/measure/numbers/silhouette.h"
#include "tools/measure/options.h"

namespace overlook::measure {
namespace {

constexpr uint32_t kFrames = 4;

// The fixture's hills, flown over northwards.
struct Hills {
    World world;
    Course course;

    explicit Hills(const std::vector<std::string>& methods, const std::vector<std::string>& sweeps) {
        world.name = "hills";
        world.content_hash = "the same hills";
        world.terrain = std::make_unique<terrain::Terrain>(test::hilly_terrain(65));
        world.refiner.emplace(*world.terrain);
        EXPECT_TRUE(upload(world));
        course.specs = *specs_from(methods, sweeps);
        add_floors(course.specs);
        for (uint32_t frame = 0; frame < kFrames; ++frame) {
            course.cameras.push_back(test::from_south(*world.terrain, 64, 64));
            course.cameras.back().position_m.y += 3.0 * frame;
        }
    }
    CourseResult run(const gl::Renderer& renderer, const std::string& cache = "") {
        Result<CourseResult> result = run_course(world, course, renderer, cache, [](double) {});
        EXPECT_TRUE(result) << result.error().message;
        return result ? std::move(*result) : CourseResult{};
    }
};

void expect_same(const CourseResult& a, const CourseResult& b) {
    ASSERT_EQ(a.runs.size(), b.runs.size());
    for (size_t run = 0; run < a.runs.size(); ++run) {
        SCOPED_TRACE(a.runs[run].label);
        ASSERT_EQ(a.runs[run].frames.size(), b.runs[run].frames.size());
        for (const Figure& one : figures()) {
            if (!one.repeats) continue;
            EXPECT_EQ(values_of(a.runs[run], one), values_of(b.runs[run], one)) << one.name;
        }
        EXPECT_EQ(a.runs[run].pop.index, b.runs[run].pop.index);
        EXPECT_EQ(a.runs[run].worst_e.test.pixels, b.runs[run].worst_e.test.pixels);
        EXPECT_EQ(a.runs[run].worst_w.test.pixels, b.runs[run].worst_w.test.pixels);
        EXPECT_EQ(a.runs[run].worst_w.reference.pixels, b.runs[run].worst_w.reference.pixels);
    }
}

TEST(MeasuredCourse, IsTheSameEveryTime) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hills hills({"terrain"}, {"error-px=1,8"});
    CourseResult once = hills.run(context->renderer()), again = hills.run(context->renderer());
    ASSERT_EQ(once.runs.size(), 3u);
    expect_same(once, again);
}

TEST(MeasuredCourse, OfThePapersLodSpriteTellsItsKeyframes) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hills hills({"lod-sprite:paper@low-error-px=4@strips=1"}, {"key-error-px=0.01,1000"});
    CourseResult once = hills.run(context->renderer()), again = hills.run(context->renderer());
    ASSERT_EQ(once.runs.size(), 3u);
    expect_same(once, again);
    for (uint32_t frame = 0; frame < kFrames; ++frame) {
        EXPECT_EQ(once.runs[0].frames[frame].counters.event_count, 1u) << frame;
        EXPECT_EQ(once.runs[1].frames[frame].counters.event_count, frame == 0 ? 1u : 0u) << frame;
    }
    const Counters &key = once.runs[0].frames[1].counters, &novel = once.runs[1].frames[1].counters;
    EXPECT_GT(key.triangle_count, 4 * novel.triangle_count);
    EXPECT_EQ(key.draw_call_count, 4u);
    EXPECT_EQ(novel.draw_call_count, 2u);
    EXPECT_GT(novel.predicted_error_px, 0);
}

TEST(MeasuredCourse, IsTheSameWithKeptReferences) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    ScratchFolder cache;
    Hills hills({"terrain"}, {});
    CourseResult drawn = hills.run(context->renderer(), cache.path()), kept = hills.run(context->renderer(), cache.path());
    EXPECT_EQ(drawn.references_drawn, kFrames);
    EXPECT_EQ(kept.references_drawn, 0u);
    EXPECT_EQ(kept.references_kept, kFrames);
    expect_same(drawn, kept);
}

TEST(MeasuredCourse, DrawsADamagedReferenceAnew) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    ScratchFolder cache;
    Hills hills({"terrain"}, {});
    CourseResult drawn = hills.run(context->renderer(), cache.path());
    std::string path = cache / *cache.names().begin(), whole = text_of_file(path);
    std::string damaged = whole;
    damaged[damaged.size() / 2] = char(damaged[damaged.size() / 2] ^ 4);
    std::ofstream(path, std::ios::binary) << damaged;
    CourseResult again = hills.run(context->renderer(), cache.path());
    EXPECT_EQ(again.references_damaged, 1u);
    EXPECT_EQ(again.references_drawn, 1u);
    EXPECT_EQ(text_of_file(path), whole);
    expect_same(drawn, again);
}

TEST(MeasuredCourse, KeepsReferencesApartByWhatIsSeen) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    ScratchFolder cache;
    Hills hills({"full"}, {});
    hills.run(context->renderer(), cache.path());
    hills.world.content_hash = "other hills";
    EXPECT_EQ(hills.run(context->renderer(), cache.path()).references_drawn, kFrames);
    hills.world.look.haze = 0;
    EXPECT_EQ(hills.run(context->renderer(), cache.path()).references_drawn, kFrames);
    hills.course.cameras[2].heading_deg += 1e-9;
    EXPECT_EQ(hills.run(context->renderer(), cache.path()).references_drawn, 1u);
    gl::Renderer other = context->renderer();
    other.version += "x";
    EXPECT_EQ(hills.run(other, cache.path()).references_drawn, kFrames);
}

TEST(MeasuredCourse, PutsTheFloorWhereItBelongs) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hills hills({"terrain@samples=1", "terrain@error-px=30"}, {});
    CourseResult course = hills.run(context->renderer());
    ASSERT_EQ(course.runs.size(), 4u);
    EXPECT_EQ(course.runs[0].floor, 2u);
    EXPECT_EQ(course.runs[1].floor, 3u);
    EXPECT_EQ(course.runs[2].label, "full@samples=1");
    EXPECT_EQ(course.runs[2].pop.index, 1);
    EXPECT_EQ(course.runs[3].frames[0].counters.triangle_count, 2u * 64 * 64);
    EXPECT_EQ(percentiles_of(course.runs[3], "hole_px").max, 0);
}

TEST(ReferenceRenderer, ShowsTheSamePixelsInItsSurroundings) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hills hills({"full"}, {});
    view::Camera camera = hills.course.cameras[0];
    Result<ReferenceRenderer> renderer = ReferenceRenderer::make(hills.world, context->renderer(), 64, 64, "");
    ASSERT_TRUE(renderer);
    Result<Frame> frame = renderer->frame(camera), wide = renderer->surroundings(camera, 5);
    ASSERT_TRUE(frame && wide);
    ASSERT_EQ(wide->width, 74u);
    ASSERT_EQ(wide->height, 74u);
    size_t same = 0, of_ground = 0;
    for (size_t y = 0; y < 64; ++y)
        for (size_t x = 0; x < 64; ++x) {
            size_t at = y * 64 + x, wide_at = (y + 5) * 74 + x + 5;
            if (frame->ids[at] == kBackground) continue;
            ++of_ground;
            same += wide->ids[wide_at] == frame->ids[at] && std::abs(wide->depth_m[wide_at] / frame->depth_m[at] - 1) < 1e-3;
        }
    EXPECT_GT(of_ground, 1000u);
    EXPECT_GE(double(same), 0.99 * double(of_ground));
}

// Draws a cut and takes its picture.
Frame picture_of(World& world, const terrain::Cut& cut, const view::Camera& camera) {
    Result<gl::Target> target = gl::Target::make(camera.width_px, camera.height_px, 1);
    EXPECT_TRUE(target);
    world.drawing->draw(*target, cut, camera, world.look);
    return captured(*target, *target, camera);
}

// Whether a pixel shows the sky and has ground above it, as no lowered crest has.
bool shows_sky_below_ground(const Frame& frame, size_t at) {
    if (frame.ids[at] != kBackground) return false;
    for (size_t above = at; above >= frame.width; above -= frame.width)
        if (frame.ids[above - frame.width] != kBackground) return true;
    return false;
}

TEST(HolesOfACut, AreFoundWhereATriangleIsMissingWhateverWasPromised) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    constexpr double kPromised_px = 8;
    constexpr uint32_t kGround = kBackground + 1;
    Hills hills({"full"}, {});
    view::Camera camera = test::from_south(*hills.world.terrain, 128, 128);
    terrain::Cut full, whole;
    hills.world.refiner->cut_by_metres(-1, full);
    hills.world.refiner->cut_by_pixels(camera, kPromised_px, whole, 0);
    Frame reference = picture_of(hills.world, full, camera), sound = picture_of(hills.world, whole, camera);
    HolePixels lowered = hole_pixels(sound, reference, kGround, {kPromised_px});
    EXPECT_EQ(lowered.count, 0u);
    EXPECT_GT(lowered.allowed, 100u) << "the cut is coarse enough to move crests";

    size_t cracks = 0, crack_px = 0, counted_px = 0;
    for (size_t triangle = 0; 3 * triangle < whole.indices.size(); ++triangle) {
        terrain::Cut torn = whole;
        auto from = torn.indices.begin() + ptrdiff_t(3 * triangle);
        torn.indices.erase(from, from + 3);
        Frame test = picture_of(hills.world, torn, camera);
        std::vector<uint8_t> strict = hole_pixels(test, reference, kGround).mask;
        HolePixels holes = hole_pixels(test, reference, kGround, {kPromised_px});
        size_t in_crack = 0;
        for (size_t at = 0; at < strict.size(); ++at) {
            if (strict[at] == 0 || !shows_sky_below_ground(test, at)) continue;
            ++in_crack;
            counted_px += holes.mask[at] == strict[at];
        }
        crack_px += in_crack;
        if (in_crack < 4) continue;
        ++cracks;
        EXPECT_GT(holes.count, 0u) << "triangle " << triangle << " opens " << in_crack << " px";
    }
    EXPECT_GT(cracks, 20u);
    EXPECT_GE(double(counted_px), 0.99 * double(crack_px)) << counted_px << " of " << crack_px;
}

TEST(MeasuredCourse, PromisesNoMoreThanWasAskedFor) {
    Counters counters;
    counters.predicted_error_px = 3;
    EXPECT_EQ(promised_px(*parse_method("terrain@error-px=4"), counters), 3);
    EXPECT_EQ(promised_px(*parse_method("terrain@error-px=2"), counters), 2);
    EXPECT_EQ(promised_px(*parse_method("terrain@error-px=2@triangles=1000"), counters), 3);
    EXPECT_EQ(promised_px(*parse_method("full"), counters), 0);
}

TEST(MeasuredCourse, SeesTheErrorOfACoarseCut) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hills hills({"terrain@error-px=0.25", "terrain@error-px=20"}, {});
    CourseResult course = hills.run(context->renderer());
    const RunResult &fine = course.runs[0], &coarse = course.runs[1];
    EXPECT_GT(percentiles_of(coarse, "e_p99_flip").max, 1.2 * percentiles_of(fine, "e_p99_flip").max);
    EXPECT_GT(percentiles_of(coarse, "w_luma").max, percentiles_of(fine, "w_luma").max);
    EXPECT_LT(percentiles_of(coarse, "triangles").max, percentiles_of(fine, "triangles").p50);
    EXPECT_LE(percentiles_of(coarse, "predicted_error_px").max, 20);
}

TEST(MeasuredCourse, TakesEOnTheFirstAndEveryTenthFrame) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hills hills({"full"}, {});
    CourseResult course = hills.run(context->renderer());
    EXPECT_TRUE(course.runs[0].frames[0].numbers.e_p99);
    for (uint32_t frame = 1; frame < kFrames; ++frame) {
        EXPECT_FALSE(course.runs[0].frames[frame].numbers.e_p99) << frame;
        EXPECT_TRUE(course.runs[0].frames[frame].numbers.w) << frame;
    }
    EXPECT_FALSE(course.runs[0].frames[0].numbers.w);
}

TEST(MeasuredCourse, TakesGOfWhatPromisesSomething) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hills hills({"terrain@error-px=4"}, {});
    CourseResult course = hills.run(context->renderer());
    const RunResult &run = course.runs[0], &floor = course.runs[1];
    EXPECT_EQ(values_of(run, figure("g_max")).size(), kFrames);
    EXPECT_GT(run.g.all().count, 100u);
    EXPECT_TRUE(is_honest(run.g.all())) << run.g.all().ratio_max << " " << run.g.all().ratio_median;
    EXPECT_LE(run.g.all().measured_max_px, 4);
    EXPECT_EQ(floor.g.all().count, 0u);
    EXPECT_TRUE(values_of(floor, figure("g_max")).empty());
}

TEST(MeasuredCourse, KeepsABudgetOfTriangles) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hills hills({"terrain@error-px=0.1", "terrain@error-px=0.1@triangles=1000"}, {});
    CourseResult course = hills.run(context->renderer());
    const RunResult &free = course.runs[0], &held = course.runs[1];
    EXPECT_GT(percentiles_of(free, "triangles").max, 2000);
    EXPECT_GT(held.frames.front().counters.triangle_count, 1000u);  // the first frame knows nothing of the next
    EXPECT_LT(held.frames.back().counters.triangle_count, free.frames.back().counters.triangle_count / 2);
    EXPECT_TRUE(is_honest(held.g.all())) << held.g.all().ratio_max;  // what it promises then, it keeps
    expect_same(course, hills.run(context->renderer()));
}

TEST(MeasuredCourse, SeesABrokenPromiseOfTheFile) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hills hills({"terrain@error-px=4"}, {});
    for (size_t code = 1; code < terrain::kMustSplit; ++code) hills.world.terrain->error_m[code] *= 0.4f;
    const RunResult run = hills.run(context->renderer()).runs[0];
    EXPECT_GT(run.g.all().above_prediction, 0u);
    std::vector<Gate> gates = gates_of(run);
    auto gate = std::find_if(gates.begin(), gates.end(), [](const Gate& one) { return one.name == "g_max"; });
    ASSERT_NE(gate, gates.end());
    EXPECT_FALSE(gate->is_kept());
}

// With 23 frames.
Hills long_flight(Compared compared) {
    Hills hills({"terrain@samples=1"}, {});
    for (uint32_t frame = kFrames; frame < 23; ++frame) {
        hills.course.cameras.push_back(hills.course.cameras.back());
        hills.course.cameras.back().position_m.y += 3.0;
    }
    hills.course.compared = compared;
    return hills;
}

TEST(MeasuredCourse, InPairsHasTheNumbersOfAllOnEveryTenthFrameAndTheNext) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hills of_pairs = long_flight(Compared::pairs), of_all = long_flight(Compared::all);
    CourseResult pairs = of_pairs.run(context->renderer()), all = of_all.run(context->renderer());
    EXPECT_EQ(pairs.references_drawn, 6u);
    EXPECT_EQ(all.references_drawn, 23u);
    for (size_t run = 0; run < all.runs.size(); ++run) {
        for (uint32_t frame = 0; frame < 23; ++frame) {
            const Numbers &some = pairs.runs[run].frames[frame].numbers, &every = all.runs[run].frames[frame].numbers;
            EXPECT_EQ(pairs.runs[run].frames[frame].counters, all.runs[run].frames[frame].counters);
            EXPECT_EQ(some.psnr_db, frame % 10 < 2 ? every.psnr_db : std::nullopt) << frame;
            EXPECT_EQ(some.e_p99, frame % 10 == 0 ? every.e_p99 : std::nullopt) << frame;
            EXPECT_EQ(some.w, frame % 10 == 1 ? every.w : std::nullopt) << frame;
            EXPECT_TRUE(every.psnr_db);
        }
    }
}

TEST(MeasuredCourse, InStepsComparesEveryFrameButTakesEOnEveryTenthAlone) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hills hills = long_flight(Compared::steps);
    hills.course.specs = *specs_from({"lod-sprite:paper@low-error-px=4@key-error-px=0.01@samples=1", "full@samples=1"}, {});
    CourseResult steps = hills.run(context->renderer());
    EXPECT_EQ(steps.references_drawn, 23u);
    for (uint32_t frame = 0; frame < 23; ++frame) {
        const FrameRecord& record = steps.runs[0].frames[frame];
        EXPECT_EQ(record.counters.event_count, 1u) << "a keyframe, for whose sake others would take E";
        EXPECT_TRUE(record.numbers.psnr_db);
        EXPECT_EQ(record.numbers.e_p99.has_value(), frame % 10 == 0) << frame;
        EXPECT_EQ(record.numbers.w.has_value(), frame > 0) << frame;
    }
}

TEST(MeasuredCourse, WithALeadIsTheEndOfALongerOne) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hills whole = long_flight(Compared::all), end = long_flight(Compared::all);
    whole.course.specs = end.course.specs = *specs_from({"lod-sprite@samples=1", "full@samples=1"}, {});
    std::vector<view::Camera>& cameras = end.course.cameras;
    end.course.lead.assign(cameras.begin(), cameras.begin() + 12);
    cameras.erase(cameras.begin(), cameras.begin() + 12);
    CourseResult all = whole.run(context->renderer()), part = end.run(context->renderer());
    ASSERT_EQ(part.runs[0].frames.size(), 11u);
    for (uint32_t frame = 0; frame < 11; ++frame) {
        const FrameRecord &late = part.runs[0].frames[frame], &same = all.runs[0].frames[12 + frame];
        EXPECT_EQ(late.frame, frame);
        EXPECT_EQ(late.counters, same.counters);
        EXPECT_EQ(late.numbers.psnr_db, same.numbers.psnr_db);
    }
    EXPECT_NE(part.runs[0].frames[0].counters, all.runs[0].frames[0].counters) << "without a lead it would begin without a key";
}

TEST(MeasuredCourse, ComparedWithNothingHasCountersAloneAndNeedsNoFloor) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hills hills = long_flight(Compared::none), of_all = long_flight(Compared::all);
    hills.course.specs.pop_back();
    CourseResult none = hills.run(context->renderer()), all = of_all.run(context->renderer());
    ASSERT_EQ(none.runs.size(), 1u);
    EXPECT_EQ(none.runs[0].floor, 0u);
    EXPECT_EQ(none.references_drawn, 0u);
    for (uint32_t frame = 0; frame < 23; ++frame) {
        EXPECT_EQ(none.runs[0].frames[frame].counters, all.runs[0].frames[frame].counters);
        EXPECT_FALSE(none.runs[0].frames[frame].numbers.psnr_db);
    }
}

TEST(MeasuredCourse, ByTheWallClockHasTimesAlone) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hills hills({"terrain"}, {});
    Result<CourseResult> course = run_by_wall_clock(hills.world, hills.course, [](double) {});
    ASSERT_TRUE(course);
    for (const RunResult& run : course->runs) {
        ASSERT_FALSE(run.frames.empty());
        for (size_t i = 1; i < run.frames.size(); ++i) EXPECT_GE(run.frames[i].frame, run.frames[i - 1].frame);
        EXPECT_FALSE(run.frames[0].numbers.psnr_db);
        EXPECT_GT(run.frames[0].counters.triangle_count, 0u);
    }
}

}  // namespace
}  // namespace overlook::measure
