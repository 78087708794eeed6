// What is drawn of a picture lies between what is taken for it from below and from above.
#include "tools/bake/discrete/drawn_texels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tools/bake/caveclod/triangle_tree.h"

namespace overlook::discrete {
namespace {

// Opacity between the four texels round a place, in texels, as it is drawn.
double opacity_at(const Mask& mask, const glm::dvec2& at) {
    double x = at.x - 0.5, y = at.y - 0.5, right = x - std::floor(x), down = y - std::floor(y);
    auto left = int64_t(std::floor(x)), top = int64_t(std::floor(y));
    return (1 - down) * ((1 - right) * mask.at(left, top) + right * mask.at(left + 1, top)) +
           down * ((1 - right) * mask.at(left, top + 1) + right * mask.at(left + 1, top + 1));
}

// A card in the xy plane, a metre a texel, whose corners are those of the picture's outermost texels' middles.
std::array<DrawnTriangle, 2> card_of(const Mask& mask) {
    double right = mask.width - 0.5, bottom = mask.height - 0.5;
    auto corner = [&](double x, double y, DrawnTriangle& t, size_t c) {
        t.at_m[c] = {x, y, 0}, t.uv[c] = glm::dvec2(x, y) / glm::dvec2(mask.width, mask.height);
    };
    std::array<DrawnTriangle, 2> card;
    corner(0.5, 0.5, card[0], 0), corner(right, 0.5, card[0], 1), corner(right, bottom, card[0], 2);
    corner(0.5, 0.5, card[1], 0), corner(right, bottom, card[1], 1), corner(0.5, bottom, card[1], 2);
    return card;
}

DrawnSets sets_of(const Mask& mask) {
    DrawnSets sets;
    for (const DrawnTriangle& triangle : card_of(mask)) add_drawn(mask, triangle, sets);
    return sets;
}

Mask random_mask(uint64_t seed, uint32_t width, uint32_t height) {
    std::mt19937_64 random(seed);
    Mask mask{width, height, std::vector<uint8_t>(size_t(width) * height, 0), true};
    for (uint32_t y = 1; y + 1 < height; ++y)
        for (uint32_t x = 1; x + 1 < width; ++x) mask.is_opaque[size_t(y) * width + x] = random() % 100 < 20 + 15 * (seed % 5);
    return mask;
}

TEST(DrawnTexels, HoldAllThatIsDrawnAndNothingForCertainThatIsNot) {
    std::mt19937_64 random(3);
    auto number = [&] { return double(random() >> 11) * 0x1p-53; };
    for (uint64_t seed = 0; seed < 20; ++seed) {
        Mask mask = random_mask(seed, 9, 7);
        DrawnSets sets = sets_of(mask);
        caveclod::TriangleTree most(sets.most), least(sets.least);
        size_t drawn = 0;
        for (int i = 0; i < 2000; ++i) {
            glm::dvec2 at(0.5 + 8 * number(), 0.5 + 6 * number());
            if (opacity_at(mask, at) < 0.5) continue;
            ++drawn;
            EXPECT_LE(most.nearest({at, 0}).distance_m, 1e-9) << seed << " " << at.x << " " << at.y;
        }
        EXPECT_GT(drawn, 50u);
        for (const caveclod::Triangle& t : sets.least)
            for (int i = 0; i < 4; ++i) {
                double a = number(), b = number() * (1 - a);
                glm::dvec3 at = t[0] + a * (t[1] - t[0]) + b * (t[2] - t[0]);
                EXPECT_GE(opacity_at(mask, glm::dvec2(at)), 0.5 - 1e-9) << seed;
            }
        // From below no texel's middle is forgotten.
        for (uint32_t y = 0; y < mask.height; ++y)
            for (uint32_t x = 0; x < mask.width; ++x) {
                if (!mask.at(x, y)) continue;
                EXPECT_LE(least.nearest({x + 0.5, y + 0.5, 0}).distance_m, 1e-9);
            }
    }
}

TEST(DrawnTexels, BoundTheDistanceOfASingleTexelFromBothSides) {
    Mask mask{5, 5, std::vector<uint8_t>(25, 0), true};
    mask.is_opaque[12] = 1;  // its middle at (2.5, 2.5)
    std::vector<caveclod::Triangle> point{{glm::dvec3(2.5, 2.5, 4), {2.5, 2.5, 4}, {2.5, 2.5, 4}}};
    caveclod::Distance distance = distance_to_drawn(point, sets_of(mask), 0, 1e-6, 1 << 16);
    EXPECT_NEAR(distance.least_m, 4, 1e-6);
    EXPECT_NEAR(distance.most_m, std::sqrt(16 + 2 * 0.7171 * 0.7171), 1e-3);
    EXPECT_NEAR(most_distance_to_drawn(point, sets_of(mask), 0, 1e-6, 1 << 16), distance.most_m, 1e-9);
}

TEST(DrawnTexels, OfATriangleThatShowsOnePlaceAreAllOrNothing) {
    Mask mask{8, 8, std::vector<uint8_t>(64, 0), true};
    for (size_t y = 2; y < 6; ++y)
        for (size_t x = 2; x < 6; ++x) mask.is_opaque[8 * y + x] = 1;
    DrawnTriangle triangle{{glm::dvec3(0), {1, 0, 0}, {0, 1, 0}}, {glm::dvec2(0.5), {0.5, 0.5}, {0.5, 0.5}}};
    DrawnSets sets;
    add_drawn(mask, triangle, sets);
    EXPECT_EQ(sets.least.size(), 1u);
    EXPECT_EQ(sets.most.size(), 1u);
    triangle.uv = {glm::dvec2(0.1), {0.1, 0.1}, {0.1, 0.1}};
    sets = {};
    add_drawn(mask, triangle, sets);
    EXPECT_TRUE(sets.least.empty() && sets.most.empty());
}

TEST(DrawnTexels, SayNothingForCertainWhereAPictureRepeats) {
    Mask mask{4, 4, std::vector<uint8_t>(16, 1), true};
    DrawnTriangle triangle{{glm::dvec3(0), {1, 0, 0}, {0, 1, 0}}, {glm::dvec2(0), {3, 0}, {0, 3}}};
    DrawnSets sets;
    add_drawn(mask, triangle, sets);
    EXPECT_TRUE(sets.least.empty());
    ASSERT_EQ(sets.most.size(), 1u);
    EXPECT_EQ(sets.most[0], triangle.at_m);
}

}  // namespace
}  // namespace overlook::discrete
