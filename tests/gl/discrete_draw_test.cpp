// Chains of levels drawn: where, which level, and by every variant.
#include <gtest/gtest.h>

#include "tests/gl/discrete_scene.h"

namespace overlook::discrete {
namespace {

using made::by_distance;
using made::camera_from;
using made::Film;
using made::placed;

constexpr Variant kAll[] = {Variant::fsi, Variant::fsi_paper, Variant::hard, Variant::blend, Variant::dither, Variant::late};

TEST(DiscreteDrawing, StandsWhereItsInstancesDo) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    gl::ErrorCounter errors;
    Chain chain = made::simple_chain();
    Film film(chain, {placed({-1.5, 0, 0}, 0.5), placed({1.5, 0, 0}, 0.5)}, by_distance(Variant::hard));
    ImageRgb8 picture = film.frame(camera_from({0, -8, 0}));
    auto is_red = [&](uint32_t x, uint32_t y) {
        overlook::test::Rgb at = overlook::test::pixel(picture, x, y);
        return at.red > 2 * at.blue;
    };
    double focal = view::focal_px(camera_from({}));
    uint32_t aside_px = uint32_t(focal * 1.5 / 8);
    EXPECT_TRUE(is_red(48 - aside_px, 40));
    EXPECT_TRUE(is_red(48 + aside_px, 40));
    EXPECT_FALSE(is_red(48, 40));
    EXPECT_FALSE(is_red(48 + aside_px, 40 - uint32_t(focal * 0.6 / 8)));
    EXPECT_TRUE(is_red(48 + aside_px, 40 - uint32_t(focal * 0.4 / 8)));
    EXPECT_EQ(film.counts.triangle_count, 2 * chain.levels[0].triangle_count());
    EXPECT_EQ(film.counts.draw_call_count, 2u);  // all instances, and the background
    EXPECT_EQ(errors.count(), 0u) << errors.first();
}

// Bunches beside the picture, which are left out, change no pixel of it: it shows what a list of the whole thing does.
TEST(DiscreteDrawing, LeavesOutNothingThatIsSeen) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Chain chain = made::sphere_chain(64);
    Drawing drawing = *Drawing::make(chain);
    gl::Target target = *gl::Target::make(96, 80, 1);
    std::vector<Placement> two = {placed({1, 2.5, 0.4}), placed({-1.2, 3, -0.3}, 0.8)};
    auto frames = *FrameDrawer::make(drawing, two, by_distance(Variant::hard));
    for (double heading_deg : {-20.0, 0.0, 25.0}) {
        view::Camera camera = camera_from({0, 0, 0});
        camera.heading_deg = heading_deg;
        frames->decide(camera, made::kStep_s, 0);
        Result<FrameCounts> drawn = frames->draw(target, {});
        ASSERT_TRUE(drawn);
        ImageRgb8 cut = target.read();
        FrameList whole = finest_frame(facts_of(chain), two, camera);
        ASSERT_LT(drawn->triangle_count, whole.triangle_count) << heading_deg;
        DrawList list = draw_list(drawing.layout(), chain, whole, two, camera, 0);
        ListBuffers buffers;
        buffers.fill(list);
        Drawn part{&drawing, &buffers, &list};
        draw(target, {&part, 1}, {});
        EXPECT_EQ(made::differing(cut, target.read()), 0u) << heading_deg;
    }
}

TEST(DiscreteDrawing, TurnsAndScalesWhatStands) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Chain chain = made::empty_chain(glm::dvec3(-1), 2);
    Level level;
    made::add_quad(chain, level, {glm::dvec3{0.2, 0, -0.2}, {1, 0, -0.2}, {1, 0, 0.2}, {0.2, 0, 0.2}}, {255, 255, 255, 255});
    made::end_level(chain, level, 0);
    scene::Transform turned;
    turned.rotation_z_deg = 180;
    Film film(chain, {placement_of(turned)}, by_distance(Variant::hard));
    ImageRgb8 picture = film.frame(camera_from({0, -4, 0}));
    uint32_t aside_px = uint32_t(view::focal_px(camera_from({})) * 0.6 / 4);
    overlook::test::Rgb left = overlook::test::pixel(picture, 48 - aside_px, 40),
                        right = overlook::test::pixel(picture, 48 + aside_px, 40);
    EXPECT_FALSE(overlook::test::is_near(left, right, 8));
    turned.rotation_z_deg = 0;
    Film other(chain, {placement_of(turned)}, by_distance(Variant::hard));
    picture = other.frame(camera_from({0, -4, 0}));
    EXPECT_TRUE(overlook::test::is_near(overlook::test::pixel(picture, 48 + aside_px, 40), left, 8));
}

