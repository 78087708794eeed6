// A mesh measured: a torus of 16,384 triangles, for the tests of what draws meshes.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/tools/caveclod/test_meshes.h"
#include "tools/bake/caveclod/bake.h"
#include "tools/measure/methods.h"
#include "tools/measure/run.h"

namespace overlook::measure {

// Baked once a process.
inline const caveclod::Hierarchy& torus_hierarchy() {
    static const caveclod::Hierarchy kHierarchy = [] {
        caveclod::BakeReport report;
        auto hierarchy = caveclod::bake(caveclod::test::torus(128, 64, 10, 4), {}, report, [](double) {});
        EXPECT_TRUE(hierarchy);
        return std::move(*hierarchy);
    }();
    return kHierarchy;
}

// Uploaded.
inline World torus_world() {
    World world;
    world.name = "torus", world.content_hash = "the same torus";
    MeshWorld& made = world.mesh.emplace();
    made.hierarchy = std::make_unique<caveclod::Hierarchy>(torus_hierarchy());
    made.mesh = std::make_unique<caveclod::Mesh>(*caveclod::Mesh::make(*made.hierarchy));
    EXPECT_TRUE(upload(world));
    return world;
}

}  // namespace overlook::measure
