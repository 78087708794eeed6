#include "runtime/view/nearest_in_triangle.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

namespace overlook::view {
namespace {

TEST(NearestInTriangle, LiesInItAndNoneIsNearer) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> share(0, 1);
    std::uniform_real_distribution<double> within(-1, 1);
    std::vector<glm::dvec3> places(4 * 500);
    for (glm::dvec3& place : places) place = {within(random), within(random), within(random)};
    for (size_t i = 0; i < places.size(); i += 4) {
        const glm::dvec3 &place = places[i], &a = places[i + 1], &b = places[i + 2], &c = places[i + 3];
        glm::dvec3 nearest = nearest_in_triangle(place, a, b, c), normal = glm::normalize(glm::cross(b - a, c - a));
        EXPECT_NEAR(glm::dot(nearest - a, normal), 0, 1e-12);
        for (auto [from, to] : {std::pair(a, b), {b, c}, {c, a}})
            EXPECT_GE(glm::dot(glm::cross(normal, to - from), nearest - from), -1e-12) << "outside";
        double found = glm::distance(nearest, place);
        for (int k = 0; k < 200; ++k) {
            double u = share(random), v = share(random) * (1 - u);
            ASSERT_GE(glm::distance(a + u * (b - a) + v * (c - a), place), found - 1e-12);
        }
    }
}

// All on one line, or in one place: what is nearest is then on the longest side.
TEST(NearestInTriangle, IsOnItsLineWhereItHasNoArea) {
    glm::dvec3 a(0, 0, 0), b(1, 0, 0), c(3, 0, 0);
    EXPECT_EQ(nearest_in_triangle({2, 5, 0}, a, b, c), glm::dvec3(2, 0, 0));
    EXPECT_EQ(nearest_in_triangle({9, 5, 1}, a, b, c), c);
    EXPECT_EQ(nearest_in_triangle({-9, 5, 1}, b, a, c), a);
    EXPECT_EQ(nearest_in_triangle({4, 5, 6}, b, b, b), b);
}

}  // namespace
}  // namespace overlook::view
