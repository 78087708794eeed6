// What section 4 of the LOD-sprite paper is run with, and what is made of the runs.
#include <gtest/gtest.h>

#include "tools/measure/methods.h"
#include "tools/measure/paper/paper_page.h"
#include "tools/measure/paper/targets.h"

namespace overlook::measure::paper {
namespace {

const std::string kPlan = R"({"version": 1, "high_px": 0.03, "low_px": 7,
  "views": [{"figure": 6, "time_s": 0, "high_triangles": 387937, "low_triangles": 1503}]})";

std::string replaced(std::string text, const std::string& part, const std::string& by) {
    return text.replace(text.find(part), part.size(), by);
}

TEST(PaperPlan, IsReadFromRunJson) {
    Result<Plan> plan = parse_plan(kPlan, "run.json");
    ASSERT_TRUE(plan) << plan.error().message;
    EXPECT_EQ(plan->high_px, 0.03);
    EXPECT_EQ(plan->low_px, 7);
    ASSERT_EQ(plan->views.size(), 1u);
    EXPECT_EQ(plan->views[0].figure, 6);
    EXPECT_EQ(plan->views[0].low_triangle_count, 1503);
}

TEST(PaperPlan, NamesThePlaceOfAMistake) {
    for (const auto& [part, by, said] :
         {std::tuple{"\"low_px\": 7", "\"low_px\": 0.02", "/low_px: 0.02 is not above high_px, 0.03"},
          std::tuple{"\"time_s\"", "\"times\"", "/views/0/times"}, std::tuple{"\"version\": 1", "\"version\": 2", "/version"},
          std::tuple{"\"high_px\": 0.03, ", "", "high_px"}}) {
        Result<Plan> plan = parse_plan(replaced(kPlan, part, by), "run.json");
        ASSERT_FALSE(plan) << by;
        EXPECT_EQ(plan.error().exit, Exit::bad_input);
        EXPECT_NE(plan.error().message.find(said), std::string::npos) << plan.error().message;
    }
}

TEST(PaperCast, TakesItsThresholdsFromThePlanUnlessAMethodBringsItsOwn) {
    Plan plan{0.03, 7, {}};
    Result<Cast> cast = cast_from(plan, {"terrain:hard", "terrain@error-px=3"});
    ASSERT_TRUE(cast) << cast.error().message;
    EXPECT_EQ(setting(cast->high, "error-px"), 0.03);
    EXPECT_EQ(setting(cast->low, "error-px"), 7);
    EXPECT_EQ(setting(cast->sprites[0], "error-px"), kThreshold_px) << "a method without keyframes: its error is the threshold";
    EXPECT_EQ(setting(cast->sprites[1], "error-px"), 3);
    for (const MethodSpec& spec : {cast->high, cast->low, cast->sprites[0], cast->sprites[1]})
        EXPECT_EQ(setting(spec, "samples"), 1);
    EXPECT_EQ(setting(at_threshold(cast->sprites[1], 0.5), "error-px"), 0.5);
    EXPECT_FALSE(cast_from(plan, {"terrain:none"}));
}

TEST(PaperCast, SweepsTheKeysThresholdWhereAMethodHasOne) {
    MethodSpec sprite{"lod-sprite", "paper", {{"error-px", 0.03}, {"key-error-px", 1}, {"samples", 1}}};
    MethodSpec other = at_threshold(sprite, 4);
    EXPECT_EQ(setting(other, "key-error-px"), 4);
    EXPECT_EQ(setting(other, "error-px"), 0.03);
}

TEST(Knee, IsWhereACurveTurnsFromSteepToFlat) {
    EXPECT_EQ(knee_of({{0, 1}, {1, 0.2}, {2, 0.15}, {4, 0.05}, {8, 0}}), 1);
    EXPECT_FALSE(knee_of({{0, 1}, {1, 0.5}, {2, 0}})) << "a straight line has none";
    EXPECT_FALSE(knee_of({{0, 1}, {1, 0.9}, {2, 0}})) << "nor has one that falls ever faster";
    EXPECT_FALSE(knee_of({{0, 1}, {1, 0}}));
    EXPECT_FALSE(knee_of({{0, 0}, {1, 0}, {2, 0}}));
}

RunResult run_of(const MethodSpec& spec, const std::vector<double>& times_ms, uint64_t triangles) {
    RunResult run;
    run.spec = spec;
    run.label = label_of(spec);
    for (size_t i = 0; i < times_ms.size(); ++i) {
        FrameRecord frame;
        frame.frame = uint32_t(i);
        frame.draw_ms = times_ms[i];
        frame.counters.triangle_count = triangles;
        frame.counters.vertex_reference_count = 3 * triangles;
        frame.numbers.e_mean = 0.1;
        frame.numbers.e_p99 = 0.5;
        run.frames.push_back(frame);
    }
    return run;
}

