// Meshes for chains of levels: a bumpy ball, and a bush of cards round it.
#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include "tools/bake/mesh_input.h"
#include "tools/make_sample/shapes.h"

namespace overlook::discrete::test {

inline mesh::Options with_motion() {
    mesh::Options options;
    options.reads_motion = true;
    return options;
}

inline mesh::MeshFile file_of(mesh::Mesh mesh) {
    mesh::MeshFile file;
    if (mesh.uvs.empty()) mesh.face_uvs.clear();
    file.report.source_name = "made.glb";
    file.mesh = std::move(mesh);
    return file;
}

inline void add_ball(sample::ShapeMaker& shapes, uint32_t surface, uint32_t rings, uint32_t sides, double radius_m,
                     double bumps_m) {
    shapes.add_tube(surface, rings, sides, true, [=](double share, double angle) {
        double at = std::numbers::pi * (0.02 + 0.96 * share);
        double r = radius_m + bumps_m * std::sin(5 * angle) * std::sin(4 * at);
        return glm::dvec3(r * std::sin(at) * std::cos(angle), r * std::sin(at) * std::sin(angle), -r * std::cos(at));
    });
}

inline mesh::Surface leaves() {
    mesh::Surface surface;
    surface.name = "leaves", surface.is_alpha_masked = surface.is_two_sided = true;
    return surface;
}

// A ball of 1 m in `card_count` cards of 0.1 m.
inline mesh::Mesh bush(uint32_t card_count) {
    mesh::Surface bark;
    bark.name = "bark";
    sample::ShapeMaker shapes({bark, leaves()});
    add_ball(shapes, 0, 24, 32, 0.5, 0.05);
    std::mt19937_64 random(7);
    auto number = [&] { return double(random() >> 11) * 0x1p-53 * 2 - 1; };
    for (uint32_t i = 0; i < card_count; ++i) {
        glm::dvec3 out = glm::normalize(glm::dvec3(number(), number(), number()) + glm::dvec3(1e-3, 0, 0));
        glm::dvec3 facing = glm::normalize(out + 0.5 * glm::dvec3(number(), number(), number()));
        glm::dvec3 right = sample::side_of(facing);
        shapes.add_card(1, (1 + 0.3 * number()) * out, 0.05 * right, 0.05 * glm::cross(facing, right), glm::vec3(facing));
    }
    return shapes.take();
}

}  // namespace overlook::discrete::test
