// Several cameras' refinements at once: each as if it were alone.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <iterator>

#include "formats/parallel.h"
#include "runtime/caveclod/refine.h"
#include "tests/caveclod/drawn_faces.h"
#include "tests/caveclod/flights.h"
#include "tests/caveclod/synthetic_hierarchy.h"

namespace overlook::caveclod {
namespace {

using synthetic::buffers;

using flights::camera_at;
using flights::flown;
using flights::hills;
using flights::kFrame_s;
using flights::mesh_of;
using flights::plain;

TEST(Refinements, OfManyCamerasAreEachAsIfAloneWithAnyThreadCount) {
    Mesh mesh = mesh_of(hills());
    constexpr size_t kCameras = 4;
    Settings settings = plain();
    settings.glide_s = 0.25, settings.most_operations = 300;
    std::vector<std::vector<uint32_t>> alone;
    for (size_t c = 0; c < kCameras; ++c) {
        Refinement refinement(mesh);
        for (int frame = 0; frame < 20; ++frame) refinement.refine(flown(0.05 * frame + 1.5 * double(c)), settings, kFrame_s);
        alone.push_back(buffers(refinement));
    }
    for (unsigned threads : {1u, 2u, 4u}) {
        set_thread_count(threads);
        std::vector<Refinement> refinements;
        for (size_t c = 0; c < kCameras; ++c) refinements.emplace_back(mesh);
        std::vector<Refinement*> pointers;
        for (Refinement& refinement : refinements) pointers.push_back(&refinement);
        std::vector<FrameReport> reports(kCameras);
        for (int frame = 0; frame < 20; ++frame) {
            std::vector<view::Camera> cameras;
            for (size_t c = 0; c < kCameras; ++c) cameras.push_back(flown(0.05 * frame + 1.5 * double(c)));
            refine_all(pointers, cameras, settings, kFrame_s, reports);
        }
        for (size_t c = 0; c < kCameras; ++c) EXPECT_EQ(buffers(refinements[c]), alone[c]) << threads << " threads, camera " << c;
    }
    set_thread_count(0);
}

// One camera has almost all of the work, in several parts, so that others' threads come to its help.
TEST(Refinements, OfUnequalCamerasAreEachAsIfAloneWithAnyThreadCount) {
    static const Hierarchy kWide = synthetic::bake(synthetic::hills(120, 120, 3));
    Mesh mesh = mesh_of(kWide);
    Settings settings = plain();
    settings.glide_s = 0.25, settings.error_px = 0.5;
    constexpr size_t kCameras = 3;
    auto cameras_of = [](int frame) {
        view::Camera away = camera_at(60, -4000, 10, 180, 0), far = camera_at(60, -900, 60, 0, 0);
        return std::array{away, camera_at(60, 10 + 0.4 * frame, 14, 0.2 * frame, -15), far};
    };
    auto fly = [&](unsigned threads, std::vector<std::vector<uint32_t>>& all, std::vector<uint32_t>& evaluated,
                   std::vector<double>& errors_px) {
        set_thread_count(threads);
        std::vector<Refinement> refinements;
        for (size_t c = 0; c < kCameras; ++c) refinements.emplace_back(mesh);
        std::vector<Refinement*> pointers;
        for (Refinement& refinement : refinements) pointers.push_back(&refinement);
        std::array<FrameReport, kCameras> reports;
        for (int frame = 0; frame < 30; ++frame) {
            refine_all(pointers, cameras_of(frame), settings, kFrame_s, reports);
            for (const FrameReport& report : reports) {
                evaluated.push_back(report.evaluated_count);
                errors_px.push_back(report.error_px);
            }
            for (const Refinement& refinement : refinements) all.push_back(buffers(refinement));
        }
    };
    std::vector<std::vector<uint32_t>> alone, together;
    std::vector<uint32_t> evaluated_alone, evaluated_together;
    std::vector<double> errors_alone_px, errors_together_px;
    fly(1, alone, evaluated_alone, errors_alone_px);
    EXPECT_GT(evaluated_alone[evaluated_alone.size() - 2], 1000u);
    for (unsigned threads : {2u, 5u}) {
        together.clear(), evaluated_together.clear(), errors_together_px.clear();
        fly(threads, together, evaluated_together, errors_together_px);
        EXPECT_EQ(together, alone) << threads;
        EXPECT_EQ(evaluated_together, evaluated_alone) << threads;
        EXPECT_EQ(errors_together_px, errors_alone_px) << threads;
    }
    set_thread_count(0);
}

ptrdiff_t threads_of_process() {
    return std::distance(std::filesystem::directory_iterator("/proc/self/task"), std::filesystem::directory_iterator());
}

// A small mesh is one part a camera: threads beyond those would only wait.
TEST(Refinements, TakeNoMoreThreadsThanThereAreParts) {
    const Hierarchy small = synthetic::bake(synthetic::hills(12, 12, 2));
    Mesh mesh = mesh_of(small), wide = mesh_of(hills());
    std::vector<Refinement> refinements;
    for (int camera = 0; camera < 3; ++camera) refinements.emplace_back(mesh);
    EXPECT_EQ(refinements[0].part_count(), 1u);
    EXPECT_GT(Refinement(wide).part_count(), 1u);
    std::array<Refinement*, 3> pointers{&refinements[0], &refinements[1], &refinements[2]};
    std::array cameras{flown(0), flown(1), flown(2)};
    std::array<FrameReport, 3> reports;
    set_thread_count(40);
    ptrdiff_t before = threads_of_process();
    refine_all(pointers, cameras, plain(), kFrame_s, reports);
    EXPECT_LE(threads_of_process() - before, 2);
    set_thread_count(0);
}

}  // namespace
}  // namespace overlook::caveclod
