// Planted ground from frame to frame: what hides what, pictures that are late, images that are not there yet.
#include <gtest/gtest.h>

#include "runtime/wang_ldi/rings.h"
#include "tests/gl/planted_frames.h"

namespace overlook::wang_ldi {
namespace {

constexpr uint32_t kSide = 8;

view::Camera small_camera() {
    view::Camera camera;
    camera.width_px = camera.height_px = kSide, camera.near_m = 0.1;
    return camera;
}

// Everything is grey and 10 m away.
gl::Target grey_target(uint32_t samples = 1) {
    auto target = gl::Target::make(kSide, kSide, samples);
    EXPECT_TRUE(target);
    target->bind();
    const GLfloat grey[] = {0.5f, 0.5f, 0.5f, 1}, depth = 0.1f / 10;
    glClearBufferfv(GL_COLOR, 0, grey);
    glClearBufferfv(GL_DEPTH, 0, &depth);
    return std::move(*target);
}

TEST(Composite, HidesWhatIsFartherAndIsHiddenByWhatIsNearer) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    auto composite = Composite::make();
    ASSERT_TRUE(composite) << composite.error().message;
    gl::Target target = grey_target();
    Warped picture;
    picture.clear(kSide, kSide);
    auto put = [&](uint32_t x, uint32_t y, uint32_t colour, float depth_m) {
        picture.colours[y * kSide + x] = colour, picture.depth_m[y * kSide + x] = depth_m;
    };
    put(1, 0, 0xff0000ff, 5), put(2, 0, 0xff00ff00, 20), put(7, 6, 0xffff0000, 9.99f), put(6, 6, 0xffff0000, 10.01f);
    EXPECT_EQ(composite->take(picture), kSide * kSide * 8u);
    composite->draw(target, small_camera(), 0);
    ImageRgb8 drawn = target.read();
    std::vector<float> depth = target.read_depth();
    const test::Rgb grey = test::pixel(drawn, 0, 0);
    EXPECT_TRUE(test::is_near(grey, {128, 128, 128}, 1));
    EXPECT_EQ(test::pixel(drawn, 1, 0), (test::Rgb{255, 0, 0}));
    EXPECT_EQ(test::pixel(drawn, 2, 0), grey);
    EXPECT_EQ(test::pixel(drawn, 7, 6), (test::Rgb{0, 0, 255}));
    EXPECT_EQ(test::pixel(drawn, 6, 6), grey);
    EXPECT_FLOAT_EQ(depth[1], 0.1f / 5);
    EXPECT_FLOAT_EQ(depth[2], 0.1f / 10);
}

TEST(Composite, PutsTheAirBeforeWhatIsFar) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    auto composite = Composite::make();
    ASSERT_TRUE(composite) << composite.error().message;
    gl::Target target = grey_target();
    Warped picture;
    picture.clear(kSide, kSide);
    picture.colours[0] = picture.colours[1] = 0xff0000ff, picture.depth_m[0] = 0.5f, picture.depth_m[1] = 9.5f;
    composite->take(picture);
    composite->draw(target, small_camera(), 0.05);
    ImageRgb8 drawn = target.read();
    EXPECT_LT(test::pixel(drawn, 0, 0).blue, 40);
    EXPECT_GT(test::pixel(drawn, 1, 0).blue, 100);
    EXPECT_GT(test::pixel(drawn, 0, 0).red, test::pixel(drawn, 1, 0).red);
}

TEST(Composite, OfAFinerPictureEachSampleTakesTheOneWhereItLies) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    auto composite = Composite::make();
    ASSERT_TRUE(composite) << composite.error().message;
    gl::Target target = grey_target(4);
    Warped picture;
    picture.clear(2 * kSide, 2 * kSide);
    auto put = [&](uint32_t x, uint32_t y, float depth_m) {
        picture.colours[y * 2 * kSide + x] = 0xff0000ff, picture.depth_m[y * 2 * kSide + x] = depth_m;
    };
    put(2, 0, 5), put(5, 1, 5), put(4, 0, 5), put(6, 0, 20), put(7, 1, 5);
    for (uint32_t quarter = 0; quarter < 4; ++quarter) put(quarter % 2, 2 + quarter / 2, 5);
    composite->take(picture);
    composite->draw(target, small_camera(), 0);
    ImageRgb8 drawn = target.read();
    auto is_red_share = [&](uint32_t x, uint32_t y, double share) {
        auto of = [&](double red, double grey) { return uint8_t(share * red + (1 - share) * grey); };
        return test::is_near(test::pixel(drawn, x, y), {of(255, 128), of(0, 128), of(0, 128)}, 2);
    };
    EXPECT_TRUE(is_red_share(0, 0, 0));
    EXPECT_TRUE(is_red_share(1, 0, 0.25));
    EXPECT_TRUE(is_red_share(2, 0, 0.5));
    EXPECT_TRUE(is_red_share(3, 0, 0.25));
    EXPECT_TRUE(is_red_share(0, 1, 1));
}

