// The gates of a run, and the numbers of a frame beside the reference: each has an input that is wrong for it, and is seen to be.
#include <gtest/gtest.h>

#include <map>

#include "tests/tools/measure_made_course.h"
#include "tests/tools/numbers_pictures.h"
#include "tools/measure/judge.h"

namespace overlook::measure {
namespace {

std::string missed(const RunResult& run) {
    std::string names;
    for (const Gate& gate : gates_of(run)) names += gate.is_kept() ? "" : std::string(gate.name) + " ";
    return names;
}

TEST(Gates, AreBrokenByAPopAHoleOrABrokenPromise) {
    CourseResult course = a_course();
    for (const Gate& gate : gates_of(course.runs[0])) EXPECT_TRUE(gate.is_kept()) << gate.name;
    EXPECT_EQ(missed(course.runs[1]), "pop_index ");
    course.runs[0].frames[7].numbers.hole_count = 1;
    EXPECT_EQ(missed(course.runs[0]), "hole_px ");
    course.runs[0].frames[7].numbers.hole_count = 0;
    course.runs[0].frames[7].counters.predicted_error_px = 1.01;
    EXPECT_EQ(missed(course.runs[0]), "predicted_error_px ");
}

TEST(Gates, AreBrokenByADishonestOrAnIdlePromise) {
    auto broken = [](float predicted, float measured) {
        RunResult run = a_course().runs[0];
        for (int i = 0; i < 9; ++i) run.g.add(std::vector<float>{predicted}, std::vector<float>{measured});
        return missed(run);
    };
    EXPECT_EQ(broken(1, 1), "");
    EXPECT_EQ(broken(1, 1.001f), "g_max ");
    EXPECT_EQ(broken(0, 0.001f), "g_max ");
    EXPECT_EQ(broken(1, 0.2f), "g_median ");
    EXPECT_EQ(gates_of(a_course().runs[2]).size(), 2u);  // the floor promises nothing
}

TEST(Gates, HoldABudgetOnceItHasSettled) {
    RunResult run = run_of(*parse_method("terrain@triangles=1000"), 5, 0.2);
    for (FrameRecord& frame : run.frames) frame.frame += 20;
    run.frames[0].frame = 19;
    run.frames[0].counters.triangle_count = 5000;
    run.frames[0].counters.predicted_error_px = 7;
    for (const Gate& gate : gates_of(run)) EXPECT_TRUE(gate.is_kept()) << gate.name;
    run.frames[1].counters.triangle_count = 1051;
    std::vector<Gate> gates = gates_of(run);
    auto gate = std::find_if(gates.begin(), gates.end(), [](const Gate& one) { return one.name == "triangles"; });
    ASSERT_NE(gate, gates.end());
    EXPECT_FALSE(gate->is_kept());
}

TEST(Gates, AreAtTheFloorWithinTwoPercent) {
    CourseResult course = a_course();
    EXPECT_TRUE(is_at_floor(course.runs[2], course.runs[2]));
    EXPECT_FALSE(is_at_floor(course.runs[0], course.runs[2]));
    RunResult near = run_of(*parse_method("terrain"), 5, 0.101);
    EXPECT_TRUE(is_at_floor(near, course.runs[2]));
    near = run_of(*parse_method("terrain"), 5, 0.105);
    EXPECT_FALSE(is_at_floor(near, course.runs[2]));
}

// A gate that is new needs a way to miss it here.
TEST(Gates, HaveEachARunThatMustMissThem) {
    const std::map<std::string_view, void (*)(RunResult&)> kSpoil = {
        {"hole_px", [](RunResult& run) { run.frames[7].numbers.hole_count = 1; }},
        {"pop_index", [](RunResult& run) { run.pop.index = 1.201; }},
        {"triangles", [](RunResult& run) { run.frames[9].counters.triangle_count = 1100; }},
        {"predicted_error_px", [](RunResult& run) { run.frames[3].counters.predicted_error_px = 1.01; }},
        {"g_max", [](RunResult& run) { run.g.add(std::vector<float>{1}, std::vector<float>{1.001f}); }},
        {"g_median", [](RunResult& run) { run.g.add(std::vector<float>(99, 1), std::vector<float>(99, 0.2f)); }},
    };
    size_t seen = 0;
    for (const char* method : {"terrain@error-px=1", "terrain@triangles=1000"}) {
        RunResult right = run_of(*parse_method(method), 5, 0.2);
        for (FrameRecord& frame : right.frames) frame.frame += 20;  // a budget has settled by then
        EXPECT_EQ(missed(right), "");
        for (const Gate& gate : gates_of(right)) {
            ASSERT_TRUE(kSpoil.count(gate.name)) << gate.name;
            RunResult wrong = right;
            kSpoil.at(gate.name)(wrong);
            EXPECT_EQ(missed(wrong), std::string(gate.name) + " ");
            ++seen;
        }
    }
    EXPECT_EQ(seen, 10u);
}

// Two frames of a plane, seen from a camera that moves; what is wrong is in the second.
struct Judged {
    FrameRecord record;
    WorstFrame worst_e, worst_w;

