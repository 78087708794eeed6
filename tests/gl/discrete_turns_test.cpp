// Frame-sequential interpolation: what its remedies mend, and what the paper's own form does instead.
#include <gtest/gtest.h>

#include <cmath>

#include "runtime/gl/png.h"
#include "tests/gl/discrete_scene.h"

namespace overlook::discrete {
namespace {

using made::by_distance;
using made::camera_from;
using made::Film;
using made::kStep_s;
using made::placed;

// A still camera in mid-transition: whichever of the two levels a frame draws, the picture is the same.
TEST(Turns, HaveNoTwoFrameCycleInMidTransition) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    // Coplanar faces; mismatched silhouettes one behind the other, which go their own ways.
    struct Case {
        Chain chain;
        std::vector<Placement> placements;
    };
    for (const Case& one : {Case{made::coplanar_chain(), {placed({0, 0, 0})}},
                            Case{made::simple_chain(), {placed({0, 0, 0}), placed({0.7, 1.5, 0.2}), placed({-0.6, 3, 0.5})}}}) {
        for (uint32_t samples : {1u, 4u}) {
            FrameOptions options = by_distance(Variant::fsi);
            options.select.distance_m = 15;
            Film film(one.chain, one.placements, options, samples);
            film.frame(camera_from({0, -17, 0}));
            view::Camera still = camera_from({0, -11, 0});
            for (double phase : {0.2, 0.5, 0.8}) {
                film.until(still, phase);
                ImageRgb8 a = film.frame(still, 0), b = film.frame(still, 0), c = film.frame(still, 0);
                ASSERT_FALSE(film.transition().is_resting());
                EXPECT_EQ(made::differing(b, c), 0u) << phase << " " << samples;
                EXPECT_EQ(made::differing(a, c), 0u) << phase << " " << samples;
            }
        }
    }
}

// Pixels that no instance under way may touch are those of levels that give way at once.
TEST(Turns, LeaveAloneWhatIsNotUnderWay) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Chain chain = made::simple_chain();
    std::vector<Placement> placements = {placed({-2.2, 0, 0}), placed({2.2, -3, 0})};
    Film film(chain, placements, by_distance(Variant::fsi)), hard(chain, placements, by_distance(Variant::hard));
    for (Film* one : {&film, &hard}) one->frame(camera_from({0, -10.3, 0}));
    size_t changed = 0;
    for (int frame = 0; frame < 8; ++frame) {
        view::Camera camera = camera_from({0, -9.4 + 0.03 * frame, 0});
        ImageRgb8 turned = film.frame(camera), at_once = hard.frame(camera);
        ASSERT_EQ(film.counts.fading_count, 1u) << frame;
        for (uint32_t y = 0; y < 80; ++y) {
            for (uint32_t x = 0; x < 96; ++x) {
                bool is_same = overlook::test::pixel(turned, x, y) == overlook::test::pixel(at_once, x, y);
                changed += !is_same;
                EXPECT_TRUE(is_same || x < 48) << frame << " " << x << "," << y;
            }
        }
    }
    EXPECT_GT(changed, 0u);
}

// By how much the picture goes away from that without a change of level in one frame at most, of the change's first frames, while
// the camera goes past.
double jump_on_entering(const Chain& chain, const FrameOptions& options) {
    auto camera = [](int frame) { return camera_from({-0.6 + 0.05 * frame, -10.3 + 0.05 * frame, 0}); };
    FrameOptions never = options;
    never.variant = Variant::hard, never.select.distance_m = 1;
    Film film(chain, {Placement{}}, options), rested(chain, {Placement{}}, never);
    double last = 0, worst = 0;
    int under_way = 0;
    for (int frame = 0; frame < 30 && under_way < 4; ++frame) {
        ImageRgb8 picture = film.frame(camera(frame)), without = rested.frame(camera(frame));
        under_way += !film.transition().is_resting();
        double away = made::mean_difference(picture, without);
        worst = std::max(worst, away - last);
        last = away;
    }
    EXPECT_EQ(under_way, 4);
    return worst;
}

// The paper looks its older buffer up with the depth of what lies behind: its prototype jumped as far as a hard switch.
TEST(Turns, EnterAChangeWithoutAJump) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Chain chain = made::simple_chain();
    double remedied = jump_on_entering(chain, by_distance(Variant::fsi));
    double printed = jump_on_entering(chain, by_distance(Variant::fsi_paper));
    EXPECT_LT(remedied, 1.5);
    EXPECT_LT(3 * remedied, printed);
}

