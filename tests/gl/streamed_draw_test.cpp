// A terrain in parts gives the picture of the whole.
#include <gtest/gtest.h>

#include "formats/terrain_tiles.h"
#include "runtime/terrain/draw.h"
#include "runtime/terrain/refine_tiles.h"
#include "tests/formats/scratch_folder.h"
#include "tests/gl/fixture.h"
#include "tests/tools/synthetic_dem.h"
#include "tools/bake/terrain.h"

namespace overlook::terrain {
namespace {

TEST(StreamedDrawing, GivesTheSameBytesAsTheWholeOnceItsTilesAreThere) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    ScratchFolder folder;
    auto terrain = bake(test::make_hills(390, 300, 3, 0.01), {}, [](double) {});
    ASSERT_TRUE(terrain);
    Result<container::Writer> writer = container::Writer::create(folder / "a.ovl", kKind);
    ASSERT_TRUE(writer && write(*writer, *terrain) && write_tiles(*writer, *terrain) && writer->commit());
    Result<container::Reader> reader = container::Reader::open(folder / "a.ovl");
    ASSERT_TRUE(reader);
    Result<std::unique_ptr<Tiles>> tiles = Tiles::open(std::move(*reader), {1 << 28, 1 << 20, 1, 1});
    ASSERT_TRUE(tiles) << tiles.error().message;

    Refiner refiner(*terrain);
    TileRefiner parts(**tiles);
    auto target = gl::Target::make(320, 200, 4);
    auto whole_drawing = Drawing::make(*terrain), parts_drawing = Drawing::make(**tiles);
    ASSERT_TRUE(target && whole_drawing && parts_drawing);
    for (double morph : {0.0, 0.5}) {
        for (Look look : {Look::shaded, Look::wireframe}) {
            view::Camera camera = test::from_south(*terrain, 320, 200);
            camera.position_m.z = refiner.highest_m() + 100;
            DrawOptions options;
            options.look = look;
            Cut cut;
            refiner.cut_by_pixels(camera, 1, cut, morph);
            whole_drawing->draw(*target, cut, camera, options);
            ImageRgb8 expected = target->read();
            do {
                for (uint32_t tile : (*tiles)->begin_frame().arrived) parts_drawing->take_tile(**tiles, tile);
                parts.cut_by_pixels(camera, 1, cut, morph);
                (*tiles)->end_frame();
            } while (!(*tiles)->is_settled());
            EXPECT_GT(cut.triangle_count(), 1000u);
            parts_drawing->draw(*target, cut, camera, options);
            EXPECT_TRUE(target->read().pixels == expected.pixels);
        }
    }
}

}  // namespace
}  // namespace overlook::terrain
