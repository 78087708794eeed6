// That formats/spec/wang_tiles.md says what the code does.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/corrupt/terrain_fixtures.h"
#include "tests/corrupt/wang_fixtures.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::wang_ldi::fixtures {
namespace {

std::string document() {
    return text_of_file(OVERLOOK_SOURCE_DIR "/formats/spec/wang_tiles.md");
}

TEST(GroundDocument, ShowsTheVeryBytesThatTheWriterWrites) {
    Bytes documented = terrain::fixtures::bytes_of_hexdump(document());
    ScratchFolder folder;
    auto writer = container::Writer::create(folder / "tulips.ovl", kKind);
    ASSERT_TRUE(writer) << writer.error().message;
    ASSERT_TRUE(write(*writer, tulips()));
    ASSERT_TRUE(writer->commit());
    std::string written = text_of_file(folder / "tulips.ovl");
    EXPECT_TRUE(std::ranges::equal(std::as_bytes(std::span(written)), documented));

    Result<container::Reader> file = container::Reader::open_bytes(documented, "wang_tiles.md");
    ASSERT_TRUE(file) << file.error().message;
    Result<PlantedTiles> ground = read(*file);
    ASSERT_TRUE(ground) << ground.error().message;
    EXPECT_TRUE(ground->set == tulips().set);
    EXPECT_TRUE(ground->planting == tulips().planting);
}

TEST(GroundDocument, HasTheSentenceOfEveryRule) {
    std::string text = document();
    for (int rule = 1; rule <= rule_count(); rule++) {
        std::string row = fmt::format("\n| W{} | {} |", rule, rule_text(rule));
        EXPECT_NE(text.find(row), std::string::npos) << row;
    }
    EXPECT_EQ(text.find(fmt::format("| W{} |", rule_count() + 1)), std::string::npos);
    EXPECT_EQ(rule_text(0), "");
    EXPECT_EQ(rule_text(rule_count() + 1), "");
}

TEST(GroundWriter, RefusesWhatNoReaderWouldTake) {
    ScratchFolder folder;
    PlantedTiles ground = tulips();
    ground.planting.tiles[1][1].x_m = 5;
    auto writer = container::Writer::create(folder / "tulips.ovl", kKind);
    ASSERT_TRUE(writer);
    auto refused = write(*writer, ground);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().exit, Exit::our_bug);
    EXPECT_NE(refused.error().message.find("W8"), std::string::npos);
}

TEST(Overhang, HasWhatNeighboursHoldOfEdgesAndCorners) {
    PlantedTiles ground = tulips();
    // Tile 1: to its west there is always an edge of colour 1, whose tulip stands 0.25 m beyond; to its east one of colour 0,
    // which has none. Each of its corners has a tulip in the north-east: three beyond its own.
    std::vector<Planted> around = overhang(ground.set, ground.planting, 1);
    ASSERT_EQ(around.size(), 4u);
    EXPECT_EQ(around[0].x_m, -0.25f);
    EXPECT_EQ(around[0].y_m, 2);
    EXPECT_EQ(around[0].turn_rad, 0.5f);
    EXPECT_EQ(around[1].x_m, 4.25f);
    EXPECT_EQ(around[1].y_m, 0.25f);
    EXPECT_EQ(around[2].x_m, 0.25f);
    EXPECT_EQ(around[2].y_m, 4.25f);
    EXPECT_EQ(around[3].x_m, 4.25f);
    EXPECT_EQ(around[3].y_m, 4.25f);
}

}  // namespace
}  // namespace overlook::wang_ldi::fixtures