TEST(DiscreteDrawing, MovesPartsByTheClip) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Chain chain = made::windmill_chain();
    Drawing drawing = *Drawing::make(chain);
    gl::Target target = *gl::Target::make(96, 80, 1);
    std::vector<Placement> one(1);
    auto frames = *FrameDrawer::make(drawing, one, by_distance(Variant::hard));
    auto at = [&](double clip_s) {
        frames->decide(camera_from({0, -8, 0}), 0, clip_s);
        EXPECT_TRUE(frames->draw(target, {}));
        return target.read();
    };
    ImageRgb8 begin = at(0), later = at(0.25), round = at(4), half_blade = at(0.5);
    EXPECT_GT(made::differing(begin, later, 8), 50u);
    EXPECT_LT(made::differing(begin, round, 8), 5u);
    EXPECT_LT(made::differing(begin, half_blade, 8), 40u);  // eight blades: a turn of an eighth
}

// A card's normals are those of the thing that it shows: from behind what looks up looks up still, and is as light.
TEST(DiscreteDrawing, LightsCardsFromBehindAsTheThingThere) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    auto brightness = [](bool is_card, double from_y) {
        Chain chain = made::empty_chain(glm::dvec3(-1), 2);
        Level level;
        made::add_quad(chain, level, {glm::dvec3{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}}, {255, 255, 255, 255});
        for (Vertex& vertex : level.vertices) vertex.normal = made::octahedral({0, -0.6, 0.8});
        level.rung = Rung::billboards;
        made::end_level(chain, level, 0);
        // A picture that does not decode is left out: the card stays white.
        chain.surfaces[0].is_alpha_masked = true, chain.surfaces[0].texture_bytes = {std::byte(1)};
        chain.picture_count = is_card ? 1 : 0;
        Film film(chain, {Placement{}}, by_distance(Variant::hard));
        view::Camera camera = camera_from({0, from_y, 0});
        camera.heading_deg = from_y < 0 ? 0 : 180;
        return int(overlook::test::pixel(film.frame(camera), 48, 40).green);
    };
    int front = brightness(true, -3), behind = brightness(true, 3);
    EXPECT_EQ(front, brightness(false, -3));
    // Up still, away from the light's side: between the two.
    EXPECT_LT(behind, front);
    EXPECT_GT(behind, brightness(false, 3) + 20);
}

// Where nothing changes its level, all variants draw the same picture.
TEST(DiscreteDrawing, IsTheSameAtRestWhateverTheVariant) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Chain chain = made::simple_chain();
    std::vector<Placement> placements = {placed({-1, 0, 0}), placed({1, 6, 0.5}), placed({0, 12, 0})};
    for (uint32_t samples : {1u, 4u}) {
        Film hard(chain, placements, by_distance(Variant::hard), samples);
        ImageRgb8 wanted;
        for (double x : {0.0, 0.02, 0.04}) wanted = hard.frame(camera_from({x, -6, 0.3}));
        for (Variant variant : kAll) {
            Film film(chain, placements, by_distance(variant), samples);
            ImageRgb8 picture;
            for (double x : {0.0, 0.02, 0.04}) picture = film.frame(camera_from({x, -6, 0.3}));
            EXPECT_EQ(made::differing(picture, wanted), 0u) << int(variant) << " " << samples;
        }
    }
}

