// Fields without images or plants, for tests of what is listed of them.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "runtime/wang_ldi/field.h"

namespace overlook::wang_ldi {

// The paper's seven levels for the first seven tiles of 2 m, each image with four samples a pixel, seen from head height.
inline ImageSet paper_images(uint32_t tiles) {
    ImageSet images;
    images.tile_m = 2, images.low_m = -0.1, images.high_m = 1.8, images.tile_count = tiles, images.direction_count = 8;
    images.cell = {1, 2.5, 1, 15, 415, 1};
    float nearest_m = 1;
    for (uint32_t side : {468, 232, 151, 111, 88, 73, 62}) images.levels.push_back({side, nearest_m, 0.01f, 1}), nearest_m += 2;
    return images;
}

// A tile for every four edges of two colours.
inline TileSet complete_set() {
    TileSet set;
    set.horizontal = set.vertical = {{}, {}};
    for (uint8_t t = 0; t < 16; ++t)
        set.tiles.push_back({uint8_t(t & 1), uint8_t(t >> 1 & 1), uint8_t(t >> 2 & 1), uint8_t(t >> 3 & 1)});
    return set;
}

inline view::Camera head_camera(const glm::dvec3& at_m, double heading_deg, double pitch_deg = -5) {
    view::Camera camera;
    camera.position_m = at_m, camera.heading_deg = heading_deg, camera.pitch_deg = pitch_deg;
    camera.width_px = 640, camera.height_px = 480, camera.near_m = 0.1;
    return camera;
}

// Owns what a field refers to.
struct TestField {
    Ground ground;
    ImageSet images;
    TileSet set;
    std::unique_ptr<Placement> placement;
    std::unique_ptr<RandomTiling> tiling;
    std::vector<uint32_t> sample_counts;

    explicit TestField(Ground ground_, const PlacementOptions& planting = {}, uint32_t contexts = 1,
                       TileSet set_ = complete_set())
        : ground(std::move(ground_)), set(std::move(set_)) {
        images = paper_images(uint32_t(set.tiles.size()));
        images.context_count = contexts;
        auto placed = Placement::of(ground, images.tile_m, planting);
        EXPECT_TRUE(placed);
        placement = std::make_unique<Placement>(std::move(*placed));
        auto tiled = RandomTiling::of(set, 3, placement->corners(set, 3));
        EXPECT_TRUE(tiled);
        tiling = std::make_unique<RandomTiling>(std::move(*tiled));
        for (uint64_t i = 0; i < images.ldi_count(); ++i) {
            uint32_t side = images.levels[which_of(images, i).level].side_px;
            sample_counts.push_back(4 * side * side);
        }
    }
    TestField(const TestField&) = delete;
    FieldParts parts() const { return {&images, sample_counts, &set, tiling.get(), placement.get()}; }
    Field field(const FieldOptions& options) const {
        auto made = Field::of(parts(), options);
        EXPECT_TRUE(made) << made.error().message;
        return std::move(*made);
    }
    FieldOptions to_horizon(double geometry_to_m = 0) const { return options_to_horizon(images, 415.7, geometry_to_m); }
};

inline FieldList list_of(const Field& field, const view::Camera& camera) {
    FieldList list;
    field.list(camera, list);
    return list;
}

}  // namespace overlook::wang_ldi
