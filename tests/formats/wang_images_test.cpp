// Layered depth images come back as they were written, none is written that a reader would refuse, and the image for an eye is
// the one whose direction is nearest.
#include "formats/wang_ldi.h"

#include <gtest/gtest.h>

#include <cmath>

#include "formats/compression.h"
#include "formats/wang_ldi_columns.h"
#include "formats/wang_ldi_grouped.h"
#include "tests/corrupt/wang_images_fixtures.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::wang_ldi {
namespace {

// Columns of 0 to 300 samples at heights that a small generator scatters.
Ldi scattered(const ImageSet& set, uint32_t level, uint32_t seed) {
    auto next = [&] { return (seed = seed * 1664525 + 1013904223) >> 8; };
    Ldi ldi;
    ldi.side_px = set.levels[level].side_px, ldi.first = {0};
    auto top = uint32_t((set.high_m - set.low_m) / double(set.levels[level].height_step_m));
    for (uint32_t p = 0; p < ldi.side_px * ldi.side_px; ++p) {
        uint32_t height = next() % (top / 2 + 1);
        for (uint32_t left = next() % 8 == 0 ? 300 : next() % 4; left > 0 && height <= top; --left, height += 1 + next() % 3)
            ldi.heights.push_back(uint16_t(height));
        ldi.first.push_back(ldi.sample_count());
    }
    for (uint32_t s = 0; s < ldi.sample_count(); ++s) {
        ldi.colours.push_back(uint8_t(next() % 200));
        if (set.has_normals) ldi.normals.push_back({int8_t(int(next() % 255) - 127), int8_t(int(next() % 255) - 127)});
        if (set.has_splats) ldi.splats.push_back(uint8_t(1 + next() % 255));
    }
    for (int c = 0; c < 200; ++c) ldi.palette.push_back({uint8_t(c), uint8_t(255 - c), 7});
    ldi.unseen_share = 0.25f;
    return ldi;
}

ImageSet field() {
    ImageSet set = image_fixtures::post();
    set.levels = {{24, 1, 0.002f, 1}, {9, 3, 0.004f, 1.25f}}, set.tile_count = 2, set.direction_count = 3;
    return set;
}

TEST(LayeredImages, ComeBackAsTheyWereWritten) {
    for (int variant = 0; variant < 8; ++variant) {
        ImageSet set = field();
        set.has_normals = (variant & 1) != 0, set.has_splats = (variant & 2) != 0, set.is_grouped = (variant & 4) != 0;
        ScratchFolder folder;
        auto file = container::Writer::create(folder / "a.ovl", container::tag("WANG"));
        ASSERT_TRUE(file);
        auto writer = ImageWriter::begin(*file, set);
        ASSERT_TRUE(writer) << writer.error().message;
        for (uint64_t i = 0; i < set.ldi_count(); ++i) {
            uint32_t level = which_of(set, i).level;
            auto bytes = packed(set, level, scattered(set, level, uint32_t(i)));
            ASSERT_TRUE(bytes) << bytes.error().message;
            ASSERT_TRUE(writer->add(*bytes));
        }
        ASSERT_TRUE(writer->end());
        ASSERT_TRUE(file->commit());

        auto read = container::Reader::open(folder / "a.ovl");
        ASSERT_TRUE(read);
        auto images = ImageReader::open(*read);
        ASSERT_TRUE(images) << images.error().message;
        EXPECT_TRUE(images->set().levels == set.levels);
        EXPECT_EQ(images->set().cell.eye_high_m, 1.9);
        for (uint64_t i = set.ldi_count(); i-- > 0;) {
            auto ldi = images->read(i);
            ASSERT_TRUE(ldi) << ldi.error().message;
            EXPECT_TRUE(*ldi == scattered(set, which_of(set, i).level, uint32_t(i))) << i;
        }
    }
}

// What packed() wrote, read without a file.
Ldi read_back(const ImageSet& set, uint32_t level, const Packed& packed) {
    std::vector<std::byte> raw(packed.raw_bytes);
    EXPECT_EQ(zstd_decode(packed.bytes, raw), "");
    Ldi ldi;
    Entry entry{0, 0, 0, packed.raw_bytes, packed.sample_count, packed.colour_count, packed.unseen_share};
    ImageFault fault = ldi_of_bytes(raw, set, level, entry, ldi);
    EXPECT_FALSE(fault) << fault.text;
    return ldi;
}

// Of every count of groups: few samples, many, and none.
TEST(LayeredImages, ComeBackGroupedWhateverTheirSize) {
    ImageSet set = field();
    set.is_grouped = true, set.has_normals = set.has_splats = false;
    set.levels = {{64, 1, 0.00003f, 1}, {20, 3, 0.004f, 1}, {6, 9, 0.004f, 1}, {1, 12, 0.004f, 1}};
    std::vector<uint64_t> counts;
    for (uint32_t level = 0; level < 4; ++level) {
        Ldi ldi = scattered(set, level, 7 + level);
        if (level == 3) ldi.first = {0, 0}, ldi.heights.clear(), ldi.colours.clear(), ldi.palette.clear();
        auto bytes = packed(set, level, ldi);
        ASSERT_TRUE(bytes) << bytes.error().message;
        EXPECT_TRUE(read_back(set, level, *bytes) == ldi) << level;
        counts.push_back(group_counts_of(ldi.sample_count()).all());
    }
    EXPECT_GT(counts[0], counts[1]);
    EXPECT_GT(counts[1], counts[2]);
}

// Heights of 65,535 steps beside each other, of which differences fit no 16 bits.
TEST(LayeredImages, ComeBackGroupedWhateverTheirHeights) {
    ImageSet set = field();
    set.is_grouped = true, set.has_normals = set.has_splats = false;
    set.levels = {{8, 1, float((set.high_m - set.low_m) / 65534), 1}};
    for (uint32_t gap : {1u, 2u, 1000u, 32765u, 32766u, 32767u, 32768u, 32769u, 40000u, 65530u}) {
        Ldi ldi;
        ldi.side_px = 8, ldi.first = {0}, ldi.palette = {{1, 2, 3}}, ldi.unseen_share = 0.25f;
        for (uint32_t p = 0; p < 64; ++p) {
            uint32_t own = p % 3 == 0 ? gap : p % 3 == 1 ? 1 + p % 5 : 65534u - gap;
            for (uint32_t height : {0u, std::max(own, 1u)}) ldi.heights.push_back(uint16_t(height)), ldi.colours.push_back(0);
            ldi.first.push_back(ldi.sample_count());
        }
        auto bytes = packed(set, 0, ldi);
        ASSERT_TRUE(bytes) << bytes.error().message;
        EXPECT_TRUE(read_back(set, 0, *bytes) == ldi) << gap;
    }
}

// An image of 2 x 2 pixels, their columns of up to 40 samples, which stand within `reach` steps.
Ldi of_four_columns(uint32_t seed, uint32_t reach) {
    auto next = [&] { return (seed = seed * 1664525 + 1013904223) >> 8; };
    Ldi ldi;
    ldi.side_px = 2, ldi.first = {0};
    for (int p = 0; p < 4; ++p) {
        uint32_t height = next() % (reach / 2);
        for (uint32_t left = next() % 41; left > 0 && height < reach; --left, height += 1 + next() % (1 + reach / 20))
            ldi.heights.push_back(uint16_t(height)), ldi.colours.push_back(uint8_t(next() % 256));
        ldi.first.push_back(ldi.sample_count());
    }
    return ldi;
}

// Eight heights at a time as one by one, of columns longer than that and of heights far apart.
TEST(WindowsBeside, SayWhatOneByOneSay) {
    using namespace groups;
    size_t told = 0, far = 0, none = 0;
    for (uint32_t seed = 0; seed < 3000; ++seed) {
        uint32_t reach = seed % 3 == 0 ? 60 : seed % 3 == 1 ? 3000 : 65535;
        Ldi ldi = of_four_columns(seed, reach);
        Beside beside(ldi, 3);
        NextAbove next(ldi, beside);
        NearestColour nearest(ldi, beside);
        std::vector<uint16_t> heights = ldi.heights;
        heights.resize(heights.size() + kLanes, uint16_t(seed));
        WindowsBeside windows(heights.data(), beside);
        for (uint32_t s = ldi.first[3]; s < ldi.first[4]; ++s) {
            int distance = 0, steps = 0, colour = nearest.of(s, true);
            uint32_t found = windows.nearest(ldi.heights[s], distance);
            if (distance == WindowsBeside::kFar) {
                ++far;
            } else {
                ++told;
                ASSERT_LT(found, ldi.first[3]);
                EXPECT_EQ(int(ldi.colours[found]), colour) << seed << " " << s;
                EXPECT_EQ(std::abs(ldi.heights[found] - ldi.heights[s]), distance) << seed << " " << s;
            }
            none += (steps = next.steps(ldi.heights[s])) < 0;
            EXPECT_EQ(windows.steps(ldi.heights[s]), steps) << seed << " " << s;
        }
    }
    EXPECT_GT(told, 10000u);
    EXPECT_GT(far, 1000u);
    EXPECT_GT(none, 1000u);
}

// Each sample's nearest are 2,200 to 2,800 steps away, in the columns beside it, and say which group its colour is in.
TEST(LayeredImages, ComeBackGroupedWhereNothingIsNear) {
    ImageSet set = field();
    set.is_grouped = true, set.has_normals = set.has_splats = false, set.levels = {{32, 1, 0.00003f, 1}};
    Ldi ldi;
    ldi.side_px = 32, ldi.first = {0}, ldi.unseen_share = 0.25f;
    for (int c = 0; c < 256; ++c) ldi.palette.push_back({uint8_t(c), 0, 7});
    uint32_t seed = 5;
    auto noise = [&](uint32_t most) { return ((seed = seed * 1664525 + 1013904223) >> 8) % most; };
    for (uint32_t p = 0; p < 32 * 32; ++p) {
        for (uint32_t layer = 0; layer < 6; ++layer) {
            ldi.heights.push_back(uint16_t(5000 * layer + 2500 * ((p + p / 32) % 2) + noise(300)));
            ldi.colours.push_back(uint8_t(noise(256)));
        }
        ldi.first.push_back(ldi.sample_count());
    }
    ASSERT_GT(group_counts_of(ldi.sample_count()).colour_classes, 1u);
    auto bytes = packed(set, 0, ldi);
    ASSERT_TRUE(bytes) << bytes.error().message;
    EXPECT_TRUE(read_back(set, 0, *bytes) == ldi);
}

// Columns that go on from pixel to pixel, as surfaces do, take fewer bytes than unpredicted.
TEST(LayeredImages, OfSurfacesTakeFewerBytesGrouped) {
    ImageSet set = field();
    set.has_normals = set.has_splats = false, set.levels = {{96, 1, 0.0005f, 1}};
    Ldi ldi;
    ldi.side_px = 96, ldi.first = {0}, ldi.palette = {};
    for (int c = 0; c < 64; ++c) ldi.palette.push_back({uint8_t(c), uint8_t(c), 7});
    uint32_t seed = 1;
    auto noise = [&](uint32_t most) { return ((seed = seed * 1664525 + 1013904223) >> 8) % most; };
    for (uint32_t p = 0; p < 96 * 96; ++p) {
        for (uint32_t layer = 0; layer < 4; ++layer) {
            ldi.heights.push_back(uint16_t(700 * layer + 3 * (p % 96) + 5 * (p / 96) + noise(9)));
            ldi.colours.push_back(uint8_t(16 * layer + noise(7)));
        }
        ldi.first.push_back(ldi.sample_count());
    }
    auto plain = packed(set, 0, ldi);
    set.is_grouped = true;
    auto grouped = packed(set, 0, ldi);
    ASSERT_TRUE(plain && grouped);
    EXPECT_LT(grouped->bytes.size(), plain->bytes.size() * 8 / 10);
    EXPECT_TRUE(read_back(set, 0, *grouped) == ldi);
}

// Whatever stands in grouped rows, what is read of them keeps the rules.
TEST(LayeredImages, OfAnyGroupedBytesAreReadOrRefused) {
    ImageSet set = image_fixtures::grouped_post();
    Ldi whole = image_fixtures::images_of_post()[0];
    std::vector<std::byte> raw = grouped_bytes_of(set, 0, whole).bytes;
    Entry entry{0, 0, 0, uint32_t(raw.size()), whole.sample_count(), uint32_t(whole.palette.size()), 0};
    size_t refused = 0;
    for (size_t at = 0; at < raw.size(); ++at)
        for (int value : {0, 1, 2, 3, 127, 128, 255}) {
            std::vector<std::byte> other = raw;
            other[at] = std::byte(value);
            Ldi ldi;
            if (ldi_of_bytes(other, set, 0, entry, ldi)) {
                ++refused;
                continue;
            }
            EXPECT_TRUE(packed(set, 0, ldi)) << at << " " << value;
        }
    EXPECT_GT(refused, 100u);
}

TEST(LayeredImages, AreNotWrittenWhereAReaderWouldRefuseThem) {
    ImageSet set = image_fixtures::post();
    auto refused = [&](auto change) {
        Ldi ldi = image_fixtures::images_of_post()[0];
        change(ldi);
        auto bytes = packed(set, 0, ldi);
        return !bytes && bytes.error().exit == Exit::our_bug;
    };
    EXPECT_FALSE(refused([](Ldi&) {}));
    EXPECT_TRUE(refused([](Ldi& ldi) { ldi.side_px = 3; }));
    EXPECT_TRUE(refused([](Ldi& ldi) { ldi.first[1] = 5; }));
    EXPECT_TRUE(refused([](Ldi& ldi) { ldi.heights[1] = 0; }));
    EXPECT_TRUE(refused([](Ldi& ldi) { ldi.colours[0] = 2; }));
    EXPECT_TRUE(refused([](Ldi& ldi) { ldi.normals.pop_back(); }));
    EXPECT_TRUE(refused([](Ldi& ldi) { ldi.normals[0][0] = -128; }));
    EXPECT_TRUE(refused([](Ldi& ldi) { ldi.splats[0] = 0; }));
    EXPECT_TRUE(refused([](Ldi& ldi) { ldi.palette.clear(); }));
    EXPECT_TRUE(refused([](Ldi& ldi) { ldi.unseen_share = NAN; }));
}

TEST(LayeredImages, ASetOfTooFewImagesIsNotWritten) {
    ScratchFolder folder;
    auto file = container::Writer::create(folder / "a.ovl", container::tag("WANG"));
    auto writer = ImageWriter::begin(*file, image_fixtures::post());
    auto bytes = packed(image_fixtures::post(), 0, image_fixtures::images_of_post()[0]);
    ASSERT_TRUE(writer->add(*bytes));
    auto ended = writer->end();
    ASSERT_FALSE(ended);
    EXPECT_EQ(ended.error().exit, Exit::our_bug);
}

TEST(LayeredImages, EveryOneHasItsOwnIndex) {
    ImageSet set = field();
    set.context_count = 2;
    for (uint64_t i = 0; i < set.ldi_count(); ++i) EXPECT_EQ(index_of(set, which_of(set, i)), i);
}

TEST(LayeredImages, TheDirectionForAnEyeIsTheNearestOne) {
    ImageSet set = field();
    for (uint32_t count : {1u, 3u, 8u, 64u}) {
        set.direction_count = count;
        for (double heading = 0.1; heading < 360; heading += 7.3) {
            double radians = heading * M_PI / 180;
            uint32_t chosen = direction_for(set, 5.0 * glm::dvec2(std::sin(radians), std::cos(radians)));
            double off = std::abs(std::remainder(heading - 360.0 * chosen / count, 360.0));
            EXPECT_LE(off, 180.0 / count + 1e-9) << heading << " of " << count;
        }
    }
}

TEST(LayeredImages, TheLevelForADistanceIsTheLastThatBeginsBefore) {
    ImageSet set = field();
    EXPECT_EQ(level_for(set, 0), 0u);
    EXPECT_EQ(level_for(set, 2.9), 0u);
    EXPECT_EQ(level_for(set, 3), 1u);
    EXPECT_EQ(level_for(set, 1e9), 1u);
}

}  // namespace
}  // namespace overlook::wang_ldi
