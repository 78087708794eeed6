// Planted ground warped by the processor: exactly, and fast, of one picture at head height amid 7,000 plants.

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "runtime/wang_ldi/fast_warp.h"
#include "runtime/wang_ldi/warp_field.h"
#include "tests/bench/benchmarks.h"
#include "tests/bench/work.h"

namespace overlook::bench {
namespace {

using namespace wang_ldi;

constexpr double kTile_m = 4.35;
constexpr uint32_t kPlants = 20;  // on a tile

// Stems with round heads, four samples a pixel at most: as many and as scattered as those of sunflowers.
Ldi plants_image(const ImageSet& set, uint32_t tile, uint32_t level_index) {
    const Level& level = set.levels[level_index];
    uint32_t side = level.side_px;
    double pixel_m = set.tile_m / side;
    std::mt19937 random(tile + 1);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<std::vector<uint16_t>> columns(size_t(side) * side);
    for (uint32_t plant = 0; plant < kPlants; ++plant) {
        glm::dvec2 middle(set.tile_m * unit(random), set.tile_m * unit(random));
        double top_m = 1.2 + 0.6 * unit(random), radius_m = 0.25 + 0.15 * unit(random);
        for (double y = middle.y - radius_m; y < middle.y + radius_m; y += pixel_m)
            for (double x = middle.x - radius_m; x < middle.x + radius_m; x += pixel_m) {
                auto column = int64_t(std::floor(x / pixel_m)), row = int64_t(std::floor(y / pixel_m));
                if (column < 0 || row < 0 || column >= int64_t(side) || row >= int64_t(side)) continue;
                for (uint32_t leaf = 0; leaf < 4; ++leaf) {
                    double z = top_m * (1 - 0.9 * unit(random) * unit(random));
                    columns[size_t(row) * side + size_t(column)].push_back(uint16_t(z / double(level.height_step_m)));
                }
            }
    }
    Ldi ldi;
    ldi.side_px = side, ldi.first = {0};
    for (auto& heights : columns) {
        std::sort(heights.begin(), heights.end());
        heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
        for (uint16_t height : heights) ldi.heights.push_back(height), ldi.colours.push_back(uint8_t(random() % 256));
        ldi.first.push_back(ldi.sample_count());
    }
    for (uint32_t c = 0; c < 256; ++c) ldi.palette.push_back({uint8_t(c), uint8_t(255 - c / 2), uint8_t(c / 4)});
    return ldi;
}

// A field to 40 tiles on a plain, its images and what is listed of it.
struct Planted {
    Ground ground = Ground::plain();
    ImageSet images;
    TileSet set;
    std::optional<Placement> placement;
    std::optional<RandomTiling> tiling;
    std::vector<Ldi> ldis;
    std::vector<PreparedLdi> prepared;
    std::vector<uint32_t> sample_counts;
    std::optional<Field> field;
    view::Camera camera;
    FieldList list;

    explicit Planted(bool small) {
        set.horizontal = set.vertical = {{}, {}};
        for (uint8_t t = 0; t < 16; ++t)
            set.tiles.push_back({uint8_t(t & 1), uint8_t(t >> 1 & 1), uint8_t(t >> 2 & 1), uint8_t(t >> 3 & 1)});
        images.tile_m = kTile_m, images.high_m = 1.9, images.tile_count = 16, images.direction_count = 1;
        images.cell = {1.5, 1.9, 1, 40 * kTile_m, 415, 1};
        float nearest_m = 1;
        for (uint32_t side : {468, 232, 151, 111, 88, 73, 62})
            images.levels.push_back({small ? side / 8 : side, nearest_m, 0.01f, 1.2f}), nearest_m += float(kTile_m);
        for (uint64_t i = 0; i < images.ldi_count(); ++i) {
            ldis.push_back(plants_image(images, which_of(images, i).tile, which_of(images, i).level));
            prepared.push_back(PreparedLdi::of(ldis.back())), sample_counts.push_back(ldis.back().sample_count());
        }
        placement.emplace(*Placement::of(ground, kTile_m, {}));
        tiling.emplace(*RandomTiling::of(set, 1));
        field.emplace(*Field::of({&images, sample_counts, &set, &*tiling, &*placement}, paper_options(images)));
        camera.position_m = {0.4, 0.3, 1.75}, camera.heading_deg = 33, camera.pitch_deg = -5;
        camera.width_px = 640, camera.height_px = 480, camera.near_m = 0.05;
        field->list(camera, list);
    }
};
const Planted& planted(bool small) {
    static const Planted made(small);
    return made;
}

// Of each sample its place, height and colour are read, and of the picture colours and depths written.
Work work_of(const WarpCounts& counts, const Warped& picture, double bytes_a_sample) {
    double least = double(counts.samples) * bytes_a_sample + double(picture.colours.size()) * 8;
    return {double(counts.samples), "samples", least, bytes_a_sample};
}

void warp_exactly(benchmark::State& state, bool small, Hiding hiding) {
    const Planted& field = planted(small);
    Warped picture;
    repeat(state, [&] {
        picture.clear(field.camera.width_px, field.camera.height_px);
        auto image_at = [&](uint64_t index) { return &field.ldis[index]; };
        return work_of(warp_field(field.camera, *field.field, field.list, image_at, hiding, picture), picture, 3);
    });
}

void warp_fast(benchmark::State& state, bool small, Hiding hiding) {
    const Planted& field = planted(small);
    Warped picture;
    FastWarp fast;
    repeat(state, [&] {
        auto image_at = [&](uint64_t index) { return &field.prepared[index]; };
        return work_of(fast.warp(field.camera, *field.field, field.list, image_at, {hiding}, picture), picture, 6);
    });
}

}  // namespace

void add_warp(bool small) {
    for (Hiding hiding : {Hiding::by_order, Hiding::by_depth}) {
        std::string how = hiding == Hiding::by_order ? "by_order" : "by_depth";
        add("warp_exactly", how, [=](benchmark::State& state) { warp_exactly(state, small, hiding); });
        add("warp_fast", how, [=](benchmark::State& state) { warp_fast(state, small, hiding); });
    }
}

}  // namespace overlook::bench
