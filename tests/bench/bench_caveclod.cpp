// Refining a mesh frame after frame: one camera, four at once, as printed, and one refinement for all.

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <span>
#include <vector>

#include "runtime/caveclod/paper.h"
#include "runtime/caveclod/refine.h"
#include "tests/bench/benchmarks.h"
#include "tests/bench/work.h"
#include "tests/caveclod/synthetic_hierarchy.h"

namespace overlook::bench {
namespace {

// What is read of each split evaluated, and written of each face that an operation touches.
constexpr double kEvaluatedBytes = sizeof(caveclod::Bounds), kOperationBytes = 6 * 3 * sizeof(uint32_t);

struct Model {
    caveclod::Hierarchy hierarchy;
    std::unique_ptr<caveclod::Mesh> mesh;
    uint32_t side = 0;
};

// Made when the first benchmark wants it, and kept.
const Model& model(uint32_t side) {
    static Model kept;
    if (kept.side == side) return kept;
    kept.hierarchy = caveclod::synthetic::bake(caveclod::synthetic::hills(side, side, 3));
    kept.mesh = std::make_unique<caveclod::Mesh>(*caveclod::Mesh::make(kept.hierarchy));
    kept.side = side;
    return kept;
}

// A lap of a small circle low over the hills: 0.3 m and 6 degrees a frame. From the second lap on all repeats itself.
constexpr int kLapFrames = 60, kLapsBefore = 3;
view::Camera flown(const Model& on, int frame, double turn_deg) {
    double t = frame * 2 * std::numbers::pi / kLapFrames, middle = on.side / 2.0;
    view::Camera camera;
    camera.position_m = {middle + 3 * std::cos(t), middle + 3 * std::sin(t), 12};
    camera.heading_deg = turn_deg + 20 * std::sin(t);
    camera.pitch_deg = -15;
    camera.near_m = 0.1;
    return camera;
}

caveclod::Settings settings() {
    caveclod::Settings asked;
    asked.error_px = 1;
    asked.most_operations = 0;
    return asked;
}

double least_bytes(const caveclod::FrameReport& report) {
    return kEvaluatedBytes * report.evaluated_count + kOperationBytes * (report.split_count + report.collapse_count);
}

// Measures laps; frame(i) does one frame.
void repeat_laps(benchmark::State& state, const std::function<Work(int)>& frame) {
    auto lap = [&] {
        Work work{0, "active faces", 0};
        for (int i = 0; i < kLapFrames; ++i) {
            Work one = frame(i);
            work.count += one.count, work.least_bytes += one.least_bytes;
        }
        return work;
    };
    for (int i = 0; i < kLapsBefore; ++i) lap();
    repeat(state, lap);
}

Work work_of(std::span<const caveclod::FrameReport> reports) {
    Work work{0, "active faces", 0};
    for (const caveclod::FrameReport& report : reports)
        work.count += double(report.triangle_count), work.least_bytes += least_bytes(report);
    return work;
}

std::vector<view::Camera> four_cameras(const Model& on, int frame) {
    std::vector<view::Camera> cameras;
    for (int c = 0; c < 4; ++c) cameras.push_back(flown(on, frame, 90.0 * c));
    return cameras;
}

void refine_one(benchmark::State& state, uint32_t side, bool moves) {
    const Model& on = model(side);
    caveclod::Refinement refinement(*on.mesh);
    repeat_laps(state, [&](int frame) {
        caveclod::FrameReport report = refinement.refine(flown(on, moves ? frame : 0, 0), settings(), 1.0 / 60);
        return work_of(std::span(&report, 1));
    });
}

void refine_four(benchmark::State& state, uint32_t side) {
    const Model& on = model(side);
    std::vector<caveclod::Refinement> refinements;
    std::vector<caveclod::Refinement*> pointers;
    for (int c = 0; c < 4; ++c) refinements.emplace_back(*on.mesh);
    for (caveclod::Refinement& refinement : refinements) pointers.push_back(&refinement);
    std::vector<caveclod::FrameReport> reports(4);
    repeat_laps(state, [&](int frame) {
        caveclod::refine_all(pointers, four_cameras(on, frame), settings(), 1.0 / 60, reports);
        return work_of(reports);
    });
}

void refine_in_turn(benchmark::State& state, uint32_t side) {
    const Model& on = model(side);
    caveclod::Refinement shared(*on.mesh);
    std::vector<caveclod::FrameReport> reports(4);
    repeat_laps(state, [&](int frame) {
        caveclod::refine_in_turn(
            shared, four_cameras(on, frame), settings(), [](size_t) {}, reports);
        return work_of(reports);
    });
}

void refine_as_printed(benchmark::State& state, uint32_t side) {
    const Model& on = model(side);
    caveclod::paper::Mesh mesh(on.hierarchy);
    caveclod::paper::CameraRefinement refinement(mesh);
    caveclod::paper::Options options;
    options.settings = settings();
    repeat_laps(state, [&](int frame) {
        caveclod::FrameReport report = refinement.refine(flown(on, frame, 0), options);
        return Work{double(report.triangle_count), "active faces", 12.0 * report.evaluated_count};
    });
}

}  // namespace

void add_caveclod(uint32_t side) {
    std::string name = fmt::format("mesh_{}", 2 * side * side);
    add("caveclod_refine_moving", name, [=](benchmark::State& state) { refine_one(state, side, true); });
    add("caveclod_refine_standing", name, [=](benchmark::State& state) { refine_one(state, side, false); });
    add("caveclod_refine_4_cameras", name, [=](benchmark::State& state) { refine_four(state, side); });
    add("caveclod_shared_4_cameras", name, [=](benchmark::State& state) { refine_in_turn(state, side); });
    add("caveclod_paper_moving", name, [=](benchmark::State& state) { refine_as_printed(state, side); });
}

}  // namespace overlook::bench
