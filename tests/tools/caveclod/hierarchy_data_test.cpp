// Hierarchies of real meshes. Wants OVERLOOK_DATA; skips without.
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>
#include <string>

#include "tools/bake/caveclod/groups.h"
#include "tools/bake/caveclod/prove_cuts.h"
#include "tools/bake/caveclod/simplify.h"
#include "tools/bake/mesh_input.h"

namespace overlook::caveclod {
namespace {

class RealHierarchy : public testing::TestWithParam<const char*> {
  protected:
    void SetUp() override {
        const char* data = std::getenv("OVERLOOK_DATA");
        if (data == nullptr) GTEST_SKIP() << "OVERLOOK_DATA names no folder";
        auto file = mesh::open_mesh(std::string(data) + "/mesh/" + GetParam());
        ASSERT_TRUE(file.has_value()) << file.error().message;
        mesh_ = std::move(file->mesh);
        groups_ = *find_groups(mesh_, {});
        auto hierarchy = build_hierarchy(mesh_, groups_, {}, &report_);
        ASSERT_TRUE(hierarchy.has_value()) << hierarchy.error().message;
        hierarchy_ = std::move(*hierarchy);
    }
    mesh::Mesh mesh_;
    Groups groups_;
    Hierarchy hierarchy_;
    SimplifyReport report_;
};
// One of every kind: clean and closed, seamed, tristrips, non-manifold, cut apart, flat-shaded, many small components.
INSTANTIATE_TEST_SUITE_P(Data, RealHierarchy,
                         testing::Values("armadillo.obj", "camel_b.obj", "igea_tristrips.ply", "bunny_nonmanifold.ply",
                                         "cube_tets.obj", "hour_glass.off", "edge_with_four_triangles.off", "duck.glb",
                                         "lowpoly_space.glb", "cycloidal.ply", "angle_block.STL", "chair_model.obj"));

TEST_P(RealHierarchy, KeepsEveryLawAndEveryFace) {
    EXPECT_EQ(broken_law(hierarchy_), "");
    EXPECT_EQ(hierarchy_.face_positions.size(), mesh_.faces.size());
    Applied all(hierarchy_.split_count(), 1);
    EXPECT_EQ(faces_of(hierarchy_, all).face.size(), mesh_.faces.size());
}

TEST_P(RealHierarchy, KeepsItsPromiseInRandomCuts) {
    ProofOptions options;
    options.cut_count = 6;
    CutsProof proof = prove_cuts(hierarchy_, options);
    EXPECT_EQ(proof.broken_count, 0u) << "first with seed " << proof.first_broken_seed;
    EXPECT_EQ(proof.turned_count, 0u) << "of " << proof.face_count;
}

TEST_P(RealHierarchy, DrawsOnlyRenderVerticesOfTheFacesOwnGroup) {
    // A render vertex is told by its place and attributes; the groups that have one such are known.
    using Key = std::array<float, 8>;
    auto key_of = [](const glm::vec3& p, const RenderVertex& v) {
        return Key{p.x, p.y, p.z, v.normal.x, v.normal.y, v.normal.z, v.uv.x, v.uv.y};
    };
    std::set<std::pair<uint32_t, Key>> known;
    for (size_t v = 0; v < groups_.vertices.size(); ++v)
        known.insert({groups_.vertex_group[v], key_of(mesh_.positions_m[groups_.vertices[v].position], groups_.vertices[v])});
    for (uint64_t seed = 0; seed < 4; ++seed) {
        CutFaces cut = faces_of(hierarchy_, random_cut(hierarchy_, mesh_.faces.size() >> (1 + 2 * seed), seed));
        size_t wrong = 0;
        for (size_t f = 0; f < cut.face.size(); ++f)
            for (uint32_t v : cut.vertices[f]) {
                const RenderVertex& vertex = hierarchy_.vertices[v];
                wrong += !known.contains(
                    {hierarchy_.face_group[cut.face[f]], key_of(hierarchy_.positions_m[vertex.position], vertex)});
            }
        EXPECT_EQ(wrong, 0u) << seed;
    }
}

}  // namespace
}  // namespace overlook::caveclod
