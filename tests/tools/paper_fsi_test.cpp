// What section 4 of the paper on frame-sequential interpolation is flown with, and what is made of the films.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "runtime/discrete/settings.h"
#include "tests/runtime/discrete/chains.h"
#include "tools/measure/paper/fsi/page.h"
#include "tools/measure/paper/fsi/targets.h"
#include "tools/measure/paper/fsi/variations.h"

namespace overlook::measure::paper::fsi {
namespace {

// Errors of 0, 0.01, 0.02, 0.4 and 3 m, a metre in radius.
discrete::Chain chain_of_errors() {
    discrete::Chain chain;
    chain.radius_m = 1;
    for (float error_m : {0.0f, 0.01f, 0.02f, 0.4f, 3.0f}) chain.levels.emplace_back().error_m = error_m;
    return chain;
}

TEST(Stand, IsWhereTheCoarserLevelIsOffByTheErrorAndTheThingFitsIntoThePicture) {
    double focal_px = kFilmHeight_px / (2 * std::tan(kFilmFov_deg * 3.14159265358979 / 360));
    Stand stand = stand_of(chain_of_errors(), 2);
    EXPECT_EQ(stand.change, 2u) << "nearer levels would be off by 2 px only within the thing";
    EXPECT_NEAR(stand.distance_m, 0.4 * focal_px / 2, 1e-3);
    EXPECT_GE(stand.distance_m, 4);
    EXPECT_EQ(stand.count, 7u);
    EXPECT_EQ(stand_of(chain_of_errors(), 1e6).change, 0u) << "no level is off so far";
}

TEST(Stand, LetsItsChangeBeginWhereItStands) {
    Stand stand = stand_of(chain_of_errors(), 2);
    // Level l does from first * 2^(l - 1) on.
    EXPECT_DOUBLE_EQ(first_distance_m(stand) * std::exp2(double(stand.change)), stand.distance_m);
    for (const Way& way : kWays) {
        MethodSpec spec = spec_of(way, settings_of(stand, way));
        bool is_by_distance = setting(spec, "by") == double(discrete::Criterion::distance);
        EXPECT_EQ(is_by_distance, way.name != "late") << way.name;
    }
}

TEST(Film, PassesTheArcsMiddleBetweenTheLastFrameBeforeTheChangeAndItsFirst) {
    Stand stand{0, 20, 3};
    std::vector<view::Camera> cameras = film_cameras(stand, {});
    ASSERT_EQ(cameras.size(), kFilmFrames);
    EXPECT_LT(cameras[kBefore - 1].position_m.y, 0);
    EXPECT_GT(cameras[kBefore].position_m.y, 0);
    EXPECT_NEAR(cameras[kBefore - 1].position_m.y, -cameras[kBefore].position_m.y, 1e-12);
}

TEST(Variations, SwitchOffEachRemedyAloneButOneThatNeedsThingsThatMove) {
    std::set<std::string> off;
    for (const Variation& one : variations())
        if (one.is_remedy) off.insert(std::string(one.setting.substr(1, one.setting.find('=') - 1)));
    std::set<std::string> remedies;
    for (const SettingKind& kind : discrete::setting_kinds(discrete::Variant::fsi)) remedies.insert(std::string(kind.name));
    for (const SettingKind& kind : discrete::setting_kinds(discrete::Variant::fsi_paper)) remedies.erase(std::string(kind.name));
    remedies.erase("move-instances");
    EXPECT_EQ(off, remedies);
    EXPECT_GE(off.size(), 5u);
    EXPECT_EQ(script_of_variations("a", "", {0, 10, 3}).takes.size(), variations().size());
}

TEST(Variations, TellWhatChangesAndNothingElse) {
    Seen whole, without;
    whole.entering_w = without.entering_w = 0.5, whole.pop = 1.2, without.pop = 3.5;
    EXPECT_EQ(change_of(whole, without), "pop index 1.2 to 3.5");
    EXPECT_EQ(change_of(whole, whole), "nothing that could be measured here");
}

// W of each frame in one tile.
RunResult run_of(const std::vector<double>& w, uint64_t triangles, uint32_t changing) {
    RunResult run;
    for (uint32_t frame = 0; frame < kFilmFrames; ++frame) {
        FrameRecord& record = run.frames.emplace_back();
        record.frame = frame;
        record.counters.triangle_count = triangles;
        record.counters.transition_count = frame >= kBefore && frame < kBefore + changing ? 1 : 0;
        if (frame == 0) continue;
        record.numbers.w = w[frame];
        run.temporal.push_back({frame, w[frame], 1, 1, {float(w[frame])}});
    }
    return run;
}

// The floor has W of 1 thousandth in every frame; a way that fades has more in its change's frames, `switch` in one.
Film made_film() {
    std::vector<double> floor(kFilmFrames, 0.001), fading = floor, at_once = floor;
    for (uint32_t frame = kBefore; frame < kBefore + kFading; ++frame) fading[frame] = 0.002;
    fading[kBefore] = 0.003, fading[kBefore + kFading] = 0.005;
    at_once[kBefore] = 0.021;
    Film film{"simple", "", {0, 10, 3}, {}, run_of(floor, 1000, 0), {run_of(floor, 10, 0), run_of(floor, 1000, 0)}};
    for (const Way& way : kWays) {
        Take take{std::string(way.name), run_of(way.fades ? fading : at_once, 100, way.fades ? kFading : 0)};
        take.run.pop = pop_index(take.run.temporal, film.floor.temporal);
        film.takes.push_back(std::move(take));
    }
    return film;
}

TEST(Seen, IsOfTheFirstFrameOfAChangeAndOfTheFirstAfterIt) {
    Film film = made_film();
    Seen fading = seen_of(film, film.takes[kOwn]), at_once = seen_of(film, film.takes[kSwitch]);
    EXPECT_NEAR(fading.entering_w, 2, 1e-9);
    EXPECT_NEAR(fading.leaving_w, 4, 1e-9);
    EXPECT_NEAR(fading.greatest_w, 4, 1e-9);
    EXPECT_NEAR(fading.integrated_w, 2 + 7 * 1 + 4, 1e-9);
    EXPECT_NEAR(fading.entering_pop, 1 + 0.002 / 0.002, 1e-4) << "by the floor's median and a thousandth";
    EXPECT_NEAR(fading.leaving_pop, 1 + 0.004 / 0.002, 1e-4);
    EXPECT_NEAR(at_once.entering_w, 20, 1e-9);
    EXPECT_NEAR(at_once.integrated_w, 20, 1e-9) << "one frame is all there is";
    EXPECT_NEAR(at_once.pop, 11, 1e-3);
    EXPECT_DOUBLE_EQ(fading.odd_even, 0);
    EXPECT_NEAR(fading.end_ratio, 5.0 / 2, 1e-9) << "3, seven times 2 and 5 thousandths";
    EXPECT_NEAR(fading.greatest_ratio, 5.0 / 2, 1e-9);
    EXPECT_NEAR(at_once.end_ratio, 21, 1e-9) << "in the time that others take it rests";
}

// A coarse level that is as restless as the change is no pop of the change.
TEST(Seen, HoldsTheEndsOfAChangeAgainstWhatItsLevelsHaveAtRest) {
    Film film = made_film();
    std::vector<double> coarse(kFilmFrames, 0.004);
    film.standing[0] = run_of(coarse, 10, 0);
    Seen fading = seen_of(film, film.takes[kOwn]), at_once = seen_of(film, film.takes[kSwitch]);
    EXPECT_DOUBLE_EQ(fading.entering_pop, 1) << "3 thousandths in the change, 4 without it";
    EXPECT_NEAR(fading.leaving_pop, 1 + 0.001 / 0.002, 1e-4) << "by the floor's median as before";
    EXPECT_NEAR(fading.standing_pop, 1 + 0.003 / 0.002, 1e-4);
    EXPECT_NEAR(at_once.entering_pop, 1 + 0.017 / 0.002, 1e-4);
    EXPECT_NEAR(fading.pop, 1 + 0.004 / 0.002, 1e-3) << "the film's, by the floor alone";
}

// However many frames one method shows the coarse level and another the fine one.
TEST(Seen, HoldsRestAgainstHardSwitchingFrameByFrame) {
    Film film = made_film();
    for (Take& take : film.takes) {
        uint32_t end = take.name == "switch" ? kBefore : kBefore + kFading;
        for (uint32_t frame = 1; frame < end; ++frame) take.run.frames[frame].numbers.w = 0.005;
        if (take.name == "switch") take.run.frames[kBefore].numbers.w = 0.021;
    }
    Seen fading = seen_of(film, film.takes[kOwn]);
    EXPECT_DOUBLE_EQ(fading.rest_ratio, 1) << "in the median of the film 5 thousandths over 1";
    EXPECT_GT(fading.median_w, 4 * seen_of(film, film.takes[kSwitch]).median_w);
    EXPECT_NEAR(fading.change_ratio, (8 * 0.005 + 0.005) / (0.021 + 8 * 0.001), 1e-9);
    for (uint32_t frame = kBefore + kFading + 1; frame < kFilmFrames; ++frame)
        film.takes[kOwn].run.frames[frame].numbers.w = 0.0013;
    EXPECT_NEAR(seen_of(film, film.takes[kOwn]).rest_ratio, 1.3, 1e-9) << "what stays restless is seen after the change";
}

Flown made_flown() {
    Flown flown;
    flown.frames = 8, flown.scenes = {"simple"};
    flown.films = {made_film()};
    Film optimised = made_film();
    optimised.chain = "optimised visibility";
    for (FrameRecord& record : optimised.takes[kOwn].run.frames)
        if (record.numbers.w) record.numbers.w = 0.001 + (*record.numbers.w - 0.001) / 2;
    flown.optimised = {optimised};
    for (size_t way = 0; way < kWays.size(); ++way)
        for (uint32_t side_px : kSides_px) {
            Point point;
            point.scene = "simple", point.method = kWays[way].name, point.side_px = side_px, point.frames = 8;
            point.p50_ms = 10.0 + double(way), point.triangles = way == kOwn ? 1010 : 1000;
            flown.points.push_back(point);
        }
    flown.combining = {{"simple", "fsi:paper", 512, 1, 1, 1, 0.5, 1, 1}, {"simple", "fsi", 512, 1, 3, 1, 0.5, 0.2, 0.1}};
    flown.drawbacks = {{"simple", {{1, "both <levels>", "triangles", {1.5, 1, 1}}}}};
    flown.pictures.push_back({7, "figure-7", "outlines", {2, 1, std::vector<uint8_t>(6)}});
    return flown;
}

const Target& named(const std::vector<Target>& targets, const std::string& begin) {
    return *std::find_if(targets.begin(), targets.end(), [&](const Target& one) { return one.name.rfind(begin, 0) == 0; });
}

TEST(FsiTargets, AreOfTheFilmsAndOfFigure8) {
    std::vector<Target> targets = targets_of(made_flown());
    EXPECT_NEAR(*named(targets, "pop index").measured[1], 3, 1e-3);
    EXPECT_NEAR(*named(targets, "W on entering").measured[1], 2.5, 1e-6);
    EXPECT_NEAR(*named(targets, "median W of a film").measured[1], 1, 1e-9);
    EXPECT_NEAR(*named(targets, "median W at rest").measured[1], 1, 1e-9);
    EXPECT_NEAR(*named(targets, "W of the frames of a change").measured[1], (3 + 7 * 2 + 5) / (21 + 8.0), 1e-9);
    EXPECT_NEAR(*named(targets, "triangles a frame").measured[1], 1.01, 1e-9);
    EXPECT_NEAR(*named(targets, "the combination pass").measured[1], 3, 1e-9);
    EXPECT_NEAR(*named(targets, "the combination pass").measured[0], 1, 1e-9);
    EXPECT_NEAR(*named(targets, "W of a change with an optimised").measured[1], 50, 1e-6);
    EXPECT_NEAR(*named(targets, "4,000 instances").measured[1], 15, 1e-9);
    for (const Target& target : targets) {
        bool is_missed = target.measured[1] && !target.is_reached(1);
        EXPECT_EQ(is_missed, !target.why.empty()) << target.name;
    }
}

TEST(FsiPage, HoldsEveryMethodAndFigure) {
    Flown flown = made_flown();
    RunSetup setup;
    std::vector<Chart> charts = charts_of(flown);
    std::string html = fsi_page_html({flown, setup, charts, true});
    for (const char* part : {"figure-8-simple.svg", "figure-2.svg", "images/figure-7.png", "both &lt;levels&gt;", "fsi:paper",
                             "dither", "SIMPLE, levels optimised visibility", "Putting two frames together", "Side by side"})
        EXPECT_NE(html.find(part), std::string::npos) << part;
    EXPECT_EQ(fsi_page_html({flown, setup, charts, false}).find("figure-8-simple.svg"), std::string::npos);
}

TEST(FsiTables, HaveARowEach) {
    Flown flown = made_flown();
    auto rows = [](const std::string& csv) { return std::count(csv.begin(), csv.end(), '\n') - 1; };
    EXPECT_EQ(rows(sizes_csv(flown.points)), std::ptrdiff_t(kWays.size() * std::size(kSides_px)));
    EXPECT_EQ(rows(films_csv(flown.films)), std::ptrdiff_t(kWays.size()));
    EXPECT_EQ(rows(combining_csv(flown.combining)), 2);
    EXPECT_NE(ramps_csv().find("\n0.25,0.5,1\n"), std::string::npos) << "one of the two is whole";
    EXPECT_NE(ramps_csv().find("\n0.75,1,0.5\n"), std::string::npos);
}

// At another size the same levels are drawn.
TEST(Figure8, AsksForAnErrorThatGrowsWithTheViewport) {
    MethodSpec small = spec_of(kWays[kOwn], settings_at({2, 1}, 256, kWays[kOwn]));
    MethodSpec large = spec_of(kWays[kOwn], settings_at({2, 1}, 1024, kWays[kOwn]));
    EXPECT_DOUBLE_EQ(setting(small, "error-px"), 1);
    EXPECT_DOUBLE_EQ(setting(large, "error-px"), 4);
}

}  // namespace
}  // namespace overlook::measure::paper::fsi
