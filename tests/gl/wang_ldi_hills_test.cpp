// Planted hills as they are drawn: what they hide, and what they take up of a budget.
#include <gtest/gtest.h>

#include "formats/discrete.h"
#include "runtime/wang_ldi/land_list.h"
#include "tests/gl/planted_frames.h"
#include "tests/runtime/discrete/chains.h"
#include "tests/runtime/hills.h"

namespace overlook::wang_ldi {
namespace {

class HillyFrames : public PlantedFrames {
  protected:
    void SetUp() override {
        PlantedFrames::SetUp();
        if (IsSkipped()) return;
        write_mounds(folder_ / "mounds.ovl", true, true);
        auto plant = container::Writer::create(folder_ / "plant.ovl", discrete::kKind);
        ASSERT_TRUE(plant && discrete::write(*plant, discrete::made::simple_chain()));
        ASSERT_TRUE(plant->add_provenance({"test", "0", {}, {}}) && plant->commit());
        scene::Planting planting;
        planting.models = {"plant.ovl"}, planting.steepest = 10;
        read_land(planting, terrain::baked(test::make_hills(129, 129, 4)));
    }
    view::Camera camera(double share, double heading_deg) const {
        const Rect& extent = land_->planted().ground().extent();
        glm::dvec2 at_m = extent.low_m + (extent.high_m - extent.low_m) * glm::dvec2(share, 0.45);
        return head_camera({at_m, land_->planted().ground().height_m(at_m) + 1.7}, heading_deg, -4);
    }
};

// Over the terrain as it is drawn, coarser than it is, what the ground hides shows nowhere, listed or not.
TEST_F(HillyFrames, ShowTheSameWithoutWhatTheGroundHides) {
    uint64_t hidden = 0, fewer = 0;
    for (double error_px : {1.0, 6.0}) {
        FrameOptions own, through;
        own.error_px = through.error_px = error_px, own.fills_holes = through.fills_holes = false, through.ground_hides = false;
        auto without = frames(own), with = frames(through);
        for (int n = 0; n < 4; ++n) {
            view::Camera here = camera(0.2 + 0.15 * n, 90 * n + 20);
            ImageRgb8 one = drawn(*without, here), other = drawn(*with, here);
            EXPECT_TRUE(one.pixels == other.pixels) << error_px << " px, " << n;
            hidden += without->counts().field.hidden;
            fewer += with->counts().warp.samples - without->counts().warp.samples;
            EXPECT_EQ(with->counts().field.hidden, 0u);
        }
    }
    EXPECT_GT(hidden, 100u);
    EXPECT_GT(fewer, 1000u);
}

// What plants leave over, the terrain takes up.
TEST_F(HillyFrames, TakeUpABudgetWithTheGround) {
    const PlantedField& planted = land_->planted();
    Land land = land_->land();
    LandLister lister(planted, *land.refiner, nullptr);
    view::Camera here = camera(0.3, 20);
    LandList list;
    auto count_at = [&](double error_px) {
        FrameOptions options;
        options.error_px = error_px;
        EXPECT_TRUE(lister.list(here, glm::dvec3(0), options, 32, 0, list));
        return double(list.triangle_count());
    };
    double finest = count_at(1), coarse = count_at(12);
    ASSERT_LT(coarse, 0.5 * finest);
    view::CountedError budget;
    auto filled = [&](double most) {
        count_at(12);
        budget.set_most(most);
        lister.fill_with_ground(here, glm::dvec3(0), 1, 12, budget, 0, list);
        return double(list.triangle_count());
    };
    double some = std::sqrt(finest * coarse);
    EXPECT_GE(filled(some), 0.95 * some);
    EXPECT_LE(filled(some), some);
    EXPECT_LT(list.cut.predicted_error_px, 12);
    EXPECT_GT(list.cut.predicted_error_px, 1);
    EXPECT_EQ(filled(0), coarse);
    EXPECT_EQ(filled(2 * finest), coarse);
    EXPECT_EQ(filled(coarse), coarse);
}

}  // namespace
}  // namespace overlook::wang_ldi
