// The stability suite, tiny: the default variant keeps its gates, and a method that is broken is seen to be.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "formats/atomic_file.h"
#include "tests/formats/schema_faults.h"
#include "tests/formats/scratch_folder.h"
#include "tests/gl/stability_hills.h"
#include "tools/measure/stability/kept.h"
#include "tools/measure/stability/report.h"

namespace overlook::measure {
namespace {

Finding found(CaseRunner run, Stage stage, const Case& each, const scene::Flight& flight, const char* method) {
    std::vector<MethodSpec> specs = *specs_from({method}, {});
    Result<std::vector<Finding>> findings = run(stage, each, flight, specs);
    EXPECT_TRUE(findings) << findings.error().message;
    return findings ? findings->front() : Finding{};
}

TEST(StabilityRun, SwitchesAreSeenOnlyWhereLevelsPop) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hills hills;
    Stage stage = hills.stage(context->renderer(), 4);
    EXPECT_EQ(found(run_jitter, stage, {}, hills.flight, "terrain").figures.at("switches_after_first_second"), 0);
    EXPECT_GT(found(run_jitter, stage, {}, hills.flight, "terrain:hard").figures.at("switches_after_first_second"), 0);
}

TEST(StabilityRun, ErrorAboveTheOneAskedIsSeen) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hills hills;
    Stage stage = hills.stage(context->renderer(), 3);
    Finding right = found(run_yaw, stage, {}, hills.flight, "terrain@samples=1");
    EXPECT_EQ(right.figures.at("frames_above_twice_asked_error"), 0);
    EXPECT_EQ(right.figures.at("hole_pixels"), 0);
    Finding broken = found(run_yaw, stage, {}, hills.flight, "terrain@samples=1@error-px=4");
    EXPECT_EQ(broken.figures.at("frames_above_twice_asked_error"), 3);
    ASSERT_TRUE(broken.worst);
    EXPECT_NE(broken.worst->test.pixels, broken.worst->reference.pixels);
}

TEST(StabilityRun, PopIndexIsWorseWhereLevelsPop) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hills hills;
    Stage stage = hills.stage(context->renderer(), 8);
    Finding morphed = found(run_dolly, stage, {}, hills.flight, "terrain@error-px=3");
    Finding popping = found(run_dolly, stage, {}, hills.flight, "terrain:hard@error-px=3");
    EXPECT_LT(morphed.figures.at("pop_index"), popping.figures.at("pop_index"));
    EXPECT_LT(morphed.figures.at("change_by_triangles"), 0.5 * popping.figures.at("change_by_triangles"));
}

TEST(StabilityRun, PicturesDependOnTheCameraAlone) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hills hills;
    Stage stage = hills.stage(context->renderer(), 3);
    Case each;
    each.settings.world_moves_m = {1e5, 1e7};
    each.settings.changed_pixel = 0.001;
    each.settings.resize_shares = {0.5, 1.25};
    EXPECT_EQ(found(run_back_and_forth, stage, each, hills.flight, "terrain").figures.at("path_difference_grey"), 0);
    EXPECT_EQ(found(run_resize, stage, each, hills.flight, "terrain").figures.at("stale_pixels"), 0);
    EXPECT_LE(found(run_moved_world, stage, each, hills.flight, "terrain").figures.at("changed_pixel_share"), 1e-4);
}

// Draws what the camera that decided last of all wants: a method whose state is not its own.
class Shared : public Method {
  public:
    explicit Shared(World& world, view::Camera& last) : method_(make_method(*parse_method("terrain"), world)), last_(last) {}
    void decide(const view::Camera& camera, uint32_t) override { last_ = camera; }
    Counters draw(const gl::Target& target) override {
        method_->decide(last_, 0);
        return method_->draw(target);
    }

  private:
    std::unique_ptr<Method> method_;
    view::Camera& last_;
};

