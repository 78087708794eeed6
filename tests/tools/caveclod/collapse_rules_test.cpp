// Which collapses are allowed, against OpenMesh's own answer and by hand.
#include "tools/bake/caveclod/collapse_rules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wextra"
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#pragma GCC diagnostic pop

#include "tests/tools/caveclod/test_meshes.h"

namespace overlook::caveclod {
namespace {

struct StatusTraits : OpenMesh::DefaultTraits {
    VertexAttributes(OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status);
    HalfedgeAttributes(OpenMesh::Attributes::Status);
};
using Reference = OpenMesh::TriMesh_ArrayKernelT<StatusTraits>;

Reference reference_of(const mesh::Mesh& mesh) {
    Reference reference;
    for (size_t p = 0; p < mesh.positions_m.size(); ++p) reference.new_vertex();
    for (const mesh::Corners& f : mesh.faces) {
        auto corner = [&](size_t c) { return OpenMesh::VertexHandle(int(f[c])); };
        EXPECT_TRUE(reference.add_face(corner(0), corner(1), corner(2)).is_valid());
    }
    return reference;
}

uint32_t working_number(const WorkingMesh& mesh, uint32_t source) {
    return uint32_t(std::find(mesh.source_position.begin(), mesh.source_position.end(), source) - mesh.source_position.begin());
}

// gone, kept: numbers in the mesh that the working one was made of.
bool gather_fan(const WorkingMesh& mesh, uint32_t source_gone, uint32_t source_kept, Fan& fan) {
    uint32_t gone = working_number(mesh, source_gone), kept = working_number(mesh, source_kept);
    Star star;
    if (!gather_star(mesh, gone, star)) return false;
    uint32_t at = 0;
    while (at <= star.count && star.link[at] != kept) ++at;
    return at <= star.count && fan_of(star, gone, at, fan);
}

// Collapses at random, one after the other, in both; at every step all half-edges must have the same answer. Of an open star with
// one face ours refuses what OpenMesh allows; there are no folded curves where nothing but the border is a feature and it is
// long.
TEST(CollapseRules, AgreeWithOpenMeshOnTopology) {
    for (const mesh::Mesh& mesh : {test::sphere(9, 6), test::torus(8, 5, 1, 0.3), test::grid(7, 6, test::rough_m)}) {
        auto groups = find_groups(mesh, {});
        auto ours = make_working_mesh(mesh, *groups);
        ASSERT_TRUE(ours.has_value());
        Reference reference = reference_of(mesh);
        uint64_t random = 1;
        size_t compared = 0, made = 0, allowed = 0;
        for (int step = 0; step < 400; ++step) {
            for (auto h : reference.halfedges()) {
                if (reference.status(reference.edge_handle(h)).deleted()) continue;
                Fan fan;
                uint32_t gone = uint32_t(reference.from_vertex_handle(h).idx()),
                         kept = uint32_t(reference.to_vertex_handle(h).idx());
                if (reference.valence(reference.from_vertex_handle(h)) < 3) continue;
                bool is_ours = gather_fan(*ours, gone, kept, fan) && keeps_topology(*ours, fan);
                // OpenMesh also lets a border position go inwards; here the border stays where it is.
                if (reference.is_boundary(reference.from_vertex_handle(h)) &&
                    !reference.is_boundary(reference.to_vertex_handle(h))) {
                    ASSERT_FALSE(is_ours) << gone << " into " << kept << " after " << made << " collapses";
                    continue;
                }
                bool is_tetrahedron = reference.valence(reference.from_vertex_handle(h)) == 3 &&
                                      reference.valence(reference.to_vertex_handle(h)) == 3;
                if (is_tetrahedron && !is_ours) continue;
                ++compared, allowed += is_ours;
                ASSERT_EQ(is_ours, reference.is_collapse_ok(h)) << gone << " into " << kept << " after " << made << " collapses";
            }
            random = random * 6364136223846793005u + 1442695040888963407u;
            OpenMesh::HalfedgeHandle h(int((random >> 33) % reference.n_halfedges()));
            if (reference.status(reference.edge_handle(h)).deleted()) continue;
            Fan fan;
            uint32_t gone = uint32_t(reference.from_vertex_handle(h).idx()), kept = uint32_t(reference.to_vertex_handle(h).idx());
            if (!gather_fan(*ours, gone, kept, fan) || !keeps_topology(*ours, fan)) continue;
            reference.collapse(h);
            apply_collapse(*ours, fan, TurnedVertices{});
            ++made;
        }
        EXPECT_GT(made, 15u);
        EXPECT_GT(allowed, 0u);
        EXPECT_LT(allowed, compared);
    }
}

struct Made {
    mesh::Mesh mesh;
    Groups groups;
    WorkingMesh working;
};
std::unique_ptr<Made> make(mesh::Mesh mesh, double crease_deg) {
    auto made = std::make_unique<Made>();
    made->mesh = std::move(mesh);
    GroupOptions options;
    options.crease_deg = crease_deg;
    made->groups = std::move(*find_groups(made->mesh, options));
    made->working = std::move(*make_working_mesh(made->mesh, made->groups));
    return made;
}

TEST(CollapseRules, LetSharpPositionsMoveAlongTheirFeatureOnly) {
    auto cube = make(test::cube(4), 40);
    size_t along = 0, across = 0;
    for (uint32_t gone = 0; gone < cube->working.positions_m.size(); ++gone) {
        Star star;
        ASSERT_TRUE(gather_star(cube->working, gone, star));
        for (uint32_t at = 0; at < star.count; ++at) {
            Fan fan;
            TurnedVertices turned;
            ASSERT_TRUE(fan_of(star, gone, at, fan));
            bool is_allowed = keeps_groups(cube->working, fan, turned);
            auto on_rim = [&](uint32_t p) {
                glm::vec3 v = cube->working.positions_m[p];
                return int(v.x == 0 || v.x == 1) + int(v.y == 0 || v.y == 1) + int(v.z == 0 || v.z == 1);
            };
            glm::vec3 step = cube->working.positions_m[fan.kept] - cube->working.positions_m[gone];
            bool is_straight = int(step.x != 0) + int(step.y != 0) + int(step.z != 0) == 1;
            // Corners of the cube stay; along a rim only the rim's own positions are reached; inside a side everything is free.
            bool should_be = on_rim(gone) == 1 || (on_rim(gone) == 2 && is_straight && on_rim(fan.kept) >= 2);
            EXPECT_EQ(is_allowed, should_be) << gone << " into " << fan.kept;
            if (on_rim(gone) == 2) ++(is_allowed ? along : across);
        }
    }
    EXPECT_EQ(along, 12u * 3 * 2);
    EXPECT_GT(across, along);
}

TEST(CollapseRules, NeverFoldAFeatureCurveOfThreeEdges) {
    // A cone over a triangle: its base's rim is a curve of three creases.
    mesh::Mesh mesh;
    mesh.positions_m = {{1, 0, 0}, {-0.5f, 0.87f, 0}, {-0.5f, -0.87f, 0}, {0, 0, 1}, {0, 0, -0.01f}};
    mesh.faces = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 0, 4}, {2, 1, 4}, {0, 2, 4}};
    test::finish(mesh);
    auto cone = make(mesh, 40);
    for (uint32_t gone : {0u, 1u, 2u})
        for (uint32_t kept : {0u, 1u, 2u}) {
            Fan fan;
            if (gone == kept || !gather_fan(cone->working, gone, kept, fan)) continue;
            EXPECT_FALSE(keeps_topology(cone->working, fan));
        }
}

TEST(CollapseRules, RefuseFacesThatTurnOver) {
    // A notch at position 3: seen from position 2, its far side is turned over.
    mesh::Mesh mesh;
    mesh.positions_m = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {3, 1.2f, 0}, {0, 4, 0}};
    mesh.faces = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {0, 3, 5}, {3, 2, 5}};
    test::finish(mesh);
    auto dart = make(mesh, 180);
    Fan fan;
    ASSERT_TRUE(gather_fan(dart->working, 4, 2, fan));
    EXPECT_FALSE(keeps_orientation(dart->working, fan));
    ASSERT_TRUE(gather_fan(dart->working, 4, 3, fan));
    EXPECT_TRUE(keeps_orientation(dart->working, fan));
}

}  // namespace
}  // namespace overlook::caveclod