    explicit Judged(void (*spoil)(Frame&)) {
        view::Camera camera;
        camera.position_m = {0, 0, 50};
        camera.pitch_deg = -10;
        camera.width_px = camera.height_px = 64;
        Frame before = plane_frame(camera);
        camera.position_m.x += 1;
        Frame truth = plane_frame(camera), test = truth;
        spoil(test);
        EXPECT_TRUE(judge_picture(
            test, truth, HoleRule{}, [&](uint32_t) { return Result<Frame>(truth); }, record.numbers));
        judge_e(test, truth, record, worst_e);
        judge_w(motion_between(before, truth), before, test, before, truth, record, worst_w);
    }
};

// Its lower half is darker, its horizon four pixels lower, and in its middle it has a hole.
void spoil(Frame& frame) {
    size_t width = frame.width, half = width * frame.height / 2;
    auto make_sky = [&](size_t pixel) {
        frame.ids[pixel] = kBackground;
        frame.depth_m[pixel] = std::numeric_limits<float>::infinity();
    };
    size_t first = size_t(std::find(frame.ids.begin(), frame.ids.end(), 1u) - frame.ids.begin());
    for (size_t pixel = first; pixel < first + 4 * width; ++pixel) make_sky(pixel);
    make_sky(half + 8 * width + 32);
    for (size_t i = 3 * half; i < frame.rgb.size(); ++i) frame.rgb[i] = uint8_t(frame.rgb[i] / 2);
}

TEST(FrameNumbers, AreEachWorseForAFrameThatIsWrong) {
    Judged right([](Frame&) {}), wrong(spoil);
    size_t seen = 0;
    for (const Figure& figure : figures()) {
        bool is_better_if_more = figure.name == "psnr_db", is_of_promises = figure.name == "hole_allowed_px";
        std::optional<double> well = figure.of(right.record), badly = figure.of(wrong.record);
        ASSERT_EQ(well.has_value(), badly.has_value()) << figure.name;
        bool is_beside_the_reference = well && *well != figure.of(FrameRecord{}).value_or(-1);
        if (!is_beside_the_reference || is_of_promises) continue;
        EXPECT_TRUE(is_better_if_more ? *badly < *well : *badly > *well) << figure.name << " " << *well << " " << *badly;
        ++seen;
    }
    EXPECT_EQ(seen, 8u);  // E twice, W, S twice, holes, PSNR, luma
}

TEST(MeasureFigures, HaveAMeanOverTheFramesThatHaveOne) {
    RunResult run = run_of(*parse_method("terrain@error-px=1"), 5, 0.2);
    EXPECT_EQ(mean_of(run, "triangles"), 1004.5);
    EXPECT_DOUBLE_EQ(mean_of(run, "e_p99_flip").value(), 0.2025);
    EXPECT_EQ(mean_of(run, "ghost_share"), std::nullopt);
    run.frames.clear();
    EXPECT_EQ(mean_of(run, "triangles"), std::nullopt);
}

}  // namespace
}  // namespace overlook::measure
