// Pictures of single tiles show what stands on them, each thing whole and from where it is said.
#include "runtime/wang_ldi/portraits.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "runtime/wang_ldi/own_objects.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::wang_ldi {
namespace {

constexpr double kTile_m = 4;
constexpr uint32_t kSide = 64;
constexpr double kPixel_m = kTile_m / kSide;
constexpr float kTight_m = 0.4f;

// One tile that repeats: an object inside, one on each edge and one at the corner, three of which reach over the rim.
PlantedTiles patch() {
    PlantedTiles ground;
    ground.set.tiles = {{}};
    ground.planting.tile_size_m = kTile_m;
    ground.planting.models = {{"post", kTight_m, 0.5f}};
    auto add = [&](float x_m, float y_m, Owner owner) {
        Planted object;
        object.x_m = x_m, object.y_m = y_m, object.owner = owner;
        ground.planting.tiles[0].push_back(object);
    };
    ground.planting.tiles.resize(1);
    add(2, 2.3f, Owner::interior), add(1.4f, 0.1f, Owner::horizontal_edge), add(3.8f, 1.6f, Owner::vertical_edge);
    add(0.2f, 3.9f, Owner::corner);
    return ground;
}

ImageSet set_of(uint32_t directions) {
    ImageSet set;
    set.tile_m = kTile_m, set.low_m = 0, set.high_m = 1;
    set.cell = {1.5, 1.9, 6, 60, 400, 1};
    set.tile_count = 1, set.direction_count = directions;
    set.levels = {{kSide, 6, 1.0f / 64, 1.5f}, {kSide / 8, 24, 1.0f / 64, 1.5f}};
    return set;
}

// Colours of a palette in which no two are alike, and none is white or what is mixed of two.
std::array<uint8_t, 3> colour_of(uint8_t number) {
    return {uint8_t(10 + 9 * number), uint8_t(200 - 7 * number), uint8_t(40 + 3 * (number % 5))};
}
Ldi ldi_of(uint32_t side, const std::function<int(double x, double y)>& colour_at, const std::vector<uint16_t>& heights) {
    Ldi ldi;
    ldi.side_px = side, ldi.first = {0};
    for (uint32_t j = 0; j < side; ++j)
        for (uint32_t i = 0; i < side; ++i) {
            int colour = colour_at((i + 0.5) * kTile_m / side, (j + 0.5) * kTile_m / side);
            for (uint16_t step : heights)
                if (colour >= 0) ldi.heights.push_back(step), ldi.colours.push_back(uint8_t(colour));
            ldi.first.push_back(ldi.sample_count());
        }
    for (uint8_t c = 0; c < 24; ++c) ldi.palette.push_back(colour_of(c));
    return ldi;
}

// Posts a metre high: of the tile's own objects in colours 0 to 3, of those that reach in in colours from 8 on.
int post_at(double x, double y) {
    PlantedTiles ground = patch();
    std::vector<Planted> all = ground.planting.tiles[0], more = overhang(ground.set, ground.planting, 0);
    all.insert(all.end(), more.begin(), more.end());
    for (size_t i = 0; i < all.size(); ++i)
        if (std::hypot(x - double(all[i].x_m), y - double(all[i].y_m)) < double(kTight_m)) return i < 4 ? int(i) : int(i) + 4;
    return -1;
}
std::vector<uint16_t> post_heights() {
    std::vector<uint16_t> heights;
    for (uint16_t step = 0; step <= 64; step = uint16_t(step + 2)) heights.push_back(step);
    return heights;
}

// A file of them, read again.
class PortraitTest : public testing::Test {
  protected:
    void write(const ImageSet& set, const std::function<Ldi(const Which&)>& image_of) {
        auto writer = container::Writer::create(folder_ / "a.ovl", kKind);
        ASSERT_TRUE(writer);
        ASSERT_TRUE(wang_ldi::write(*writer, patch()));
        auto images = ImageWriter::begin(*writer, set);
        ASSERT_TRUE(images) << images.error().message;
        for (uint64_t i = 0; i < set.ldi_count(); ++i) {
            Which which = which_of(set, i);
            auto bytes = packed(set, which.level, image_of(which));
            ASSERT_TRUE(bytes) << bytes.error().message;
            ASSERT_TRUE(images->add(*bytes));
        }
        ASSERT_TRUE(images->end());
        ASSERT_TRUE(writer->commit());
        auto file = container::Reader::open(folder_ / "a.ovl");
        ASSERT_TRUE(file);
        file_ = std::move(*file);
        auto opened = ImageReader::open(*file_);
        ASSERT_TRUE(opened) << opened.error().message;
        images_ = std::move(*opened);
    }

