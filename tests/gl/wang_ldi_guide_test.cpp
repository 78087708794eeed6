// Where pictures of planted ground are taken from: nobody steps off what is planted.
#include <gtest/gtest.h>

#include "formats/discrete.h"
#include "tests/formats/scratch_folder.h"
#include "tests/gl/planting_file.h"
#include "tests/runtime/discrete/chains.h"
#include "tests/runtime/hills.h"
#include "tools/measure/paper/wang_ldi/fields.h"

namespace overlook::measure::paper::wang {
namespace {

// Hills, planted below the middle of their heights.
TEST(Guide, StepsAsideOntoPlantedGroundAlone) {
    ScratchFolder folder;
    wang_ldi::write_mounds(folder / "mounds.ovl", true, true);
    auto plant = container::Writer::create(folder / "plant.ovl", discrete::kKind);
    ASSERT_TRUE(plant && discrete::write(*plant, discrete::made::simple_chain()));
    ASSERT_TRUE(plant->add_provenance({"test", "0", {}, {}}) && plant->commit());
    terrain::Terrain hills = terrain::baked(test::make_hills(65, 65, 4));
    auto writer = container::Writer::create(folder / "hills.ovl", terrain::kKind);
    ASSERT_TRUE(writer && terrain::write(*writer, hills) && writer->commit());
    wang_ldi::Ground ground(hills);
    wang_ldi::Rect extent = ground.extent();
    double middle_m = ground.height_m((extent.low_m + extent.high_m) / 2.0);
    std::string text = R"({"version": 1, "layers": [{"asset": "hills.ovl", "method": "terrain"}, {"asset": "mounds.ovl",
        "method": "wang-ldi", "planting": {"models": ["plant.ovl"], "steepest": 10, "highest_m": )" +
                       std::to_string(middle_m) + "}}]}";
    ASSERT_TRUE(write_file(folder / "planting.json", std::string_view(text)));
    auto lands = read_lands(folder.path());
    ASSERT_TRUE(lands) << lands.error().message;
    ASSERT_EQ(lands->size(), 1u);
    const Land& land = lands->front();
    Guide guide(land);
    const wang_ldi::Placement& placement = land.planted().placement();
    auto is_planted = [&](const glm::dvec2& at_m) {
        glm::dvec2 tile = glm::floor(at_m / placement.tile_m());
        return placement.is_planted(int64_t(tile.x), int64_t(tile.y));
    };
    // In the middles of planted tiles whose neighbours are not.
    int stood = 0;
    auto first = glm::ivec2(extent.low_m / placement.tile_m()), last = glm::ivec2(extent.high_m / placement.tile_m());
    for (int j = first.y; j < last.y; j += std::max(1, (last.y - first.y) / 40))
        for (int i = first.x; i < last.x; ++i) {
            if (!placement.is_planted(i, j) || placement.is_planted(i + 1, j)) continue;
            glm::dvec2 at_m = placement.tile_m() * (glm::dvec2(i, j) + 0.5);
            view::Camera camera = guide.camera(0, 0, 0, -4, 64, 48);
            camera.position_m = {at_m, ground.height_m(at_m) + 1.7};
            view::Camera aside = guide.cleared(camera);
            EXPECT_TRUE(is_planted(glm::dvec2(aside.position_m))) << at_m.x << " " << at_m.y;
            EXPECT_TRUE(std::isfinite(aside.position_m.z));
            ++stood;
        }
    EXPECT_GT(stood, 10);
}

}  // namespace
}  // namespace overlook::measure::paper::wang
