// A terrain in parts: the same cut when all is there, and an honest one without cracks when it is not.
#include "runtime/terrain/tiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "formats/atomic_file.h"
#include "runtime/terrain/refine_tiles.h"
#include "tests/formats/scratch_folder.h"
#include "tests/runtime/hills.h"

namespace overlook::terrain {
namespace {

std::string written(const ScratchFolder& folder, const Terrain& terrain) {
    Result<container::Writer> writer = container::Writer::create(folder / "a.ovl", kKind);
    EXPECT_TRUE(writer && write(*writer, terrain) && write_tiles(*writer, terrain) && writer->commit());
    return folder / "a.ovl";
}

std::unique_ptr<Tiles> opened(const std::string& path, const stream::Settings& settings) {
    Result<container::Reader> reader = container::Reader::open(path);
    EXPECT_TRUE(reader);
    Result<std::unique_ptr<Tiles>> tiles = Tiles::open(std::move(*reader), settings);
    EXPECT_TRUE(tiles) << tiles.error().message;
    return std::move(*tiles);
}

// Which sample each slot's places stand on.
class Places {
  public:
    explicit Places(const Tiles& tiles) : tiles_(tiles), tile_of_slot_(tiles.slot_count()) {
        for (uint32_t tile = 0; tile < tiles.grid().count(); ++tile)
            if (tiles.view(tile).heights != nullptr) tile_of_slot_[tiles.view(tile).slot] = tile;
    }
    uint32_t sample(uint32_t place) const {
        uint32_t tile = tile_of_slot_[place / kTileSamples], local = place % kTileSamples;
        GridPlace from = tiles_.grid().origin(tile);
        uint32_t level = tiles_.grid().block(tile).level;
        GridPoint at =
            sample_of(tiles_.head().shape, {from.x + (local % kTileSide << level), from.y + (local / kTileSide << level)});
        return at.y * tiles_.head().shape.width + at.x;
    }
    uint32_t sample_of_index(const Cut& cut, uint32_t index) const {
        uint32_t places = tiles_.slot_count() * kTileSamples;
        return sample(index < places ? index : cut.morphs[index - places].sample);
    }