class Frames : public PlantedFrames {
  protected:
    void SetUp() override {
        PlantedFrames::SetUp();
        if (IsSkipped()) return;
        write_mounds(folder_ / "mounds.ovl");
        read_land();
    }
    // A step north each frame.
    static view::Camera camera(int frame) { return head_camera({0.7, 0.9 + 0.8 * frame, 1.7}, 12); }
    static ImageRgb8 picture(FrameDrawer& frames, int frame, double turned_deg = 0) {
        view::Camera turned = camera(frame);
        turned.heading_deg += turned_deg;
        return drawn(frames, turned);
    }
};

TEST_F(Frames, ShowMoundsBelowTheSky) {
    auto drawer = frames({}, waiting());
    ImageRgb8 drawn = picture(*drawer, 0);
    const FrameCounts& counts = drawer->counts();
    EXPECT_GT(counts.warp.samples_drawn, 10'000u);
    EXPECT_GT(counts.field.tiles_listed, 50u);
    EXPECT_EQ(counts.images.stand_ins + counts.images.missing + counts.warp.images_missing, 0u);
    EXPECT_GT(counts.stream.resident_bytes, 0u);
    auto in_rows = [&](uint32_t from, uint32_t to, const auto& is_it) {
        int count = 0;
        for (uint32_t y = from; y < to; ++y)
            for (uint32_t x = 0; x < 640; ++x) count += is_it(test::pixel(drawn, x, y));
        return count;
    };
    EXPECT_EQ(in_rows(0, 40, [](const test::Rgb& c) { return c.blue < c.red; }), 0);  // sky
    // Level 0 has green 60, level 1 120; blue says the direction.
    EXPECT_GT(in_rows(300, 480, [](const test::Rgb& c) { return std::abs(c.green - 60) <= 1; }), 20'000);
    EXPECT_EQ(in_rows(420, 480, [](const test::Rgb& c) { return std::abs(c.green - 120) <= 1; }), 0);
}

TEST_F(Frames, ThatArePipelinedAreThoseOfTheFrameBefore) {
    FrameOptions late;
    late.is_pipelined = true;
    auto now = frames({}, waiting()), before = frames(late, waiting());
    std::vector<ImageRgb8> pictures;
    for (int frame = 0; frame < 4; ++frame) {
        pictures.push_back(picture(*now, frame));
        EXPECT_EQ(now->counts().latency_frames, 0u);
        ImageRgb8 shown = picture(*before, frame);
        EXPECT_EQ(before->counts().latency_frames, frame == 0 ? 0u : 1u);
        EXPECT_TRUE(shown.pixels == pictures[size_t(std::max(0, frame - 1))].pixels) << frame;
    }
    EXPECT_FALSE(pictures[0].pixels == pictures[1].pixels);
    ASSERT_TRUE(before->change({}));  // and at once again
    EXPECT_TRUE(picture(*before, 3).pixels == pictures[3].pixels);
    EXPECT_EQ(before->counts().latency_frames, 0u);
}

// Whoever warps, the picture is the same, but for rounding.
TEST_F(Frames, AreTheSameByTheGraphicsCard) {
    FrameOptions by_card;
    by_card.warper = Warper::card;
    auto by_processor = frames({}, waiting()), carded = frames(by_card, waiting());
    for (int frame : {0, 3}) {
        ImageRgb8 one = picture(*by_processor, frame), other = picture(*carded, frame);
        EXPECT_FALSE(by_processor->counts().is_warped_by_card);  // the renderer is a processor
        EXPECT_TRUE(carded->counts().is_warped_by_card);
        EXPECT_GE(carded->counts().warp.samples, by_processor->counts().warp.samples);
        size_t differing = 0;
        for (size_t p = 0; p < one.pixels.size(); p += 3)
            differing += !std::equal(&one.pixels[p], &one.pixels[p] + 3, &other.pixels[p]);
        EXPECT_LE(differing, one.pixels.size() / 3 / 1000) << frame;
    }
}

// Into a target of one sample a pixel comes what stands in pixels' middles, whatever the frame was warped for.
TEST_F(Frames, DrawnAgainIntoATargetOfOtherSamplesShowTheSameFromTheSameEye) {
    for (Warper warper : {Warper::processor, Warper::card})
        for (bool is_pipelined : {false, true}) {
            if (is_pipelined && warper == Warper::card) continue;  // it never is
            FrameOptions one, four;
            one.warper = four.warper = warper, one.is_pipelined = four.is_pipelined = is_pipelined, four.samples = 4;
            auto single = frames(one, waiting()), multiple = frames(four, waiting());
            auto middle = gl::Target::make(640, 480, 1), target = gl::Target::make(640, 480, 4);
            ASSERT_TRUE(middle && target);
            for (int frame = 0; frame < 3; ++frame) {
                ASSERT_TRUE(single->decide(camera(frame), 0.1, 0) && multiple->decide(camera(frame), 0.1, 0));
                single->draw(*middle, {});
                ImageRgb8 expected = middle->read();
                std::vector<float> depth = middle->read_depth();
                multiple->draw(*target, {});
                ImageRgb8 soft = target->read();
                multiple->draw(*middle, {});
                EXPECT_TRUE(middle->read().pixels == expected.pixels) << frame << is_pipelined;
                EXPECT_TRUE(middle->read_depth() == depth) << frame << is_pipelined;
                multiple->draw(*target, {});
                EXPECT_TRUE(target->read().pixels == soft.pixels) << frame << is_pipelined;
                EXPECT_FALSE(soft.pixels == expected.pixels);
            }
        }
}

TEST_F(Frames, HaveOthersInPlaceOfImagesThatAreOnTheirWay) {
    ImageStreaming late;
    late.settings.latency_frames = 3;
    auto waited = frames({}, waiting()), streamed = frames({}, late);
    ImageRgb8 whole = picture(*waited, 0);
    ImageRgb8 first = picture(*streamed, 0);
    EXPECT_GT(streamed->counts().images.stand_ins, 10u);
    EXPECT_EQ(streamed->counts().images.missing + streamed->counts().warp.images_missing, 0u);
    EXPECT_FALSE(first.pixels == whole.pixels);
    ImageRgb8 last;
    for (int again = 0; again < 4; ++again) last = picture(*streamed, 0);
    EXPECT_EQ(streamed->counts().images.stand_ins, 0u);
    EXPECT_TRUE(last.pixels == whole.pixels);
}

TEST_F(Frames, KeepTheBudgetOfTheirImages) {
    auto roomy = frames({}, waiting());
    picture(*roomy, 0);
    ImageStreaming tight = waiting();
    tight.settings.residency_budget_bytes = tight.settings.upload_budget_bytes = roomy->counts().stream.resident_bytes * 2 / 3;
    auto drawer = frames({}, tight);
    for (int frame = 0; frame < 6; ++frame) {
        picture(*drawer, 3 * frame);
        const FrameCounts& counts = drawer->counts();
        EXPECT_LE(counts.stream.resident_bytes + counts.stream.on_the_way_bytes, tight.settings.residency_budget_bytes);
        EXPECT_GT(counts.images.stand_ins, 0u);
        EXPECT_EQ(counts.warp.images_missing, 0u);
    }
    EXPECT_GT(drawer->counts().stream.dropped_count, 0u);
    tight.settings.residency_budget_bytes = 1000;
    auto refused = FrameDrawer::make(land_->planted(), land_->land(), {}, tight);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().exit, Exit::impossible);
}

TEST_F(Frames, ShowRingsByColours) {
    FrameOptions rings;
    rings.shows_rings = true;
    auto plain = frames({}, waiting()), coloured = frames(rings, waiting());
    ImageRgb8 own = picture(*plain, 0), shown = picture(*coloured, 0);
    EXPECT_FALSE(own.pixels == shown.pixels);
    EXPECT_EQ(plain->counts().warp, coloured->counts().warp);
    // Of a budget that has room for nothing but the images, they keep their own colours.
    ImageStreaming tight = waiting();
    tight.settings.residency_budget_bytes = plain->counts().stream.resident_bytes + 1000;
    auto narrow = frames(rings, tight);
    EXPECT_TRUE(picture(*narrow, 0).pixels == own.pixels);
    int first_ring = 0;
    for (uint32_t x = 0; x < 640; ++x)
        for (uint32_t y = 300; y < 480; ++y) {
            test::Rgb colour = test::pixel(shown, x, y);
            first_ring += colour.red > 2 * colour.green && colour.red > 2 * colour.blue;
        }
    EXPECT_GT(first_ring, 20'000);
}

TEST_F(Frames, RefuseFilesWithoutImages) {
    write_mounds(folder_ / "bare.ovl", false);
    auto file = container::Reader::open(folder_ / "bare.ovl");
    ASSERT_TRUE(file);
    auto land = PlantedLand::read(std::move(*file), {}, {}, "");
    ASSERT_FALSE(land);
    EXPECT_EQ(land.error().exit, Exit::bad_input);
    EXPECT_TRUE(
        land.error().message.ends_with("bare.ovl: holds a planting without images; bake it without --only planting to draw it"))
        << land.error().message;
}

}  // namespace
}  // namespace overlook::wang_ldi
