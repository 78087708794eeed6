// What the tests of refinement share: a mesh of hills, cameras over it, and settings.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "runtime/caveclod/mesh.h"
#include "runtime/caveclod/settings.h"
#include "runtime/view/camera.h"
#include "tests/caveclod/synthetic_hierarchy.h"

namespace overlook::caveclod::flights {

constexpr double kFrame_s = 1.0 / 60;

// 64 m wide; baked once a process.
inline const Hierarchy& hills() {
    static const Hierarchy kHills = synthetic::bake(synthetic::hills(64, 64, 3));
    return kHills;
}

inline view::Camera camera_at(double x, double y, double z, double heading_deg, double pitch_deg, uint32_t width_px = 800,
                              uint32_t height_px = 600) {
    view::Camera camera;
    camera.position_m = {x, y, z};
    camera.heading_deg = heading_deg, camera.pitch_deg = pitch_deg;
    camera.width_px = width_px, camera.height_px = height_px;
    camera.near_m = 0.1;
    return camera;
}

// Round hills of 64 m and down to them.
inline view::Camera flown(double t) {
    double away_m = 50 + 30 * std::sin(1.3 * t);
    return camera_at(32 + away_m * std::sin(t), 32 - away_m * std::cos(t), 12 + 6 * std::sin(2.7 * t), -t * 180 / 3.14159265,
                     -25);
}

inline Mesh mesh_of(const Hierarchy& hierarchy) {
    Result<Mesh> mesh = Mesh::make(hierarchy);
    EXPECT_TRUE(mesh);
    return std::move(*mesh);
}

inline Settings plain() {
    Settings settings;
    settings.error_px = 4;
    settings.glide_s = 0;
    settings.most_operations = 0;
    return settings;
}

}  // namespace overlook::caveclod::flights