// No ghosts and no holes: behind what is not there yet is what really stands there.
TEST(Turns, ShowWhatStandsBehindMismatchedOutlines) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Chain chain = made::simple_chain();
    // A wall of others, which rest, behind the one under way.
    std::vector<Placement> placements = {placed({0, 0, 0})};
    for (int i = 0; i < 25; ++i) placements.push_back(placed({1.4 * (i % 5 - 2), 8, 1.4 * (i / 5 - 2)}));
    // Level 0 of the first one, or 1 of it alone.
    auto film_of = [&](double distance_m) {
        FrameOptions options = by_distance(Variant::hard);
        options.select.distance_m = distance_m;
        return std::make_unique<Film>(chain, placements, options);
    };
    auto camera = [](int frame) { return camera_from({0.04 * frame, -9.4, 0.02 * frame}); };
    auto film_fine = film_of(10), film_coarse = film_of(9);
    Film film(chain, placements, by_distance(Variant::fsi));
    film.frame(camera_from({0, -11, 0}));
    size_t beyond = 0, frames = 0;
    for (int frame = 0; frame < 12; ++frame) {
        ImageRgb8 picture = film.frame(camera(frame));
        ImageRgb8 a = film_fine->frame(camera(frame)), b = film_coarse->frame(camera(frame));
        if (frame == 0 || film.transition().is_resting()) continue;
        beyond += made::beyond(picture, a, b, 40);
        ++frames;
    }
    ASSERT_GT(frames, 8u);
    EXPECT_LT(double(beyond) / double(frames), 0.005 * 96 * 80);
}

// Things that move are looked up where they themselves were.
TEST(Turns, FollowWhatMoves) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Chain chain = made::simple_chain();
    view::Camera camera = camera_from({0, -10.5, 0});
    auto error = [&](bool moves_instances, bool splits_things) {
        FrameOptions options = by_distance(Variant::fsi);
        options.remedies.moves_instances = moves_instances;
        options.remedies.splits_things = splits_things;
        FrameOptions fine = by_distance(Variant::hard), coarse = fine;
        fine.select.distance_m = 100, coarse.select.distance_m = 1;
        Film film(chain, {Placement{}}, options), level_0(chain, {Placement{}}, fine), level_1(chain, {Placement{}}, coarse);
        size_t count = 0;
        for (int frame = 0; frame < 14; ++frame) {
            // Towards the eye and across: it changes its level on the way.
            std::vector<Placement> moved = {placed({-1 + 0.25 * frame, -0.3 * frame, 0})};
            for (Film* one : {&film, &level_0, &level_1}) one->frames().place(moved);
            ImageRgb8 picture = film.frame(camera), a = level_0.frame(camera), b = level_1.frame(camera);
            if (frame > 0) count += made::beyond(picture, a, b, 40);
        }
        return count;
    };
    for (bool splits_things : {false, true}) {
        size_t with = error(true, splits_things), without = error(false, splits_things);
        EXPECT_LT(with, splits_things ? 170u : 150u);
        EXPECT_LT(3 * with, without);
    }
}

// More than 2,048 instances, far away: ids and depths of 16 bits take one thing for another.
TEST(Turns, KnowThousandsOfInstancesApart) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Chain chain = made::simple_chain();
    std::vector<Placement> placements(5000, placed({0, -1000, 0}));  // behind the eye
    placements[4096] = placed({-0.5, 0, 0}), placements[4097] = placed({0.5, 0.6, 0});
    for (uint32_t i = 0; i < 2; ++i) placements.push_back(placed({1.2 * i - 0.6, 30, 0}));
    auto picture_of = [&](bool is_wide) {
        FrameOptions options = by_distance(Variant::fsi);
        options.remedies.has_wide_ids = is_wide;
        Film film(chain, placements, options);
        film.frame(camera_from({0, -12, 0}));
        ImageRgb8 picture;
        for (int frame = 0; frame < 6; ++frame) picture = film.frame(camera_from({0.1 * frame, -9, 0}));
        return picture;
    };
    EXPECT_GT(made::differing(picture_of(true), picture_of(false), 10), 20u);
}

TEST(Turns, RemediesEachChangeThePicture) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Chain chain = made::simple_chain();
    auto picture_of = [&](const FrameOptions& options) {
        Film film(chain, {placed({0, 0, 0}), placed({0.8, 1, 0.1})}, options);
        film.frame(camera_from({0, -12, 0}));
        ImageRgb8 picture;
        for (int frame = 0; frame < 5; ++frame) picture = film.frame(camera_from({0.15 * frame, -8.5, 0}));
        return picture;
    };
    FrameOptions all = by_distance(Variant::fsi);
    ImageRgb8 whole = picture_of(all);
    for (const char* name : {"keep-hidden", "weigh-by-phase", "search", "softness", "ease-ends", "reproject"}) {
        FrameOptions without = all;
        set(without, name, 0);
        EXPECT_GT(made::differing(picture_of(without), whole, 4), 10u) << name;
    }
}

