// Every rule of the section of directional textures has files that break it, and each is refused by its rule; so is every damage
// of whole ones. formats/spec/wang_textures.md says what the code does.
#include <gtest/gtest.h>

#include "tests/corrupt/laws.h"
#include "tests/corrupt/terrain_fixtures.h"
#include "tests/corrupt/wang_textures_fixtures.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::wang_ldi::texture_fixtures {
namespace {

using namespace container::fixtures;

Result<void> read_bytes(std::span<const std::byte> bytes, const std::string& name) {
    Result<container::Reader> file = container::Reader::open_bytes(bytes, name);
    if (!file) return tl::unexpected(file.error());
    for (const container::Section& section : file->sections())
        if (auto intact = file->check(section); !intact) return intact;
    Result<ImageReader> images = ImageReader::open(*file);
    if (!images) return tl::unexpected(images.error());
    auto textures = read_textures(*file, images->set());
    return textures ? Result<void>() : tl::unexpected(textures.error());
}

const container::fixtures::Kind kKind{
    "wang_textures",   'X', wang_ldi::texture_fixtures::whole_files, wang_ldi::texture_fixtures::corrupt_files, read_bytes,
    texture_rule_count};

class CorruptTextures : public testing::TestWithParam<Fixture> {};

TEST_P(CorruptTextures, AreRefusedByTheirRule) {
    expect_refused_by_its_rule(kKind, GetParam());
}
TEST_P(CorruptTextures, AreAWholeContainer) {
    expect_whole_container(GetParam());
}
TEST_P(CorruptTextures, StandInTheRepositoryAsTheyAreMade) {
    expect_in_repository_as_made(kKind, GetParam());
}
INSTANTIATE_TEST_SUITE_P(Rule, CorruptTextures, testing::ValuesIn(wang_ldi::texture_fixtures::corrupt_files()),
                         [](const auto& fixture) { return test_name(kKind, fixture.param); });

TEST(CorruptTextureFiles, ThereIsOneForEveryRule) {
    expect_one_for_every_rule(kKind);
}
TEST(CorruptTextureFiles, NoOtherFilesStandInTheFolder) {
    expect_no_other_files(kKind);
}
TEST(WholeTextures, AreAcceptedAndStandInTheCorpusAsTheyAreMade) {
    expect_whole_ones_accepted(kKind);
    expect_whole_ones_in_corpus(kKind);
}
TEST(DamagedTextures, AreRefusedAtEveryTruncatedLength) {
    expect_refused_at_every_length(kKind, "post.ovl");
}
TEST(DamagedTextures, AreRefusedAtEveryBitOfEveryByteOfTheirSections) {
    expect_refused_at_every_bit(kKind, "post.ovl");
}

std::string document() {
    return text_of_file(OVERLOOK_SOURCE_DIR "/formats/spec/wang_textures.md");
}

TEST(TexturesDocument, ShowsTheVeryBytesOfTheExample) {
    std::string text = document();
    size_t at = text.find("## WLDT of the example");
    ASSERT_NE(at, std::string::npos);
    EXPECT_TRUE(terrain::fixtures::bytes_of_hexdump(text.substr(at)) == bytes_of_textures(post()));
}

TEST(TexturesDocument, HasTheSentenceOfEveryRule) {
    std::string text = document();
    for (int rule = 1; rule <= texture_rule_count(); rule++) {
        std::string row = fmt::format("\n| X{} | {} |", rule, texture_rule_text(rule));
        EXPECT_NE(text.find(row), std::string::npos) << row;
    }
    EXPECT_EQ(text.find(fmt::format("| X{} |", texture_rule_count() + 1)), std::string::npos);
    EXPECT_EQ(texture_rule_text(0), "");
    EXPECT_EQ(texture_rule_text(texture_rule_count() + 1), "");
}

// Of one tile or of several, in either context, each texel comes back where it was.
TEST(DirectionalTextures, ComeBackAsTheyWereWritten) {
    for (bool has_normals : {false, true}) {
        ImageSet images = image_fixtures::post();
        images.tile_count = 3, images.direction_count = 5, images.context_count = 2, images.has_normals = has_normals;
        TextureSet set = post();
        set.side_px = 8, set.tile_count = 3, set.direction_count = 5, set.context_count = 2, set.has_normals = has_normals;
        ASSERT_EQ(texture_levels(8), 4u);
        ASSERT_EQ(texture_texels(8), 64u + 16 + 4 + 1);
        set.textures.assign(30, {});
        uint32_t number = 0;
        for (DirectionalTexture& texture : set.textures) {
            texture.unseen_share = 0.25f, texture.standard_error = float(number % 1000);
            for (size_t t = 0; t < texture_texels(8); ++t) {
                auto next = [&] { return uint8_t((number = number * 1664525 + 1013904223) >> 24); };
                texture.colours.push_back({next(), next(), next(), next()}), texture.heights.push_back({next(), next()});
                auto one = [&] { return int8_t(int(next()) % 255 - 127); };
                if (has_normals) texture.normals.push_back({one(), one(), one()});
            }
        }
        set.direction_fade = images.direction_fade;  // not stored again
        ScratchFolder folder;
        auto writer = container::Writer::create(folder / "a.ovl", container::tag("WANG"));
        auto written = write_textures(*writer, images, set);
        ASSERT_TRUE(written) << written.error().message;
        ASSERT_TRUE(writer->commit());
        auto file = container::Reader::open(folder / "a.ovl");
        ASSERT_TRUE(has_textures(*file));
        auto again = read_textures(*file, images);
        ASSERT_TRUE(again) << again.error().message;
        EXPECT_TRUE(*again == set);
    }
}

TEST(DirectionalTextures, AreNotWrittenWhereAReaderWouldRefuseThem) {
    auto refused = [](auto change) {
        ScratchFolder folder;
        auto writer = container::Writer::create(folder / "a.ovl", container::tag("WANG"));
        TextureSet set = post();
        change(set);
        auto written = write_textures(*writer, image_fixtures::post(), set);
        return !written && written.error().exit == Exit::our_bug;
    };
    EXPECT_FALSE(refused([](TextureSet&) {}));
    EXPECT_TRUE(refused([](TextureSet& set) { set.side_px = 3; }));
    EXPECT_TRUE(refused([](TextureSet& set) { set.side_px = 4; }));
    EXPECT_TRUE(refused([](TextureSet& set) { set.tile_m = 3; }));
    EXPECT_TRUE(refused([](TextureSet& set) { set.textures.clear(); }));
    EXPECT_TRUE(refused([](TextureSet& set) { set.textures[0].normals.pop_back(); }));
    EXPECT_TRUE(refused([](TextureSet& set) { set.textures[0].normals[1][2] = -128; }));
    EXPECT_TRUE(refused([](TextureSet& set) { set.textures[0].standard_error = NAN; }));
    EXPECT_TRUE(refused([](TextureSet& set) { set.farthest_m = INFINITY; }));
}

}  // namespace
}  // namespace overlook::wang_ldi::texture_fixtures
