// A baked planting of mounds, for tests of what draws them.
#pragma once

#include <gtest/gtest.h>

#include "formats/wang_ground.h"
#include "tests/runtime/wang_ldi/field_images.h"

namespace overlook::wang_ldi {

// Lit from the south; sixteen tiles of 2 m, two levels, four directions, sampled for eyes 1 to 2.5 m high and 1 to 30 m away.
inline ImageSet mound_images() {
    ImageSet set = paper_images(16);
    set.levels = {{48, 1, 0.01f, 1.5f}, {24, 8, 0.02f, 1.5f}};
    set.direction_count = 4, set.cell.farthest_m = 30;
    set.to_sun = {0, -0.6, 0.8};
    return set;
}

// with_images: false = the planting alone. with_plant: besides, one plant in the middle of every tile.
inline void write_mounds(const std::string& path, bool with_images = true, bool with_plant = false) {
    PlantedTiles tiles;
    tiles.set = complete_set();
    ImageSet images = mound_images();
    tiles.planting.tile_size_m = images.tile_m;
    tiles.planting.tiles.resize(tiles.set.tiles.size());
    if (with_plant) {
        tiles.planting.models = {{"plant", 0.3f, 0.4f}};
        for (auto& tile : tiles.planting.tiles) tile = {{0, 1, 1, 0, 0.5f, Owner::interior}};
    }
    auto file = container::Writer::create(path, kKind);
    ASSERT_TRUE(file) << file.error().message;
    auto written = write(*file, tiles);
    ASSERT_TRUE(written) << written.error().message;
    if (with_images) {
        auto writer = ImageWriter::begin(*file, images);
        ASSERT_TRUE(writer) << writer.error().message;
        for (uint64_t i = 0; i < images.ldi_count(); ++i) {
            auto bytes = packed(images, which_of(images, i).level, mounds_image(images, which_of(images, i)));
            ASSERT_TRUE(bytes) << bytes.error().message;
            ASSERT_TRUE(writer->add(*bytes));
        }
        ASSERT_TRUE(writer->end());
    }
    ASSERT_TRUE(file->add_provenance({"test", "0", {}, {}}));
    ASSERT_TRUE(file->commit());
}

}  // namespace overlook::wang_ldi
