// The gates of meshes, where the suite judges them in another way than terrains: each has an input that must fail it, and one
// that passes; through the suite, as the program runs it.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <set>

#include "formats/atomic_file.h"
#include "tests/formats/scratch_folder.h"
#include "tests/gl/fixture.h"
#include "tests/gl/measure_torus.h"
#include "tools/make_sample/sample_objects.h"
#include "tools/measure/stability/suite.h"

namespace overlook::measure {
namespace {

constexpr char kCases[] = OVERLOOK_SOURCE_DIR "/samples/stability";

struct Trial {
    const char* number;
    const char* figure;
    const char* right;
    const char* wrong;
    enum class Flies { to_and_fro, from_side_to_side, trembling, round_it, past_masts } flies = Flies::to_and_fro;
};
std::ostream& operator<<(std::ostream& out, const Trial& trial) {
    return out << trial.number << "_" << trial.figure;
}
std::string name_of(const testing::TestParamInfo<Trial>& info) {
    return std::string(info.param.number) + "_" + info.param.figure;
}

scene::Key key(double time_s, double heading_deg, double away_m) {
    view::Camera camera;
    camera.heading_deg = heading_deg, camera.pitch_deg = -20;
    glm::dvec3 at = -view::axes_of(camera).forward * away_m;
    return {time_s, {at.x, at.y, at.z}, heading_deg, -20, {}};
}

scene::Flight flight_of(const Trial& trial) {
    scene::Flight flight;
    flight.step_s = 1.0 / 32;
    bool is_even = trial.flies != Trial::Flies::trembling && trial.flies != Trial::Flies::from_side_to_side;
    flight.interpolation = is_even ? scene::Interpolation::linear : scene::Interpolation::constant;
    if (trial.flies == Trial::Flies::trembling)
        for (int frame = 0; frame < 64; ++frame) flight.keys.push_back(key(frame * flight.step_s, 20, 24 + 0.2 * (frame % 2)));
    else if (trial.flies == Trial::Flies::round_it)
        for (int i = 0; i <= 12; ++i) flight.keys.push_back(key(i / 32.0, 20 + 4 * i, 30));
    else if (trial.flies == Trial::Flies::past_masts)
        flight = sample::masts_flight();
    else if (!is_even)
        flight.keys = {key(0, 20, 40), key(0.5, 170, 24), key(1, 280, 70)};
    else
        flight.keys = {key(0, 20, 30), key(1.25, 24, 22), key(2.5, 24, 30)};
    return flight;
}

class MeshGate : public testing::TestWithParam<Trial> {};

TEST_P(MeshGate, IsKeptByTheRightAndMissedByTheWrong) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    const Trial& trial = GetParam();
    Result<std::vector<Case>> cases = read_cases(kCases);
    ASSERT_TRUE(cases);
    auto found = std::find_if(cases->begin(), cases->end(), [&](const Case& each) { return each.number == trial.number; });
    ASSERT_NE(found, cases->end());
    ScratchFolder folder;
    Case each = for_meshes(*found);
    each.flight = each.mesh_flight = folder / "flight.json";
    ASSERT_TRUE(write_file(each.flight, std::string_view(scene::json_from_flight(flight_of(trial)))));
    ASSERT_NE(std::find(each.runs.begin(), each.runs.end(), "caveclod"), each.runs.end());