  private:
    const Tiles& tiles_;
    std::vector<uint32_t> tile_of_slot_;
};

// Frames of one camera until nothing more comes. Returns how many that took.
uint32_t settle(Tiles& tiles, const TileRefiner& refiner, const view::Camera& camera, double error_px, double morph, Cut& cut) {
    for (uint32_t frame = 1;; ++frame) {
        EXPECT_TRUE(tiles.begin_frame().faults.empty());
        refiner.cut_by_pixels(camera, error_px, cut, morph);
        tiles.end_frame();
        if (tiles.is_settled()) return frame;
    }
}

TEST(TileRefiner, CutsAsTheWholeDoesOnceItsTilesAreThere) {
    ScratchFolder folder;
    for (const auto& [width, height, voids] : {std::tuple{300u, 420u, 0.0}, {513u, 513u, 0.0}, {390u, 260u, 0.02}}) {
        Terrain terrain = baked(test::make_hills(width, height, 3, voids));
        Refiner whole(terrain);
        std::unique_ptr<Tiles> tiles = opened(written(folder, terrain), {1 << 30, 64 << 20, 1, 1});
        TileRefiner parts(*tiles);
        Cut expected, cut;
        expected.wants_codes = cut.wants_codes = true;
        for (uint64_t seed = 0; seed < 24; ++seed) {
            view::Camera camera = random_camera(terrain, seed);
            double error_px = random_tolerance_px(seed), morph = seed % 2 == 0 ? 0 : 0.5;
            whole.cut_by_pixels(camera, error_px, expected, morph);
            settle(*tiles, parts, camera, error_px, morph, cut);
            ASSERT_EQ(cut.stopped_count, 0u);
            ASSERT_EQ(cut.indices.size(), expected.indices.size()) << seed;
            ASSERT_EQ(cut.predicted_error_px, expected.predicted_error_px);
            ASSERT_EQ(cut.tested_count, expected.tested_count);
            ASSERT_EQ(cut.codes, expected.codes);
            Places places(*tiles);
            uint32_t samples = width * height, slots = tiles->slot_count() * kTileSamples;
            for (size_t i = 0; i < cut.indices.size(); ++i) {
                bool morphs = expected.indices[i] >= samples;
                uint32_t sample = morphs ? expected.morphs[expected.indices[i] - samples].sample : expected.indices[i];
                ASSERT_EQ(places.sample_of_index(cut, cut.indices[i]), sample);
                ASSERT_EQ(cut.indices[i] >= slots, morphs);
                if (!morphs) continue;
                ASSERT_EQ(cut.morphs[cut.indices[i] - slots].rise_m, expected.morphs[expected.indices[i] - samples].rise_m);
            }
        }
    }
}

view::Camera flying(const Terrain& terrain, uint32_t frame, uint32_t frames) {
    view::Camera camera = random_camera(terrain, 0);
    double t = double(frame) / frames;
    camera.position_m = {terrain.shape.width * terrain.frame.metres_per_column * (0.1 + 0.8 * t),
                         -(terrain.shape.height * terrain.frame.metres_per_row) * (0.5 + 0.35 * std::sin(9 * t)), 1500};
    camera.heading_deg = 90 + 40 * std::sin(5 * t), camera.pitch_deg = -12, camera.fov_y_deg = 60;
    camera.width_px = 640, camera.height_px = 480;
    return camera;
}

// Fly over a terrain of several times the budget, and check its memory in every frame, its triangles in every sixth.
TEST(TileRefiner, KeepsItsMemoryAndSaysWhichErrorWithoutCracks) {
    ScratchFolder folder;
    Terrain terrain = baked(test::make_hills(1025, 1025, 3, 0));
    stream::Settings settings{1'200'000, 250'000, 1, 1};
    std::unique_ptr<Tiles> tiles = opened(written(folder, terrain), settings);
    uint64_t all_bytes = 0;
    for (uint32_t tile = 0; tile < tiles->grid().count(); ++tile) all_bytes += tiles->grid().bytes(tile);
    ASSERT_GT(all_bytes, 3 * settings.residency_budget_bytes);
    TileRefiner refiner(*tiles);
    Refiner whole(terrain);
    Cut cut, expected;
    cut.wants_codes = true;
    uint32_t coarse_frames = 0, fine_frames = 0;
    for (uint32_t frame = 0; frame < 240; ++frame) {
        view::Camera camera = flying(terrain, frame, 240);
        double error_px = frame < 180 ? 0.1 : 4;
        tiles->begin_frame();
        refiner.cut_by_pixels(camera, error_px, cut);
        const stream::Counts& counts = tiles->counts();
        EXPECT_LE(counts.uploaded_bytes, settings.upload_budget_bytes);
        std::vector<uint32_t> samples;
        Places places(*tiles);
        for (uint32_t index : cut.indices) samples.push_back(places.sample_of_index(cut, index));
        tiles->end_frame();
        EXPECT_LE(counts.resident_bytes + counts.on_the_way_bytes, settings.residency_budget_bytes);
        if (frame % 6 != 0) continue;
        EXPECT_EQ(count_t_junctions(samples, terrain.shape.width), 0u) << frame;
        // What is coarser than asked says so, what is not is the whole's.
        whole.cut_by_pixels(camera, error_px, expected);
        EXPECT_GE(cut.predicted_error_px, expected.predicted_error_px);
        if (cut.stopped_count == 0) {
            ++fine_frames;
            EXPECT_EQ(samples, expected.indices) << frame;
        } else {
            ++coarse_frames;
            EXPECT_GT(cut.predicted_error_px, error_px) << frame;
            EXPECT_LT(cut.triangle_count(), expected.triangle_count());
        }
    }
    EXPECT_GT(coarse_frames, 5u);
    EXPECT_GT(fine_frames, 5u);
    EXPECT_GT(tiles->counts().dropped_count, 20u);
}

TEST(TileRefiner, GivesTheSameFramesAgain) {
    ScratchFolder folder;
    Terrain terrain = baked(test::make_hills(513, 513, 3, 0));
    std::string path = written(folder, terrain);
    auto fly = [&] {
        std::unique_ptr<Tiles> tiles = opened(path, {1'500'000, 300'000, 1, 2});
        TileRefiner refiner(*tiles);
        std::vector<uint32_t> all;
        Cut cut;
        for (uint32_t frame = 0; frame < 60; ++frame) {
            tiles->begin_frame();
            refiner.cut_by_pixels(flying(terrain, frame, 60), 3, cut, 0.5);
            tiles->end_frame();
            all.insert(all.end(), cut.indices.begin(), cut.indices.end());
        }
        return all;
    };
    EXPECT_EQ(fly(), fly());
}

TEST(TileRefiner, FliesOnOverADamagedBlockAndSaysSoOnce) {
    ScratchFolder folder;
    Terrain terrain = baked(test::make_hills(513, 513, 3, 0));
    std::string path = written(folder, terrain);
    std::string bytes = text_of_file(path);
    Result<container::Reader> reader = container::Reader::open(path);
    ASSERT_TRUE(reader);
    const container::Section& blocks = *reader->find(container::tag("TBLK"));
    bytes[size_t(blocks.offset + blocks.stored_bytes - 1)] ^= 1;  // of the last block, in the south-east
    ASSERT_TRUE(write_file(folder / "damaged.ovl", std::string_view(bytes)));

    std::unique_ptr<Tiles> tiles = opened(folder / "damaged.ovl", {1 << 30, 64 << 20, 1, 1});
    TileRefiner refiner(*tiles);
    view::Camera camera;
    camera.position_m = {512 * terrain.frame.metres_per_column * 0.9, -512 * terrain.frame.metres_per_row * 0.9, 1200};
    camera.pitch_deg = -80, camera.width_px = 640, camera.height_px = 480;
    Cut cut;
    std::vector<Error> faults;
    for (uint32_t frame = 0; frame < 12; ++frame) {
        const stream::Stream::Changes& changes = tiles->begin_frame();
        faults.insert(faults.end(), changes.faults.begin(), changes.faults.end());
        refiner.cut_by_pixels(camera, 0.1, cut);
        tiles->end_frame();
    }
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_EQ(faults[0].exit, Exit::bad_input);
    EXPECT_EQ(faults[0].message, fmt::format("{}: T11: block {}: its bytes do not match their checksum; was the file damaged?",
                                             folder / "damaged.ovl", tiles->grid().count() - 1));
    EXPECT_GT(cut.stopped_count, 0u);
    EXPECT_GT(cut.predicted_error_px, 0.1);
    EXPECT_FALSE(read(folder / "damaged.ovl").has_value()) << "whoever reads the whole refuses it";
}

}  // namespace
}  // namespace overlook::terrain
