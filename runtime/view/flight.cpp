#include "runtime/view/flight.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace overlook::view {
namespace {

constexpr size_t kHeading = 3;
using Pose = std::array<double, 6>;  // x, y, z, heading, pitch, field of view

Pose pose_of(const scene::Key& key, const Camera& base) {
    const auto& [x, y, z] = key.position_m;
    return {x, y, z, key.heading_deg, key.pitch_deg, key.fov_y_deg.value_or(base.fov_y_deg)};
}

Camera camera_of(const Pose& pose, const Camera& base) {
    Camera camera = base;
    camera.position_m = {pose[0], pose[1], pose[2]};
    camera.heading_deg = pose[3];
    camera.pitch_deg = std::clamp(pose[4], -90.0, 90.0);
    camera.fov_y_deg = std::clamp(pose[5], 1.0, 170.0);
    return camera;
}

// A flight's keys as the formula names them.
struct Path {
    const scene::Flight& flight;
    const Camera& base;

    double h(size_t i) const { return flight.keys[i + 1].time_s - flight.keys[i].time_s; }
    Pose delta(size_t i) const {
        Pose from = pose_of(flight.keys[i], base), to = pose_of(flight.keys[i + 1], base);
        Pose delta;
        for (size_t k = 0; k < delta.size(); ++k) delta[k] = to[k] - from[k];
        delta[kHeading] = std::remainder(delta[kHeading], 360.0);
        return delta;
    }
    // The slope at key i.
    Pose m(size_t i) const {
        size_t last = flight.keys.size() - 1;
        if (last == 1) return scaled(delta(0), 1 / h(0));
        size_t middle = std::clamp<size_t>(i, 1, last - 1);  // of the three keys
        double h0 = h(middle - 1), h1 = h(middle);
        Pose d0 = delta(middle - 1), d1 = delta(middle);
        Pose slope;
        for (size_t k = 0; k < slope.size(); ++k) {
            double before = d0[k] / h0, after = d1[k] / h1;
            double bend = (after - before) / (h0 + h1);  // half the parabola's second derivative
            slope[k] = i < middle ? before - h0 * bend : i > middle ? after + h1 * bend : (h1 * before + h0 * after) / (h0 + h1);
        }
        return slope;
    }
    static Pose scaled(Pose pose, double factor) {
        for (double& value : pose) value *= factor;
        return pose;
    }
};

}  // namespace

Camera camera_at(const scene::Flight& flight, double time_s, const Camera& base) {
    assert(!flight.keys.empty());
    const std::vector<scene::Key>& keys = flight.keys;
    if (!(time_s > keys.front().time_s)) return camera_of(pose_of(keys.front(), base), base);
    if (time_s >= keys.back().time_s) return camera_of(pose_of(keys.back(), base), base);
    auto after =
        std::upper_bound(keys.begin(), keys.end(), time_s, [](double time, const scene::Key& key) { return time < key.time_s; });
    size_t i = size_t(after - keys.begin()) - 1;

    Pose pose = pose_of(keys[i], base);
    double s = (time_s - keys[i].time_s) / (keys[i + 1].time_s - keys[i].time_s);
    if (flight.interpolation == scene::Interpolation::constant || s == 0) return camera_of(pose, base);

    Path path{flight, base};
    Pose delta = path.delta(i);
    if (flight.interpolation == scene::Interpolation::linear) {
        for (size_t k = 0; k < pose.size(); ++k) pose[k] += s * delta[k];
        return camera_of(pose, base);
    }
    Pose m0 = path.m(i), m1 = path.m(i + 1);
    double h = path.h(i), s2 = s * s, s3 = s2 * s;
    double along = 3 * s2 - 2 * s3, leaving = (s3 - 2 * s2 + s) * h, arriving = (s3 - s2) * h;
    for (size_t k = 0; k < pose.size(); ++k) pose[k] += along * delta[k] + leaving * m0[k] + arriving * m1[k];
    return camera_of(pose, base);
}

Camera camera_into(const scene::Transform& transform, const Camera& camera) {
    double angle = transform.rotation_z_deg * std::numbers::pi / 180;
    double cosine = std::cos(angle), sine = std::sin(angle);
    const auto& [x, y, z] = transform.translation_m;
    glm::dvec3 from_origin_m = camera.position_m - glm::dvec3(x, y, z);
    Camera local = camera;
    local.position_m.x = (cosine * from_origin_m.x + sine * from_origin_m.y) / transform.scale;
    local.position_m.y = (cosine * from_origin_m.y - sine * from_origin_m.x) / transform.scale;
    local.position_m.z = from_origin_m.z / transform.scale;
    local.heading_deg = camera.heading_deg + transform.rotation_z_deg;
    local.near_m = camera.near_m / transform.scale;
    return local;
}

Camera camera_out_of(const scene::Transform& transform, const Camera& camera) {
    double angle = transform.rotation_z_deg * std::numbers::pi / 180;
    double cosine = std::cos(angle), sine = std::sin(angle);
    const auto& [x, y, z] = transform.translation_m;
    glm::dvec3 local_m = camera.position_m * transform.scale;
    Camera world = camera;
    world.position_m.x = cosine * local_m.x - sine * local_m.y + x;
    world.position_m.y = sine * local_m.x + cosine * local_m.y + y;
    world.position_m.z = local_m.z + z;
    world.heading_deg = camera.heading_deg - transform.rotation_z_deg;
    world.near_m = camera.near_m * transform.scale;
    return world;
}

}  // namespace overlook::view
