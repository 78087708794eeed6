// What section 4 of the LOD-sprite paper is run with, and what is made of the runs.
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "tools/measure/methods.h"
#include "tools/measure/paper/lod_sprite/page_sections.h"
#include "tools/measure/paper/lod_sprite/paper_page.h"
#include "tools/measure/paper/lod_sprite/targets.h"

namespace overlook::measure::paper::sprite {
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

TEST(PaperTargets, TellWhyTheyAreMissedAndNothingElse) {
    Flown flown = small_flown();
    for (const Target& target : targets_of(flown)) {
        bool is_missed = target.measured[0] && !target.is_reached(0);
        EXPECT_TRUE(is_missed || target.why.empty()) << target.name;
    }
    RunResult& sprite = flown.beside.runs[2];
    std::swap(sprite.frames[0].counters, sprite.frames[2].counters);  // the first key takes over at the third frame
    for (uint32_t frame : {2u, 3u}) sprite.frames[frame].numbers.e_mean = 0.1;
    std::vector<Target> targets = targets_of(flown);
    EXPECT_NE(targets[0].why.find("the low cut by itself gains 25.0"), std::string::npos) << targets[0].why;
    EXPECT_DOUBLE_EQ(*targets[6].measured[0], 1.5);
    EXPECT_EQ(
        targets[6].why,
        "frames before the first key, which is whole at frame 2, are drawn coarser; from then on it is 1, worst at frame 2, "
        "0 frames after a key took over");
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
    Target least{"", "", 10, true, {9.0, 10.0, std::nullopt}, "", ""}, most{"", "", 10, false, {11.0, 10.0}, "", ""};
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

TEST(Remedies, AreSettingsOfTheMethodThatChangeItEachByItself) {
    MethodSpec whole = *parse_method("lod-sprite");
    std::set<std::string> labels;
    for (const Remedy& remedy : remedies()) {
        Result<MethodSpec> spec = parse_method("lod-sprite@" + std::string(remedy.off));
        ASSERT_TRUE(spec) << spec.error().message;
        size_t changed = 0;
        for (size_t i = 0; i < spec->settings.size(); ++i) changed += spec->settings[i] != whole.settings[i];
        EXPECT_EQ(changed, 1u) << remedy.off;
        EXPECT_TRUE(labels.insert(label_of(*spec)).second) << remedy.off;
    }
    EXPECT_GE(labels.size(), 11u);
}

TEST(Remedies, TellOnlyWhatChanges) {
    RemedyFigures whole;
    whole.mean_ms = whole.p99_ms = 20;
    whole.e_mean = 0.02, whole.e_p99 = 0.1, whole.w_mean = 0.001, whole.pop_index = 1.2;
    whole.triangles = 1000, whole.ghost_share = 0.001, whole.hole_px = 2;
    EXPECT_EQ(change_of(whole, whole), "nothing that could be measured here");
    RemedyFigures without = whole;
    without.mean_ms = 22;  // times are noisy
    without.p99_ms = 29;
    without.e_p99 = 0.104;
    without.ghost_share = 0.00104;
    EXPECT_EQ(change_of(whole, without), "nothing that could be measured here");
    without.p99_ms = 60;
    without.w_mean = 0.0008;
    without.ghost_share = 0.02;
    without.hole_px = 0;
    EXPECT_EQ(change_of(whole, without), "p99 time x 3.00, W x 0.80, ghosts 0.10 to 2.00 %, holes 2 to 0 px");
}

TEST(Remedies, AreCountedFromTheirRuns) {
    RunResult run = run_of(*parse_method("lod-sprite"), {10, 20, 30}, 100);
    for (FrameRecord& frame : run.frames) frame.numbers.hole_count = frame.frame;
    run.frames[1].counters.event_count = 1;
    run.frames[2].counters.key_pixel_count = 300;
    run.frames[2].numbers.ghost_share = 0.5;  // the only frame that used a key
    RemedyFigures figures = figures_of(run);
    EXPECT_EQ(figures.mean_ms, 20);
    EXPECT_EQ(figures.triangles, 100);
    EXPECT_EQ(figures.key_pixels, 100);
    EXPECT_EQ(figures.keys, 1u) << "begun in the last frame; the event is that one takes over";
    EXPECT_DOUBLE_EQ(figures.e_mean, 0.1);
    EXPECT_EQ(figures.ghost_share, 0.5);
    EXPECT_EQ(figures.hole_px, 2);
}

TEST(Remedies, AreARowEach) {
    RemedyTable table;
    EXPECT_EQ(remedies_html(table), "") << "not flown";
    for (const char* name : {"high", "paper", "all"}) table.rows.push_back({name, "", "", run_of({name, "", {}}, {10}, 100)});
    table.rows.push_back({"cross-fade", "fade-frames=0", "Why.", run_of({"off", "", {}}, {40}, 100)});
    table.floor = run_of(floor_spec(1), {90}, 1000);
    std::string html = remedies_html(table), csv = remedies_csv(table);
    EXPECT_NE(html.find("<code>fade-frames=0</code>"), std::string::npos);
    EXPECT_NE(html.find("Why. <strong>Then: mean time x 4.00, p99 time x 4.00.</strong>"), std::string::npos) << html;
    EXPECT_NE(csv.find("\ncross-fade,fade-frames=0,40,40,100,"), std::string::npos) << csv;
}

constexpr uint8_t kSky = 0;

// Four pixels of a wall 100 m ahead and one of sky, in a row; the first key 10 m beside the camera, the second 20 m.
struct HeldScene {
    Frame truth;
    Sources sources;
    Reuse reuse;

    HeldScene() {
        truth.width = truth.camera.width_px = 5;
        truth.height = truth.camera.height_px = 100;
        truth.camera.fov_y_deg = 90;
        truth.depth_m.assign(500, 100);
        for (size_t row = 0; row < 100; ++row) truth.depth_m[5 * row + 4] = std::numeric_limits<float>::infinity();
        sources.keys = {truth.camera, truth.camera};
        sources.keys[0].position_m.x += 10;
        sources.keys[1].position_m.x += 20;
        sources.of_pixel.assign(500, 1);
        reuse.is_ghost.assign(500, 0);
        reuse.is_loss.assign(500, 0);
    }
};

TEST(HeldKeys, JudgeAPixelByTheKeyThatItShows) {
    HeldScene scene;
    scene.sources.of_pixel[1] = 2;
    scene.sources.of_pixel[2] = 3;
    scene.sources.of_pixel[3] = Sources::kOwn;
    scene.sources.of_pixel[4] = kSky;
    scene.sources.of_pixel[5] = Sources::kNear;
    scene.reuse.is_ghost[1] = scene.reuse.is_loss[3] = 1;
    JudgedPixels judged = judged_pixels(scene.sources, scene.truth, scene.reuse);
    EXPECT_NEAR(judged.parallax_px[0], 5, 1e-4);
    EXPECT_NEAR(judged.parallax_px[1], 10, 1e-4);
    EXPECT_NEAR(judged.parallax_px[2], 10, 1e-4) << "of several the greatest";
    EXPECT_NEAR(judged.parallax_px[3], 5, 1e-4) << "of none the least";
    std::vector<Reused> is(judged.pixels.begin(), judged.pixels.begin() + 6);
    EXPECT_EQ(
        is, (std::vector<Reused>{Reused::well, Reused::ghost, Reused::well, Reused::loss, Reused::nothing_there, Reused::near}));
}

TEST(HeldKeys, SweepTheThicknessThatThePaperDoesNotPrint) {
    std::vector<HeldRun> runs = held_runs({0.03, 7, {}});
    std::set<double> thicknesses;
    size_t own = 0, in_strips = 0;
    for (const HeldRun& run : runs) {
        EXPECT_EQ(setting(run.spec, "key-error-px"), 1000) << run.title;
        EXPECT_EQ(setting(run.spec, "low-error-px"), 7) << run.title;
        if (run.spec.variant != "paper") {
            ++own;
            continue;
        }
        thicknesses.insert(setting(run.spec, "depth-thickness"));
        in_strips += setting(run.spec, "strips") == 1;
    }
    EXPECT_EQ(own, 1u);
    EXPECT_GE(thicknesses.size(), 4u);
    EXPECT_EQ(in_strips, 1u);
}

TEST(HeldKeys, AreHeldAgainstTheFiguresUpToThirtyTwoPixels) {
    std::vector<HeldRun> runs = held_runs({0.03, 7, {}});
    runs.resize(2);
    std::vector<float> parallax(1000, 10);
    std::vector<Reused> pixels(1000, Reused::well);
    pixels[0] = Reused::ghost;
    runs[0].tally.add(parallax, pixels);
    std::fill_n(pixels.begin(), 20, Reused::loss);
    runs[1].tally.add(parallax, pixels);
    std::string html = held_keys_html(runs, true), csv = held_keys_csv(runs);
    EXPECT_NE(html.find("<td>0.10</td><td>0.00</td>"), std::string::npos) << html;
    EXPECT_NE(html.find("<td><strong class=\"broken\">2.00</strong></td>"), std::string::npos) << html;
    EXPECT_NE(csv.find("\nlod-sprite,0,8,16,11.31,1000,0.001,0,0\n"), std::string::npos) << csv;
    EXPECT_EQ(held_keys_charts(runs).size(), 2u);
    EXPECT_EQ(held_keys_html({}, true), "");
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
}  // namespace overlook::measure::paper::sprite