TEST(StabilityRun, CamerasAtOnceSeeWhatTheySeeAlone) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hills hills;
    Case each;
    each.settings.cameras = 4;
    for (const char* method : {"terrain", "terrain:hard", "terrain@triangles=500"}) {
        Finding finding = found(run_cameras, hills.stage(context->renderer(), 12), each, hills.flight, method);
        EXPECT_EQ(finding.figures.at("cameras_that_differ"), 0) << method;
        EXPECT_EQ(finding.frames, 12u);
        ASSERT_TRUE(finding.worst);
        EXPECT_EQ(finding.worst->test.pixels, finding.worst->reference.pixels);
    }
}

TEST(StabilityRun, CamerasThatDisturbEachOtherAreSeen) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hills hills;
    std::vector<view::Camera> all = cameras_of(hills.stage(context->renderer(), 0), hills.flight, Pick::all);
    std::vector<std::vector<view::Camera>> legs = {{all.front(), all[1]}, {all[40], all[41]}, {all.back(), all.back()}};
    view::Camera last;
    Result<Together> together = fly_together([&] { return std::make_unique<Shared>(hills.world, last); }, legs, 1);
    ASSERT_TRUE(together) << together.error().message;
    EXPECT_EQ(together->cameras_that_differ, 2u);  // the last one gets its way
    EXPECT_NE(together->worst->test.pixels, together->worst->reference.pixels);
}

TEST(StabilityRun, FallbacksToCoarserHeightsAreSaid) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hills hills;
    terrain::Terrain& terrain = *hills.world.terrain;
    Stage stage = hills.stage(context->renderer(), 3);
    Finding exact = found(run_climb, stage, {}, hills.flight, "terrain@samples=1");
    EXPECT_EQ(exact.figures.at("fallbacks_unsaid"), 0);
    EXPECT_NE(exact.sentence.find("0 of 3 frames cannot keep that"), std::string::npos) << exact.sentence;

    terrain.finest_error_m = 20;  // a file of coarse heights that knows it
    for (size_t code = 0; code < terrain::kMustSplit; ++code) terrain.error_m[code] += 20;
    Finding said = found(run_climb, stage, {}, hills.flight, "terrain@samples=1");
    EXPECT_EQ(said.figures.at("fallbacks_unsaid"), 0);
    EXPECT_NE(said.sentence.find("3 of 3 frames cannot keep that"), std::string::npos) << said.sentence;

    for (size_t code = 0; code < terrain::kMustSplit; ++code) terrain.error_m[code] -= 20;  // and one that keeps it to itself
    EXPECT_EQ(found(run_climb, stage, {}, hills.flight, "terrain@samples=1").figures.at("fallbacks_unsaid"), 3);
}

TEST(StabilityRun, PlacesShownFromKeysAreMeasured) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hills hills;
    Stage stage = hills.stage(context->renderer(), 16);
    Finding right = found(run_slopes, stage, {}, hills.flight, "lod-sprite@error-px=0.5@key-error-px=0.5");
    double right_px = right.figures.at("shear_error_px");
    EXPECT_GT(right_px, 0);
    EXPECT_LE(right_px, 1.5) << right.sentence;
    ASSERT_TRUE(right.worst);
    Finding bent = found(run_slopes, stage, {}, hills.flight,
                         "lod-sprite@error-px=0.5@key-error-px=2@low-error-px=32@place-test=0@slab-test=0@look-ups=0");
    EXPECT_GT(bent.figures.at("shear_error_px"), 1.5) << bent.sentence;
}

