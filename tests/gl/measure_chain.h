// A field of spheres of four levels, flown towards: for the tests of what measures chains.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/runtime/discrete/chains.h"
#include "tools/measure/methods.h"
#include "tools/measure/run.h"

namespace overlook::measure {

inline std::vector<scene::Instance> field_of(int side, double apart_m) {
    std::vector<scene::Instance> instances;
    for (int i = 0; i < side * side; ++i) {
        scene::Transform one;
        one.translation_m = {apart_m * (i % side - side / 2), apart_m * (i / side), 0.2 * (i * 7 % 5)};
        one.rotation_z_deg = i * 37 % 360;
        one.scale = 1 + 0.1 * (i % 3);
        instances.push_back({one});
    }
    return instances;
}

// Uploaded.
inline World world_of_chain(const std::string& name, discrete::Chain chain, const std::vector<scene::Instance>& instances) {
    World world;
    world.name = name, world.content_hash = "the same " + name;
    world.chains.push_back(chain_world(std::move(chain), instances));
    world.base.near_m = 0.01;
    EXPECT_TRUE(upload(world));
    return world;
}

// Towards the field at some height, a metre in six frames, looking a little down.
inline std::vector<view::Camera> dolly(uint32_t frames, uint32_t width_px, uint32_t height_px) {
    std::vector<view::Camera> cameras;
    for (uint32_t frame = 0; frame < frames; ++frame) {
        view::Camera camera;
        camera.position_m = {0.3, -14 + frame / 6.0, 4.5}, camera.pitch_deg = -14, camera.near_m = 0.01;
        camera.width_px = width_px, camera.height_px = height_px, camera.fov_y_deg = 45;
        cameras.push_back(camera);
    }
    return cameras;
}

}  // namespace overlook::measure
