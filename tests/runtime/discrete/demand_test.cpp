#include "runtime/discrete/demand.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/runtime/discrete/budget_runs.h"

namespace overlook::discrete {
namespace {

TEST(Demand, IsWhatAFrameTakesWhenItsChangesAreOver) {
    for (Variant variant : kAll) {
        SCOPED_TRACE(int(variant));
        BudgetRun show(variant, crowd(12));
        double at_first = 0;
        for (int frame = 0; frame < 40; ++frame) {
            if (frame == 10) show.keeper.set_triangles(at_first / 3);
            if (frame == 20) show.keeper.set_triangles(0);
            show.frame(passing(frame));
            if (frame == 0) at_first = show.settled();
            // Where levels change at once they are what was wanted; else they are on the way to it, or to what was wanted before.
            if (!fades(variant)) {
                EXPECT_EQ(show.settled(), show.foretold) << frame;
            }
        }
        double still = 0;
        for (int frame = 0; frame < 40; ++frame) show.frame(passing(40)), still = show.foretold;
        EXPECT_EQ(show.settled(), still);
        EXPECT_EQ(show.drawn(), still);
    }
}

TEST(Demand, ChangesNothing) {
    BudgetRun asked(Variant::fsi, crowd(8)), unasked(Variant::fsi, crowd(8));
    for (int frame = 0; frame < 30; ++frame) {
        for (double dt_s : {kStep_s, 0.0, 1.0}) asked.director.demand(passing(3 * frame + 1), dt_s);
        asked.director.decide(passing(frame), kStep_s);
        unasked.director.decide(passing(frame), kStep_s);
        ASSERT_TRUE(asked.director.frame().items == unasked.director.frame().items) << frame;
    }
}

TEST(Demand, CountsOfWhatThePicturesSidesCutOnlyWhatIsInIt) {
    // One large thing of many triangles, half of it beside the picture.
    BudgetRun show(Variant::hard, std::vector<Placement>(1), made::sphere_chain(128, 3));
    view::Camera camera = camera_at({0, -3, 0}, 25);
    camera.pitch_deg = 0;
    show.frame(camera);
    uint64_t whole = show.director.facts().levels[0].triangle_count;
    EXPECT_LT(show.settled(), 0.8 * double(whole));
    EXPECT_GT(show.settled(), 0);
    EXPECT_EQ(show.settled(), show.foretold);
}

TEST(Demand, NeverGrowsAsLevelsMayBeCoarser) {
    BudgetRun show(Variant::fsi, crowd(10));
    for (int frame = 0; frame < 20; ++frame) {
        Demand demand = show.director.demand(passing(frame), kStep_s);
        double before = std::numeric_limits<double>::infinity();
        for (double times = 1; times < 5000; times *= 1.3) {
            double now = demand.triangles(times);
            EXPECT_LE(now, before) << times;
            before = now;
        }
        show.frame(passing(frame));
    }
}

// Random strains, those of some coarser levels smaller than a finer one's; in steps, so that many are at a limit.
TEST(Selector, WantsOfStrainsWhatItWantsOfPlaces) {
    std::mt19937 random(7);
    for (int trial = 0; trial < 300; ++trial) {
        ChainFacts facts;
        facts.radius_m = 1;
        for (int level = 0; level < 5; ++level)
            facts.levels.push_back({level == 0 ? 0 : 0.01 * double(random() % 20), 0, uint64_t(1000 >> level), {}});
        SelectSettings settings;
        settings.refine_share = 0.25 + 0.25 * double(random() % 4), settings.coarsen_share = 0.2 + 0.2 * double(random() % 4);
        settings.criterion = Criterion(random() % 4);
        view::Camera camera = camera_at({0, -5.0 - double(random() % 200), 0}), later = camera;
        later.position_m.y += double(random() % 20) - 10;
        double times = std::exp2(double(random() % 8));
        SelectSettings coarse = coarser(settings, times);
        bool knows_ahead = random() % 2 == 0;
        Selector fine_ahead(facts, settings, later), coarse_ahead(facts, coarse, later);
        Selector fine(facts, settings, camera, knows_ahead ? &fine_ahead : nullptr);
        Selector wanting(facts, coarse, camera, knows_ahead ? &coarse_ahead : nullptr);
        std::vector<double> now, ahead;
        fine.note_strains({}, now, ahead);
        ASSERT_EQ(now.size(), 5u);
        ASSERT_EQ(ahead.size(), knows_ahead ? 5u : 0u);
        EXPECT_EQ(wanted_level(settings, now, ahead, std::nullopt, times), wanting.wanted({})) << trial;
        for (uint32_t level = 0; level < 5; ++level)
            EXPECT_EQ(wanted_level(settings, now, ahead, level, times), wanting.wanted({}, level)) << trial << " " << level;
    }
}

}  // namespace
}  // namespace overlook::discrete