// Four frames; the sprite's first is a keyframe at the high cut.
Flown small_flown() {
    Flown flown;
    flown.plan = *parse_plan(kPlan, "run.json");
    flown.cast = *cast_from(flown.plan, {"terrain:hard@error-px=1"});
    flown.step_s = 0.5;
    flown.beside.runs.push_back(run_of(flown.cast.high, {100, 100, 100, 100}, 20'000));
    flown.beside.runs.push_back(run_of(flown.cast.low, {4, 4, 4, 4}, 100));
    RunResult sprite = run_of(flown.cast.sprites[0], {120, 10, 10, 20}, 100);
    sprite.frames[0].counters.triangle_count = 20'000;
    sprite.frames[0].counters.event_count = 1;
    for (FrameRecord& frame : sprite.frames) frame.numbers.e_mean = 0.2;
    sprite.floor = 3;
    flown.beside.runs.push_back(sprite);
    flown.beside.runs.push_back(run_of(floor_spec(1), {150, 150, 150, 150}, 30'000));
    flown.frame_counts = {{"terrain:hard", 1, 2, 1, 10, 0}, {"terrain:hard", 1, 8, 2, 10, 0}};
    flown.thresholds = {{"terrain:hard", 1, 4, 1, 40, 100}};
    ViewPicture picture{"terrain:hard", 7, {1, 1, {10, 20, 30}}};
    flown.views.push_back({flown.plan.views[0], picture, picture, {picture}});
    flown.views[0].sprites[0].image.pixels = {10, 30, 25};
    flown.path.resize(4);
    return flown;
}

TEST(PaperTargets, AreCountedFromTheRuns) {
    std::vector<Target> targets = targets_of(small_flown());
    auto measured = [&](const std::string& part) {
        for (const Target& target : targets)
            if (target.name.find(part) != std::string::npos) return target.measured.at(0);
        ADD_FAILURE() << part;
        return std::optional<double>();
    };
    EXPECT_DOUBLE_EQ(*measured("speed-up"), 100.0 / 40);
    EXPECT_DOUBLE_EQ(*measured("over the median"), 120.0 / 10);
    EXPECT_DOUBLE_EQ(*measured("slowest"), 1.2);
    EXPECT_DOUBLE_EQ(*measured("between keyframes"), 200);
    EXPECT_DOUBLE_EQ(*measured("keyframes included"), 80'000.0 / 20'300);
    EXPECT_DOUBLE_EQ(*measured("E, mean"), 2);
    EXPECT_DOUBLE_EQ(*measured("share of keyframes"), 0.25);
    EXPECT_DOUBLE_EQ(*measured("with the most frames"), 0.5);
    EXPECT_FALSE(measured("W, mean")) << "no W was taken";
}

TEST(PaperTargets, LeaveOutWhatKeyframesCostWhereASliceIsDrawnEveryFrame) {
    Flown flown = small_flown();
    for (FrameRecord& frame : flown.beside.runs[2].frames) {
        frame.counters.triangle_count = 600;
        frame.counters.key_triangle_count = 500;
        frame.counters.event_count = 1;
    }
    std::vector<Target> targets = targets_of(flown);
    EXPECT_DOUBLE_EQ(*targets[4].measured[0], 200);
}

TEST(PaperTargets, AreReachedOnTheirOwnSide) {
    Target least{"", "", 10, true, {9.0, 10.0, std::nullopt}, ""}, most{"", "", 10, false, {11.0, 10.0}, ""};
    EXPECT_FALSE(least.is_reached(0));
    EXPECT_TRUE(least.is_reached(1));
    EXPECT_FALSE(least.is_reached(2));
    EXPECT_FALSE(most.is_reached(0));
    EXPECT_TRUE(most.is_reached(1));
}

TEST(CountedCost, IsIndicesAndAFifthOfAllPixels) {
    Counters counters;
    counters.vertex_reference_count = 300;
    counters.key_pixel_count = 50;
    EXPECT_DOUBLE_EQ(counted_cost(counters, 100), 330);
}

TEST(PaperFigures, ShowDifferencesFourTimesAsGreat) {
    Flown flown = small_flown();
    std::vector<FigurePicture> pictures = pictures_of(flown.views[0]);
    ASSERT_EQ(pictures.size(), 5u);
    EXPECT_EQ(pictures[2].name, "figure-6c");
    EXPECT_NE(pictures[3].caption.find("mean 0 of 255"), std::string::npos) << pictures[3].caption;
    EXPECT_NE(pictures[4].caption.find("mean 10 of 255"), std::string::npos) << pictures[4].caption;
    EXPECT_NE(pictures[3].image.pixels, pictures[4].image.pixels);
}

TEST(PaperPage, HoldsEveryFigureAndMarksWhatIsMissed) {
    Flown flown = small_flown();
    RunSetup setup;
    std::vector<Chart> charts = charts_8_to_14(flown);
    std::vector<std::vector<FigurePicture>> pictures{pictures_of(flown.views[0])};
    std::string html = paper_page_html({flown, setup, charts, pictures, true});
    for (const char* part : {"figure-8-map", "figure-8-profile", "figure-9", "figure-10", "figure-11", "figure-12", "figure-13",
                             "figure-14", "images/figure-6e.png", "class=\"broken\">2.5<", "387,937"})
        EXPECT_NE(html.find(part), std::string::npos) << part;
    EXPECT_EQ(swept_csv(flown.thresholds),
              "method,threshold_px,frames,keyframes,keyframe_share,mean_ms,high_mean_ms,speed_up\n"
              "terrain:hard,1,4,1,0.25,40,100,2.5\n");
    EXPECT_NE(path_csv(flown).find("\n0,0,0,0,0,0,1,0\n1,0,0,0,0,0,0,0\n"), std::string::npos);
}

}  // namespace
}  // namespace overlook::measure::paper
