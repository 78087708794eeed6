// What the page on tiling layered depth images is made of.
#include <gtest/gtest.h>

#include <cmath>

#include "formats/atomic_file.h"
#include "runtime/wang_ldi/perspective_warp.h"
#include "tests/formats/scratch_folder.h"
#include "tools/measure/page_text.h"
#include "tools/measure/paper/wang_ldi/broken.h"
#include "tools/measure/paper/wang_ldi/page.h"
#include "tools/measure/paper/wang_ldi/targets.h"

namespace overlook::measure::paper::wang {
namespace {

TEST(Broken, CountsHolesAndWrongDepthsOfWhatShouldBeThereAlone) {
    wang_ldi::Warped truth, picture;
    truth.clear(4, 1), picture.clear(4, 1);
    truth.colours = {1, 1, 1, 0}, truth.depth_m = {10, 10, 10, INFINITY};
    picture.colours = {0, 1, 1, 1}, picture.depth_m = {INFINITY, 10.4f, 12, 3};
    Broken broken = broken_of(truth, picture);
    EXPECT_DOUBLE_EQ(broken.hole_share, 1.0 / 3);
    EXPECT_DOUBLE_EQ(broken.wrong_share, 1.0 / 3);
}

// A wall 10 m to the north of an image's eye, seen from 2 m beside it: what lies beyond the image's rim is told from what is
// hidden.
TEST(Holes, AreToldApartByWhetherTheImageCouldHaveThem) {
    wang_ldi::PerspectiveView image;
    image.width_px = 64, image.height_px = 48, image.fov_y_deg = 60;
    view::Camera there = wang_ldi::camera_of(image);
    there.position_m.x = 2;
    wang_ldi::Warped truth, picture;
    truth.clear(64, 48), picture.clear(64, 48);
    for (size_t p = 0; p < 64 * 48; ++p) truth.colours[p] = 1, truth.depth_m[p] = 10;
    for (uint32_t row = 0; row < 48; ++row) picture.colours[row * 64 + 20] = 1;
    HoleCauses causes = causes_of_holes(there, image, truth, picture);
    // 2 m are 8.3 columns at 10 m: those of the last eight, whose middles lie beyond the rim.
    EXPECT_DOUBLE_EQ(causes.beyond_share, 8.0 / 64);
    EXPECT_DOUBLE_EQ(causes.hidden_share, 55.0 / 64);
    image.far_m = 9;
    EXPECT_DOUBLE_EQ(causes_of_holes(there, image, truth, picture).hidden_share, 0);
}

TEST(Errors, AreOfThePixelsInWhichEitherShowsSomething) {
    wang_ldi::Warped truth, picture;
    truth.clear(40, 30), picture.clear(40, 30);
    truth.colours[15 * 40 + 3] = 0xff0000ff, picture.colours[15 * 40 + 30] = 0xff00ff00;
    EXPECT_EQ(errors_of(truth, picture).size(), 2u);
    for (double error : errors_of(truth, picture)) EXPECT_GT(error, 0.1);
    EXPECT_EQ(errors_of(truth, truth), std::vector<double>(1, 0.0));
    EXPECT_DOUBLE_EQ(differing_share(truth, picture), 2.0 / 1200);
    EXPECT_EQ(differing_share(truth, truth), 0);
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
    level.side_px = 300, level.unseen_share_mean = unseen, level.own = Judged{2 * holes, holes, 0.01, 0.3, 0.8, 0.31, {}, {}};
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
    Way one{"one LDI", 5000, 9000, {{0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 5000, 2}}};
    one.rows.push_back({4, 2, 0.5, 0.875, 0.25, 0.25, 0.125, 0.0625, 0.03125, 0, 5000, 3});
    plants.figure_2.ways = {one,
                            {"8 tiles", 7000, 14000, {{4, 2, 0.375, 0.75, 0.5, 0.0625, 0.03125, 0, 0.25, 0.015625, 6000, 4}}}};
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
    EXPECT_EQ(charts.size(), 3u);
    EXPECT_EQ(figure_2_csv(one).substr(figure_2_csv(one).find('\n') + 1),
              "sunflowers,\"one LDI\",0,1,0,0,0,0,0,0,0,0,5000,2,5000,9000\n"
              "sunflowers,\"one LDI\",4,2,0.5,0.875,0.25,0.25,0.125,0.0625,0.03125,0,5000,3,5000,9000\n"
              "sunflowers,\"8 tiles\",4,2,0.375,0.75,0.5,0.0625,0.03125,0,0.25,0.015625,6000,4,7000,14000\n");
    std::string page = wang_page_html({one, {}, charts, false});
    for (const char* part :
         {"Figure 2: sunflowers", "not measured", "gnuplot was not installed", "a single tile", "beyond its rim, %", "8 tiles"})
        EXPECT_NE(page.find(part), std::string::npos) << part;
    EXPECT_EQ(page.find("Glossy plants"), std::string::npos);
    one.plants[0].gloss = report_of(0, 0), one.plants[0].gloss_none = report_of(0, 0);
    for (auto* report : {&one.plants[0].gloss, &one.plants[0].gloss_none})
        (*report)->images->all.own = Judged{0, 0, 0, 0.375, 0.8125, 0, {}, {}};
    std::string glossy = wang_page_html({one, {}, charts, false});
    EXPECT_NE(glossy.find("Glossy plants"), std::string::npos);
    EXPECT_NE(glossy.find(short_number(0.8125)), std::string::npos);
    EXPECT_EQ(glossy.find("Things thinner"), std::string::npos);
    one.plants[0].every = report_of(0, 0);
    one.plants[0].every->images->all.own = Judged{0, 0, 0, 0.5, 0.75, 0, 2.5, 2.625};
    std::string thin = wang_page_html({one, {}, charts, false});
    EXPECT_NE(thin.find("Things thinner"), std::string::npos);
    for (double times : {2.5, 2.625}) EXPECT_NE(thin.find(short_number(times)), std::string::npos);
    std::string levels = levels_csv(one);
    EXPECT_NE(levels.find("sunflowers,paper,300,0,0,0,0,0,0.15,0.16,0.08,0.01,0.3,0.8,0.31,,,,,,,,,,\n"), std::string::npos)
        << levels;
    EXPECT_NE(levels.find("sunflowers,own,300,0,0,0,0,0,0.019,,,,,,,,,,,,,,,,\n"), std::string::npos) << levels;
    EXPECT_NE(planting_csv(one).find("sunflowers,own,corner,0.30000000000000004,0.5\n"), std::string::npos);
}

TEST(Race, IsWonByTheLeastOfItsRows) {
    Flown one = flown();
    FlownLand land;
    land.name = "hills";
    auto add = [&](const char* family, double x, double ms, std::optional<double> times) {
        FieldRow row{"race", family, times ? "up to 174 m" : "", x};
        row.ms_p50 = ms, row.own_times_as_fast = times;
        land.rows.push_back(row);
    };
    add("Overlook", 1, 100, {}), add(kByProcessor, 1, 250, 2.5), add(kByOpenGl, 1, 900, 9);
    add("Overlook", 2, 80, {}), add(kByProcessor, 2, 60, 0.75), add(kByOpenGl, 2, 400, 5);
    one.plants[0].lands = {land};
    std::vector<Target> targets = targets_of(one);
    const Target &race = target_of(targets, "as geometry by the processor"),
                 &opengl = target_of(targets, "as geometry by OpenGL");
    EXPECT_DOUBLE_EQ(*race.measured[1], 0.75);
    EXPECT_FALSE(race.measured[0]);
    EXPECT_FALSE(race.is_reached(1));
    EXPECT_EQ(race.note, "At 2 px, up to 174 m");
    EXPECT_DOUBLE_EQ(*opengl.measured[1], 5);
    EXPECT_TRUE(opengl.is_reached(1));
    std::string csv = fields_csv(one), head = csv.substr(0, csv.find('\n'));
    EXPECT_EQ(std::count(head.begin(), head.end(), ','), 25) << "charts take the ratio from column 26";
    EXPECT_NE(csv.find("sunflowers,hills,race,geometry by OpenGL,\"up to 174 m\",1,900,"), std::string::npos) << csv;
    EXPECT_NE(csv.find(",9\n"), std::string::npos) << csv;
    size_t at = csv.find("race,Overlook");
    std::string row = csv.substr(at, csv.find('\n', at) - at);
    EXPECT_EQ(std::count(row.begin(), row.end(), ','), 25 - 2) << row;
    std::string page = wang_page_html({one, {}, charts_of(one), true});
    EXPECT_NE(page.find("race-hills-sunflowers.svg"), std::string::npos);
    EXPECT_NE(page.find(short_number(0.75)), std::string::npos);
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