    World world = trial.flies == Trial::Flies::past_masts ? world_of("masts", baked(sample::masts_mesh())) : torus_world();
    world.base.near_m = 0.01;
    uint32_t frames = trial.flies == Trial::Flies::from_side_to_side ? 40 : 12;
    Stage stage{world, context->renderer(), 96, 96, frames, 1, ""};
    for (bool is_right : {true, false}) {
        MethodSpec spec = *parse_method(is_right ? trial.right : trial.wrong);
        Result<SuiteResult> result = run_suite(stage, {each}, std::span(&spec, 1), [](double) {});
        ASSERT_TRUE(result) << result.error().message;
        ASSERT_EQ(result->verdicts.size(), 1u);
        const std::vector<HeldGate>& gates = result->verdicts[0].gates;
        auto gate = std::find_if(gates.begin(), gates.end(), [&](const HeldGate& one) { return one.figure == trial.figure; });
        ASSERT_NE(gate, gates.end());
        EXPECT_EQ(gate->is_kept(), is_right) << sentence_of(*gate) << ": " << result->verdicts[0].finding.sentence;
    }
}

constexpr Trial kTrials[] = {
    Trial{"S02", "switches_after_first_second", "caveclod", "caveclod:paper", Trial::Flies::trembling},
    Trial{"S03", "frames_above_twice_asked_error", "caveclod", "caveclod@error-px=12"},
    Trial{"S04", "frames_until_error_met", "caveclod", "caveclod@operations=3", Trial::Flies::from_side_to_side},
    Trial{"S09", "pop_index", "caveclod@error-px=0.01", "caveclod:shared@error-px=8", Trial::Flies::round_it},
    Trial{"S10", "lost_mast_share", "caveclod@error-px=0.01", "caveclod@error-px=1", Trial::Flies::past_masts},
    Trial{"S19", "budget_miss_share", "caveclod@error-px=0.25", "caveclod:paper@error-px=0.25"},
    Trial{"S19", "frames_until_budget_met", "caveclod@error-px=0.25", "caveclod@error-px=0.25@operations=20"}};
INSTANTIATE_TEST_SUITE_P(OfTheSuite, MeshGate, testing::ValuesIn(kTrials), name_of);

// Baked to keep thin things, masts stand at the default error; by as small pictures and few frames as here.
TEST(MeshGates, AreKeptByMastsThatAreBakedToStay) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Result<std::vector<Case>> cases = read_cases(kCases);
    ASSERT_TRUE(cases);
    auto found = std::find_if(cases->begin(), cases->end(), [](const Case& each) { return each.number == "S10"; });
    ASSERT_NE(found, cases->end());
    ScratchFolder folder;
    Case each = for_meshes(*found);
    each.flight = each.mesh_flight = folder / "flight.json";
    ASSERT_TRUE(write_file(each.flight, std::string_view(scene::json_from_flight(sample::masts_flight()))));
    MethodSpec spec = *parse_method("caveclod");
    for (bool keeps_thin : {true, false}) {
        caveclod::BakeOptions options;
        options.simplify.keeps_thin = keeps_thin, options.precision.position_bits = 16;
        World world = world_of("masts", baked(sample::masts_mesh(), options));
        world.base.near_m = 0.01;
        Stage stage{world, context->renderer(), 160, 120, 6, 1, ""};
        Result<SuiteResult> result = run_suite(stage, {each}, std::span(&spec, 1), [](double) {});
        ASSERT_TRUE(result) << result.error().message;
        double lost = result->verdicts.at(0).finding.figures.at("lost_mast_share");
        EXPECT_EQ(lost < 0.15, keeps_thin) << lost;
    }
}

// Of the cases that methods of meshes run alone; the others' inputs stand in stability_gates_test.
TEST(MeshGates, HaveEachAnInputThatMustFailIt) {
    std::set<std::string> tried;
    for (const Trial& trial : kTrials) tried.insert(std::string(trial.number) + "_" + trial.figure);
    Result<std::vector<Case>> cases = read_cases(kCases);
    ASSERT_TRUE(cases);
    for (const Case& each : *cases) {
        if (!is_of_meshes_alone(each) || each.mesh_scene.empty()) continue;
        for (const CaseGate& gate : each.gates) {
            std::string name = each.number + "_" + gate.figure;
            EXPECT_TRUE(tried.count(name)) << name;
        }
    }
}

}  // namespace
}  // namespace overlook::measure
