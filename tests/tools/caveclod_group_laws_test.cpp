// What holds for the surface groups of any mesh, against definitions written out anew.
#include <gtest/gtest.h>

#include <map>
#include <numeric>
#include <set>

#include "formats/parallel.h"
#include "tests/tools/caveclod_meshes.h"
#include "tools/bake/caveclod/groups.h"

namespace overlook::caveclod {
namespace {

using Edge = std::pair<uint32_t, uint32_t>;

// The definitions of 3.1 and 3.3 face by face, with maps and searches.
struct Brute {
    const mesh::Mesh& mesh;
    std::map<Edge, std::vector<uint32_t>> faces_on;  // a < b

    explicit Brute(const mesh::Mesh& mesh_) : mesh(mesh_) {
        for (uint32_t face = 0; face < mesh.faces.size(); ++face)
            for (uint32_t corner = 0; corner < 3; ++corner) {
                uint32_t a = mesh.faces[face][corner], b = mesh.faces[face][(corner + 1) % 3];
                faces_on[std::minmax(a, b)].push_back(face);
            }
    }
    uint32_t corner_at(uint32_t face, uint32_t position) const {
        return uint32_t(std::find(mesh.faces[face].begin(), mesh.faces[face].end(), position) - mesh.faces[face].begin());
    }
    bool look_alike(uint32_t f, uint32_t g, uint32_t position) const {
        uint32_t a = corner_at(f, position), b = corner_at(g, position);
        return mesh.normals[mesh.face_normals[f][a]] == mesh.normals[mesh.face_normals[g][b]] &&
               mesh.uvs[mesh.face_uvs[f][a]] == mesh.uvs[mesh.face_uvs[g][b]] &&
               mesh.colours[mesh.face_colours[f][a]] == mesh.colours[mesh.face_colours[g][b]];
    }
    bool is_manifold(const Edge& edge) const {
        const std::vector<uint32_t>& on = faces_on.at(edge);
        if (on.size() != 2) return false;
        auto runs_forth = [&](uint32_t face) { return mesh.faces[face][(corner_at(face, edge.first) + 1) % 3] == edge.second; };
        return runs_forth(on[0]) != runs_forth(on[1]);
    }
    bool is_smooth(const Edge& edge) const {
        if (!is_manifold(edge)) return false;
        const std::vector<uint32_t>& on = faces_on.at(edge);
        return mesh.face_surface[on[0]] == mesh.face_surface[on[1]] && look_alike(on[0], on[1], edge.first) &&
               look_alike(on[0], on[1], edge.second);
    }
    // Faces reached from one over edges that pass.
    template <class Passes>
    std::set<uint32_t> flood(uint32_t from, const Passes& passes) const {
        std::set<uint32_t> reached = {from};
        for (std::vector<uint32_t> open = {from}; !open.empty();) {
            uint32_t face = open.back();
            open.pop_back();
            for (uint32_t corner = 0; corner < 3; ++corner) {
                Edge edge = std::minmax(mesh.faces[face][corner], mesh.faces[face][(corner + 1) % 3]);
                if (!passes(edge)) continue;
                for (uint32_t other : faces_on.at(edge))
                    if (reached.insert(other).second) open.push_back(other);
            }
        }
        return reached;
    }
    PositionKind kind(uint32_t position) const {
        std::set<uint32_t> round;
        size_t feature_count = 0;
        for (const auto& [edge, on] : faces_on) {
            if (edge.first != position && edge.second != position) continue;
            feature_count += !is_smooth(edge);
            if (on.size() > 2 || (on.size() == 2 && !is_manifold(edge))) return PositionKind::rigid;
            round.insert(on.begin(), on.end());
        }
        auto is_at = [&](const Edge& edge) { return (edge.first == position || edge.second == position) && is_manifold(edge); };
        if (round.empty() || flood(*round.begin(), is_at) != round) return PositionKind::rigid;
        return feature_count == 0 ? PositionKind::free : feature_count == 2 ? PositionKind::sharp : PositionKind::rigid;
    }
};

// The laws below say something about a case only if the meshes have it.
TEST(RandomMeshes, HoldEveryCase) {
    std::array<uint64_t, 3> kinds{}, features{};
    uint64_t ambiguous_count = 0, point_count = 0, many_ids = 0;
    for (uint32_t seed = 1; seed < 41; ++seed) {
        mesh::Mesh mesh = random_mesh(seed);
        Groups groups = *find_groups(mesh, {});
        for (PositionKind kind : groups.kind) ++kinds[size_t(kind)];
        for (const FeatureEdge& feature : groups.features) ++features[size_t(feature.kind)];
        ambiguous_count += groups.ambiguous_count;
        many_ids += groups.packed_count > 3;
        for (uint32_t position = 0; position < groups.kind.size(); ++position)  // four borders meet
            point_count += groups.kind[position] == PositionKind::rigid &&
                           std::count_if(groups.features.begin(), groups.features.end(), [&](const FeatureEdge& feature) {
                               return feature.kind == FeatureKind::border && (feature.a == position || feature.b == position);
                           }) == 4;
    }
    for (uint64_t count : kinds) EXPECT_GT(count, 100u);
    for (uint64_t count : features) EXPECT_GT(count, 50u);
    EXPECT_GT(ambiguous_count, 50u);
    EXPECT_GT(point_count, 20u);
    EXPECT_GT(many_ids, 10u);
}

class AnyMesh : public testing::TestWithParam<uint32_t> {};
INSTANTIATE_TEST_SUITE_P(Random, AnyMesh, testing::Range(1u, 41u));

TEST_P(AnyMesh, GroupsAreTheRegionsThatSmoothEdgesJoin) {
    mesh::Mesh mesh = random_mesh(GetParam());
    Groups groups = *find_groups(mesh, {});
    Brute brute(mesh);
    std::set<uint32_t> done;
    uint32_t count = 0;
    for (uint32_t face = 0; face < mesh.faces.size(); ++face) {
        if (done.count(face)) continue;
        std::set<uint32_t> region = brute.flood(face, [&](const Edge& edge) { return brute.is_smooth(edge); });
        for (uint32_t other : region) ASSERT_EQ(groups.face_group[other], count);
        EXPECT_EQ(groups.group_surface[count], mesh.face_surface[face]);
        done.insert(region.begin(), region.end());
        ++count;
    }
    EXPECT_EQ(groups.group_surface.size(), count);
}

TEST_P(AnyMesh, ClassesAndFeatureEdgesAreThoseOfTheDefinition) {
    mesh::Mesh mesh = random_mesh(GetParam());
    Groups groups = *find_groups(mesh, {});
    Brute brute(mesh);
    for (uint32_t position = 0; position < mesh.positions_m.size(); ++position)
        ASSERT_EQ(groups.kind[position], brute.kind(position)) << position;

    size_t feature_count = 0;
    for (const auto& [edge, on] : brute.faces_on) {
        if (brute.is_smooth(edge)) continue;
        ASSERT_LT(feature_count, groups.features.size());
        const FeatureEdge& feature = groups.features[feature_count++];
        ASSERT_EQ(Edge(feature.a, feature.b), edge);
        FeatureKind kind = !brute.is_manifold(edge)                               ? FeatureKind::border
                           : groups.face_group[on[0]] == groups.face_group[on[1]] ? FeatureKind::seam
                                                                                  : FeatureKind::between;
        ASSERT_EQ(feature.kind, kind);
        std::span<const uint32_t> ends = std::span(groups.feature_ends)
                                             .subspan(groups.feature_begin[edge.first],
                                                      groups.feature_begin[edge.first + 1] - groups.feature_begin[edge.first]);
        ASSERT_TRUE(std::binary_search(ends.begin(), ends.end(), edge.second));
    }
    EXPECT_EQ(feature_count, groups.features.size());
    EXPECT_EQ(groups.feature_ends.size(), 2 * feature_count);
}

TEST_P(AnyMesh, EveryCornersVertexLooksAsTheCornerDoes) {
    mesh::Mesh mesh = random_mesh(GetParam());
    Groups groups = *find_groups(mesh, {});
    for (uint32_t face = 0; face < mesh.faces.size(); ++face)
        for (uint32_t corner = 0; corner < 3; ++corner) {
            uint32_t vertex = groups.face_vertices[face][corner], position = mesh.faces[face][corner];
            const RenderVertex& look = groups.vertices[vertex];
            ASSERT_EQ(look.position, position);
            ASSERT_GE(vertex, groups.vertex_begin[position]);
            ASSERT_LT(vertex, groups.vertex_begin[position + 1]);
            ASSERT_EQ(groups.vertex_group[vertex], groups.face_group[face]);
            ASSERT_EQ(look.normal, mesh.normals[mesh.face_normals[face][corner]]);
            ASSERT_EQ(look.uv, mesh.uvs[mesh.face_uvs[face][corner]]);
            ASSERT_EQ(look.colour, mesh.colours[mesh.face_colours[face][corner]]);
        }
}

// Corners at one position share a vertex exactly where smooth edges round it lead from one to the other.
TEST_P(AnyMesh, VerticesAreTheFansOfCorners) {
    mesh::Mesh mesh = random_mesh(GetParam());
    Groups groups = *find_groups(mesh, {});
    Brute brute(mesh);
    for (uint32_t face = 0; face < mesh.faces.size(); ++face)
        for (uint32_t corner = 0; corner < 3; ++corner) {
            uint32_t position = mesh.faces[face][corner];
            std::set<uint32_t> fan = brute.flood(face, [&](const Edge& edge) {
                return (edge.first == position || edge.second == position) && brute.is_smooth(edge);
            });
            std::set<uint32_t> sharing;
            for (uint32_t other = 0; other < mesh.faces.size(); ++other)
                for (uint32_t at = 0; at < 3; ++at)
                    if (groups.face_vertices[other][at] == groups.face_vertices[face][corner]) sharing.insert(other);
            ASSERT_EQ(fan, sharing);
        }
}

TEST_P(AnyMesh, PackedIdsTellApartWhatMeets) {
    mesh::Mesh mesh = random_mesh(GetParam());
    Groups groups = *find_groups(mesh, {});
    uint64_t entry_count = 0;
    for (uint32_t position = 0; position < mesh.positions_m.size(); ++position) {
        std::map<uint32_t, uint32_t> group_by_id;
        for (uint32_t vertex = groups.vertex_begin[position]; vertex < groups.vertex_begin[position + 1]; ++vertex) {
            uint32_t group = groups.vertex_group[vertex];
            ASSERT_LT(groups.group_packed[group], groups.packed_count);
            auto [at, is_new] = group_by_id.emplace(groups.group_packed[group], group);
            ASSERT_EQ(at->second, group);
        }
        entry_count += group_by_id.size();
    }
    EXPECT_LE(groups.clique_bound, groups.packed_count);
    EXPECT_DOUBLE_EQ(groups.dense_population, double(entry_count) / double(groups.packed_count * mesh.positions_m.size()));
}

TEST_P(AnyMesh, AreTheSameWhateverTheOrderOfFaces) {
    mesh::Mesh mesh = random_mesh(GetParam());
    std::vector<uint32_t> order(mesh.faces.size());
    std::iota(order.begin(), order.end(), 0u);
    std::mt19937 random(GetParam());
    for (size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
    Groups first = *find_groups(mesh, {}), second = *find_groups(permuted(mesh, order), {});

    EXPECT_EQ(first.kind, second.kind);
    EXPECT_EQ(first.feature_ends, second.feature_ends);
    EXPECT_EQ(first.vertex_begin, second.vertex_begin);
    EXPECT_EQ(first.ambiguous_count, second.ambiguous_count);
    EXPECT_EQ(first.floor_face_estimate, second.floor_face_estimate);
    std::map<uint32_t, uint32_t> renamed, renamed_back;
    for (uint32_t face = 0; face < order.size(); ++face) {
        uint32_t a = first.face_group[order[face]], b = second.face_group[face];
        ASSERT_EQ(renamed.emplace(a, b).first->second, b);
        ASSERT_EQ(renamed_back.emplace(b, a).first->second, a);
    }
}

TEST_P(AnyMesh, AreTheSameWithAnyThreadCount) {
    mesh::Mesh mesh = random_mesh(GetParam(), 90, 70);
    set_thread_count(1);
    Groups one = *find_groups(mesh, {});
    set_thread_count(4);
    Groups four = *find_groups(mesh, {});
    set_thread_count(0);
    EXPECT_EQ(one.face_group, four.face_group);
    EXPECT_EQ(one.vertices, four.vertices);
    EXPECT_EQ(one.face_vertices, four.face_vertices);
    EXPECT_EQ(one.group_packed, four.group_packed);
}

TEST_P(AnyMesh, KeepsAtLeastTheFacesWhoseCornersAllStay) {
    mesh::Mesh mesh = random_mesh(GetParam());
    Groups groups = *find_groups(mesh, {});
    EXPECT_LE(groups.fixed_face_count, groups.floor_face_estimate);
    EXPECT_LE(groups.floor_face_estimate, mesh.faces.size());
}

}  // namespace
}  // namespace overlook::caveclod
