// What the page on tiling layered depth images is made of.
#include <gtest/gtest.h>

#include <cmath>

#include "formats/atomic_file.h"
#include "tests/formats/scratch_folder.h"
#include "tools/measure/page_text.h"
#include "tools/measure/paper/wang_ldi/page.h"
#include "tools/measure/paper/wang_ldi/targets.h"

namespace overlook::measure::paper::wang {
namespace {

view::Camera camera_at(double x_m) {
    view::Camera camera;
    camera.position_m = {x_m, 0, 0}, camera.width_px = 64, camera.height_px = 48, camera.near_m = 0.1;
    return camera;  // looks north
}

// A wall 10 m to the north and before it, 5 m away, a post of the middle metre.
wang_ldi::Warped seen_from(double x_m) {
    view::Camera camera = camera_at(x_m);
    wang_ldi::Warped seen;
    seen.clear(64, 48);
    double focal = view::focal_px(camera);
    for (uint32_t p = 0; p < 64 * 48; ++p) {
        double tangent = (p % 64 + 0.5 - 32) / focal;
        bool is_post = std::abs(x_m + 5 * tangent) < 0.5;
        seen.colours[p] = is_post ? 0xff0000ff : 0xffff0000, seen.depth_m[p] = is_post ? 5 : 10;
    }
    return seen;
}

TEST(OneLdi, ShowsFromItsOwnPlaceWhatWasSeenThere) {
    OneLdi one(camera_at(0));
    one.add(camera_at(0), seen_from(0));
    EXPECT_EQ(one.sample_count(), 64u * 48);
    EXPECT_EQ(one.most_layers(), 1u);
    wang_ldi::Warped drawn;
    drawn.clear(64, 48);
    one.draw(camera_at(0), drawn);
    EXPECT_TRUE(drawn.colours == seen_from(0).colours);
    Broken broken = broken_of(seen_from(0), drawn);
    EXPECT_EQ(broken.hole_share, 0);
    EXPECT_EQ(broken.wrong_share, 0);
    one.add(camera_at(0), seen_from(0));
    EXPECT_EQ(one.sample_count(), 64u * 48) << "what is there is not added again";
}

TEST(OneLdi, LosesFromAsideWhatNoEyeSawAndLessWhereMoreEyesDid) {
    auto broken_from_aside = [](const std::vector<double>& eyes) {
        OneLdi one(camera_at(0));
        for (double x_m : eyes) one.add(camera_at(x_m), seen_from(x_m));
        wang_ldi::Warped drawn;
        drawn.clear(64, 48);
        one.draw(camera_at(0.5), drawn);
        EXPECT_EQ(one.most_layers(), eyes.size() > 1 ? 2u : 1u);
        return broken_of(seen_from(0.5), drawn).hole_share;
    };
    double of_one = broken_from_aside({0}), of_three = broken_from_aside({0, 0.5, -0.5});
    // Two columns of 64 lie beyond its rim, two more behind the post as one eye saw it.
    EXPECT_DOUBLE_EQ(of_one, 4.0 / 64);
    EXPECT_DOUBLE_EQ(of_three, 2.0 / 64);
}

TEST(Broken, CountsHolesAndWrongDepthsOfWhatShouldBeThereAlone) {
    wang_ldi::Warped truth, picture;
    truth.clear(4, 1), picture.clear(4, 1);
    truth.colours = {1, 1, 1, 0}, truth.depth_m = {10, 10, 10, INFINITY};
    picture.colours = {0, 1, 1, 1}, picture.depth_m = {INFINITY, 10.4f, 12, 3};
    Broken broken = broken_of(truth, picture);
    EXPECT_DOUBLE_EQ(broken.hole_share, 1.0 / 3);
    EXPECT_DOUBLE_EQ(broken.wrong_share, 1.0 / 3);
}

BakeReport report_of(double unseen, double holes) {
    BakeReport report;
    report.tiles = 8, report.correlation = -0.002, report.objects = 160, report.method = "corners", report.relative_radius = 0.75;
    report.density_corner = 0.97, report.density_edge = 1.02, report.density_inside = 1.01, report.distance_step_m = 0.2;
    report.density_by_corner_distance = {0, 0.5}, report.density_by_edge_distance = {1, 1};
    ImagesReport images;
    images.seconds = 600, images.directions = 8;
    images.all.samples = 1000, images.all.bytes = 2000;
    LevelReport level;
    level.side_px = 300, level.unseen_share_mean = unseen, level.own = Judged{2 * holes, holes, 0.01, 0.3, 0.8, 0.31};
    images.levels = {level};
    report.images = images;
    return report;
}

Flown flown() {
    Flown flown;
    Plants plants;
    plants.name = "sunflowers";
    plants.paper = report_of(0.15, 0.08), plants.own = report_of(0.019, 0.004);
    plants.paper.density_corner = 0.2;
    flown.plants.push_back(std::move(plants));
    return flown;
}

const Target& target_of(const std::vector<Target>& targets, const std::string& part) {
    auto found =
        std::find_if(targets.begin(), targets.end(), [&](const Target& one) { return one.name.find(part) != std::string::npos; });
    EXPECT_NE(found, targets.end()) << part;
    return found == targets.end() ? targets.front() : *found;
}

TEST(Targets, AreOfTheFinestLevelAndSayWhyTheyAreMissed) {
    std::vector<Target> targets = targets_of(flown());
    for (const Target& target : targets) EXPECT_EQ(target.measured.size(), target_columns().size()) << target.name;
    const Target& unseen = target_of(targets, "unseen");
    EXPECT_DOUBLE_EQ(*unseen.measured[0], 15);
    EXPECT_FALSE(unseen.is_reached(0));
    EXPECT_TRUE(unseen.is_reached(1));
    const Target& holes = target_of(targets, "show nothing");
    EXPECT_DOUBLE_EQ(*holes.measured[1], 0.4);
    EXPECT_FALSE(holes.is_reached(1));
    EXPECT_NE(holes.why.find("1.9 %"), std::string::npos) << holes.why;
    EXPECT_EQ(holes.note, "Before any are filled 16 and 0.8");
    EXPECT_FALSE(target_of(targets, "foreign").measured[1]);
    EXPECT_EQ(target_of(targets, "minutes").printed, "64 h (500 MHz)");
    EXPECT_DOUBLE_EQ(*target_of(targets, "farthest off the mean").measured[0], 0.8);
    EXPECT_TRUE(target_of(targets, "correlation").is_reached(1)) << "a negative one counts by how great it is";
}

TEST(Page, HoldsATableOfEveryPlantsAndNoMoreThanWasMeasured) {
    Flown one = flown();
    one.plants[0].own.images->levels[0].own.reset();
    std::vector<Chart> charts = charts_of(one);
    EXPECT_EQ(charts.size(), 2u);
    std::string page = wang_page_html({one, {}, charts, false});
    for (const char* part : {"Figure 2: sunflowers", "not measured", "gnuplot was not installed", "a single tile"})
        EXPECT_NE(page.find(part), std::string::npos) << part;
    EXPECT_EQ(page.find("Glossy plants"), std::string::npos);
    one.plants[0].gloss = report_of(0, 0), one.plants[0].gloss_none = report_of(0, 0);
    for (auto* report : {&one.plants[0].gloss, &one.plants[0].gloss_none})
        (*report)->images->all.own = Judged{0, 0, 0, 0.375, 0.8125, 0};
    std::string glossy = wang_page_html({one, {}, charts, false});
    EXPECT_NE(glossy.find("Glossy plants"), std::string::npos);
    EXPECT_NE(glossy.find(short_number(0.8125)), std::string::npos);
    std::string levels = levels_csv(one);
    EXPECT_NE(levels.find("sunflowers,paper,300,0,0,0,0,0,0.15,0.16,0.08,0.01,0.3,0.8,0.31,,,,,,\n"), std::string::npos)
        << levels;
    EXPECT_NE(levels.find("sunflowers,own,300,0,0,0,0,0,0.019,,,,,,,,,,,,\n"), std::string::npos) << levels;
    EXPECT_NE(planting_csv(one).find("sunflowers,own,corner,0.30000000000000004,0.5\n"), std::string::npos);
}

TEST(Report, ThatIsNoneIsRefusedWithItsFile) {
    ScratchFolder folder;
    for (const char* text : {"", "[]", "{}", "{\"tiles\": {\"count\": \"eight\"}, \"planting\": {}}"}) {
        std::string path = folder / "a.json";
        ASSERT_TRUE(write_file(path, std::string_view(text)));
        auto report = read_report(path);
        ASSERT_FALSE(report);
        EXPECT_EQ(report.error().exit, Exit::bad_input);
        EXPECT_TRUE(report.error().message.starts_with(path + ": is not what bake-wang-ldi --json says: "))
            << report.error().message;
    }
}

}  // namespace
}  // namespace overlook::measure::paper::wang
