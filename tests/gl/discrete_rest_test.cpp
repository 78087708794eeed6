// Frame-sequential interpolation where nothing changes: what is not put together of two frames, to the last bit.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/gl/discrete_scene.h"

namespace overlook::discrete {
namespace {

using made::by_distance;
using made::camera_from;
using made::Film;
using made::placed;

// Where nothing is under way the newer frame is the picture: putting all squares together gives the same, depth and all, to the
// last bit.
TEST(Turns, CopyWhatRestsToTheLastBit) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Chain chain = made::simple_chain();
    std::vector<Placement> placements = {placed({-2.2, 0, 0}), placed({2.2, -3, 0}), placed({2.5, -2.2, 0.4})};
    constexpr uint64_t kAll_px = 96 * 80;
    for (uint32_t samples : {1u, 4u}) {
        FrameOptions options = by_distance(Variant::fsi), everywhere = options;
        set(everywhere, "copy-rest", 0);
        Film film(chain, placements, options, samples), whole(chain, placements, everywhere, samples);
        uint64_t changing = 0, resting = 0;
        for (int frame = 0; frame < 40; ++frame) {
            view::Camera camera = camera_from({0.02 * frame, -12.5 + 0.15 * frame, 0});
            ImageRgb8 a = film.frame(camera), b = whole.frame(camera);
            EXPECT_TRUE(a.pixels == b.pixels) << frame << " " << samples;
            if (samples == 1) {
                EXPECT_TRUE(film.target().read_depth() == whole.target().read_depth()) << frame;
            }
            EXPECT_EQ(whole.counts.combined_px, kAll_px);
            EXPECT_EQ(film.counts.combined_px > 0, film.counts.fading_count > 0) << frame;
            EXPECT_LT(film.counts.combined_px, kAll_px);
            ++(film.counts.fading_count > 0 ? changing : resting);
        }
        EXPECT_GT(changing, 10u);
        EXPECT_GT(resting, 5u);
    }
}

// Blocks that the sieve leaves out would have shown the newer frame anyway: the same picture to the last bit, depth and all, of
// an eye that goes near and far, fast and slowly, past things that move, before others and behind them.
TEST(Turns, SearchOnlyWhereSomethingUnderWayIsSeenToTheLastBit) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Chain chain = made::simple_chain();
    struct Case {
        double step_m, moved_m;
        uint32_t samples;
        uint32_t width_px = 96, height_px = 80;  // or no multiples of a block's
    };
    for (const Case& one :
         {Case{0.02, 0, 1}, Case{0.3, 0, 1}, Case{0.02, 0.2, 1}, Case{0.3, 0.2, 1}, Case{0.3, 0.2, 4}, Case{0, 0, 4},
          Case{0.3, 0.2, 1, 93, 77}, Case{0.02, 0.2, 4, 93, 77}}) {
        FrameOptions options = by_distance(Variant::fsi), everywhere = options;
        set(everywhere, "sieve", 0);
        std::vector<Placement> placements = {placed({-2.2, 0, 0}, 0.5), placed({1.2, -1, 0}), placed({1.9, 0.2, 0.4}),
                                             placed({-1, 0.3, 1.5}, 0.3)};
        auto from = [&](const glm::dvec3& position_m) {
            view::Camera camera = camera_from(position_m);
            camera.width_px = one.width_px, camera.height_px = one.height_px;
            return camera;
        };
        Film film(chain, placements, options, one.samples, from({})), whole(chain, placements, everywhere, one.samples, from({}));
        uint64_t searched_px = 0, combined_px = 0, moving = 0;
        for (int frame = 0; frame < 40; ++frame) {
            view::Camera camera =
                from({one.step_m * (frame - 20), -12.5 + std::max(0.15, one.step_m) * (frame % 20), 0.1});
            placements[1] = placed({1.2 - one.moved_m * frame, -1, 0});
            for (Film* each : {&film, &whole}) each->frames().place(placements);
            ImageRgb8 a = film.frame(camera), b = whole.frame(camera);
            EXPECT_TRUE(a.pixels == b.pixels) << frame << " " << one.step_m << " " << one.moved_m << " " << one.samples;
            if (one.samples == 1) {
                EXPECT_TRUE(film.target().read_depth() == whole.target().read_depth()) << frame;
            }
            EXPECT_EQ(whole.frames().searched_px(one.samples), whole.counts.combined_px);
            searched_px += film.frames().searched_px(one.samples), combined_px += film.counts.combined_px;
            moving += film.counts.fading_count > 0;
        }
        EXPECT_GT(moving, 15u);
        EXPECT_GT(searched_px, 0u);
        EXPECT_LT(4 * searched_px, 3 * combined_px);
    }
}

}  // namespace
}  // namespace overlook::discrete
