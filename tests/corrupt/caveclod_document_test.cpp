// That formats/spec/caveclod.md says what the code does.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/caveclod/mesh_files.h"
#include "tests/corrupt/caveclod_fixtures.h"
#include "tests/corrupt/terrain_fixtures.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::caveclod::fixtures {
namespace {

std::string document() {
    return text_of_file(OVERLOOK_SOURCE_DIR "/formats/spec/caveclod.md");
}

TEST(MeshDocument, ShowsTheVeryBytesThatTheWriterWrites) {
    Bytes documented = terrain::fixtures::bytes_of_hexdump(document());
    std::string written = synthetic::file_of(hexagon(), Codec::draco);
    EXPECT_TRUE(std::ranges::equal(std::as_bytes(std::span(written)), documented));
    EXPECT_TRUE(std::ranges::equal(Parts::of(hexagon()).file(), documented));

    Result<container::Reader> file = container::Reader::open_bytes(documented, "caveclod.md");
    ASSERT_TRUE(file) << file.error().message;
    Result<Hierarchy> mesh = read(*file);
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ(mesh->positions_m, hexagon().positions_m);
    EXPECT_EQ(mesh->face_positions, hexagon().face_positions);
    EXPECT_EQ(mesh->moved, hexagon().moved);
    EXPECT_EQ(mesh->error_m, hexagon().error_m);
}

TEST(MeshDocument, HasTheSentenceOfEveryRule) {
    std::string text = document();
    for (int rule = 1; rule <= rule_count(); rule++) {
        std::string row = fmt::format("\n| M{} | {} |", rule, rule_text(rule));
        EXPECT_NE(text.find(row), std::string::npos) << row;
    }
    EXPECT_EQ(text.find(fmt::format("| M{} |", rule_count() + 1)), std::string::npos);
    EXPECT_EQ(rule_text(0), "");
    EXPECT_EQ(rule_text(rule_count() + 1), "");
}

}  // namespace
}  // namespace overlook::caveclod::fixtures
