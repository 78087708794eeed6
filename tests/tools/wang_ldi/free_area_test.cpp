// What is free is found, however little it is, and what is full is known to be full.
#include "tools/bake/wang_ldi/free_area.h"

#include <gtest/gtest.h>

namespace overlook::wang_ldi {
namespace {

constexpr Bounds kUnit{0, 0, 1, 1};

TEST(FreeArea, OfNothingIsNoPlace) {
    DiscGrid discs(kUnit, 1);
    discs.add({0.5, 0.5, 1});
    FreeArea area(std::span(&kUnit, 1), 0.25, 1e-6);
    Random random(1);
    EXPECT_FALSE(area.draw(discs, random));
}

TEST(FreeArea, FindsTheOneSmallPlaceThatIsLeft) {
    // Four discs about the corners leave a curved square in the middle, of a half diagonal of 0.7072 - 0.705.
    DiscGrid discs(kUnit, 0.5);
    for (double x : {0.0, 1.0})
        for (double y : {0.0, 1.0}) discs.add({x, y, 0.455});
    for (uint64_t seed = 1; seed <= 20; ++seed) {
        FreeArea area(std::span(&kUnit, 1), 0.25, 1e-6);
        Random random(seed);
        auto place = area.draw(discs, random);
        ASSERT_TRUE(place);
        EXPECT_LE(std::hypot(place->x - 0.5, place->y - 0.5), 0.0032);
        EXPECT_GE(place->clearance, 0.25);
    }
    FreeArea none(std::span(&kUnit, 1), 0.2525, 1e-6);
    Random random(1);
    EXPECT_FALSE(none.draw(discs, random));
}

TEST(FreeArea, IsHitAsOftenAsItIsLarge) {
    DiscGrid discs(kUnit, 0.25);
    double left = 0;
    for (uint64_t seed = 1; seed <= 2000; ++seed) {
        std::vector<Bounds> rects{{0, 0, 0.5, 0.5}, {0.5, 0, 1, 1}};
        FreeArea area(rects, 0.1, 1e-3);
        Random random(seed);
        left += area.draw(discs, random)->x < 0.5;
    }
    EXPECT_NEAR(left / 2000, 1.0 / 3, 0.04);
}

TEST(FreeArea, IsFilledUntilAFineGridOfPointsFindsNoPlace) {
    Bounds all{0, 0, 8, 8};
    DiscGrid discs(all, 0.3);
    FreeArea area(std::span(&all, 1), 0.3, 1e-5);
    Random random(4);
    size_t count = 0;
    while (auto place = area.draw(discs, random)) discs.add({place->x, place->y, 0.3}), ++count;
    // Random sequential adsorption of discs: 0.547 of the plane is covered when nothing more fits.
    EXPECT_NEAR(double(count) * 3.14159265 * 0.09 / (8.5 * 8.5), 0.547, 0.03);
    for (int y = 0; y <= 800; ++y)
        for (int x = 0; x <= 800; ++x) ASSERT_LT(discs.clearance(x / 100.0, y / 100.0), 0.3 + 1.5e-5);
}

}  // namespace
}  // namespace overlook::wang_ldi
