// How a case's gates are held against what its runner found.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "formats/atomic_file.h"
#include "tests/formats/schema_faults.h"
#include "tests/formats/scratch_folder.h"
#include "tests/gl/stability_hills.h"
#include "tools/measure/stability/report.h"

namespace overlook::measure {
namespace {

Case two_gates() {
    Case each;
    each.number = "S03", each.what = "yaw", each.methods = each.runs = {"terrain"};
    each.gates = {{"hole_pixels", 0, "all", -1}, {"loss_share", 0.5, "all", -1}};
    return each;
}

std::vector<std::string> held_figures(const Case& each, const char* method) {
    std::vector<std::string> names;
    for (const HeldGate& gate : held_gates(each, *parse_method(method), {}, 1)) names.push_back(gate.figure);
    return names;
}

TEST(StabilityVerdict, MissesAGateWhoseFigureWasNotFound) {
    for (const char* method : {"terrain", "lod-sprite", "caveclod", "discrete:fsi", "wang-ldi"}) {
        Verdict verdict;
        verdict.spec = *parse_method(method);
        verdict.finding.figures["hole_pixels"] = 0;
        verdict.gates = held_gates(two_gates(), verdict.spec, verdict.finding, 1);
        ASSERT_EQ(verdict.gates.size(), 2u) << method;
        EXPECT_TRUE(verdict.gates[0].is_kept());
        EXPECT_FALSE(verdict.gates[1].is_kept()) << method;
        EXPECT_EQ(verdict.outcome(), "miss") << method;
        EXPECT_EQ(verdict.numbers(), (std::vector<std::string>{"hole_pixels 0 (gate 0)", "loss_share not measured (gate 0.5)"}));
        verdict.finding.figures["loss_share"] = 0.5;
        verdict.gates = held_gates(two_gates(), verdict.spec, verdict.finding, 1);
        EXPECT_EQ(verdict.outcome(), "pass") << method;
        verdict.finding.figures["loss_share"] = std::numeric_limits<double>::quiet_NaN();
        verdict.gates = held_gates(two_gates(), verdict.spec, verdict.finding, 1);
        EXPECT_EQ(verdict.outcome(), "miss") << method;
    }
}

TEST(StabilityVerdict, HoldsAMethodToItsOwnSidesGates) {
    Case each;
    for (const char* of : {"all", "geometry", "image", "chain", "planting"}) each.gates.push_back({of, 0, of, -1});
    EXPECT_EQ(held_figures(each, "terrain"), (std::vector<std::string>{"all", "geometry"}));
    EXPECT_EQ(held_figures(each, "caveclod"), (std::vector<std::string>{"all", "geometry"}));
    EXPECT_EQ(held_figures(each, "discrete"), (std::vector<std::string>{"all", "geometry"}));
    EXPECT_EQ(held_figures(each, "lod-sprite"), (std::vector<std::string>{"all", "image"}));
    EXPECT_EQ(held_figures(each, "discrete:late"), (std::vector<std::string>{"all", "chain"}));
    EXPECT_EQ(held_figures(each, "wang-ldi:paper"), (std::vector<std::string>{"all", "planting"}));
}

TEST(StabilityVerdict, StatesWhatNoGateHolds) {
    Verdict verdict;
    verdict.finding.figures["path_difference_grey"] = 2.5;
    EXPECT_EQ(verdict.outcome(), "stated");
    EXPECT_TRUE(verdict.is_kept());
    EXPECT_EQ(verdict.numbers(), std::vector<std::string>{"path_difference_grey 2.5 (no gate)"});
}

TEST(StabilityVerdict, OfAFigureThatNoRunnerFindsIsSaidOnThePageAndHeldAgainstTheSuite) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hills hills;
    Stage stage = hills.stage(context->renderer(), 2);
    ScratchFolder folder;
    Case each = two_gates();
    each.scene = "unused", each.flight = folder / "flight.json";
    ASSERT_TRUE(write_file(each.flight, std::string_view(scene::json_from_flight(hills.flight))));
    Result<SuiteResult> result = run_suite(stage, {each}, *specs_from({"terrain@samples=1"}, {}), [](double) {});
    ASSERT_TRUE(result) << result.error().message;
    ASSERT_EQ(result->verdicts.size(), 1u);
    EXPECT_FALSE(is_kept(*result));
    RunSetup setup;
    setup.scene = hills.world.name, setup.command = {"stability"}, setup.scene_hash = hills.world.content_hash;
    setup.renderer = stage.renderer;
    std::string page = stability_html(*result, setup, stage);
    EXPECT_NE(page.find("<span class=\"broken\">loss_share not measured (gate 0.5)</span>"), std::string::npos);
    EXPECT_NE(page.find("Stability suite: 0 of 1 verdicts pass"), std::string::npos);
    nlohmann::json report = nlohmann::json::parse(stability_json(*result, setup, stage));
    EXPECT_EQ(test::faults_of(report, "stability.schema.json"), std::vector<std::string>());
    EXPECT_EQ(report["verdicts"][0]["outcome"], "miss");
    EXPECT_EQ(report["verdicts"][0]["gates"][1]["measured"], false);
    EXPECT_EQ(report["verdicts"][0]["gates"][1]["value"], nullptr);
    EXPECT_EQ(report["kept"], false);
}

}  // namespace
}  // namespace overlook::measure