TEST(StabilityRun, BudgetsOfMethodsWithKeysAreHeldToAllThatTheyDraw) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hills hills;
    Case each;
    each.settings.budget_share = 0.5;
    Stage stage = hills.stage(context->renderer(), 0);
    Finding kept = found(run_halved_budget, stage, each, hills.flight, "lod-sprite@error-px=0.3@key-error-px=0.3");
    EXPECT_LE(kept.figures.at("budget_miss_share"), 0.05) << kept.sentence;
    EXPECT_LE(kept.figures.at("frames_until_budget_met"), 20) << kept.sentence;
    // Keys of the paper are drawn at once, whatever the budget.
    Finding broken = found(run_halved_budget, stage, each, hills.flight, "lod-sprite:paper@error-px=0.3@key-error-px=0.3");
    EXPECT_GT(broken.figures.at("budget_miss_share"), 0.05) << broken.sentence;
}

TEST(StabilityRun, CamerasWithKeysOfTheirOwnSeeWhatTheySeeAlone) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hills hills;
    Case each;
    each.settings.cameras = 2;
    Finding finding = found(run_cameras, hills.stage(context->renderer(), 4), each, hills.flight, "lod-sprite");
    EXPECT_EQ(finding.figures.at("cameras_that_differ"), 0);
    EXPECT_EQ(finding.frames, 2 * 24u);
}

TEST(StabilitySuite, GoesOnWhereItWasBrokenOff) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hills hills;
    ScratchFolder folder;
    Stage stage = hills.stage(context->renderer(), 2);
    stage.kept_folder = folder.path();
    stage.program_hash = "this program";
    Case each{"S03", "yaw", "unused", folder / "flight.json", {}, {}, {"terrain"}, {"terrain"}};
    each.gates.push_back({"hole_pixels", 0, "all", -1});
    ASSERT_TRUE(write_file(each.flight, std::string_view(scene::json_from_flight(hills.flight))));
    std::vector<MethodSpec> specs = *specs_from({"terrain@samples=1"}, {});
    auto run = [&] { return run_suite(stage, {each}, specs, [](double) {}); };
    Result<SuiteResult> first = run(), again = run();
    ASSERT_TRUE(first && again);
    const Finding &a = first->verdicts[0].finding, &b = again->verdicts[0].finding;
    EXPECT_EQ(a.sentence, b.sentence);
    EXPECT_EQ(a.figures, b.figures);
    EXPECT_EQ(a.worst->test.pixels, b.worst->test.pixels);
    EXPECT_EQ(folder.names().size(), 2u);  // the flight, and what was found

    // What was kept is taken, not found anew; what was damaged is not.
    std::string kept = folder / name_of_findings(stage, each, *scene::read_flight(each.flight), specs);
    std::vector<Finding> other = {a};
    other[0].figures["hole_pixels"] = std::numeric_limits<double>::infinity();
    ASSERT_TRUE(keep_findings(kept, other));
    EXPECT_TRUE(std::isinf(run()->verdicts[0].gates[0].value.value()));
    std::string bytes = text_of_file(kept);
    bytes[bytes.size() / 2] ^= 1;
    ASSERT_TRUE(write_file(kept, std::string_view(bytes)));
    EXPECT_EQ(run()->verdicts[0].gates[0].value.value(), 0);

    stage.program_hash = "another";
    EXPECT_EQ(run()->verdicts[0].finding.sentence, a.sentence);
    EXPECT_EQ(folder.names().size(), 3u);
}

TEST(StabilitySuite, HoldsItsGatesAgainstTheBaselineThatPops) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hills hills;
    Stage stage = hills.stage(context->renderer(), 2);
    ScratchFolder folder;
    Case each{"S02", "jitter", "unused", folder / "flight.json", {}, {}, {"terrain"}, {"terrain"}};
    each.gates.push_back({"switches_after_first_second", 0, "all", -1});
    each.note = "known & said";
    ASSERT_TRUE(write_file(each.flight, std::string_view(scene::json_from_flight(hills.flight))));
    Result<SuiteResult> result = run_suite(stage, {each}, *specs_from({"terrain", "terrain:hard"}, {}), [](double) {});
    ASSERT_TRUE(result) << result.error().message;
    ASSERT_EQ(result->verdicts.size(), 2u);
    EXPECT_TRUE(result->verdicts[0].is_kept());
    EXPECT_FALSE(result->verdicts[1].is_kept());
    EXPECT_NE(stability_html(*result, {}, stage).find("known &amp; said"), std::string::npos);
    EXPECT_TRUE(is_kept(*result));  // the baseline's misses are shown, not held against the suite
    result->verdicts[1].spec = result->verdicts[0].spec;
    EXPECT_FALSE(is_kept(*result));
    EXPECT_TRUE(result->owed.empty());
}

