#include "runtime/discrete/budget.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "runtime/discrete/director.h"
#include "tests/runtime/discrete/chains.h"

namespace overlook::discrete {
namespace {

constexpr double kStep_s = 1.0 / 32;
constexpr Variant kAll[] = {Variant::fsi, Variant::fsi_paper, Variant::hard, Variant::blend, Variant::dither, Variant::late};

// side x side spheres on the ground before the eye.
std::vector<Placement> crowd(int side) {
    std::vector<Placement> placements;
    for (int i = 0; i < side * side; ++i) {
        Placement placed;
        placed.translation_m = {3.0 * (i % side - side / 2) + 0.1 * (i * 7 % 11), 6 + 3.0 * (i / side), 0.1 * (i * 5 % 7)};
        placed.scale = 0.5 + 0.1 * (i % 3);
        placements.push_back(placed);
    }
    return placements;
}

view::Camera camera_at(const glm::dvec3& at_m, double heading_deg = 0) {
    view::Camera camera;
    camera.position_m = at_m, camera.heading_deg = heading_deg, camera.pitch_deg = -8;
    camera.width_px = 640, camera.height_px = 480, camera.near_m = 0.01;
    return camera;
}
// Past the crowd, sideways.
view::Camera passing(int frame) {
    return camera_at({-8 + 4 * kStep_s * frame, -4, 4});
}

// As FrameDrawer does it.
struct Show {
    Show(Variant variant, const std::vector<Placement>& placements, Chain chain = made::sphere_chain(64, 6))
        : Show(defaults_of(variant), placements, std::move(chain)) {}
    Show(const FrameOptions& options, const std::vector<Placement>& placements, Chain chain = made::sphere_chain(64, 6))
        : director(facts_of(chain), placements, options) {}

    void frame(const view::Camera& camera, double dt_s = kStep_s) {
        Demand demand = director.demand(camera, dt_s);
        times = keeper.times(std::span(&demand, 1));
        foretold = demand.triangles(times);
        director.coarsen(times);
        director.decide(camera, dt_s);
    }
    double settled() const { return double(director.frame().settled_triangle_count); }
    double drawn() const { return double(director.frame().triangle_count); }

