// Frames of planted ground look alike whoever draws the plants that are geometry.
#include <gtest/gtest.h>

#include "formats/wang_ldi_layout.h"
#include "tests/gl/planted_frames.h"
#include "tests/runtime/discrete/chains.h"

namespace overlook::wang_ldi {
namespace {

// A globe in the middle of every tile, which near ones are drawn with.
class FramesWithGeometry : public PlantedFrames {
  protected:
    void SetUp() override {
        PlantedFrames::SetUp();
        if (IsSkipped()) return;
        write_mounds(folder_ / "mounds.ovl", true, true);
        auto writer = container::Writer::create(folder_ / "plant.ovl", discrete::kKind);
        ASSERT_TRUE(writer);
        discrete::Chain globe = discrete::made::sphere_chain(64, 1);
        globe.radius_m += globe.position_step_m;
        auto written = discrete::write(*writer, globe);
        ASSERT_TRUE(written) << written.error().message;
        ASSERT_TRUE(writer->add_provenance({"test", "0", {}, {}}));
        ASSERT_TRUE(writer->commit());
        scene::Planting planting;
        planting.models = {"plant.ovl"};
        read_land(planting);
    }
    static FrameOptions drawn_by(Warper geometry_by) {
        FrameOptions options;
        options.geometry_by = geometry_by, options.geometry_m = 8;
        return options;
    }
    // A step north each frame. haze_per_m: of the air.
    ImageRgb8 picture(FrameDrawer& frames, int frame, double haze_per_m = 0) {
        terrain::DrawOptions look;
        look.haze = haze_per_m / land_->land().drawing->haze_per_m({});
        return drawn(frames, head_camera({0.7, 0.9 + 0.8 * frame, 1.7}, 12, -10), look);
    }
};

// But for rounding: outlines to another pixel, light between corners to another tone.
void expect_alike(const ImageRgb8& one, const ImageRgb8& other) {
    size_t differing = 0;
    double sum = 0;
    for (size_t p = 0; p < one.pixels.size(); p += 3) {
        int most = 0;
        for (size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(int(one.pixels[p + c]) - int(other.pixels[p + c])));
        differing += most > 8, sum += most;
    }
    EXPECT_LE(differing, one.pixels.size() / 3 / 200);
    EXPECT_LE(sum / double(one.pixels.size() / 3), 0.5);
}

TEST_F(FramesWithGeometry, AreAlikeWhoeverDrawsIt) {
    auto by_processor = frames(drawn_by(Warper::processor)), by_opengl = frames(drawn_by(Warper::card));
    FrameOptions bare = drawn_by(Warper::processor);
    bare.has_geometry = false;
    ImageRgb8 without = picture(*frames(bare), 0);
    for (double haze_per_m : {0.0, 0.1}) {
        ImageRgb8 one = picture(*by_processor, 0, haze_per_m), other = picture(*by_opengl, 0, haze_per_m);
        EXPECT_TRUE(by_processor->counts().are_plants_by_processor);
        EXPECT_FALSE(by_opengl->counts().are_plants_by_processor);
        EXPECT_GT(by_opengl->counts().plants.plant_count, 4u);
        EXPECT_EQ(by_opengl->counts().plants.triangle_count, by_processor->counts().plants.triangle_count);
        EXPECT_EQ(by_processor->counts().plants.draw_call_count, 0u);
        expect_alike(one, other);
        size_t of_plants = 0;
        for (size_t p = 0; p < one.pixels.size(); p += 3) of_plants += one.pixels[p] != without.pixels[p];
        EXPECT_GT(of_plants, 10'000u);
    }
}

TEST_F(FramesWithGeometry, AreAlikeAFrameLate) {
    FrameOptions options[] = {drawn_by(Warper::processor), drawn_by(Warper::card)};
    for (FrameOptions& one : options) one.is_pipelined = true;
    auto by_processor = frames(options[0]), by_opengl = frames(options[1]), at_once = frames(drawn_by(Warper::processor));
    ImageRgb8 before;
    for (int frame = 0; frame < 3; ++frame) {
        ImageRgb8 late = picture(*by_processor, frame, 0.1);
        expect_alike(late, picture(*by_opengl, frame, 0.1));
        ImageRgb8 now = picture(*at_once, frame, 0.1);
        EXPECT_TRUE(late.pixels == (frame == 0 ? now : before).pixels) << frame;
        before = std::move(now);
    }
}

TEST_F(FramesWithGeometry, AreTheProcessorsWhereItWarpsByDepthWhatHasGeometry) {
    auto is_by_processor = [&](FrameOptions options) {
        auto drawer = frames(options);
        picture(*drawer, 0);
        return drawer->counts().are_plants_by_processor;
    };
    FrameOptions own = drawn_by(Warper::by_renderer);
    EXPECT_TRUE(is_by_processor(own));  // the renderer is a processor
    FrameOptions exact = own, fine = own, bare = own, carded = own, by_order = own, paper = defaults_of(Variant::paper);
    exact.is_exact = true, fine.samples = 4, bare.has_geometry = false, carded.warper = Warper::card;
    by_order.is_by_depth = false, paper.geometry_by = Warper::processor;
    EXPECT_TRUE(is_by_processor(exact));
    for (const FrameOptions& other : {fine, bare, carded, by_order, paper}) EXPECT_FALSE(is_by_processor(other));
    bare.geometry_by = Warper::processor;
    EXPECT_FALSE(is_by_processor(bare));
}

TEST_F(FramesWithGeometry, ThatAreWarpedExactlyAreAlikeToo) {
    FrameOptions one = drawn_by(Warper::processor), other = drawn_by(Warper::card);
    one.is_exact = other.is_exact = true;
    auto by_processor = frames(one), by_opengl = frames(other);
    expect_alike(picture(*by_processor, 1), picture(*by_opengl, 1));
    EXPECT_TRUE(by_processor->counts().are_plants_by_processor);
}

}  // namespace
}  // namespace overlook::wang_ldi
