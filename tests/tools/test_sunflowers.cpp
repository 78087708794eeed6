// Sunflowers are as large as the paper's, and their florets stand as Vogel says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "tools/make_sample/plant_textures.h"
#include "tools/make_sample/sample_plants.h"
#include "tools/make_sample/sunflower.h"

namespace overlook::sample {
namespace {

const std::vector<mesh::Mesh>& sunflowers() {
    static const std::vector<mesh::Mesh> made = [] {
        std::vector<mesh::Mesh> meshes;
        auto set = plant_set("sunflowers", 1);
        EXPECT_TRUE(set) << set.error().message;
        if (set)
            for (Plant& plant : set->plants) meshes.push_back(std::move(plant.mesh));
        return meshes;
    }();
    return made;
}

// The middles of the pieces of the disc that are not its floor, in the file's order.
std::vector<glm::dvec3> florets_m(const mesh::Mesh& mesh) {
    std::vector<uint32_t> piece(mesh.positions_m.size());
    for (uint32_t i = 0; i < piece.size(); ++i) piece[i] = i;
    auto find = [&](uint32_t i) {
        while (piece[i] != i) i = piece[i] = piece[piece[i]];
        return i;
    };
    for (const mesh::Corners& face : mesh.faces)
        for (int c = 1; c < 3; ++c)
            piece[std::max(find(face[0]), find(face[size_t(c)]))] = std::min(find(face[0]), find(face[size_t(c)]));
    std::vector<glm::dvec3> middles;
    std::vector<double> counts;
    uint32_t last = mesh::kNone;
    for (size_t f = 0; f < mesh.faces.size(); ++f) {
        if (mesh.face_surface[f] != kDisc) continue;
        if (find(mesh.faces[f][0]) != last) last = find(mesh.faces[f][0]), middles.emplace_back(0), counts.push_back(0);
        for (size_t c = 0; c < 3; ++c) middles.back() += glm::dvec3(corner_m(mesh, f, c)), counts.back() += 1;
    }
    for (size_t i = 0; i < middles.size(); ++i) middles[i] /= counts[i];
    middles.erase(middles.begin());
    return middles;
}

struct Seen {
    glm::dvec3 middle{0}, axis{0};
};
Seen head_of(const std::vector<glm::dvec3>& florets) {
    Seen head;
    for (const glm::dvec3& at : florets) head.middle += at / double(florets.size());
    for (size_t i = 1; i < florets.size(); ++i) head.axis += glm::cross(florets[i - 1] - head.middle, florets[i] - head.middle);
    head.axis = glm::normalize(head.axis);
    return head;
}

double top_m(const mesh::Mesh& mesh) {
    float top = 0;
    for (const glm::vec3& at : mesh.positions_m) top = std::max(top, at.z);
    return double(top);
}

TEST(Sunflowers, AreElevenOfThePapersTriangles) {
    ASSERT_EQ(sunflowers().size(), 11u);
    for (const mesh::Mesh& mesh : sunflowers()) EXPECT_NEAR(double(mesh.faces.size()), 35'000, 500);
}
TEST(Sunflowers, DifferInHeightAndStandOnTheirFeet) {
    double least = 1e9, most = 0;
    for (const mesh::Mesh& mesh : sunflowers()) {
        least = std::min(least, top_m(mesh)), most = std::max(most, top_m(mesh));
        double foot_m = 0, low_m = 1;
        for (const glm::vec3& at : mesh.positions_m) {
            low_m = std::min(low_m, double(at.z));
            if (at.z < 0.01f) foot_m = std::max(foot_m, std::hypot(double(at.x), double(at.y)));
        }
        EXPECT_LT(low_m, 0);
        EXPECT_GT(low_m, -0.03);
        EXPECT_GT(foot_m, 0.01);
        EXPECT_LT(foot_m, 0.05);
    }
    EXPECT_GE(least, 1.4);
    EXPECT_LE(most, 2.4);
    EXPECT_GT(most - least, 0.6);
}
TEST(Sunflowers, TurnEachFloretByTheGoldenAngle) {
    for (const mesh::Mesh& mesh : sunflowers()) {
        std::vector<glm::dvec3> florets = florets_m(mesh);
        ASSERT_GT(florets.size(), 500u);
        Seen head = head_of(florets);
        double sum_deg = 0;
        size_t from = florets.size() / 8;
        for (size_t n = from; n + 1 < florets.size(); ++n) {
            glm::dvec3 a = florets[n] - head.middle, b = florets[n + 1] - head.middle;
            a -= head.axis * glm::dot(head.axis, a), b -= head.axis * glm::dot(head.axis, b);
            double turn_deg = glm::degrees(std::atan2(glm::dot(head.axis, glm::cross(a, b)), glm::dot(a, b)));
            EXPECT_NEAR(turn_deg, 137.508, 2.5);
            sum_deg += turn_deg;
        }
        EXPECT_NEAR(sum_deg / double(florets.size() - 1 - from), 137.508, 0.01);
    }
}
TEST(Sunflowers, PutFloretsAtTheRootOfTheirNumber) {
    for (const mesh::Mesh& mesh : sunflowers()) {
        std::vector<glm::dvec3> florets = florets_m(mesh);
        Seen head = head_of(florets);
        double least = 1e9, most = 0;
        for (size_t n = florets.size() / 8; n < florets.size(); ++n) {
            glm::dvec3 from = florets[n] - head.middle;
            double spacing_m = glm::length(from - head.axis * glm::dot(head.axis, from)) / std::sqrt(double(n) + 0.5);
            least = std::min(least, spacing_m), most = std::max(most, spacing_m);
        }
        EXPECT_GT(least, 0.0015);
        EXPECT_LT(most, 0.005);
        EXPECT_LT(most / least, 1.06);
    }
}
TEST(Sunflowers, LookAsideInFlowerAndNodWhenTheirFruitsAreRipe) {
    double least_deg = 180, most_deg = 0;
    for (int i = 0; i < kSunflowers; ++i) {
        Seen head = head_of(florets_m(sunflowers()[size_t(i)]));
        EXPECT_LT(head.axis.y, -0.3) << "they all look south";
        double tilt_deg = glm::degrees(std::acos(head.axis.z));
        double age = sunflower_of(1, i).age;
        if (age > 0.35 && age < 0.65) {
            EXPECT_NEAR(tilt_deg, 70, 15);
        }
        if (age > 0.95) {
            EXPECT_GT(tilt_deg, 95);
        }
        least_deg = std::min(least_deg, tilt_deg), most_deg = std::max(most_deg, tilt_deg);
    }
    EXPECT_LT(least_deg, 55);
    EXPECT_GT(most_deg, 100);
}
TEST(Sunflowers, HaveLeavesCutOutOfTrianglesOrOfTheirPicture) {
    int cards = 0;
    for (const mesh::Mesh& mesh : sunflowers()) {
        cards += mesh.surfaces[kHeartLeaves].is_alpha_masked;
        EXPECT_TRUE(mesh.surfaces[kHeartLeaves].is_two_sided && mesh.surfaces[kRays].is_two_sided);
        EXPECT_FALSE(mesh.surfaces[kStem].is_two_sided || mesh.surfaces[kDisc].is_two_sided);
        size_t faces[4] = {};
        for (uint32_t surface : mesh.face_surface) ++faces[surface];
        for (size_t count : faces) EXPECT_GT(count, 300u);
        // Nothing of a card's picture comes in from its other side.
        if (!mesh.surfaces[kHeartLeaves].is_alpha_masked) continue;
        for (int i = 0; i <= 1000; ++i)
            for (auto [u, v] : {std::pair(i / 1000.0, 0.001), {i / 1000.0, 0.999}, {0.001, i / 1000.0}, {0.5, i / 1000.0}})
                EXPECT_EQ(heart_leaf_paint(1)(u, v).a, 0) << u << " " << v;
    }
    EXPECT_GE(cards, 1);
    EXPECT_LT(cards, kSunflowers);
}

}  // namespace
}  // namespace overlook::sample
