// Every gate of the suite's files has an input that must fail it, and one that passes: through the suite, as the program runs it.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <ostream>
#include <set>

#include "formats/atomic_file.h"
#include "tests/formats/scratch_folder.h"
#include "tests/gl/stability_hills.h"
#include "tools/measure/stability/suite.h"

namespace overlook::measure {
namespace {

constexpr char kCases[] = OVERLOOK_SOURCE_DIR "/samples/stability";

// What a case runs on. A trial may spoil any of it.
struct Given {
    Hills hills;
    Case each;
    MethodMaker make = make_method;
};

// A gate, an input that keeps it and one that does not: another method or setting, `harm` done to the same, or both.
struct Trial {
    const char* number;
    const char* figure;
    uint32_t frames;
    const char* right;
    const char* wrong;
    void (*prepare)(Given&) = nullptr;  // for both
    void (*harm)(Given&) = nullptr;     // for the wrong one
};

void promise_a_share(Given& given, float share) {
    for (size_t code = 1; code < terrain::kMustSplit; ++code) given.hills.world.terrain->error_m[code] *= share;
}
void promise_less(Given& given) {
    promise_a_share(given, 0.4f);
}
void promise_hardly_anything(Given& given) {
    promise_a_share(given, 0.01f);
}

// The source's heights are farther off than the file says.
void be_coarse_in_silence(Given& given) {
    given.hills.world.terrain->finest_error_m = 20;
}

// Along a line, `seconds` long.
void fly(Given& given, const glm::dvec3& from_m, const glm::dvec3& to_m, double seconds, double pitch_deg) {
    scene::Flight& flight = given.hills.flight;
    flight.keys = {{0, {from_m.x, from_m.y, from_m.z}, 0, pitch_deg, {}}, {seconds, {to_m.x, to_m.y, to_m.z}, 0, pitch_deg, {}}};
}
void fly_past(Given& given, double metres) {
    glm::dvec3 from_m = given.hills.world.base.position_m + glm::dvec3(0, 300, -168);
    fly(given, from_m, from_m + glm::dvec3(metres, 0, 0), 1, -20);
}
void fly_past_slowly(Given& given) {
    fly_past(given, 20);
}
void fly_past_fast(Given& given) {
    fly_past(given, 70);
}
void fly_past_fast_and_long(Given& given) {
    fly_past(given, 300);
    given.hills.flight.keys[1].time_s = 2;
}
void stand_still(Given& given) {
    fly(given, given.hills.world.base.position_m, given.hills.world.base.position_m, 2, -20);
}
// Half as high over the ground as the near plane is away.
void skim(Given& given) {
    const terrain::Terrain& terrain = *given.hills.world.terrain;
    double ground_m = terrain.height_m(64, 64);
    glm::dvec3 at_m(640, -640, ground_m + 0.5 * given.hills.world.base.near_m);
    fly(given, at_m, at_m, 0.1, -20);
}
// What is on the card stays where it was.
void sink(Given& given) {
    given.hills.world.terrain->height_offset_m -= 100;
}

void move_out_of_reach(Given& given) {
    given.each.settings.world_moves_m = {1e17};
}

// Draws what the camera that decided last of all wants: a method whose state is not its own.
class Shared : public Method {
  public:
    Shared(std::unique_ptr<Method> method, std::shared_ptr<view::Camera> last) : method_(std::move(method)), last_(last) {}
    void decide(const view::Camera& camera, uint32_t) override { *last_ = camera; }
    Counters draw(const gl::Target& target) override {
        method_->decide(*last_, 0);
        return method_->draw(target);
    }

  private:
    std::unique_ptr<Method> method_;
    std::shared_ptr<view::Camera> last_;
};
void share_the_camera(Given& given) {
    given.make = [last = std::make_shared<view::Camera>()](const MethodSpec& spec, World& world) {
        return std::make_unique<Shared>(make_method(spec, world), last);
    };
}

// Says in two frames that a picture takes over from another; what it draws then is up to the methods it has.
class Announcing : public Method {
  public:
    Announcing(std::unique_ptr<Method> before, std::unique_ptr<Method> after)
        : before_(std::move(before)), after_(std::move(after)) {}
    void decide(const view::Camera& camera, uint32_t frame) override {
        frame_ = frame;
        now().decide(camera, frame);
    }
    Counters draw(const gl::Target& target) override {
        Counters counters = now().draw(target);
        counters.event_count = frame_ == kFirst || frame_ == kTakeover ? 1 : 0;
        return counters;
    }

