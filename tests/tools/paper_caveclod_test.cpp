// What section 4 of the CAVECLOD paper is flown with, and what is made of the flyovers.
#include <gtest/gtest.h>

#include <set>

#include "tests/caveclod/synthetic_hierarchy.h"
#include "tools/measure/paper/caveclod/page.h"
#include "tools/measure/paper/caveclod/targets.h"

namespace overlook::measure::paper::cameras {
namespace {

std::vector<std::array<uint32_t, 4>> numbers_of(const std::vector<view::Part>& places) {
    std::vector<std::array<uint32_t, 4>> numbers;
    for (const view::Part& place : places) numbers.push_back({place.left_px, place.top_px, place.width_px, place.height_px});
    return numbers;
}

TEST(Screen, IsSharedAsSection41Says) {
    using Places = std::vector<std::array<uint32_t, 4>>;
    EXPECT_EQ(numbers_of(places_of(1, 800, 600)), (Places{{0, 0, 800, 600}}));
    EXPECT_EQ(numbers_of(places_of(2, 800, 600)), (Places{{0, 0, 800, 600}, {0, 0, 400, 300}}));
    EXPECT_EQ(numbers_of(places_of(3, 800, 600)), (Places{{0, 0, 400, 300}, {400, 0, 400, 300}, {0, 300, 400, 300}}));
    Places odd = numbers_of(places_of(4, 5, 3));
    EXPECT_EQ(odd, (Places{{0, 0, 2, 1}, {2, 0, 3, 1}, {0, 1, 2, 2}, {2, 1, 3, 2}}));
}

TEST(Screen, ShowsLaterCamerasOverEarlierOnes) {
    std::vector<view::Part> places = places_of(2, 4, 2);
    ImageRgb8 a{4, 2, std::vector<uint8_t>(24, 10)}, b{2, 1, std::vector<uint8_t>(6, 200)};
    ImageRgb8 screen = composed({a, b}, places, 4, 2);
    EXPECT_EQ(screen.pixels[0], 200);
    EXPECT_EQ(screen.pixels[3 * 2], 10) << "right of the second";
    EXPECT_EQ(screen.pixels[3 * 4], 10) << "below it";
    ImageRgb8 three = composed({b, b, b}, places_of(3, 4, 2), 4, 2);
    EXPECT_EQ(three.pixels.back(), 0) << "the fourth quadrant is empty";
}

TEST(Clips, AreAsManyFramesAsAreWantedEvenlyOverTheFlight) {
    for (uint32_t frames : {1u, 29u, 30u, 31u, 600u, 3841u}) {
        std::vector<Clip> clips = clips_of(3841, frames);
        uint32_t count = 0, last_end = 0;
        for (const Clip& clip : clips) {
            EXPECT_GE(clip.begin, last_end);
            EXPECT_LE(clip.end - clip.begin, kClipFrames);
            EXPECT_GT(clip.end, clip.begin);
            count += clip.end - clip.begin, last_end = clip.end;
        }
        EXPECT_EQ(count, frames);
        EXPECT_EQ(clips.front().begin, 0u);
        if (clips.size() > 1) {
            EXPECT_EQ(clips.back().end, 3841u) << frames;
        }
    }
    std::vector<Clip> whole = clips_of(100, 1000);
    for (size_t i = 1; i < whole.size(); ++i) EXPECT_EQ(whole[i].begin, whole[i - 1].end) << "all of it, without gaps";
}

TEST(Clips, AreLedUpToAndSettledOnlyAfterAGap) {
    std::vector<uint32_t> settled, counted, led;
    std::vector<Clip> clips = {{0, 2}, {2, 4}, {100, 101}};
    over_frames(
        clips, true, [&](uint32_t frame) { settled.push_back(frame); },
        [&](uint32_t frame, bool is_counted) { (is_counted ? counted : led).push_back(frame); });
    EXPECT_EQ(settled, (std::vector<uint32_t>{0, 100 - kLeadFrames}));
    EXPECT_EQ(counted, (std::vector<uint32_t>{0, 1, 2, 3, 100}));
    ASSERT_EQ(led.size(), 2 * kLeadFrames);
    EXPECT_EQ(led[0], 0u);
    EXPECT_EQ(led[kLeadFrames - 1], 0u) << "the cameras stand where the flight begins";
    EXPECT_EQ(led[kLeadFrames], 100 - kLeadFrames);
    EXPECT_EQ(led.back(), 99u);
}

// n, d of the printed rows by hand: 643,064 = 4n + 4 * 80,000 + 16, and so on.
TEST(Table1, HoldsTheNumbersThatThePaperDoesNotPrint) {
    EXPECT_EQ(solved(kThreeLakes).nodes, 80'762);
    EXPECT_EQ(solved(kThreeLakes).vertices, 42'732);
    EXPECT_TRUE(solved(kThreeLakes).is_whole());
    EXPECT_EQ(solved(kCliff).nodes, 108'084);
    EXPECT_EQ(solved(kCliff).vertices, 55'838);
    EXPECT_TRUE(solved(kCliff).is_whole());
    EXPECT_EQ(solved(kCanyon).nodes, 127'562);
    EXPECT_FALSE(solved(kCanyon).is_whole()) << "its printed value fits no grid";
    EXPECT_EQ(printed_of("canyon"), &kCanyon);
    EXPECT_EQ(printed_of("hills"), nullptr);
    double share = 0;
    for (const PrintedTerrain* terrain : {&kThreeLakes, &kCliff, &kCanyon})
        share += double(terrain->camera_bytes) / double(terrain->static_bytes) / 3;
    EXPECT_NEAR(share, Printed::kCameraShare, 5e-4);
}

scene::Flight flight_of(double x_m, double heading_deg) {
    scene::Flight flight;
    flight.keys = {{0, {x_m, 4, 9}, heading_deg, -20, {}}, {4, {x_m + 8, 30, 9}, heading_deg + 20, -20, {}}};
    return flight;
}

// Hills of 40 x 40 cells in two surfaces, and four cameras that look different ways.
Subject make_subject() {
    World world;
    MeshWorld& made = world.mesh.emplace();
    made.hierarchy = std::make_unique<caveclod::Hierarchy>(caveclod::synthetic::bake(caveclod::synthetic::hills(40, 40, 2)));
    made.mesh = std::make_unique<caveclod::Mesh>(*caveclod::Mesh::make(*made.hierarchy));
    world.base.near_m = 0.1;
    Subject subject{"hills", std::move(world), nullptr, {}, {}, {}, {}};
    subject.printed = std::make_unique<caveclod::paper::Mesh>(*subject.world.mesh->hierarchy);
    for (uint32_t i = 0; i < kMostCameras; ++i) subject.flights[i] = flight_of(6.0 + 8 * i, 90.0 * i);
    return subject;
}

const Subject& small_subject() {
    static const Subject kSubject = make_subject();
    return kSubject;
}

Flying small_flying() {
    Flying flying;
    flying.width_px = 80, flying.height_px = 60, flying.frames = 45;
    return flying;
}

uint64_t operations_of(const Flyover& flyover) {
    uint64_t sum = 0;
    for (const FlownFrame& frame : flyover.frames)
        for (const CameraRecord& camera : frame.cameras) sum += camera.split_count + camera.collapse_count;
    return sum;
}

TEST(Flyovers, CountEveryOperationOfEveryCamera) {
    const Subject& subject = small_subject();
    Flyover own = fly(subject, small_flying(), Way::own, 4);
    ASSERT_EQ(own.frames.size(), 45u);
    ASSERT_EQ(own.frames[0].cameras.size(), 4u);
    EXPECT_NEAR(operations_per_s(own) * 45 * own.step_s * 4, double(operations_of(own)), 1e-6);
    EXPECT_GT(operations_of(own), 0u);
    size_t windows = 0;
    for (const Window& window : windows_of(own)) windows += window.frames.size();
    EXPECT_EQ(windows, 45u);
}

TEST(Flyovers, OfOneRefinementForAllTakeMoreOperationsAndDrawAsMuch) {
    const Subject& subject = small_subject();
    Flyover own = fly(subject, small_flying(), Way::own, 4), shared = fly(subject, small_flying(), Way::shared, 4);
    EXPECT_GT(operations_of(shared), 2 * operations_of(own));
    EXPECT_NEAR(mean_faces(shared) / mean_faces(own), 1, 0.2);
    EXPECT_EQ(shared.frames[0].cameras[1].memory.active_bytes, 0u) << "the first keeps what all share";
}

TEST(Flyovers, UseMoreVerticesTheMoreCamerasLookAtOneSize) {
    const Subject& subject = small_subject();
    Flyover three = fly(subject, small_flying(), Way::own, 3), four = fly(subject, small_flying(), Way::own, 4);
    EXPECT_GT(mean_used_share(four), mean_used_share(three));
    EXPECT_LE(mean_used_share(four), 1);
    Flyover printed = fly(subject, small_flying(), Way::printed, 4);
    EXPECT_GT(mean_used_share(printed), 0);
}

TEST(Flyovers, AreTheSameEveryTime) {
    const Subject& subject = small_subject();
    for (Way way : kWays) {
        Flyover a = fly(subject, small_flying(), way, 2), b = fly(subject, small_flying(), way, 2);
        for (size_t i = 0; i < a.frames.size(); ++i)
            for (size_t camera = 0; camera < 2; ++camera) {
                ASSERT_EQ(a.frames[i].cameras[camera].split_count, b.frames[i].cameras[camera].split_count) << name_of(way);
                ASSERT_EQ(a.frames[i].cameras[camera].face_count, b.frames[i].cameras[camera].face_count) << name_of(way);
            }
    }
}

TEST(Speed, IsOfTheSameFacesOnAnyNumberOfThreads) {
    const Subject& subject = small_subject();
    Speed speed = measure_speed(subject, small_flying(), [](double) {});
    EXPECT_TRUE(speed.is_same);
    EXPECT_GT(speed.own_faces, 0);
    EXPECT_GT(speed.gain(), 0);
    EXPECT_GT(speed.bandwidth_gb_s, 0.1);
    EXPECT_EQ(least_bytes({3, 2, 10, 0, {}}, 800), 100 + 10 * 16 + 5 * 72);
}

// One terrain, every way with one to four cameras.
Flown make_flown() {
    const Subject& subject = small_subject();
    Flown flown;
    flown.flying = small_flying();
    flown.flight_s = 4;
    FlownSubject one;
    one.name = "canyon";
    one.face_count = subject.mesh().face_count();
    one.split_count = subject.mesh().split_count();
    one.memory = {"canyon", printed_of("canyon"), counted_of(subject)};
    one.step_s = subject.step_s();
    for (Way way : kWays)
        for (uint32_t cameras = 1; cameras <= kMostCameras; ++cameras)
            one.flyovers.push_back(fly(subject, flown.flying, way, cameras));
    one.pictures.push_back({9, "figure-9", "three <cameras>", {2, 1, std::vector<uint8_t>(6)}});
    flown.subjects.push_back(std::move(one));
    flown.rates = {{1, 50, 10}, {2, 100, 20}};
    flown.speed = {2, 30, 20, true, 4, 40, 1e6, 1e6, 3e6, 10};
    return flown;
}

const Flown& small_flown() {
    static const Flown kFlown = make_flown();
    return kFlown;
}

TEST(Table1, IsCountedByEquation1) {
    Flown flown = small_flown();
    const Counted& is = flown.subjects[0].memory.counted;
    EXPECT_EQ(is.polygons, 3200u);
    EXPECT_EQ(is.terms.static_bytes(), 44 * is.nodes + 12 * is.polygons + 32 * is.vertices + 2 * is.ids * is.positions);
    EXPECT_EQ(is.terms.cameras, 4 * is.nodes + 4 * is.polygons + 16);
    EXPECT_EQ(is.ids, 2u);
    EXPECT_GT(is.population, 0.5);
    EXPECT_LT(is.population, 0.6) << "two groups that share one column of positions";
    std::string html = table1_html({flown.subjects[0].memory});
    EXPECT_NE(html.find("9,297,526"), std::string::npos);
    EXPECT_NE(html.find("63736.41"), std::string::npos) << html;
    EXPECT_NE(table1_csv({flown.subjects[0].memory}).find("\ncanyon,"), std::string::npos);
}

TEST(CaveclodTargets, AreCountedFromTheFlyovers) {
    Flown flown = small_flown();
    std::vector<Target> targets = targets_of(flown);
    ASSERT_EQ(targets.size(), 6u);
    EXPECT_DOUBLE_EQ(*targets[0].measured[1], *operations_ratio(flown.subjects[0], Way::own, 4));
    EXPECT_NEAR(*targets[2].measured[0], 42, 3) << "12 bytes a node and 36 a polygon, half as many nodes as polygons";
    EXPECT_DOUBLE_EQ(*targets[4].measured[1], 1.5);
    EXPECT_DOUBLE_EQ(*targets[5].measured[1], 4);
    EXPECT_DOUBLE_EQ(*targets[5].measured[0], 40);
    for (const Target& target : targets) {
        bool is_missed = target.measured[1] && !target.is_reached(1);
        EXPECT_EQ(is_missed, !target.why.empty()) << target.name;
    }
    EXPECT_FALSE(targets[4].is_reached(1));
    flown.speed.is_same = false;
    EXPECT_FALSE(targets_of(flown)[4].measured[1]) << "a time for other faces is none";
}

TEST(CaveclodPage, HoldsEveryFigureWithThePapersNumbers) {
    Flown flown = small_flown();
    RunSetup setup;
    std::vector<Chart> charts = charts_10_to_14(flown);
    std::string html = caveclod_page_html({flown, setup, charts, true});
    for (const char* part : {"figure-10", "figure-11", "figure-12", "figure-13", "figure-14", "images/figure-9.png", "14,868",
                             "1,016,184", "three &lt;cameras&gt;", "7 % of the picture", "Section 4.4", "class=\"broken\">1.5<"})
        EXPECT_NE(html.find(part), std::string::npos) << part;
    EXPECT_NEAR(mean_fps(flown.rates, &Rate::with_fps), 66.67, 0.01) << "frames over seconds";
    EXPECT_EQ(caveclod_page_html({flown, setup, charts, false}).find("figure-12.svg"), std::string::npos);
}

TEST(CaveclodTables, HaveARowEach) {
    Flown flown = small_flown();
    auto rows = [](const std::string& csv) { return std::count(csv.begin(), csv.end(), '\n') - 1; };
    EXPECT_EQ(rows(flyovers_csv(flown)), 4 * 4);
    EXPECT_EQ(rows(windows_csv(flown)), 4 * (1 + 2 + 3 + 4) * 2) << "45 frames are two windows";
    EXPECT_EQ(rows(memory_csv(flown)), 4 * 4 * 2);
    EXPECT_EQ(rows(frame_rates_csv(flown)), 2);
}

}  // namespace
}  // namespace overlook::measure::paper::cameras
