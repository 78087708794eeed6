// The numbers of `measure` on pictures of a plane under a sky, seen from two places.

#include <fmt/format.h>

#include "tests/bench/benchmarks.h"
#include "tests/bench/work.h"
#include "tests/tools/numbers_pictures.h"
#include "tools/measure/numbers/flip.h"
#include "tools/measure/numbers/silhouette.h"
#include "tools/measure/numbers/temporal.h"

namespace overlook::bench {
namespace {

// A pair of frames one step apart, and the same drawn a little wrong: from 1 m higher.
struct Pictures {
    measure::Frame before, now, test_before, test_now;
    double pixels = 0;

    explicit Pictures(uint32_t side_px) : pixels(double(side_px) * side_px) {
        view::Camera camera;
        camera.position_m = {0, 0, 100};
        camera.pitch_deg = -12;
        camera.width_px = camera.height_px = side_px;
        before = measure::plane_frame(camera);
        camera.position_m.z = 101;
        test_before = measure::plane_frame(camera);
        camera.position_m = {1, 4, 100};
        camera.heading_deg = 1;
        now = measure::plane_frame(camera);
        camera.position_m.z = 101;
        camera.pitch_deg = -11.9;  // its horizon stands a few pixels off
        test_now = measure::plane_frame(camera);
    }
};

// Two pictures in, a map out.
Work flip_once(const Pictures& at) {
    benchmark::DoNotOptimize(measure::flip(measure::rgb_of(at.test_now), measure::rgb_of(at.now)));
    return {at.pixels, "pixels", at.pixels * (3 + 3 + 4)};
}

// Two depths in, two coordinates out.
Work motion_once(const Pictures& at) {
    benchmark::DoNotOptimize(measure::motion_between(at.before, at.now));
    return {at.pixels, "pixels", at.pixels * (4 + 4 + 8)};
}

// Four pictures and a motion in.
Work unrest_once(const Pictures& at, const measure::Motion& motion) {
    benchmark::DoNotOptimize(measure::temporal_error(motion, measure::rgb_of(at.test_before), measure::rgb_of(at.test_now),
                                                     measure::rgb_of(at.before), measure::rgb_of(at.now)));
    return {at.pixels, "pixels", at.pixels * (4 * 3 + 8)};
}

// Ids of both in.
Work silhouette_once(const Pictures& at) {
    benchmark::DoNotOptimize(measure::silhouette_error(at.test_now, at.now));
    return {at.pixels, "pixels", at.pixels * (4 + 4)};
}

// Ids and depths of both in, a mask out.
Work holes_once(const Pictures& at) {
    benchmark::DoNotOptimize(measure::hole_pixels(at.test_now, at.now, 1));
    return {at.pixels, "pixels", at.pixels * (2 * (4 + 4) + 1)};
}

}  // namespace

void add_numbers(uint32_t side_px) {
    std::string input = fmt::format("{}x{}", side_px, side_px);
    auto on_pictures = [&](const char* name, Work (*once)(const Pictures&)) {
        add(name, input, [=](benchmark::State& state) {
            Pictures pictures(side_px);
            repeat(state, [&] { return once(pictures); });
        });
    };
    on_pictures("flip", flip_once);
    on_pictures("motion", motion_once);
    add("unrest", input, [=](benchmark::State& state) {
        Pictures pictures(side_px);
        measure::Motion motion = measure::motion_between(pictures.before, pictures.now);
        repeat(state, [&] { return unrest_once(pictures, motion); });
    });
    on_pictures("silhouette", silhouette_once);
    on_pictures("hole_pixels", holes_once);
}

}  // namespace overlook::bench
