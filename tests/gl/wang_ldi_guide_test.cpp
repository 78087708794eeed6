// Where pictures of planted ground are taken from: nobody steps off what is planted.
#include <gtest/gtest.h>

#include "formats/discrete.h"
#include "tests/formats/scratch_folder.h"
#include "tests/gl/fixture.h"
#include "tests/gl/planting_file.h"
#include "tests/runtime/discrete/chains.h"
#include "tests/runtime/hills.h"
#include "tools/measure/methods.h"
#include "tools/measure/paper/wang_ldi/flown_fields.h"
#include "tools/measure/planting_method.h"

namespace overlook::measure::paper::wang {
namespace {

// Hills of 256 m, planted below the middle of their heights.
Result<std::vector<Land>> planted_hills(const ScratchFolder& folder, const terrain::Terrain& hills) {
    wang_ldi::write_mounds(folder / "mounds.ovl", true, true);
    auto plant = container::Writer::create(folder / "plant.ovl", discrete::kKind);
    EXPECT_TRUE(plant && discrete::write(*plant, discrete::made::simple_chain()));
    EXPECT_TRUE(plant->add_provenance({"test", "0", {}, {}}) && plant->commit());
    auto writer = container::Writer::create(folder / "hills.ovl", terrain::kKind);
    EXPECT_TRUE(writer && terrain::write(*writer, hills) && writer->commit());
    wang_ldi::Ground ground(hills);
    double middle_m = ground.height_m((ground.extent().low_m + ground.extent().high_m) / 2.0);
    std::string text = R"({"version": 1, "layers": [{"asset": "hills.ovl", "method": "terrain"}, {"asset": "mounds.ovl",
        "method": "wang-ldi", "planting": {"models": ["plant.ovl"], "steepest": 10, "highest_m": )" +
                       std::to_string(middle_m) + "}}]}";
    EXPECT_TRUE(write_file(folder / "planting.json", std::string_view(text)));
    return read_lands(folder.path());
}

TEST(Guide, StepsAsideOntoPlantedGroundAlone) {
    ScratchFolder folder;
    terrain::Terrain hills = terrain::baked(test::make_hills(65, 65, 4));
    auto lands = planted_hills(folder, hills);
    ASSERT_TRUE(lands) << lands.error().message;
    ASSERT_EQ(lands->size(), 1u);
    const Land& land = lands->front();
    wang_ldi::Ground ground(hills);
    wang_ldi::Rect extent = ground.extent();
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

// What images show is drawn as geometry in their place, the same by whoever draws it; far points stay.
// Of the images that a method lists, not of what is drawn beyond them.
uint64_t image_samples(const Land& land, const view::Camera& camera, const std::string& method) {
    Result<MethodSpec> spec = parse_method(method);
    EXPECT_TRUE(spec) << method;
    auto frames =
        wang_ldi::FrameDrawer::make(land.planted(), land.world.planted->land(), planting_options(*spec), streaming_of(*spec));
    EXPECT_TRUE(frames && (*frames)->decide(camera, 0, 0)) << method;
    return (*frames)->list().counts.samples;
}

TEST(Race, HasTheSameGeometryInPlaceOfAllImages) {
    std::string reason;
    auto context = test::software_context(reason);
    if (!context) GTEST_SKIP() << "no software renderer: " << reason;
    ScratchFolder folder;
    auto lands = planted_hills(folder, terrain::baked(test::make_hills(65, 65, 4)));
    ASSERT_TRUE(lands) << lands.error().message;
    Land& land = lands->front();
    ASSERT_TRUE(upload(land.world));
    std::vector<FieldRow> rows;
    std::vector<view::Camera> cameras = Guide(land).steps(2, 96, 64);
    auto raced = race_geometry(land, cameras, context->renderer(), rows);
    ASSERT_TRUE(raced) << raced.error().message;
    ASSERT_EQ(rows.size(), 12u);
    for (size_t first = 0; first < rows.size(); first += 3) {
        const FieldRow &own = rows[first], &by_processor = rows[first + 1], &by_opengl = rows[first + 2];
        EXPECT_EQ(own.family, "Overlook");
        EXPECT_EQ(by_processor.family, kByProcessor);
        EXPECT_EQ(by_opengl.family, kByOpenGl);
        EXPECT_GT(own.samples, 0);
        EXPECT_GT(by_processor.triangles, own.triangles) << own.x;
        EXPECT_EQ(by_processor.triangles, by_opengl.triangles) << own.x;
        EXPECT_LT(by_processor.samples, own.samples) << own.x;
        EXPECT_EQ(by_processor.samples, by_opengl.samples) << own.x;
        Raced raced_here = raced_at(land, cameras.front(), own.x);
        EXPECT_GT(image_samples(land, cameras.front(), raced_here.own), 0u) << own.x;
        EXPECT_EQ(image_samples(land, cameras.front(), raced_here.by_processor), 0u) << own.x;
        EXPECT_EQ(image_samples(land, cameras.front(), raced_here.by_opengl), 0u) << own.x;
        EXPECT_FALSE(own.own_times_as_fast);
        for (const FieldRow* row : {&by_processor, &by_opengl}) {
            ASSERT_TRUE(row->own_times_as_fast);
            EXPECT_DOUBLE_EQ(*row->own_times_as_fast, row->ms_p50 / own.ms_p50);
            EXPECT_TRUE(row->what.starts_with("up to ")) << row->what;
        }
    }
    EXPECT_GT(rows[1].triangles, rows[10].triangles) << "at 1 px more than at 8";
}

}  // namespace
}  // namespace overlook::measure::paper::wang