// Two levels that are the same: what is put together of two frames is the thing's own picture, whose outlines an eye that moves
// on sees where they are, and not by up to half a pixel beside it.
TEST(Turns, OutlinesOfTheOlderFrameStandAtTheirOwnPlaceBetweenPixels) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Chain chain = made::simple_chain();
    chain.levels[1] = chain.levels[0];
    chain.levels[1].error_m = 0.1F;
    for (double step_m : {0.02, 0.04, 0.05}) {
        auto picture_of = [&](Variant variant) {
            Film film(chain, {placed({0, 0, 0})}, by_distance(variant), 4);
            film.frame(camera_from({0, -12, 0}));
            ImageRgb8 picture;
            for (int frame = 0; frame < 6; ++frame) picture = film.frame(camera_from({step_m * frame, -9, 0}));
            return picture;
        };
        ImageRgb8 put_together = picture_of(Variant::fsi), own = picture_of(Variant::hard);
        EXPECT_EQ(made::differing(put_together, own, 32), 0u) << step_m;
    }
}

// Divided between even and odd frames or not: the same to the last bit while the eye rests.
TEST(Turns, DivideABigThingUnseen) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    for (const Chain& chain : {made::simple_chain(), made::coplanar_chain(), made::sphere_chain(24, 2)}) {
        for (uint32_t samples : {1u, 4u}) {
            FrameOptions options = by_distance(Variant::fsi), undivided = options;
            options.select.distance_m = undivided.select.distance_m = 15;
            set(undivided, "split-things", 0);
            Film film(chain, {placed({0, 0, 0})}, options, samples), whole(chain, {placed({0, 0, 0})}, undivided, samples);
            for (Film* one : {&film, &whole}) one->frame(camera_from({0, -17, 0}));
            view::Camera still = camera_from({0.3, -4.5, 0.2});
            for (double phase : {0.2, 0.5, 0.8}) {
                while (film.transition().phase < phase) film.frame(still);
                while (whole.transition().phase + 1e-6 < film.transition().phase) whole.frame(still);
                ASSERT_NEAR(film.transition().phase, whole.transition().phase, 1e-6);
                for (Film* one : {&film, &whole}) one->frame(still, 0);
                for (int again = 0; again < 2; ++again)
                    EXPECT_EQ(made::differing(film.frame(still, 0), whole.frame(still, 0)), 0u) << phase << " " << samples;
            }
        }
    }
}

// On the way: every pixel is what an undivided thing shows, its finer level in even frames or in odd ones.
TEST(Turns, DivideABigThingUnseenOnTheWay) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Chain chain = made::simple_chain();
    for (glm::dvec3 way_m : {glm::dvec3(0.08, 0.01, 0), glm::dvec3(0.01, 0.12, 0), glm::dvec3(0.03, 0.02, 0.09)}) {
        FrameOptions options = by_distance(Variant::fsi), undivided = options;
        set(undivided, "split-things", 0);
        Film film(chain, {placed({0, 0, 0})}, options), odd(chain, {placed({0, 0, 0})}, undivided),
            even(chain, {placed({0, 0, 0})}, undivided);
        even.frame(camera_from({0, -12, 0}));
        size_t compared = 0, beyond = 0, apart = 0;
        for (int frame = 0; frame < 16; ++frame) {
            view::Camera camera = camera_from(glm::dvec3(0, frame == 0 ? -12 : -6, 0) + double(frame) * way_m);
            ImageRgb8 a = film.frame(camera), b = odd.frame(camera), c = even.frame(camera);
            if (frame < 2) continue;
            ASSERT_EQ(film.transition(), odd.transition());
            ASSERT_EQ(film.transition(), even.transition());
            EXPECT_NE(film.counts.triangle_count, odd.counts.triangle_count) << "is divided";
            ++compared;
            beyond += made::beyond(a, b, c, 6);
            apart += std::min(made::differing(a, b, 6), made::differing(a, c, 6));
        }
        EXPECT_GT(compared, 10u);
        EXPECT_GT(double(apart) / double(compared), 5) << "each is what is seen somewhere";
        EXPECT_LT(double(beyond) / double(compared), 4) << way_m.x << ": of some 1,000";
    }
}

TEST(Turns, BeginAnewAtAnotherSize) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Chain chain = made::simple_chain();
    for (Variant variant : {Variant::fsi, Variant::fsi_paper}) {
        Film film(chain, {Placement{}}, by_distance(variant));
        film.frame(camera_from({0, -11, 0}));
        film.frame(camera_from({0, -9, 0}));
        view::Camera wide = camera_from({0, -9, 0});
        wide.width_px = 120, wide.height_px = 60;
        gl::Target target = *gl::Target::make(120, 60, 1);
        film.frames().decide(wide, kStep_s, 0);
        ImageRgb8 first = film.again(target);
        EXPECT_EQ(first.width, 120u);
        EXPECT_FALSE(film.transition().is_resting());
        for (int frame = 0; frame < 20; ++frame) {
            film.frames().decide(wide, kStep_s, 0);
            first = film.again(target);
        }
        Film fresh(chain, {Placement{}}, by_distance(variant));
        fresh.frames().decide(wide, kStep_s, 0);
        EXPECT_EQ(made::differing(first, fresh.again(target)), 0u);
    }
}

}  // namespace
}  // namespace overlook::discrete