  private:
    static constexpr uint32_t kFirst = 1, kTakeover = 4;
    Method& now() { return frame_ < kTakeover ? *before_ : *after_; }

    std::unique_ptr<Method> before_, after_;
    uint32_t frame_ = 0;
};
void announce(Given& given, const char* after) {
    given.make = [after](const MethodSpec&, World& world) {
        return std::make_unique<Announcing>(make_method(floor_spec(4), world), make_method(*parse_method(after), world));
    };
}
void announce_nothing_new(Given& given) {
    announce(given, "full");
}
void announce_coarse_ground(Given& given) {
    announce(given, "terrain@error-px=16");
}

// Takes three times as long over a transition as it says.
void fade_slowly(Given& given) {
    given.make = [](MethodSpec spec, World& world) {
        for (auto& [name, value] : spec.settings) {
            if (name == "fade-frames") value *= 3;
        }
        return make_method(spec, world);
    };
}

void rush_to_and_fro(Given& given) {
    scene::Flight& flight = given.hills.flight;
    scene::Key near = flight.keys[0], far = flight.keys[1];
    far.position_m[1] -= 600;
    flight.keys.clear();
    for (int turn = 0; turn < 30; ++turn) {
        flight.keys.push_back(turn % 2 == 0 ? near : far);
        flight.keys.back().time_s = turn / 10.0;
    }
}

constexpr Trial kTrials[] = {
    {"S01", "pop_index", 8, "terrain@error-px=0.1", "terrain:hard@error-px=8"},
    {"S02", "switches_after_first_second", 2, "terrain", "terrain:hard"},
    {"S02", "switches_after_first_second", 2, "lod-sprite", "lod-sprite", stand_still, fly_past_fast_and_long},
    {"S03", "hole_pixels", 2, "terrain", "terrain", nullptr, promise_hardly_anything},
    {"S03", "frames_above_twice_asked_error", 2, "terrain", "terrain@error-px=4"},
    {"S03", "frames_above_twice_asked_error", 2, "lod-sprite", "lod-sprite@error-px=8@low-error-px=64@key-error-px=64"},
    {"S04", "hole_pixels", 2, "terrain", "terrain", nullptr, promise_hardly_anything},
    {"S04", "frames_until_error_met", 2, "terrain", "terrain@error-px=4"},
    {"S04", "frames_until_error_met", 2, "lod-sprite", "lod-sprite@error-px=8@low-error-px=64@key-error-px=64"},
    {"S05", "ghost_share", 24, "lod-sprite@samples=1@error-px=0.1@low-error-px=0.1",
     "lod-sprite@samples=1@near=0@key-error-px=1000@place-test=0@slab-test=0", fly_past_slowly, fly_past_fast},
    {"S05", "loss_share", 24, "lod-sprite@samples=1", "lod-sprite:paper@samples=1@key-error-px=50", fly_past_slowly},
    {"S06", "hole_pixels", 2, "terrain", "terrain", nullptr, promise_hardly_anything},
    {"S06", "near_plane_cuts", 2, "terrain", "terrain", skim, sink},
    {"S07", "silhouette_p95_px", 2, "terrain", "terrain@error-px=20"},
    {"S08", "hole_pixels", 2, "terrain", "terrain", nullptr, promise_hardly_anything},
    {"S08", "fallbacks_unsaid", 2, "terrain", "terrain", nullptr, be_coarse_in_silence},
    {"S11", "honesty", 2, "terrain@error-px=4", "terrain@error-px=4", nullptr, promise_less},
    {"S11", "shear_error_px", 16, "lod-sprite@error-px=0.5@key-error-px=0.5",
     "lod-sprite@error-px=0.5@key-error-px=2@low-error-px=32@place-test=0@slab-test=0@look-ups=0"},
    {"S12", "changed_pixel_share", 2, "terrain", "terrain", nullptr, move_out_of_reach},
    {"S15", "pop_index", 0, "lod-sprite", "lod-sprite", announce_nothing_new, announce_coarse_ground},
    {"S15", "transition_over_time_s", 0, "lod-sprite", "lod-sprite", fly_past_fast, fade_slowly},
    {"S16", "pop_index_ratio", 8, "terrain", "terrain:hard@error-px=8"},
    {"S17", "stale_pixels", 2, "terrain", "terrain@triangles=500"},
    {"S18", "cameras_that_differ", 2, "terrain", "terrain", nullptr, share_the_camera},
    {"S19", "budget_miss_share", 0, "terrain@error-px=0.3", "terrain@error-px=0.3", nullptr, rush_to_and_fro},
    {"S19", "frames_until_budget_met", 0, "terrain@error-px=0.3", "terrain@error-px=0.3", nullptr, rush_to_and_fro},
    {"S19", "changes_of_sign", 0, "terrain", "terrain", nullptr, rush_to_and_fro},
    {"S20", "path_difference_grey", 2, "terrain", "terrain@triangles=500"},
};

HeldGate held(const Trial& trial, const gl::Renderer& renderer, bool is_wrong) {
    Given given;
    std::vector<Case> cases = *read_cases(kCases);
    given.each = *std::find_if(cases.begin(), cases.end(), [&](const Case& each) { return each.number == trial.number; });
    if (trial.prepare != nullptr) trial.prepare(given);
    if (is_wrong && trial.harm != nullptr) trial.harm(given);
    ScratchFolder folder;
    given.each.flight = folder / "flight.json";
    EXPECT_TRUE(write_file(given.each.flight, std::string_view(scene::json_from_flight(given.hills.flight))));
    Stage stage = given.hills.stage(renderer, trial.frames);
    stage.make = given.make;
    std::vector<MethodSpec> specs = *specs_from({is_wrong ? trial.wrong : trial.right}, {});
    Result<SuiteResult> result = run_suite(stage, {given.each}, specs, [](double) {});
    EXPECT_TRUE(result) << result.error().message;
    if (!result || result->verdicts.size() != 1) return {"nothing was run", std::nullopt};
    const Verdict& verdict = result->verdicts[0];
    auto found = std::find_if(verdict.gates.begin(), verdict.gates.end(),
                              [&](const HeldGate& gate) { return gate.figure == trial.figure; });
    if (found == verdict.gates.end()) return {"no such gate", std::nullopt};
    EXPECT_EQ(verdict.is_kept(),
              std::all_of(verdict.gates.begin(), verdict.gates.end(), [](const HeldGate& gate) { return gate.is_kept(); }));
    return *found;
}

class Gate : public testing::TestWithParam<Trial> {};

TEST_P(Gate, IsKeptByTheRightAndMissedByTheWrong) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    HeldGate right = held(GetParam(), context->renderer(), false), wrong = held(GetParam(), context->renderer(), true);
    EXPECT_EQ(right.figure, GetParam().figure);
    EXPECT_EQ(wrong.figure, GetParam().figure);
    EXPECT_TRUE(right.is_kept()) << sentence_of(right);
    EXPECT_FALSE(wrong.is_kept()) << sentence_of(wrong);
    EXPECT_TRUE(right.value && wrong.value);
}

std::string name_of(const std::string& number, const std::string& figure) {
    return number + "_" + figure;
}
std::ostream& operator<<(std::ostream& out, const Trial& trial) {
    return out << name_of(trial.number, trial.figure);
}
INSTANTIATE_TEST_SUITE_P(OfTheSuite, Gate, testing::ValuesIn(kTrials), [](const auto& trial) {
    bool shows_pictures_again = is_image(*parse_method(trial.param.right));
    return name_of(trial.param.number, trial.param.figure) + (shows_pictures_again ? "_of_pictures" : "");
});

// Of the cases that any method runs today: whoever makes another ready, or adds a gate, adds what must fail it. Those of meshes
// alone stand in stability_mesh_gates_test.
TEST(StabilityGates, HaveEachAnInputThatMustFailIt) {
    std::set<std::string> gates, tried;
    std::vector<Case> cases = *read_cases(kCases);
    for (const Case& each : cases) {
        for (const CaseGate& gate : each.gates) {
            if (!each.runs.empty() && !is_of_meshes_alone(each)) gates.insert(name_of(each.number, gate.figure));
        }
    }
    for (const Trial& trial : kTrials) tried.insert(name_of(trial.number, trial.figure));
    EXPECT_EQ(gates, tried);
}

}  // namespace
}  // namespace overlook::measure
