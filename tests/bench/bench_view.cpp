// What is asked once a frame or once a node: no work on memory, so no share of the memory's limit.

#include <algorithm>

#include "runtime/view/error_budget.h"
#include "runtime/view/flight.h"
#include "runtime/view/pixel_error.h"
#include "tests/bench/benchmarks.h"
#include "tests/bench/work.h"

namespace overlook::bench {
namespace {

constexpr int kCalls = 10'000;

void pixel_error(benchmark::State& state) {
    view::Camera camera;
    double focal = view::focal_px(camera), secant = view::corner_secant(camera);
    repeat(state, [&] {
        double sum = 0;
        for (int i = 1; i <= kCalls; ++i) sum += view::error_px_bound_vertical(focal, 0.01 * i, 100.0 + i, secant, 5.0 * i, 0.3);
        benchmark::DoNotOptimize(sum);
        return Work{kCalls, "bounds"};
    });
}

void pixel_error_of_sphere(benchmark::State& state) {
    view::Camera camera;
    repeat(state, [&] {
        double sum = 0;
        for (int i = 1; i <= kCalls; ++i) sum += view::error_px_bound_of_sphere(camera, {10.0, 50.0 + i, -5.0}, 20, 0.01 * i);
        benchmark::DoNotOptimize(sum);
        return Work{kCalls, "bounds"};
    });
}

void camera_at(benchmark::State& state) {
    scene::Flight flight;
    for (int i = 0; i < 1000; ++i) {
        scene::Key key;
        key.time_s = i;
        key.position_m = {10.0 * i, 3.0 * (i % 7), 100};
        key.heading_deg = 13.0 * i;
        flight.keys.push_back(key);
    }
    repeat(state, [&] {
        double sum = 0;
        for (int i = 0; i < kCalls; ++i) sum += view::camera_at(flight, 0.0999 * i, {}).position_m.x;
        benchmark::DoNotOptimize(sum);
        return Work{kCalls, "cameras"};
    });
}

// Frames whose cost falls as 1 / error, from a scene that grows dearer and cheaper.
void error_controller(benchmark::State& state) {
    repeat(state, [&] {
        view::ErrorController controller({1e5, 1, true});
        for (int i = 0; i < kCalls; ++i) controller.frame_done((2e5 + 50.0 * std::abs(i % 4000 - 2000)) / controller.error_px());
        benchmark::DoNotOptimize(controller);
        return Work{kCalls, "frames"};
    });
}

}  // namespace

void add_view() {
    add("pixel_error", "vertical", pixel_error);
    add("pixel_error", "sphere", pixel_error_of_sphere);
    add("camera_at", "1000_keys", camera_at);
    add("error_controller", "10000_frames", error_controller);
}

}  // namespace overlook::bench
