// Surface groups of real meshes, against what is known of them. Wants OVERLOOK_DATA; skips without.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <map>
#include <string>

#include "tools/bake/caveclod/groups.h"
#include "tools/bake/mesh_input.h"

namespace overlook::caveclod {
namespace {

constexpr double kUnknown = -1;

struct Known {
    const char* file;
    double ambiguous_share;  // of positions at which a group has several vertices
    double rigid_share;      // of positions
    int seam_edge_count;     // of groups against themselves
    uint32_t most_packed;    // ids that do
};
void PrintTo(const Known& known, std::ostream* out) {
    *out << known.file;
}

// The mesh before repair cut it apart: positions at one place are one again.
mesh::Mesh uncut(const mesh::Mesh& mesh) {
    mesh::Mesh whole = mesh;
    std::map<std::array<float, 3>, uint32_t> at;
    std::vector<uint32_t> merged;
    whole.positions_m.clear();
    for (const glm::vec3& place : mesh.positions_m) {
        auto [found, is_new] = at.emplace(std::array{place.x, place.y, place.z}, uint32_t(whole.positions_m.size()));
        if (is_new) whole.positions_m.push_back(place);
        merged.push_back(found->second);
    }
    for (auto& face : whole.faces)
        for (uint32_t& corner : face) corner = merged[corner];
    whole.link.clear();
    return whole;
}

class RealMesh : public testing::TestWithParam<Known> {
  protected:
    void SetUp() override {
        const char* data = std::getenv("OVERLOOK_DATA");
        if (data == nullptr) GTEST_SKIP() << "OVERLOOK_DATA names no folder";
        Result<mesh::MeshFile> file = mesh::open_mesh(std::string(data) + "/mesh/" + GetParam().file);
        ASSERT_TRUE(file.has_value()) << file.error().message;
        mesh_ = std::move(file->mesh);
    }
    mesh::Mesh mesh_;
};
INSTANTIATE_TEST_SUITE_P(Data, RealMesh,
                         testing::Values(Known{"camel_b.obj", 0.128, kUnknown, 243, 1},
                                         Known{"shaderball.glb", 0.066, kUnknown, -1, 5},
                                         Known{"lowpoly_space.glb", 0, 0.989, -1, 10},
                                         Known{"city_diorama.glb", kUnknown, 0.63, -1, 29}),
                         [](const auto& of) {
                             std::string name = of.param.file;
                             return name.substr(0, name.find('.'));
                         });

TEST_P(RealMesh, HasTheSharesThatWereMeasuredOfIt) {
    Result<Groups> groups = find_groups(uncut(mesh_), {});
    ASSERT_TRUE(groups.has_value()) << groups.error().message;
    double position_count = double(groups->kind.size());
    if (GetParam().ambiguous_share != kUnknown) {
        EXPECT_NEAR(double(groups->ambiguous_count) / position_count, GetParam().ambiguous_share, 0.0005);
    }
    if (GetParam().rigid_share != kUnknown) {
        EXPECT_NEAR(double(groups->rigid_count) / position_count, GetParam().rigid_share, 0.005);
    }
    if (GetParam().seam_edge_count >= 0) {
        EXPECT_EQ(std::count_if(groups->features.begin(), groups->features.end(),
                                [](const FeatureEdge& feature) { return feature.kind == FeatureKind::seam; }),
                  GetParam().seam_edge_count);
    }
}

TEST_P(RealMesh, NeedsNoMoreIdsAndFewerBytesThanWereMeasured) {
    Result<Groups> groups = find_groups(mesh_, {});
    ASSERT_TRUE(groups.has_value()) << groups.error().message;
    EXPECT_LE(groups->packed_count, GetParam().most_packed);
    EXPECT_LE(groups->packed_count, groups->clique_bound + 1);
    if (groups->packed_count > 3) {
        EXPECT_LT(groups->rows_bytes, groups->dense_bytes);
    }
    EXPECT_EQ(groups->dense_bytes, 4 * uint64_t(groups->packed_count) * mesh_.positions_m.size());
}

}  // namespace
}  // namespace overlook::caveclod
