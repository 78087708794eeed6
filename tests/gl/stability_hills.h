// A small world and a flight over it, for the stability suite's tests.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "tests/gl/fixture.h"
#include "tools/measure/stability/stage.h"

namespace overlook::measure {

// The fixture's hills, flown over northwards in small steps.
struct Hills {
    World world;
    scene::Flight flight;

    Hills() {
        world.name = "hills";
        world.content_hash = "the same hills";
        world.terrain = std::make_unique<terrain::Terrain>(test::hilly_terrain(129));
        world.refiner.emplace(*world.terrain);
        world.look.anisotropy = 1;
        EXPECT_TRUE(upload(world));
        view::Camera camera = test::from_south(*world.terrain, 96, 96);
        world.base = camera;
        flight.interpolation = scene::Interpolation::linear;
        const glm::dvec3& at_m = camera.position_m;
        flight.keys.push_back({0, {at_m.x, at_m.y, at_m.z}, camera.heading_deg, camera.pitch_deg, {}});
        flight.keys.push_back({3, {at_m.x, at_m.y + 90, at_m.z}, camera.heading_deg, camera.pitch_deg, {}});
    }
    Stage stage(const gl::Renderer& renderer, uint32_t frames) { return {world, renderer, 96, 96, frames, 1, ""}; }
};

}  // namespace overlook::measure
