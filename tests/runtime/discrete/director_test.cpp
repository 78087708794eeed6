#include "runtime/discrete/director.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/runtime/discrete/chains.h"

namespace overlook::discrete {
namespace {

constexpr double kStep_s = 1.0 / 60;

view::Camera camera_at(double distance_m) {
    view::Camera camera;
    camera.position_m = {0, -distance_m, 0};
    camera.width_px = 640, camera.height_px = 480, camera.near_m = 0.01;
    return camera;
}

// side x side spheres, two metres and a half apart, some of them nearer than others.
std::vector<Placement> field(int side) {
    std::vector<Placement> placements;
    for (int i = 0; i < side * side; ++i) {
        Placement placed;
        placed.translation_m = {2.5 * (i % side - side / 2), 0.1 * (i * 7 % 11), 2.5 * (i / side - side / 2)};
        placements.push_back(placed);
    }
    return placements;
}

// Of a camera that is put elsewhere to see what follows: changes take their time all the same.
Director director_of(Variant variant, const std::vector<Placement>& placements) {
    FrameOptions options = defaults_of(variant);
    options.remedies.knows_cuts = false;
    return Director(facts_of(made::sphere_chain()), placements, options);
}

TEST(Director, BeginsWithWhatIsWanted) {
    std::vector<Placement> one(1);
    for (Variant variant : {Variant::fsi, Variant::hard, Variant::late}) {
        Director director = director_of(variant, one);
        director.decide(camera_at(60), kStep_s);
        EXPECT_EQ(director.frame().fading.size(), 0u);
        EXPECT_EQ(director.frame().begun_count, 0u);
        ASSERT_EQ(director.frame().items.size(), 1u);
        EXPECT_GT(director.frame().items[0].level, 0u);
        EXPECT_LE(director.frame().error_px, director.options().select.error_px);
        EXPECT_GT(director.frame().error_px, 0);
    }
}

TEST(Director, LeavesOutWhatIsOutOfViewAndChangesItAtOnce) {
    std::vector<Placement> one(1);
    Director director = director_of(Variant::fsi, one);
    director.decide(camera_at(60), kStep_s);
    uint32_t far_level = director.transition(0).to;
    view::Camera away = camera_at(5);
    away.heading_deg = 180;
    director.decide(away, kStep_s);
    EXPECT_TRUE(director.frame().items.empty());
    EXPECT_TRUE(director.transition(0).is_resting());
    EXPECT_LT(director.transition(0).to, far_level);
}

TEST(Director, TakesLevelsAtOnceAfterACut) {
    std::vector<Placement> one(1);
    for (bool knows_cuts : {true, false}) {
        FrameOptions options = defaults_of(Variant::fsi);
        options.remedies.knows_cuts = knows_cuts;
        Director director(facts_of(made::sphere_chain()), one, options);
        director.decide(camera_at(60), kStep_s);
        EXPECT_LE(director.frame().error_px, 1);
        director.decide(camera_at(5), kStep_s);
        EXPECT_EQ(director.frame().error_px <= 1, knows_cuts);
        EXPECT_EQ(director.frame().fading.empty(), knows_cuts);
    }
}

// What comes into view again has never been seen as it was.
TEST(Director, TakesLevelsAtOnceOfWhatComesIntoView) {
    std::vector<Placement> one(1);
    Director director(facts_of(made::sphere_chain()), one, defaults_of(Variant::fsi));
    view::Camera away = camera_at(20);
    away.heading_deg = 180;
    director.decide(away, kStep_s);
    director.decide(camera_at(16), kStep_s);
    EXPECT_TRUE(director.frame().fading.empty());
    EXPECT_LE(director.frame().error_px, 1);
    EXPECT_EQ(director.frame().items.size(), 1u);
}

// A thing that is put elsewhere is seen as an eye that is.
TEST(Director, TakesTheLevelAtOnceOfWhatIsPutElsewhere) {
    std::vector<Placement> one(1);
    Director director(facts_of(made::sphere_chain()), one, defaults_of(Variant::fsi));
    director.decide(camera_at(60), kStep_s);
    one[0].translation_m.y = -50;
    director.place(one);
    director.decide(camera_at(60), kStep_s);
    EXPECT_TRUE(director.frame().fading.empty());
    EXPECT_LE(director.frame().error_px, 1);
    // And what comes on fast is not.
    Director steady(facts_of(made::sphere_chain()), one, defaults_of(Variant::fsi));
    uint32_t begun = 0;
    for (double distance_m = 120; distance_m > 60; distance_m *= 0.97) {
        steady.decide(camera_at(distance_m), kStep_s);
        begun += uint32_t(!steady.frame().fading.empty());
    }
    EXPECT_GT(begun, 5u);
}

TEST(Director, ChangesHardAtOnceAndCountsIt) {
    std::vector<Placement> one(1);
    Director director = director_of(Variant::hard, one);
    director.decide(camera_at(60), kStep_s);
    uint32_t before = director.frame().items[0].level;
    director.decide(camera_at(10), kStep_s);
    EXPECT_LT(director.frame().items[0].level, before);
    EXPECT_EQ(director.frame().begun_count, 1u);
    EXPECT_EQ(director.frame().items[0].show, Show::whole);
    director.decide(camera_at(10), kStep_s);
    EXPECT_EQ(director.frame().begun_count, 0u);
}

TEST(Director, TakesLateOnlyWhatNobodySees) {
    std::vector<Placement> one(1);
    Director hard = director_of(Variant::hard, one), late = director_of(Variant::late, one);
    for (double distance_m : {10.0, 30.0, 60.0, 200.0}) {
        hard.decide(camera_at(distance_m), kStep_s);
        late.decide(camera_at(distance_m), kStep_s);
        EXPECT_LE(late.frame().error_px, 0.25);
        EXPECT_LE(late.frame().items[0].level, hard.frame().items[0].level);
    }
}

// Both levels, by turns: one a frame.
TEST(Director, DrawsTheTwoLevelsInTurn) {
    std::vector<Placement> one(1);
    for (Variant variant : {Variant::fsi, Variant::fsi_paper}) {
        FrameOptions options = defaults_of(variant);
        options.remedies.splits_things = false, options.remedies.knows_cuts = false;
        Director director(facts_of(made::sphere_chain()), one, options);
        director.decide(camera_at(60), kStep_s);
        director.decide(camera_at(15), kStep_s);
        uint32_t frames = 0, last = ~0u;
        for (; !director.frame().fading.empty(); ++frames) {
            ASSERT_EQ(director.frame().items.size(), 1u);
            const Item& item = director.frame().items[0];
            const Transition& transition = director.frame().fading[0].transition;
            EXPECT_EQ(item.level, director.frame().fading[0].drawn_level);
            EXPECT_NE(item.level, last);
            EXPECT_EQ(item.show, Show::visible);
            EXPECT_EQ(item.share, visible_share(transition, item.level));
            last = item.level;
            director.decide(camera_at(15), kStep_s);
        }
        EXPECT_LE(frames, 15u);
        EXPECT_GE(frames, 13u);
        EXPECT_EQ(director.frame().items[0].show, Show::whole);
    }
}

TEST(Director, BlendsAndDithersBothLevelsInOneFrame) {
    std::vector<Placement> one(1);
    Director blend = director_of(Variant::blend, one), dither = director_of(Variant::dither, one);
    for (Director* director : {&blend, &dither}) {
        director->decide(camera_at(60), kStep_s);
        director->decide(camera_at(15), kStep_s);
    }
    ASSERT_EQ(blend.frame().items.size(), 1u);
    ASSERT_EQ(blend.frame().translucent.size(), 1u);
    const Transition& transition = blend.transition(0);
    EXPECT_EQ(blend.frame().items[0].level, transition.from);  // whole, until the new one is
    EXPECT_EQ(blend.frame().translucent[0].level, transition.to);
    EXPECT_EQ(blend.frame().translucent[0].share, visible_share_of_new(transition.phase));
    while (blend.transition(0).phase <= 0.5) blend.decide(camera_at(15), kStep_s);
    EXPECT_EQ(blend.frame().items[0].level, transition.to);
    EXPECT_EQ(blend.frame().translucent[0].level, transition.from);

    ASSERT_EQ(dither.frame().items.size(), 2u);
    EXPECT_NE(dither.frame().items[0].show, dither.frame().items[1].show);
    EXPECT_EQ(dither.frame().items[0].share, dither.frame().items[1].share);
}

TEST(Director, SortsWhatIsTranslucentBackToFront) {
    std::vector<Placement> placements = field(8);
    Director director = director_of(Variant::blend, placements);
    director.decide(camera_at(130), kStep_s);
    view::Camera near = camera_at(40);
    director.decide(near, kStep_s);
    ASSERT_GT(director.frame().translucent.size(), 10u);
    double last_m = 1e9;
    for (const Item& item : director.frame().translucent) {
        double distance_m = glm::distance(placements[item.instance].translation_m, near.position_m);
        EXPECT_LE(distance_m, last_m + 1e-9);
        last_m = distance_m;
    }
}

TEST(Director, KeepsThoseOfALevelTogether) {
    std::vector<Placement> placements = field(12);
    Director director = director_of(Variant::fsi, placements);
    director.decide(camera_at(40), kStep_s);
    std::set<uint32_t> levels;
    uint64_t triangles = 0;
    for (size_t i = 0; i < director.frame().items.size(); ++i) {
        const Item& item = director.frame().items[i];
        if (i > 0) {
            EXPECT_LE(director.frame().items[i - 1].level, item.level);
        }
        levels.insert(item.level);
        triangles += director.facts().levels[item.level].triangle_count;
    }
    EXPECT_EQ(director.frame().triangle_count, triangles);
}

// Even and odd frames take the same work, though one level costs four times the other.
TEST(Director, SharesTheWorkEvenlyBetweenFrames) {
    std::vector<Placement> placements = field(12);
    for (bool splits : {true, false}) {
        FrameOptions options = defaults_of(Variant::fsi);
        options.remedies.splits_parities = splits, options.remedies.knows_cuts = false;
        Director director(facts_of(made::sphere_chain()), placements, options);
        director.decide(camera_at(75), kStep_s);
        view::Camera camera = camera_at(25);
        director.decide(camera, kStep_s);
        ASSERT_GT(director.frame().fading.size(), 20u);
        uint64_t before = director.frame().triangle_count;
        director.decide(camera, kStep_s);
        double ratio =
            double(std::max(before, director.frame().triangle_count)) / double(std::min(before, director.frame().triangle_count));
        if (splits)
            EXPECT_LE(ratio, 1.02);
        else
            EXPECT_GT(ratio, 1.2);
    }
}

// One level a frame: at 5 m/s towards the field and back, hardly more triangles than levels that give way at once.
TEST(Director, DrawsNoMoreTrianglesThanHardSwitching) {
    std::vector<Placement> placements = field(12);
    Director fsi = director_of(Variant::fsi, placements), hard = director_of(Variant::hard, placements);
    uint64_t fsi_count = 0, hard_count = 0, fading_count = 0;
    for (int frame = 0; frame < 1080; ++frame) {
        double distance_m = 20 + 5 * kStep_s * std::abs(540 - frame);
        for (Director* director : {&fsi, &hard}) director->decide(camera_at(distance_m), kStep_s);
        fsi_count += fsi.frame().triangle_count, hard_count += hard.frame().triangle_count;
        fading_count += fsi.frame().fading.size();
    }
    EXPECT_GT(fading_count, 2 * 144u);
    EXPECT_LE(double(fsi_count), 1.02 * double(hard_count));
}

// What fades is over before the level that goes would be too coarse, however fast and whichever way one flies evenly.
TEST(Director, KeepsItsPromiseWhileLevelsChange) {
    std::vector<Placement> placements = field(12);
    for (bool foresees : {true, false}) {
        double worst_px = 0;
        for (double speed_m_s : {3.0, 12.0, 40.0}) {
            for (Variant variant : {Variant::fsi, Variant::blend, Variant::dither}) {
                FrameOptions options = defaults_of(variant);
                options.foresees = foresees;
                Director director(facts_of(made::sphere_chain()), placements, options);
                uint64_t changes = 0;
                for (int frame = 0; 130 - speed_m_s * frame * kStep_s > 8; ++frame) {
                    view::Camera camera = camera_at(130 - speed_m_s * frame * kStep_s);
                    camera.position_m.x = 3 - 0.004 * frame, camera.heading_deg = 0.005 * frame;
                    director.decide(camera, kStep_s);
                    worst_px = std::max(worst_px, director.frame().error_px);
                    changes += director.frame().begun_count;
                }
                EXPECT_GT(changes, 144u);
            }
        }
        if (foresees)
            EXPECT_LE(worst_px, 1);
        else
            EXPECT_GT(worst_px, 1.1);
    }
}

TEST(Director, SuitsTheGrainToThePixel) {
    std::vector<Placement> one(1);
    FrameOptions options = defaults_of(Variant::fsi);
    options.remedies.splits_things = false, options.remedies.knows_cuts = false;
    Director director(facts_of(made::sphere_chain()), one, options);
    director.set_grain_m({1e-4, 1e-4, 1e-4});
    director.decide(camera_at(60), kStep_s);
    director.decide(camera_at(15), kStep_s);
    ASSERT_EQ(director.frame().items.size(), 1u);
    double grain_m = 1e-4 * director.frame().items[0].grain, pixel_m = 15 / view::focal_px(camera_at(15));
    EXPECT_GE(grain_m, pixel_m);
    EXPECT_LT(grain_m, 2 * pixel_m);
    double kept = director.frame().items[0].grain;
    director.decide(camera_at(10), kStep_s);  // and stays while the change is under way
    EXPECT_EQ(director.frame().items[0].grain, kept);
}

TEST(Director, IsTheSameEveryTime) {
    std::vector<Placement> placements = field(9);
    Director a = director_of(Variant::fsi, placements), b = director_of(Variant::fsi, placements);
    for (int frame = 0; frame < 60; ++frame) {
        for (Director* director : {&a, &b}) director->decide(camera_at(70 - frame), kStep_s);
        ASSERT_EQ(a.frame().items, b.frame().items);
    }
}

TEST(Settings, AreThoseOfTheVariant) {
    auto has = [](Variant variant, std::string_view name) {
        std::span<const SettingKind> kinds = setting_kinds(variant);
        return std::any_of(kinds.begin(), kinds.end(), [&](const SettingKind& kind) { return kind.name == name; });
    };
    for (const char* remedy : {"keep-hidden", "wide-ids", "wide-depth", "weigh-by-phase", "split-parities", "move-instances",
                               "search", "suit-grain", "ease-ends", "softness"}) {
        EXPECT_TRUE(has(Variant::fsi, remedy)) << remedy;
        EXPECT_FALSE(has(Variant::fsi_paper, remedy)) << remedy;
        EXPECT_FALSE(has(Variant::blend, remedy)) << remedy;
    }
    EXPECT_TRUE(has(Variant::fsi_paper, "half-precision"));
    EXPECT_TRUE(has(Variant::blend, "fade-s"));
    EXPECT_FALSE(has(Variant::hard, "fade-s"));
    for (Variant variant : {Variant::fsi, Variant::fsi_paper, Variant::hard, Variant::blend, Variant::dither, Variant::late}) {
        for (const SettingKind& kind : setting_kinds(variant)) {
            EXPECT_GE(kind.otherwise, kind.least) << kind.name;
            EXPECT_LE(kind.otherwise, kind.most) << kind.name;
            FrameOptions options = defaults_of(variant);
            set(options, kind.name, kind.otherwise);
        }
    }
    FrameOptions options = defaults_of(Variant::fsi);
    set(options, "search", 0);
    set(options, "by", 2);
    EXPECT_FALSE(options.remedies.searches);
    EXPECT_EQ(options.select.criterion, Criterion::distance);
}

}  // namespace
}  // namespace overlook::discrete