    ScratchFolder folder_;
    std::optional<container::Reader> file_;
    std::optional<ImageReader> images_;
};

std::array<uint8_t, 3> pixel_of(const ImageRgb8& picture, uint32_t x, uint32_t y) {
    const uint8_t* rgb = picture.pixels.data() + (size_t(y) * picture.width + x) * 3;
    return {rgb[0], rgb[1], rgb[2]};
}
// How many pixels of the rectangle have exactly this colour.
int count_of(const ImageRgb8& picture, uint8_t number, uint32_t left, uint32_t top, uint32_t right, uint32_t bottom) {
    int count = 0;
    for (uint32_t y = top; y < bottom; ++y)
        for (uint32_t x = left; x < right; ++x) count += pixel_of(picture, x, y) == colour_of(number);
    return count;
}
int count_of(const ImageRgb8& picture, uint8_t number) {
    return count_of(picture, number, 0, 0, picture.width, picture.height);
}

TEST(ObjectMap, PartsATilesSamplesAmongTheTilesWhoseObjectsTheyAreOf) {
    PlantedTiles ground = patch();
    Ldi ldi = ldi_of(kSide, post_at, post_heights());
    ObjectMap map(ground, 0, kSide);
    Ldi own = map.only_of_square(ldi, {0, 0});
    auto is_own = [](uint8_t colour) { return colour < 8; };
    EXPECT_EQ(own.sample_count(), std::count_if(ldi.colours.begin(), ldi.colours.end(), is_own));
    EXPECT_TRUE(std::all_of(own.colours.begin(), own.colours.end(), is_own));
    EXPECT_EQ(std::set<uint8_t>(own.colours.begin(), own.colours.end()).size(), 4u);
    EXPECT_EQ(own.first.size(), ldi.first.size());
    uint32_t all = 0;
    std::array<uint32_t, 9> of_square{};
    for (int k = 0; k < 9; ++k) {
        Ldi part = map.only_of_square(ldi, {(k % 3 - 1) * kTile_m, (k / 3 - 1) * kTile_m});
        all += of_square[size_t(k)] = part.sample_count();
        EXPECT_EQ(part.palette.empty(), part.sample_count() == 0);
    }
    EXPECT_EQ(all, ldi.sample_count());
    EXPECT_GT(of_square[3], 0u);  // the vertical edge's reaches in from the west, the other edge's from the north
    EXPECT_GT(of_square[7], 0u);
    EXPECT_EQ(of_square[8], 0u);
}

TEST_F(PortraitTest, FromAboveEachObjectStandsWhereItIsAmongItsNeighbours) {
    write(set_of(2), [](const Which& which) { return ldi_of(which.level == 0 ? kSide : kSide / 8, post_at, post_heights()); });
    PlantedTiles ground = patch();
    auto picture = tiles_from_above(*images_, ground, {});
    ASSERT_TRUE(picture) << picture.error().message;
    ASSERT_EQ(picture->width, 220u + 16);
    ASSERT_EQ(picture->height, 220u + 16);
    double metre_px = 220 / (kTile_m * 1.24), margin_px = 8 + 220 * 0.12 / 1.24;
    auto at = [&](double x_m, double y_m) {
        return pixel_of(*picture, uint32_t(margin_px + x_m * metre_px), uint32_t(picture->height - margin_px - y_m * metre_px));
    };
    for (size_t i = 0; i < 4; ++i) {
        const Planted& object = ground.planting.tiles[0][i];
        EXPECT_EQ(at(double(object.x_m), double(object.y_m)), colour_of(uint8_t(i))) << i;
    }
    EXPECT_EQ(at(1, 2), (std::array<uint8_t, 3>{255, 255, 255}));
    EXPECT_EQ(at(2, kTile_m), (std::array<uint8_t, 3>{110, 110, 110}));  // the line round it
    EXPECT_EQ(at(4.2, 3.9), colour_of(3));                               // the neighbour's own
    EXPECT_EQ(at(1.4, 4.1), colour_of(1));
}

TEST_F(PortraitTest, FromAsideOwnObjectsAreWholeAndAlone) {
    write(set_of(2), [](const Which& which) { return ldi_of(which.level == 0 ? kSide : kSide / 8, post_at, post_heights()); });
    PlantedTiles ground = patch();
    auto picture = tiles_from_aside(*images_, ground, {});
    ASSERT_TRUE(picture) << picture.error().message;
    for (uint8_t own = 0; own < 4; ++own) EXPECT_GT(count_of(*picture, own), 50) << int(own);
    // What of them stands over the rim has the colours of what reaches in there.
    int beyond = 0, kinds = 0;
    for (uint8_t colour = 8; colour < 24; ++colour) beyond += count_of(*picture, colour), kinds += count_of(*picture, colour) > 5;
    EXPECT_GE(kinds, 3);
    EXPECT_LT(beyond, count_of(*picture, 0) + count_of(*picture, 1) + count_of(*picture, 2) + count_of(*picture, 3));
}

// What is nearest is seen in the lower half of a picture, what is to the west of a tile on its left as seen from the south.
TEST_F(PortraitTest, DirectionsAreSeenFromWhereTheyAreForAndFromAQuarterTurnOn) {
    write(set_of(4), [](const Which& which) {
        return ldi_of(which.level == 0 ? kSide : kSide / 8,
                      [&](double x, double y) { return int(4 * which.direction) + (x < 2 ? 0 : 1) + (y < 2 ? 0 : 2); }, {4});
    });
    auto picture = directions_portrait(*images_, 0, {});
    ASSERT_TRUE(picture) << picture.error().message;
    uint32_t cell_px = (picture->height - 3 * 8) / 2;
    // Of each column: which image, and which quarter (west or east, south or north) is near on the left seen from its side.
    constexpr std::array<uint8_t, 4> kDirections{2, 3, 0, 1}, kNearLeft{0, 2, 3, 1};
    for (uint32_t column = 0; column < 4; ++column)
        for (uint32_t row = 0; row < 2; ++row) {
            uint32_t left = 8 + column * 228, top = 8 + row * (cell_px + 8);
            int most = 0;
            uint8_t seen = 255;
            for (uint8_t colour = 0; colour < 16; ++colour) {
                int count = count_of(*picture, colour, left, top + cell_px / 2, left + 110, top + cell_px);
                if (count > most) most = count, seen = colour;
                EXPECT_TRUE(colour / 4 == kDirections[column] || count == 0);
            }
            EXPECT_GT(most, 200);
            EXPECT_EQ(seen, 4 * kDirections[column] + kNearLeft[(column + row) % 4]) << column << " " << row;
        }
}

TEST_F(PortraitTest, LevelsAreSeenFarCloseUpAndAsTheyShouldBe) {
    write(set_of(4), [](const Which& which) {
        return ldi_of(which.level == 0 ? kSide : kSide / 8, [&](double, double) { return int(which.level); }, {4});
    });
    auto picture = levels_portrait(*images_, 0, {});
    ASSERT_TRUE(picture) << picture.error().message;
    ASSERT_EQ(picture->width, 3 * 228u + 8);
    auto count_in = [&](uint32_t column, uint8_t colour) {
        return count_of(*picture, colour, 8 + column * 228, 8, 228 + column * 228, picture->height - 8);
    };
    EXPECT_GT(count_in(0, 1), 100);
    EXPECT_GT(count_in(1, 1), count_in(0, 1));
    EXPECT_GT(count_in(2, 0), count_in(0, 1) / 2);
    EXPECT_EQ(count_in(0, 0) + count_in(1, 0) + count_in(2, 1), 0);
}

TEST_F(PortraitTest, OfImagesThatAreOfOtherGroundThereIsNone) {
    write(set_of(1), [](const Which& which) { return ldi_of(which.level == 0 ? kSide : kSide / 8, post_at, post_heights()); });
    PlantedTiles other = patch();
    other.planting.tile_size_m = 3;
    for (auto picture : {tiles_from_above(*images_, other, {}), tiles_from_aside(*images_, other, {})}) {
        ASSERT_FALSE(picture);
        EXPECT_EQ(picture.error().exit, Exit::bad_input);
        EXPECT_EQ(picture.error().message, "images of 1 tiles of 4 m, planted are 1 of 3 m");
    }
}

}  // namespace
}  // namespace overlook::wang_ldi
