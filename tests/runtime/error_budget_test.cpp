#include "runtime/view/error_budget.h"

#include <gtest/gtest.h>

#include <cmath>

#include "runtime/terrain/refine.h"
#include "tests/tools/synthetic_dem.h"
#include "tools/bake/terrain.h"

namespace overlook::view {
namespace {

struct Settling {
    int frames = 0;        // until the cost stays within 5 % of the budget (or at the least error)
    int sign_changes = 0;  // of the error's steps
};

// Runs `frames` frames of a cost that depends on the error alone, from a settled state at `before` to the budget `after`.
template <class Cost>
Settling settle(const Cost& cost, double before, double after, int frames) {
    ErrorController controller({before, 0.5, false});
    for (int i = 0; i < 60; ++i) controller.frame_done(cost(controller.error_px()));
    controller.set_budget({after, 0.5, false});
    Settling result;
    double last_step = 0;
    for (int i = 0; i < frames; ++i) {
        double error_px = controller.error_px(), now = cost(error_px);
        if (std::abs(now / after - 1) > 0.05) result.frames = i + 1;
        controller.frame_done(now);
        double step = controller.error_px() - error_px;
        if (step * last_step < 0) ++result.sign_changes;
        if (step != 0) last_step = step;
    }
    return result;
}

TEST(ErrorController, SettlesWhenTheBudgetIsHalvedWhateverTheCostsLaw) {
    for (double exponent : {0.5, 0.8, 1.0, 1.4, 2.0}) {
        Settling result = settle([=](double error_px) { return 1e5 * std::pow(error_px, -exponent); }, 8e4, 4e4, 60);
        EXPECT_LE(result.frames, 20) << exponent;
        EXPECT_LE(result.sign_changes, 1) << exponent;
    }
}

TEST(ErrorController, SettlesOnARealTerrainsTriangles) {
    auto terrain = terrain::bake(test::make_hills(513, 513, 3), {}, [](double) {});
    ASSERT_TRUE(terrain.has_value());
    terrain::Refiner refiner(*terrain);
    Camera camera;
    camera.position_m = {7000, -15000, 2000};
    camera.pitch_deg = -15;
    terrain::Cut cut;
    auto triangles = [&](double error_px) {
        refiner.cut_by_pixels(camera, error_px, cut, 0.5);
        return double(cut.triangle_count());
    };
    double before = 0.8 * triangles(0.5);
    Settling result = settle(triangles, before, before / 2, 60);
    EXPECT_LE(result.frames, 20);
    EXPECT_LE(result.sign_changes, 1);
}

TEST(ErrorController, ComesDownSlowlyAndNoFurtherThanAsked) {
    ErrorController controller({1000, 2, false});
    controller.frame_done(8000);
    double high_px = controller.error_px();
    EXPECT_GT(high_px, 10);
    for (int i = 0; i < 10; ++i) controller.frame_done(1);
    EXPECT_GT(controller.error_px(), high_px * std::exp(-0.31));
    for (int i = 0; i < 1000; ++i) controller.frame_done(1);
    EXPECT_EQ(controller.error_px(), 2);
}

TEST(ErrorController, RestsInItsBand) {
    ErrorController controller({1000, 1, false});
    controller.frame_done(3000);
    double error_px = controller.error_px();
    for (double cost : {951.0, 999.0, 960.0}) controller.frame_done(cost);
    EXPECT_EQ(controller.error_px(), error_px);
}

TEST(ErrorController, DoesNotMoveForOneSlowFrame) {
    ErrorController controller({10, 1, true});
    for (double ms : {9.7, 9.6, 9.8, 40.0, 9.7, 9.6}) controller.frame_done(ms);
    EXPECT_EQ(controller.error_px(), 1);
    for (double ms : {20.0, 21.0, 20.0}) controller.frame_done(ms);
    EXPECT_GT(controller.error_px(), 1.5);
}

TEST(ErrorController, WithoutABudgetAsksWhatWasAsked) {
    ErrorController controller({0, 1.5, false});
    controller.frame_done(1e9);
    EXPECT_EQ(controller.error_px(), 1.5);
}

}  // namespace
}  // namespace overlook::view
