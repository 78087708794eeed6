#include "tools/make_sample/flight_lift.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "runtime/view/flight.h"

namespace overlook::sample {

void lift(scene::Flight& flight, const GroundHeight& ground_m, double clearance_m) {
    for (int round = 0; round < 200; ++round) {
        bool is_low = false;
        for (uint32_t frame = 0; frame < scene::frame_count(flight); ++frame) {
            double time_s = scene::frame_time_s(flight, frame);
            glm::dvec3 at_m = view::camera_at(flight, time_s, {}).position_m;
            double lack_m = ground_m(at_m.x, at_m.y) + clearance_m - at_m.z;
            if (lack_m <= 0) continue;
            is_low = true;
            size_t after = 0;
            while (after + 1 < flight.keys.size() && flight.keys[after].time_s <= time_s) ++after;
            flight.keys[after].position_m[2] += std::ceil(lack_m);
            if (after > 0) flight.keys[after - 1].position_m[2] += std::ceil(lack_m);
        }
        if (!is_low) return;
    }
    double lack_m = clearance_m - least_clearance_m(flight, ground_m);
    for (scene::Key& key : flight.keys) key.position_m[2] += std::max(0.0, std::ceil(lack_m));
}

double least_clearance_m(const scene::Flight& flight, const GroundHeight& ground_m) {
    double least_m = std::numeric_limits<double>::infinity();
    for (uint32_t frame = 0; frame < scene::frame_count(flight); ++frame) {
        glm::dvec3 at_m = view::camera_at(flight, scene::frame_time_s(flight, frame), {}).position_m;
        least_m = std::min(least_m, at_m.z - ground_m(at_m.x, at_m.y));
    }
    return least_m;
}

}  // namespace overlook::sample