    Director director;
    BudgetKeeper keeper;
    double times = 1, foretold = 0;
};

double free_triangles(Variant variant, const std::vector<Placement>& placements, const view::Camera& camera) {
    Show show(variant, placements);
    show.frame(camera);
    return show.settled();
}

TEST(Demand, IsWhatAFrameTakesWhenItsChangesAreOver) {
    for (Variant variant : kAll) {
        SCOPED_TRACE(int(variant));
        Show show(variant, crowd(12));
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
    Show asked(Variant::fsi, crowd(8)), unasked(Variant::fsi, crowd(8));
    for (int frame = 0; frame < 30; ++frame) {
        for (double dt_s : {kStep_s, 0.0, 1.0}) asked.director.demand(passing(3 * frame + 1), dt_s);
        asked.director.decide(passing(frame), kStep_s);
        unasked.director.decide(passing(frame), kStep_s);
        ASSERT_TRUE(asked.director.frame().items == unasked.director.frame().items) << frame;
    }
}

TEST(Demand, CountsOfWhatThePicturesSidesCutOnlyWhatIsInIt) {
    // One large thing of many triangles, half of it beside the picture.
    Show show(Variant::hard, std::vector<Placement>(1), made::sphere_chain(128, 3));
    view::Camera camera = camera_at({0, -3, 0}, 25);
    camera.pitch_deg = 0;
    show.frame(camera);
    uint64_t whole = show.director.facts().levels[0].triangle_count;
    EXPECT_LT(show.settled(), 0.8 * double(whole));
    EXPECT_GT(show.settled(), 0);
    EXPECT_EQ(show.settled(), show.foretold);
}

TEST(Demand, NeverGrowsAsLevelsMayBeCoarser) {
    Show show(Variant::fsi, crowd(10));
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

TEST(BudgetKeeper, WithoutABudgetAsksWhatWasAsked) {
    Show show(Variant::fsi, crowd(8));
    double before = 0;
    for (int frame = 0; frame < 10; ++frame) {
        show.frame(passing(0));
        EXPECT_EQ(show.times, 1);
        if (frame > 0) {
            EXPECT_EQ(show.settled(), before);
        }
        before = show.settled();
    }
    show.keeper.set_triangles(before / 2);
    show.frame(passing(0));
    EXPECT_GT(show.times, 1);
    show.keeper.set_triangles(0);
    for (int frame = 0; frame < 60; ++frame) show.frame(passing(0));
    EXPECT_EQ(show.times, 1);
    EXPECT_GE(show.drawn(), 0.95 * before);
}

TEST(BudgetKeeper, OfMoreThanIsTakenAsksWhatWasAsked) {
    for (Variant variant : kAll) {
        std::vector<Placement> placements = crowd(10);
        double free = free_triangles(variant, placements, passing(0));
        Show show(variant, placements);
        for (double budget : {1.001 * free / 0.975, 10 * free, 1e18, std::numeric_limits<double>::max()}) {
            show.keeper.set_triangles(budget);
            show.frame(passing(0));
            EXPECT_EQ(show.times, 1) << budget;
            EXPECT_EQ(show.settled(), free);
        }
    }
}

// The least error that fits: a little less and it would be too much.
TEST(BudgetKeeper, IsNoCoarserThanItMust) {
    std::vector<Placement> placements = crowd(16);
    double free = free_triangles(Variant::hard, placements, passing(0));
    for (double share : {0.8, 0.4, 0.2, 0.1}) {
        Show show(Variant::hard, placements);
        Demand demand = show.director.demand(passing(0), kStep_s);
        show.keeper.set_triangles(share * free);
        double times = show.keeper.times(std::span(&demand, 1));
        EXPECT_GT(times, 1);
        EXPECT_LE(demand.triangles(times), 0.975 * share * free);
        EXPECT_GT(demand.triangles(times / 1.0001), 0.975 * share * free) << share;
    }
}

TEST(BudgetKeeper, ConvergesAtOnceAndThenChangesNothing) {
    for (Variant variant : kAll) {
        SCOPED_TRACE(int(variant));
        std::vector<Placement> placements = crowd(16);
        double free = free_triangles(variant, placements, passing(0));
        Show show(variant, placements);
        for (int frame = 0; frame < 10; ++frame) show.frame(passing(0));
        for (double share : {0.7, 0.35, 0.1, 0.5, 0.9}) {
            show.keeper.set_triangles(share * free);
            show.frame(passing(0));
            double foretold = show.foretold;
            EXPECT_LE(foretold, share * free) << share;
            EXPECT_GE(foretold, 0.95 * share * free) << share;
            for (int frame = 0; frame < 20; ++frame) show.frame(passing(0));  // until changes are over
            double times = show.times;
            for (int frame = 0; frame < 30; ++frame) {
                show.frame(passing(0));
                EXPECT_EQ(show.director.frame().begun_count, 0u) << share;
                EXPECT_EQ(show.drawn(), foretold) << share;
                EXPECT_EQ(show.times, times) << share;
            }
        }
    }
}

// 20 frames after it changed, of several loads. What is foretold is within 5 %; of what is drawn, while levels change that are
// four times as many triangles as the next, 10 %.
TEST(BudgetKeeper, KeepsItOnTheWayPastACrowdWhateverTheStep) {
    std::vector<Placement> placements = crowd(24);
    double free = free_triangles(Variant::fsi, placements, passing(0));
    for (double share : {0.5, 0.6, 0.9, 1.5, 2.0}) {
        Show show(Variant::fsi, placements);
        double budget = 0.4 * free;
        show.keeper.set_triangles(budget);
        for (int frame = 0; frame < 40; ++frame) show.frame(passing(frame));
        budget *= share;
        show.keeper.set_triangles(budget);
        int changes_of_sign = 0;
        bool was_over = show.drawn() > budget;
        for (int frame = 40; frame < 120; ++frame) {
            show.frame(passing(frame));
            bool is_over = show.drawn() > budget;
            if (frame <= 60 && is_over != was_over) ++changes_of_sign;
            was_over = is_over;
            if (frame >= 60) {
                EXPECT_LE(show.foretold, budget) << share << " in frame " << frame;
                EXPECT_GE(show.foretold, 0.95 * budget) << share << " in frame " << frame;
                EXPECT_LE(std::abs(show.drawn() - budget), 0.1 * budget) << share << " in frame " << frame;
            }
        }
        EXPECT_LE(changes_of_sign, 1) << share;
    }
}

// An eye that trembles by 1 % at a budget's edge makes nothing go to and fro.
TEST(BudgetKeeper, DoesNotSwingWithACameraThatTrembles) {
    for (Variant variant : {Variant::fsi, Variant::hard}) {
        std::vector<Placement> placements = crowd(16);
        double free = free_triangles(variant, placements, passing(0));
        for (double share = 0.2; share < 1; share += 0.1) {
            Show show(variant, placements);
            show.keeper.set_triangles(share * free);
            uint64_t begun = 0;
            for (int frame = 0; frame < 96; ++frame) {
                show.frame(camera_at({0, -4 + (frame % 2 == 0 ? 0.04 : -0.04), 4}));
                if (frame < 32) continue;
                begun += show.director.frame().begun_count;
                EXPECT_LE(show.settled(), share * free);
            }
            EXPECT_EQ(begun, 0u) << share;
        }
    }
}

TEST(BudgetKeeper, OfABudgetThatCannotBeKeptTakesTheFewestThereAreAndComesBack) {
    std::vector<Placement> placements = crowd(8);
    for (Variant variant : kAll) {
        SCOPED_TRACE(int(variant));
        Show show(variant, placements);
        for (int frame = 0; frame < 10; ++frame) show.frame(passing(0));
        double free = show.settled(), fewest = show.director.demand(passing(0), kStep_s).triangles(4096);
        for (double budget : {0.5 * fewest, 1.0, 1e-300}) {
            show.keeper.set_triangles(budget);
            for (int frame = 0; frame < 60; ++frame) show.frame(passing(0));
            EXPECT_EQ(show.drawn(), fewest);
            EXPECT_LT(show.times, 4096);  // no coarser than it takes
            EXPECT_LE(show.keeper.sum_count(), 2) << "what cannot be kept is not searched for again";
        }
        show.keeper.set_triangles(0.5 * free);
        show.frame(passing(0));
        EXPECT_GE(show.foretold, 0.9 * 0.5 * free);
        EXPECT_LE(show.foretold, 0.5 * free);
    }
}

// By size and by distance as well, whose levels no error moves; over the whole range of what may be set.
TEST(BudgetKeeper, WorksWhateverLevelsAreChosenBy) {
    std::vector<Placement> placements = crowd(16);
    for (Criterion criterion : {Criterion::error, Criterion::size, Criterion::distance, Criterion::importance}) {
        SCOPED_TRACE(int(criterion));
        for (double scale : {0.01, 1.0, 50.0, 10000.0}) {
            FrameOptions options = defaults_of(Variant::hard);
            options.select.criterion = criterion;
            options.select.error_px = scale, options.select.size_px = 256 * scale, options.select.distance_m = 100 / scale;
            Show show(options, placements);
            show.frame(passing(0));
            double free = show.settled();
            Demand demand = show.director.demand(passing(0), kStep_s);
            double fewest = demand.triangles(4096);
            for (double budget : {0.5 * free, 0.1 * free}) {
                show.keeper.set_triangles(budget);
                for (int frame = 0; frame < 3; ++frame) show.frame(passing(0));
                EXPECT_LE(show.settled(), std::max(budget, fewest)) << scale;
                EXPECT_EQ(show.settled(), show.foretold);
                EXPECT_TRUE(std::isfinite(show.times));
            }
        }
    }
}

TEST(BudgetKeeper, SurvivesHostileSettings) {
    FrameOptions options = defaults_of(Variant::fsi);
    options.select.refine_share = 1e-12, options.select.coarsen_share = 1e-12, options.select.error_px = 1e-300;
    Show show(options, crowd(4));
    for (double budget : {1.0, 1e300, 500.0}) {
        show.keeper.set_triangles(budget);
        for (int frame = 0; frame < 5; ++frame) show.frame(passing(frame), frame == 2 ? 0 : 1e9);
        EXPECT_TRUE(show.times >= 1 && show.times <= 4096);
    }
    // Nothing in view, and an eye in the midst of a thing.
    show.frame(camera_at({0, -4, 4}, 180));
    EXPECT_EQ(show.settled(), 0);
    Show inside(Variant::hard, std::vector<Placement>(1));
    inside.keeper.set_triangles(10);
    inside.frame(camera_at({0, 0, 0}));
    EXPECT_EQ(inside.settled(), inside.foretold);
    EXPECT_TRUE(inside.times >= 1 && inside.times <= 4096);
}

// One by one on the way; and a chain that has one level alone.
TEST(BudgetKeeper, OfLevelsOneByOneEndsWhereItSaid) {
    FrameOptions options = defaults_of(Variant::fsi);
    options.is_one_by_one = true;
    std::vector<Placement> placements = crowd(12);
    Show show(options, placements);
    show.frame(passing(0));
    double budget = 0.2 * show.settled();
    show.keeper.set_triangles(budget);
    show.frame(passing(0));
    double times = show.times;
    for (int frame = 0; frame < 60; ++frame) {
        show.frame(passing(0));
        EXPECT_LE(show.times, times * 1.000001) << frame;  // waits for what is under way
    }
    EXPECT_LE(show.drawn(), budget);
    EXPECT_GE(show.drawn(), 0.9 * budget);
    Show alone(Variant::fsi, placements, made::sphere_chain(16, 1));
    alone.keeper.set_triangles(1);
    alone.frame(passing(0));
    EXPECT_EQ(alone.settled(), alone.foretold);
}

// Of a file made by hand, in which a coarser level may have more triangles than a finer one.
TEST(BudgetKeeper, KeepsABudgetOfLevelsThatAreNotCheaper) {
    ChainFacts facts;
    facts.radius_m = 1;
    for (uint64_t triangles : {100, 400, 50, 80, 60})
        facts.levels.push_back({0.01 * double(facts.levels.size()), 0, triangles, {}});
    for (double budget : {12000.0, 9000.0, 5000.0}) {
        Director director(facts, crowd(12), defaults_of(Variant::hard));
        BudgetKeeper keeper;
        keeper.set_triangles(budget);
        for (int frame = 0; frame < 40; ++frame) {
            Demand demand = director.demand(passing(frame), kStep_s);
            director.coarsen(keeper.times(std::span(&demand, 1)));
            director.decide(passing(frame), kStep_s);
            EXPECT_LE(double(director.frame().settled_triangle_count), std::max(budget, demand.triangles(4096))) << frame;
        }
    }
}

// Several directors of one picture share the budget at one coarseness.
TEST(BudgetKeeper, SharesABudgetAmongChains) {
    Show fine(Variant::hard, crowd(12)), rough(Variant::hard, crowd(12), made::sphere_chain(16, 4));
    view::Camera camera = passing(0);
    std::vector<Demand> demands = {fine.director.demand(camera, kStep_s), rough.director.demand(camera, kStep_s)};
    double free = demands[0].triangles(1) + demands[1].triangles(1);
    BudgetKeeper keeper;
    keeper.set_triangles(free / 2);
    double times = keeper.times(demands), sum = 0;
    for (Show* show : {&fine, &rough}) {
        show->director.coarsen(times);
        show->director.decide(camera, kStep_s);
        sum += show->settled();
    }
    EXPECT_LE(sum, free / 2);
    EXPECT_GE(sum, 0.9 * free / 2);
}

}  // namespace
}  // namespace overlook::discrete
