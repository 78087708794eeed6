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

inline caveclod::Hierarchy baked(const mesh::Mesh& mesh, const caveclod::BakeOptions& options = {}) {
    caveclod::BakeReport report;
    auto hierarchy = caveclod::bake(mesh, options, report, [](double) {});
    EXPECT_TRUE(hierarchy);
    return std::move(*hierarchy);
}

// Baked once a process.
inline const caveclod::Hierarchy& torus_hierarchy() {
    static const caveclod::Hierarchy kHierarchy = baked(caveclod::test::torus(128, 64, 10, 4));
    return kHierarchy;
}

// Uploaded.
inline World world_of(const std::string& name, const caveclod::Hierarchy& hierarchy) {
    World world;
    world.name = name, world.content_hash = "the same " + name;
    MeshWorld& made = world.mesh.emplace();
    made.hierarchy = std::make_unique<caveclod::Hierarchy>(hierarchy);
    made.mesh = std::make_unique<caveclod::Mesh>(*caveclod::Mesh::make(*made.hierarchy));
    EXPECT_TRUE(upload(world));
    return world;
}
inline World torus_world() {
    return world_of("torus", torus_hierarchy());
}

}  // namespace overlook::measure
