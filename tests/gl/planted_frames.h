// Frames of a planting of mounds, on a plain unless a terrain is given.
#pragma once

#include "runtime/wang_ldi/draw_land.h"
#include "tests/formats/scratch_folder.h"
#include "tests/gl/fixture.h"
#include "tests/gl/planting_file.h"

namespace overlook::wang_ldi {

class PlantedFrames : public ::testing::Test {
  protected:
    void SetUp() override {
        std::string reason;
        context_ = test::software_context(reason);
        if (!context_) GTEST_SKIP() << "no software renderer: " << reason;
    }
    // The folder's mounds.ovl, and the chains that are planted if any are named.
    void read_land(const scene::Planting& planting = {}, std::optional<terrain::Terrain> terrain = {}) {
        auto file = container::Reader::open(folder_ / "mounds.ovl");
        ASSERT_TRUE(file);
        auto land = PlantedLand::read(std::move(*file), std::move(terrain), planting, folder_ / "scene.json");
        ASSERT_TRUE(land) << land.error().message;
        land_ = std::move(*land);
        if (!planting.models.empty()) {
            auto models = land_->read_models();
            ASSERT_TRUE(models) << models.error().message;
        }
        ASSERT_TRUE(land_->upload());
    }
    static ImageStreaming waiting() {
        ImageStreaming streaming;
        streaming.settings.latency_frames = 1, streaming.waits = true;
        return streaming;
    }
    std::unique_ptr<FrameDrawer> frames(const FrameOptions& options, const ImageStreaming& streaming = waiting()) {
        auto made = FrameDrawer::make(land_->planted(), land_->land(), options, streaming);
        EXPECT_TRUE(made) << made.error().message;
        return std::move(*made);
    }
    static ImageRgb8 drawn(FrameDrawer& frames, const view::Camera& camera, const terrain::DrawOptions& look = {}) {
        auto decided = frames.decide(camera, 0.1, 0);
        EXPECT_TRUE(decided) << decided.error().message;
        auto target = gl::Target::make(640, 480, 1);
        EXPECT_TRUE(target);
        frames.draw(*target, look);
        return target->read();
    }

    ScratchFolder folder_;
    std::optional<gl::Context> context_;
    std::unique_ptr<PlantedLand> land_;
};

}  // namespace overlook::wang_ldi
