#include "runtime/view/error_budget.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

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

// A camera that moves on changes the cost a little in every frame.
TEST(ErrorController, StaysWithinABudgetWhoseCostDrifts) {
    for (double exponent : {0.5, 1.0, 2.0})
        for (double drift : {0.995, 1.005}) {
            ErrorController controller({5e4, 0.5, false});
            double scale = 1e5;
            for (int frame = 0; frame < 200; ++frame, scale *= drift) {
                double share = scale * std::pow(controller.error_px(), -exponent) / 5e4;
                if (frame >= 40 && controller.error_px() > 0.5) {
                    EXPECT_LE(std::abs(share - 1), 0.05) << exponent << " " << drift << " " << frame;
                }
                controller.frame_done(share * 5e4);
            }
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
    for (double cost : {961.0, 999.0, 970.0}) controller.frame_done(cost);
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

TEST(MiddleOfThree, IsTheMiddleOfTheLastThree) {
    MiddleOfThree middle;
    std::vector<double> given = {5, 1, 3, 9, 2, 2, 7, 8, 6, 0}, wanted = {5, 1, 3, 3, 3, 2, 2, 7, 7, 6};
    for (size_t i = 0; i < given.size(); ++i) {
        EXPECT_EQ(middle.next(given[i]), wanted[i]) << i;
        EXPECT_EQ(middle.is_full(), i >= 2) << i;
    }
    middle.forget();
    EXPECT_EQ(middle.next(4), 4);
    EXPECT_FALSE(middle.is_full());
}

// A renderer that takes `fixed_ms` and `ms_a_piece`, of work that comes in pieces of `grain`, `demanded` of it.
struct Worker {
    double fixed_ms = 2, ms_a_piece = 1e-4, grain = 500, demanded = 4e5;
    double done(const WorkAllowance& allowance) const {
        if (allowance.work() <= 0) return demanded;
        return std::min(demanded, std::max(std::floor(allowance.work() / grain), 1.0) * grain);
    }
    double ms(double work) const { return fixed_ms + ms_a_piece * work; }
};

// The last of so many frames' milliseconds; jitter: a factor of each.
template <class Jitter>
double run(WorkAllowance& allowance, const Worker& worker, int frames, Jitter&& jitter) {
    double ms = 0;
    for (int frame = 0; frame < frames; ++frame) {
        double work = worker.done(allowance);
        ms = worker.ms(work);
        allowance.frame_done(ms * jitter(frame), work, work, work < worker.demanded);
    }
    return ms;
}
double evenly(int) {
    return 1;
}

TEST(WorkAllowance, LetsAFrameTakeItsTimeAndNoMoreWhateverElseTakesTime) {
    for (double fixed_ms : {0.0, 2.0, 9.0, 14.0}) {
        Worker worker;
        worker.fixed_ms = fixed_ms;
        WorkAllowance allowance;
        allowance.set_most_ms(16);
        double ms = run(allowance, worker, 120, evenly);
        EXPECT_LE(ms, 16) << fixed_ms;
        EXPECT_GE(ms, 0.8 * 16) << fixed_ms;
        double work = allowance.work();
        run(allowance, worker, 60, evenly);
        EXPECT_EQ(allowance.work(), work) << fixed_ms;  // rests
    }
}

TEST(WorkAllowance, FollowsStepsOfTheTimeAndOfTheLoadWithoutSwinging) {
    Worker worker;
    WorkAllowance allowance;
    allowance.set_most_ms(20);
    EXPECT_LE(run(allowance, worker, 60, evenly), 20);
    for (auto [most_ms, ms_a_piece] : {std::pair(10.0, 1e-4), {10.0, 3e-4}, {30.0, 3e-4}, {30.0, 5e-5}, {8.0, 5e-5}}) {
        allowance.set_most_ms(most_ms), worker.ms_a_piece = ms_a_piece;
        int changes_of_sign = 0;
        double last_step = 0;
        for (int frame = 0; frame < 150; ++frame) {
            double before = allowance.work();
            run(allowance, worker, 1, evenly);
            double step = allowance.work() - before;
            if (step * last_step < 0) ++changes_of_sign;
            if (step != 0) last_step = step;
        }
        double ms = worker.ms(worker.done(allowance));
        EXPECT_LE(ms, most_ms) << most_ms << " " << ms_a_piece;
        EXPECT_TRUE(ms >= 0.8 * most_ms || worker.done(allowance) == worker.demanded) << ms << " of " << most_ms;
        EXPECT_LE(changes_of_sign, 1) << most_ms << " " << ms_a_piece;
    }
}

TEST(WorkAllowance, IsNotMovedByOneSlowFrame) {
    WorkAllowance allowance;
    allowance.set_most_ms(10);
    for (double ms : {9.0, 9.1, 40.0, 9.0, 8.9, 40.0, 9.0}) allowance.frame_done(ms, 1000, 1000, false);
    EXPECT_EQ(allowance.work(), 0);
    for (double ms : {20.0, 21.0}) allowance.frame_done(ms, 1000, 1000, false);
    EXPECT_GT(allowance.work(), 0);
    EXPECT_LT(allowance.work(), 500);
}

TEST(WorkAllowance, OfATimeThatCannotBeKeptDoesNotWindUpAndComesBack) {
    Worker worker;
    worker.fixed_ms = 50;
    WorkAllowance allowance;
    allowance.set_most_ms(10);
    run(allowance, worker, 1000, evenly);
    EXPECT_LE(worker.done(allowance), worker.grain);
    EXPECT_GE(allowance.work(), 1);
    worker.fixed_ms = 2;
    EXPECT_GE(run(allowance, worker, 300, evenly), 8);
    EXPECT_LE(run(allowance, worker, 10, evenly), 10);
}

// Changes of level take a quarter of a second, in which what was and what will be are drawn together, or one after the other: a
// time is not charged again for what is over soon.
TEST(WorkAllowance, WaitsForChangesThatAreUnderWay) {
    constexpr int kChange_frames = 15;
    for (bool is_both : {false, true})
        for (double fixed_ms : {0.0, 2.0, 9.0}) {
            Worker worker;
            worker.fixed_ms = fixed_ms;
            WorkAllowance allowance;
            allowance.set_most_ms(16);
            double from = worker.demanded, to = worker.demanded, ms = 0;
            int left = 0, over = 0, changes_of_sign = 0;
            double last_step = 0, least = worker.demanded;
            for (int frame = 0; frame < 400; ++frame) {
                double wanted = worker.done(allowance);
                if (wanted != to) {
                    from = left > 0 ? from + (to - from) * (kChange_frames - left) / kChange_frames : to;
                    to = wanted, left = kChange_frames;
                }
                double through = 1 - double(left) / kChange_frames;
                double drawn = left == 0 ? to : is_both ? from + to : from + (to - from) * through;
                ms = worker.ms(drawn);
                over += ms > 16;
                double before = allowance.work();
                allowance.frame_done(ms, drawn, to, to < worker.demanded);
                double step = allowance.work() - before;
                if (step * last_step < 0) ++changes_of_sign;
                if (step != 0) last_step = step;
                if (allowance.work() > 0) least = std::min(least, allowance.work());
                left = std::max(0, left - 1);
            }
            double fits = (16 - fixed_ms) / worker.ms_a_piece;
            EXPECT_LE(ms, 16) << is_both << " " << fixed_ms;
            EXPECT_GE(ms, 0.8 * 16) << is_both << " " << fixed_ms;
            EXPECT_GE(least, 0.5 * fits) << is_both << " " << fixed_ms;
            EXPECT_LE(over, 5 * kChange_frames) << is_both << " " << fixed_ms;
            EXPECT_LE(changes_of_sign, 2) << is_both << " " << fixed_ms;
        }
}

TEST(WorkAllowance, WithoutATimeThereIsNone) {
    WorkAllowance allowance;
    for (int i = 0; i < 10; ++i) allowance.frame_done(1e9, 1e9, 1e9, true);
    EXPECT_EQ(allowance.work(), 0);
    allowance.set_most_ms(1);
    for (int i = 0; i < 10; ++i) allowance.frame_done(1e9, 1e9, 1e9, true);
    EXPECT_GE(allowance.work(), 1);
    allowance.set_most_ms(0);
    EXPECT_EQ(allowance.work(), 0);
}

// Times that scatter by a quarter, as of a busy machine: over the time in few frames, and not far under it.
TEST(WorkAllowance, IsKeptWhereTimesScatter) {
    Worker worker;
    WorkAllowance allowance;
    allowance.set_most_ms(16);
    auto scattered = [state = uint32_t(1)](int) mutable {
        state = state * 1664525u + 1013904223u;
        return 0.875 + 0.25 * double(state >> 8) / double(1u << 24);
    };
    run(allowance, worker, 60, scattered);
    double sum = 0;
    for (int frame = 0; frame < 300; ++frame) sum += run(allowance, worker, 1, scattered);
    EXPECT_LE(sum / 300, 16);
    EXPECT_GE(sum / 300, 0.75 * 16);
}

}  // namespace
}  // namespace overlook::view
