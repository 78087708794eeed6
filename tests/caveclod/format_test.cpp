// Baked meshes: what is written is read, whole and in prefixes, in few bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "tests/caveclod/mesh_files.h"
#include "tests/caveclod/synthetic_hierarchy.h"

namespace overlook::caveclod {
namespace {

using synthetic::Triangle;

void expect_same(const Hierarchy& a, const Hierarchy& b) {
    EXPECT_EQ(a.origin_m, b.origin_m);
    EXPECT_EQ(a.base_position_count, b.base_position_count);
    EXPECT_EQ(a.base_face_count, b.base_face_count);
    EXPECT_EQ(a.positions_m, b.positions_m);
    EXPECT_EQ(a.owner, b.owner);
    EXPECT_EQ(a.error_m, b.error_m);
    EXPECT_EQ(a.radius_m, b.radius_m);
    EXPECT_EQ(a.cone, b.cone);
    EXPECT_EQ(a.need_begin, b.need_begin);
    EXPECT_EQ(a.needs, b.needs);
    EXPECT_EQ(a.added_begin, b.added_begin);
    EXPECT_EQ(a.moved_begin, b.moved_begin);
    EXPECT_EQ(a.moved, b.moved);
    EXPECT_EQ(a.face_positions, b.face_positions);
    EXPECT_EQ(a.face_group, b.face_group);
    EXPECT_EQ(a.group_surface, b.group_surface);
    EXPECT_EQ(a.group_packed, b.group_packed);
    EXPECT_EQ(a.vertices, b.vertices);
    EXPECT_EQ(a.vertex_begin, b.vertex_begin);
    EXPECT_EQ(a.birth_wedge, b.birth_wedge);
    EXPECT_EQ(a.moved_wedge, b.moved_wedge);
    EXPECT_EQ(a.moved_back_wedge, b.moved_back_wedge);
    EXPECT_EQ(a.attributes, b.attributes);
    EXPECT_EQ(a.surfaces, b.surfaces);
    EXPECT_EQ(a.grid, b.grid);
    EXPECT_EQ(a.finest_error_m, b.finest_error_m);
}

TEST(BakedMesh, IsReadAsItWasWritten) {
    for (Codec codec : {Codec::meshopt, Codec::draco}) {
        for (const synthetic::Source& source : {synthetic::hills(40, 30, 3), synthetic::sphere(16), synthetic::hills(1, 1)}) {
            Hierarchy hierarchy = synthetic::bake(source);
            std::string file = synthetic::file_of(hierarchy, codec);
            ASSERT_FALSE(file.empty());
            Result<Hierarchy> read = synthetic::read_bytes(file);
            ASSERT_TRUE(read) << read.error().message;
            expect_same(*read, hierarchy);
        }
    }
}

TEST(BakedMesh, KeepsWhatNoSplitShows) {
    synthetic::Source source = synthetic::hills(20, 20, 2);
    source.attributes = {true, true, true};
    Hierarchy hierarchy = synthetic::bake(source);
    for (size_t i = 0; i < hierarchy.vertices.size(); ++i) hierarchy.vertices[i].colour = {uint8_t(i), uint8_t(i / 7), 3, 250};
    hierarchy.surfaces[1] = {"second", {1, 2, 3, 4}, "bark.png", {std::byte(1), std::byte(2)}, true, 0.25f, true};
    ASSERT_GT(hierarchy.split_count(), 50u);
    // One that nothing touched asks for.
    auto row = [&](size_t i) {
        return std::vector<uint32_t>(hierarchy.needs.begin() + hierarchy.need_begin[i],
                                     hierarchy.needs.begin() + hierarchy.need_begin[i + 1]);
    };
    std::vector<uint32_t> given = row(40);
    uint32_t other = 39;
    while (std::binary_search(given.begin(), given.end(), other)) --other;
    given.insert(std::lower_bound(given.begin(), given.end(), other), other);
    hierarchy.needs.insert(hierarchy.needs.begin() + hierarchy.need_begin[40], other);
    for (size_t i = 41; i < hierarchy.need_begin.size(); ++i) ++hierarchy.need_begin[i];
    ASSERT_TRUE(complete(hierarchy));
    round_errors(hierarchy);
    EXPECT_EQ(row(40), given);
    Result<Hierarchy> read = synthetic::read_bytes(synthetic::file_of(hierarchy));
    ASSERT_TRUE(read) << read.error().message;
    expect_same(*read, hierarchy);
}

// Any set of splits that is closed under needs, reached in any order, is the same crack-free mesh.
TEST(BakedMesh, HasACrackFreeMeshForEveryLegalCut) {
    Hierarchy h = synthetic::bake(synthetic::sphere(16));
    std::mt19937 random(7);
    for (int round = 0; round < 20; ++round) {
        std::vector<bool> is_applied(h.split_count(), false);
        for (uint32_t i = 0; i < h.split_count(); ++i) {
            bool is_legal = random() % 20 != 0;
            for (uint32_t k = h.need_begin[i]; k < h.need_begin[i + 1]; ++k) is_legal = is_legal && is_applied[h.needs[k]];
            is_applied[i] = is_legal;
        }
        std::map<std::pair<uint32_t, uint32_t>, int> edges;
        for (const Triangle& t : synthetic::triangles_of(h, is_applied))
            for (size_t c = 0; c < 3; ++c) ++edges[{t.positions[c], t.positions[(c + 1) % 3]}];
        for (const auto& [edge, count] : edges) {
            ASSERT_EQ(count, 1);
            ASSERT_EQ(edges.count({edge.second, edge.first}), 1u);
        }
    }
}

TEST(BakedMesh, IsAHierarchyAfterAnyNumberOfBlocks) {
    Hierarchy h = synthetic::bake(synthetic::hills(90, 80, 2));
    std::string file = synthetic::file_of(h);
    uint32_t splits_before = 0;
    for (uint32_t blocks = 0; blocks < 5; ++blocks) {
        Result<Hierarchy> part = synthetic::read_bytes(file, blocks);
        ASSERT_TRUE(part) << part.error().message;
        uint32_t splits = part->split_count();
        EXPECT_TRUE(blocks == 0 ? splits == 0 : splits > splits_before || splits == h.split_count());
        splits_before = splits;
        float missing_m = h.finest_error_m;
        for (uint32_t i = splits; i < h.split_count(); ++i) missing_m = std::max(missing_m, h.error_m[i]);
        EXPECT_EQ(part->finest_error_m, missing_m);
        std::vector<bool> of_whole(h.split_count(), false);
        std::fill(of_whole.begin(), of_whole.begin() + splits, true);
        EXPECT_EQ(synthetic::triangles_of(*part, std::vector<bool>(splits, true)), synthetic::triangles_of(h, of_whole));
    }
    EXPECT_EQ(splits_before, h.split_count());
}

TEST(BakedMesh, TakesFewBitsATriangle) {
    Hierarchy h = synthetic::bake(synthetic::hills(130, 120, 2));
    for (Codec codec : {Codec::meshopt, Codec::draco}) {
        double bits = 8.0 * double(synthetic::file_of(h, codec).size()) / double(h.face_positions.size());
        RecordProperty(codec == Codec::meshopt ? "bits_meshopt" : "bits_draco", std::to_string(bits));
        std::printf("%s: %.2f bits a triangle\n", codec == Codec::meshopt ? "meshopt" : "draco", bits);
        EXPECT_LE(bits, codec == kDefaultCodec ? 36 : 40);
    }
}

TEST(BakedMesh, HoldsInEachSphereAllThatNeedsItsSplit) {
    Hierarchy h = synthetic::bake(synthetic::sphere(24));
    std::vector<std::vector<uint32_t>> dependents(h.split_count());
    for (uint32_t i = 0; i < h.split_count(); ++i)
        for (uint32_t k = h.need_begin[i]; k < h.need_begin[i + 1]; ++k) {
            ASSERT_LT(h.needs[k], i);
            EXPECT_LE(h.error_m[i], h.error_m[h.needs[k]]);
            dependents[h.needs[k]].push_back(i);
        }
    for (uint32_t i = 0; i < h.split_count(); i += 7) {
        std::vector<bool> is_held(h.split_count(), false);
        is_held[i] = true;
        glm::dvec3 middle(h.positions_m[h.owner[i]]);
        for (uint32_t j = i; j < h.split_count(); ++j) {
            if (!is_held[j]) continue;
            for (uint32_t dependent : dependents[j]) is_held[dependent] = true;
            std::vector<uint32_t> touched = {h.owner[j], h.new_position(j)};
            for (uint32_t face = h.added_begin[j]; face < h.added_begin[j + 1]; ++face)
                touched.insert(touched.end(), h.face_positions[face].begin(), h.face_positions[face].end());
            for (uint32_t p : touched) ASSERT_LE(glm::length(glm::dvec3(h.positions_m[p]) - middle), h.radius_m[i] * (1 + 1e-6));
        }
        EXPECT_LE(h.radius_m[i], 35);  // of a sphere of 20 m across
    }
}

TEST(NormalCone, HoldsWhatItWasMadeOf) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 1000; ++i) {
        glm::dvec3 axis(normal(random), normal(random), normal(random)), side(normal(random), normal(random), normal(random));
        double half_rad = std::abs(normal(random));
        NormalCone cone = cone_of(axis, half_rad);
        axis = glm::normalize(axis), side = glm::normalize(side - axis * glm::dot(side, axis));
        if (half_rad > 3.1) continue;
        glm::dvec3 rim = axis * std::cos(half_rad) + side * std::sin(half_rad);
        EXPECT_LE(std::acos(std::clamp(glm::dot(rim, axis_of(cone)), -1.0, 1.0)), half_angle_rad_of(cone) + 1e-9);
        EXPECT_LE(half_angle_rad_of(cone), half_rad + 0.04);
    }
}

TEST(QuantisedMesh, MovesNothingFartherThanItSays) {
    synthetic::Source source = synthetic::hills(30, 30);
    Hierarchy h = synthetic::bake(source, {12, 12, 8});
    double step_m = h.grid.position_step_m;
    EXPECT_LE(h.finest_error_m, 1.1 * std::sqrt(3) * step_m / 2);
    std::vector<glm::dvec3> found;
    for (const glm::vec3& p : h.positions_m) found.push_back(glm::dvec3(p) + h.origin_m);
    for (const glm::vec3& p : source.positions_m) {
        double nearest_m = 1e9;
        for (const glm::dvec3& q : found) nearest_m = std::min(nearest_m, glm::length(q - glm::dvec3(p)));
        EXPECT_LE(nearest_m, h.finest_error_m);
    }
}

}  // namespace
}  // namespace overlook::caveclod