// On the way nothing is shown but what lies between the two levels, and the new one in the end.
void expect_only_what_lies_between(const Chain& chain, Variant variant) {
    view::Camera far_off = camera_from({0, -11, 0}), near = camera_from({0, -9, 0});
    Film hard(chain, {Placement{}}, by_distance(Variant::hard));
    FrameOptions always = by_distance(Variant::hard);
    always.select.distance_m = 1;
    Film coarse(chain, {Placement{}}, always);
    ImageRgb8 fine_picture = hard.frame(near), coarse_picture = coarse.frame(near);
    ASSERT_GT(made::differing(fine_picture, coarse_picture, 20), 300u);
    Film film(chain, {Placement{}}, by_distance(variant));
    film.frame(far_off);
    ImageRgb8 last;
    size_t changed = 0, leaking = 0;
    for (int frame = 0; frame < 20; ++frame) {
        double phase_before = film.transition().phase;
        ImageRgb8 picture = film.frame(near);
        if (frame > 1) {  // the first frames' older pictures are from elsewhere
            size_t beyond = made::beyond(picture, fine_picture, coarse_picture, 3);
            // The paper's two buffers are a frame apart: where the new level was not yet whole and the old one is not any more,
            // what is behind both shows through.
            bool may_leak = variant == Variant::fsi_paper && phase_before < 0.5 && film.transition().phase > 0.5;
            leaking += may_leak && beyond > 0;
            if (!may_leak) {
                EXPECT_EQ(beyond, 0u) << frame;
            }
            changed += made::differing(picture, last) > 0;
        }
        last = picture;
    }
    EXPECT_EQ(leaking, variant == Variant::fsi_paper ? 1u : 0u);
    EXPECT_GE(changed, 6u);
    EXPECT_EQ(made::differing(last, fine_picture), 0u);
}

TEST(DiscreteDrawing, GoesFromOneLevelToTheOther) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    gl::ErrorCounter errors;
    for (Variant variant : {Variant::fsi, Variant::fsi_paper, Variant::blend, Variant::dither}) {
        SCOPED_TRACE(int(variant));
        expect_only_what_lies_between(made::flat_chain(), variant);
        // Of closed things the paper's form and blending let see the inside as well, which is the paper's drawback 5.
        if (variant == Variant::fsi || variant == Variant::dither) expect_only_what_lies_between(made::simple_chain(), variant);
    }
    EXPECT_EQ(errors.count(), 0u) << errors.first();
}

// Two chains of one instance each, or one chain of two: every variant draws the same.
TEST(DiscreteDrawing, IsTheSameOfOneChainOrOfSeveral) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    gl::ErrorCounter errors;
    Chain chain = made::simple_chain(), same = chain;
    Drawing drawing = *Drawing::make(chain), other = *Drawing::make(same);
    gl::Target target = *gl::Target::make(96, 80, 1);
    std::vector<Placement> near = {placed({0, 0, 0})}, far = {placed({0.7, 1.5, 0.2})}, both = {near[0], far[0]};
    std::vector<Stand> apart = {{&drawing, near}, {&other, far}};
    for (Variant variant : kAll) {
        SCOPED_TRACE(int(variant));
        FrameOptions options = by_distance(variant);
        options.remedies.splits_parities = false;  // which each chain does by itself
        auto one = *FrameDrawer::make(drawing, both, options), several = *FrameDrawer::make(apart, options);
        for (int frame = 0; frame < 20; ++frame) {
            view::Camera camera = camera_from({0.02 * frame, -11.2 + 0.1 * frame, 0});
            one->decide(camera, made::kStep_s, 0), several->decide(camera, made::kStep_s, 0);
            FrameCounts wanted = *one->draw(target, {});
            ImageRgb8 picture = target.read();
            FrameCounts counts = *several->draw(target, {});
            EXPECT_EQ(made::differing(picture, target.read()), 0u) << frame;
            EXPECT_EQ(counts.triangle_count, wanted.triangle_count);
            EXPECT_EQ(counts.fading_count, wanted.fading_count);
        }
    }
    EXPECT_EQ(errors.count(), 0u) << errors.first();
}

// What is drawn again into another target is the same picture, though that target has no history.
TEST(DiscreteDrawing, IsTheSameInEveryTarget) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Chain chain = made::simple_chain();
    for (Variant variant : {Variant::fsi, Variant::fsi_paper, Variant::blend}) {
        Film film(chain, {Placement{}}, by_distance(variant)), smooth(chain, {Placement{}}, by_distance(variant), 4);
        gl::Target four = *gl::Target::make(96, 80, 4);
        film.frame(camera_from({0, -11, 0})), smooth.frame(camera_from({0, -11, 0}));
        for (int frame = 0; frame < 6; ++frame) film.frame(camera_from({0.01 * frame, -9, 0}));
        for (int frame = 0; frame < 6; ++frame) smooth.frame(camera_from({0.01 * frame, -9, 0}));
        ASSERT_FALSE(film.transition().is_resting());
        EXPECT_EQ(made::differing(film.again(four), smooth.again(smooth.target())), 0u) << int(variant);
        EXPECT_EQ(made::differing(film.again(film.target()), film.again(film.target())), 0u) << int(variant);
    }
}

}  // namespace
}  // namespace overlook::discrete
