// Tables, JSON and page of a run made by hand.
#include <gtest/gtest.h>

#include <cstdlib>

#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "tests/formats/schema_faults.h"
#include "tests/formats/scratch_folder.h"
#include "tests/tools/measure_made_course.h"
#include "tools/measure/deliver.h"
#include "tools/measure/figures.h"
#include "tools/measure/page.h"
#include "tools/measure/page_text.h"

namespace overlook::measure {
namespace {

using Json = nlohmann::json;

RunSetup a_setup() {
    RunSetup setup;
    setup.version = "1.2.3";
    setup.command = {"measure", "a scene.json", "--method", "<b>&\"x\""};
    setup.scene = "<scene>.json";
    setup.scene_hash = setup.flight_hash = std::string(32, 'a');
    setup.flight = "f.json";
    setup.processor = "A processor";
    setup.processor_threads = 2;
    setup.renderer = {"llvmpipe", "4.5", true};
    setup.width_px = setup.height_px = 4;
    setup.step_s = 0.5;
    return setup;
}

std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(csv);
    for (std::string line; std::getline(lines, line);) {
        rows.emplace_back(1);
        for (char c : line) {
            if (c == ',')
                rows.back().emplace_back();
            else
                rows.back().back() += c;
        }
    }
    return rows;
}

std::string cell(const std::vector<std::vector<std::string>>& rows, size_t row, const std::string& column) {
    auto found = std::find(rows[0].begin(), rows[0].end(), column);
    EXPECT_NE(found, rows[0].end()) << column;
    return found == rows[0].end() ? "" : rows[row][size_t(found - rows[0].begin())];
}

TEST(FramesTable, HasARowForEveryFrameOfEveryRun) {
    auto rows = rows_of(frames_csv(a_course(), 0.5));
    ASSERT_EQ(rows.size(), 31u);
    for (const auto& row : rows) EXPECT_EQ(row.size(), 3 + figures().size());
    EXPECT_EQ(cell(rows, 1, "run"), "terrain@error-px=1@samples=4@morph=0.5");
    EXPECT_EQ(cell(rows, 4, "frame"), "3");
    EXPECT_EQ(cell(rows, 4, "time_s"), "1.5");
    EXPECT_EQ(cell(rows, 4, "frame_ms"), "8");
    EXPECT_EQ(cell(rows, 30, "triangles"), "1009");
    EXPECT_EQ(cell(rows, 30, "run"), "full@samples=4");
}

TEST(FramesTable, LeavesEmptyWhatWasNotTaken) {
    auto rows = rows_of(frames_csv(a_course(), 0.5));
    EXPECT_EQ(cell(rows, 1, "w_luma"), "");
    EXPECT_EQ(cell(rows, 2, "e_p99_flip"), "");
    EXPECT_DOUBLE_EQ(std::stod(cell(rows, 6, "e_p99_flip")), 0.205);
}

TEST(FramesTable, NamesTheUnitOfEveryNumberThatHasOne) {
    static const std::regex kCounts(
        "triangles|key_triangles|key_pixels|vertex_references|draw_calls|tested|events|transitions|operations|wrong_corners|luma_difference|"
        "samples_warped|tiles|outside_tiles|missing_images|"
        "g_max|g_median|g_above");
    for (const Figure& one : figures()) {
        std::string name(one.name);
        bool has_unit = std::regex_search(name, std::regex("_(ms|px|bytes|db|luma|flip|share)$"));
        EXPECT_TRUE(has_unit || std::regex_match(name, kCounts)) << name;
    }
}

TEST(RunsTable, HasWhatTheChartsDraw) {
    auto rows = rows_of(runs_csv(a_course()));
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_EQ(cell(rows, 2, "pop_index"), "3");
    EXPECT_EQ(cell(rows, 1, "frame_ms_p50"), "9");
    EXPECT_DOUBLE_EQ(std::stod(cell(rows, 1, "e_p99_flip")), 0.205);
    EXPECT_EQ(cell(rows, 3, "is_floor"), "1");
}

TEST(HonestyTable, HasARowForEveryStepOfWhatWasPromised) {
    auto rows = rows_of(honesty_csv(a_course()));
    ASSERT_EQ(rows.size(), 3u);  // half a pixel and one; of nothing promised there is no ratio
    EXPECT_EQ(cell(rows, 1, "method"), "terrain");
    EXPECT_EQ(cell(rows, 1, "things"), "4");  // two runs of two frames
    EXPECT_NEAR(std::stod(cell(rows, 1, "promised_px")), 0.5, 0.1);
    EXPECT_DOUBLE_EQ(std::stod(cell(rows, 1, "measured_p50_px")), 0.5 * std::stod(cell(rows, 1, "promised_px")));
    EXPECT_EQ(cell(rows, 2, "worst_px"), "0.75");
    EXPECT_EQ(cell(rows, 2, "worst_promised_px"), "1");
}

std::vector<std::string> faults_of(const Json& runs) {
    return test::faults_of(runs, "runs.schema.json");
}

TEST(RunsJson, KeepsItsSchema) {
    EXPECT_EQ(faults_of(Json::parse(runs_json(a_course(), a_setup()))), std::vector<std::string>());
}

TEST(RunsJson, WithoutPicturesKeepsItsSchema) {
    CourseResult course = a_course();
    RunSetup setup = a_setup();
    setup.is_wall_clock = true;
    for (RunResult& run : course.runs) {
        run.worst_e = run.worst_w = {};
        for (FrameRecord& frame : run.frames) frame.numbers = {};
    }
    Json runs = Json::parse(runs_json(course, setup));
    EXPECT_EQ(faults_of(runs), std::vector<std::string>());
    EXPECT_TRUE(runs["runs"][0]["gates"].empty());
}

TEST(RunsJson, OfAnotherFormDoesNotKeepTheSchema) {
    Json runs = Json::parse(runs_json(a_course(), a_setup()));
    for (const char* place : {"/form_version", "/runs/0/summary/frame_ms/p99", "/machine/is_software", "/runs/1/gates"}) {
        Json other = runs;
        other[Json::json_pointer(place)] = "other";
        EXPECT_EQ(faults_of(other).size(), 1u) << place;
    }
    runs["date"] = "today";
    EXPECT_EQ(faults_of(runs), std::vector<std::string>{": has date"});
}

TEST(Sentences, SayHowBadAWorstFrameIsAndWhere) {
    CourseResult course = a_course();
    EXPECT_EQ(worst_sentence(course.runs[1], course.runs[2], true),
              "Frame 5: E 0.405, 3.86 times the floor's 0.105 on the same frame; the greatest part of it (100 %) lies in the "
              "upper left ninth of "
              "the picture.");
    course.runs[1].worst_w.map.assign(16, 0.0f);
    EXPECT_EQ(worst_sentence(course.runs[1], course.runs[2], false),
              "Frame 3: W 0.04, 4 times the floor's 0.01 on the same frame; nothing differs.");
}

TEST(Sentences, NameTheCheapestAtTheFloorOrTheNearest) {
    CourseResult course = a_course();
    EXPECT_NE(chart_sentence("front_ms", course)
                  .find("None is at the floor (within 1.02 times its E); the nearest is "
                        "terrain@error-px=1@samples=4@morph=0.5 at 1.95 times."),
              std::string::npos)
        << chart_sentence("front_ms", course);
    course.runs[0] = run_of(course.runs[0].spec, 5, 0.1);
    course.runs[0].floor = 2;
    EXPECT_NE(chart_sentence("front_ms", course)
                  .find("The cheapest at the floor (within 1.02 times its E) is "
                        "terrain@error-px=1@samples=4@morph=0.5, for 0.167 of the floor's cost."),
              std::string::npos)
        << chart_sentence("front_ms", course);
}

TEST(Sentences, SayWhetherEveryPromiseIsKept) {
    CourseResult course = a_course();
    EXPECT_EQ(
        chart_sentence("promise", course),
        "Of 12 triangles in 4 frames of 2 runs, none lie farther from a source sample that they cover than was promised of "
        "them; the greatest share of a promise used is 0.75 (terrain@error-px=1@samples=4@morph=0.5). Nothing at all was "
        "promised of 4: "
        "none of them are out of place. The median triangle uses 0.5, in terrain@error-px=1@samples=4@morph=0.5 0.5; under 0.3 a "
        "promise is called idle. Every promise is kept.");
    course.runs[1].g.add(std::vector<float>{2}, std::vector<float>{3});
    std::string text = chart_sentence("promise", course);
    EXPECT_NE(text.find("1 lie farther"), std::string::npos) << text;
    EXPECT_NE(text.find("used is 1.5 (terrain@error-px=4@samples=4@morph=0.5)"), std::string::npos) << text;
    EXPECT_NE(text.find("Not every promise is kept."), std::string::npos) << text;
}

std::set<std::string> links_of(const std::string& html) {
    static const std::regex kLink("(?:href|src|srcset)=\"([^\"]*)\"");
    std::set<std::string> links;
    for (std::sregex_iterator at(html.begin(), html.end(), kLink), end; at != end; ++at) links.insert((*at)[1]);
    return links;
}

TEST(Page, LinksOnlyToWhatLiesBesideIt) {
    ScratchFolder folder;
    command::Common common;
    common.quiet = true;
    Result<void> delivered = deliver(a_course(), a_setup(), folder.path(), common);
    ASSERT_TRUE(delivered) << delivered.error().message;
    std::string html = text_of_file(folder / "index.html");
    std::set<std::string> links = links_of(html);
    EXPECT_GT(links.size(), 8u);
    for (const std::string& link : links) EXPECT_TRUE(std::filesystem::exists(folder / link)) << link;
    for (const char* outside : {"http:", "https:", "//", "@import", "url(", "<script"}) {
        EXPECT_EQ(html.find(outside), std::string::npos) << outside;
    }
}

TEST(Page, NamesEveryRunAndEveryWorstFrame) {
    CourseResult course = a_course();
    std::string html = page_html({course, a_setup(), charts_of(course), true});
    // A label is cut into what may not be broken.
    std::string plain = std::regex_replace(html, std::regex("<wbr>|</?span>"), "");
    for (const RunResult& run : course.runs) {
        std::string name = "<span class=\"name\">" + run.label;
        EXPECT_NE(plain.find("<th scope=\"row\">" + name + "</th>"), std::string::npos) << run.label;
        EXPECT_NE(plain.find("<h3>" + name + "</h3>"), std::string::npos) << run.label;
        for (bool is_e : {true, false}) {
            std::string sentence = escaped(worst_sentence(run, course.runs[run.floor], is_e));
            EXPECT_NE(html.find(sentence), std::string::npos) << sentence;
        }
    }
    EXPECT_NE(html.find("pop_index 3 &gt; 1.2"), std::string::npos);
}

TEST(Page, SaysThatAProcessorDrew) {
    CourseResult course = a_course();
    RunSetup setup = a_setup();
    EXPECT_NE(page_html({course, setup, {}, true}).find("software OpenGL"), std::string::npos);
    setup.renderer.is_software = false;
    EXPECT_EQ(page_html({course, setup, {}, true}).find("software OpenGL"), std::string::npos);
}

TEST(Page, TakesNoMarkupFromNames) {
    CourseResult course = a_course();
    std::string html = page_html({course, a_setup(), {}, true});
    EXPECT_EQ(html.find("<scene>"), std::string::npos);
    EXPECT_EQ(html.find("<b>"), std::string::npos);
    EXPECT_NE(html.find("'a scene.json'"), std::string::npos);
}

TEST(Page, SaysWhenThereAreNoCharts) {
    CourseResult course = a_course();
    std::string html = page_html({course, a_setup(), charts_of(course), false});
    EXPECT_NE(html.find("gnuplot was not installed"), std::string::npos);
    EXPECT_EQ(html.find("charts/front_ms.svg"), std::string::npos);
}

// Whatever settings stand after the one that is swept.
TEST(Charts, AreDrawnOfRunsWithAnySettings) {
    if (std::system("command -v gnuplot >/dev/null 2>&1") != 0) GTEST_SKIP() << "gnuplot is not installed: no chart was drawn";
    CourseResult course = a_course();
    course.runs[0] = run_of(*parse_method("caveclod@triangles=10000@cameras=3@glide-s=0"), 5, 0.2);
    course.runs[1] = run_of(*parse_method("caveclod@error-px=2@cameras=4@operations=7"), 5, 0.2);
    for (RunResult& run : course.runs) run.floor = 2;
    ScratchFolder folder;
    ASSERT_TRUE(write_file(folder / "runs.csv", std::string_view(runs_csv(course))));
    std::vector<Chart> fronts = charts_of(course);
    std::erase_if(fronts, [](const Chart& chart) { return !chart.name.starts_with("front"); });
    ASSERT_EQ(fronts.size(), 2u);
    Result<bool> drawn = draw_charts(fronts, folder.path());
    ASSERT_TRUE(drawn) << drawn.error().message;
    EXPECT_TRUE(*drawn);
}

TEST(Charts, AreTheSameEveryTime) {
    std::vector<Chart> once = charts_of(a_course()), again = charts_of(a_course());
    ASSERT_EQ(once.size(), 5u);
    for (size_t i = 0; i < once.size(); ++i) EXPECT_EQ(once[i].script, again[i].script);
}

}  // namespace
}  // namespace overlook::measure