// A real run's report: figures, an infinite one among them, owed cases, pictures.
nlohmann::json report_of_a_run(const gl::Renderer& renderer) {
    Hills hills;
    Stage stage = hills.stage(renderer, 2);
    ScratchFolder folder;
    std::string flight = folder / "flight.json";
    EXPECT_TRUE(write_file(flight, std::string_view(scene::json_from_flight(hills.flight))));
    std::vector<Case> cases = *read_cases(OVERLOOK_SOURCE_DIR "/samples/stability");
    std::vector<Case> few = {cases[1], cases[4], cases[17]};
    for (Case& each : few) each.flight = flight;
    few[0].methods.push_back("not-ready");
    Result<SuiteResult> result = run_suite(stage, few, *specs_from({"terrain", "terrain:hard"}, {}), [](double) {});
    EXPECT_TRUE(result) << result.error().message;
    result->verdicts[0].gates[0].value = std::numeric_limits<double>::infinity();
    RunSetup setup;
    setup.version = "1.2.3";
    setup.command = {"stability", "cases"};
    setup.scene = hills.world.name;
    setup.scene_hash = hills.world.content_hash;
    setup.renderer = renderer;
    return nlohmann::json::parse(stability_json(*result, setup, stage));
}

TEST(StabilityJson, KeepsItsSchema) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    nlohmann::json report = report_of_a_run(context->renderer());
    EXPECT_EQ(report["verdicts"].size(), 4u);
    EXPECT_EQ(report["verdicts"][0].at("gates").at(0).at("value"), nullptr);
    EXPECT_TRUE(report["verdicts"][2].contains("worst"));
    EXPECT_FALSE(report["owed"].empty());
    EXPECT_EQ(test::faults_of(report, "stability.schema.json"), std::vector<std::string>());
    for (const char* place : {"/version", "/asked_px", "/renderer/software", "/verdicts/1/kept", "/verdicts/2/gates/0/most",
                              "/verdicts/2/worst/frame", "/owed/0/case"}) {
        nlohmann::json other = report;
        other[nlohmann::json::json_pointer(place)] = "other";
        EXPECT_EQ(test::faults_of(other, "stability.schema.json").size(), 1u) << place;
    }
    report["owed"][0].erase("what");
    report["date"] = "today";
    EXPECT_EQ(test::faults_of(report, "stability.schema.json").size(), 2u);
}

TEST(StabilitySuite, OwesWhatIsNotReady) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Hills hills;
    Stage stage = hills.stage(context->renderer(), 2);
    Result<std::vector<Case>> cases = read_cases(OVERLOOK_SOURCE_DIR "/samples/stability");
    ASSERT_TRUE(cases) << cases.error().message;
    std::vector<std::string> owed;
    for (Case& each : *cases) {
        std::vector<std::string> ready = each.runs;
        for (const std::string& method : each.methods) {
            if (std::find(ready.begin(), ready.end(), method) == ready.end()) owed.push_back(each.number + " " + method);
        }
    }
    Result<SuiteResult> result = run_suite(stage, *cases, {}, [](double) {});
    ASSERT_TRUE(result) << result.error().message;
    std::vector<std::string> said;
    for (const Owed& each : result->owed) said.push_back(each.number + " " + each.method);
    EXPECT_EQ(said, owed);  // every case that the files call ready has its runner
}

}  // namespace
}  // namespace overlook::measure
