// Every rule of the container has files that break it, and each is refused by its rule.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "tests/corrupt/container_fixtures.h"

namespace overlook::container::fixtures {
namespace {

const std::string kCorruptFolder = OVERLOOK_SOURCE_DIR "/tests/corrupt/container";
const std::string kWholeFolder = OVERLOOK_SOURCE_DIR "/tests/fuzz/corpus/container";

class CorruptContainer : public testing::TestWithParam<Fixture> {};

TEST_P(CorruptContainer, IsRefusedByItsRule) {
    const Fixture& fixture = GetParam();
    ASSERT_EQ(fixture.name.substr(0, 4), fmt::format("c{:02}_", fixture.rule));
    Result<void> read = read_everything(fixture.bytes, fixture.name);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().exit, Exit::bad_input);
    EXPECT_EQ(rule_in(read.error().message), fixture.rule) << read.error().message;
    EXPECT_EQ(read.error().message.rfind(fixture.name + ": C", 0), 0u) << read.error().message;
    EXPECT_EQ(read.error().message.find('\n'), std::string::npos);
}

// Sections' bytes are not looked at before they are asked for: rules C1..C18 are of opening, C19..C23 of reading.
TEST_P(CorruptContainer, IsRefusedOnOpeningIfItsHeadIsBroken) {
    EXPECT_EQ(Reader::open_bytes(GetParam().bytes, GetParam().name).has_value(), GetParam().rule >= 19);
}

TEST_P(CorruptContainer, StandsInTheRepositoryAsItIsMade) {
    Result<MappedFile> file = MappedFile::open(kCorruptFolder + "/" + GetParam().name);
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_TRUE(std::ranges::equal(file->bytes(), GetParam().bytes)) << "make_container_fixtures writes them anew";
}

std::string test_name(const testing::TestParamInfo<Fixture>& fixture) {
    std::string name = fixture.param.name.substr(0, fixture.param.name.size() - 4);
    name[0] = 'C';
    return name;
}
INSTANTIATE_TEST_SUITE_P(Rule, CorruptContainer, testing::ValuesIn(corrupt_files()), test_name);

TEST(CorruptContainers, ThereIsOneForEveryRule) {
    std::set<int> rules, expected;
    for (const Fixture& fixture : corrupt_files()) rules.insert(fixture.rule);
    for (int rule = 1; rule <= rule_count(); rule++) expected.insert(rule);
    EXPECT_EQ(rules, expected);
}

TEST(CorruptContainers, NoOtherFilesStandInTheFolder) {
    std::set<std::string> names, expected;
    for (const Fixture& fixture : corrupt_files()) expected.insert(fixture.name);
    for (const auto& file : std::filesystem::directory_iterator(kCorruptFolder)) names.insert(file.path().filename());
    EXPECT_EQ(names, expected);
}

TEST(WholeContainers, AreAcceptedAndStandInTheCorpusAsTheyAreMade) {
    for (const Fixture& fixture : whole_files()) {
        Result<Reader> reader = Reader::open_bytes(fixture.bytes, fixture.name);
        ASSERT_TRUE(reader) << reader.error().message;
        for (const Section& section : reader->sections()) {
            Result<Bytes> raw = reader->read(section, kMostRawBytes);
            ASSERT_TRUE(raw) << raw.error().message;
            EXPECT_EQ(raw->size(), section.raw_bytes);
        }
        Result<MappedFile> file = MappedFile::open(kWholeFolder + "/" + fixture.name);
        ASSERT_TRUE(file) << file.error().message;
        EXPECT_TRUE(std::ranges::equal(file->bytes(), fixture.bytes)) << fixture.name;
    }
}

// Few sections, so that all values of all bytes are cheap.
Bytes small_file() {
    for (Fixture& fixture : whole_files()) {
        if (fixture.name == "compressed.ovl") return fixture.bytes;
    }
    return {};
}

TEST(DamagedContainer, IsRefusedAtEveryTruncatedLength) {
    Bytes file = small_file();
    ASSERT_TRUE(read_everything(file, "a.ovl"));
    for (size_t size = 0; size < file.size(); size++) {
        // Memory of exactly this size, so that a sanitizer sees a read behind the end.
        Bytes cut(file.begin(), file.begin() + long(size));
        Result<Reader> reader = Reader::open_bytes(cut, "a.ovl");
        ASSERT_FALSE(reader) << "cut to " << size << " bytes";
        int expected = size < 8 ? 1 : size < 4096 ? 2 : 4;
        ASSERT_EQ(rule_in(reader.error().message), expected) << reader.error().message;
    }
}

TEST(DamagedContainer, IsRefusedAtEveryValueOfEveryByteOfHeaderAndTable) {
    Bytes file = small_file();
    for (size_t at = 0; at < kFirstSectionOffset; at++) {
        int expected = at < 8 ? 1 : at < 10 ? 3 : at >= 16 && at < 24 ? 4 : 5;
        for (int flip = 1; flip < 256; flip++) {
            file[at] ^= std::byte(flip);
            Result<Reader> reader = Reader::open_bytes(file, "a.ovl");
            file[at] ^= std::byte(flip);
            ASSERT_FALSE(reader) << "byte " << at << " xor " << flip;
            ASSERT_EQ(rule_in(reader.error().message), expected) << reader.error().message;
        }
    }
}

TEST(DamagedContainer, IsRefusedAtEveryValueOfEveryByteOfSectionsAndPadding) {
    Bytes file = small_file();
    Result<Reader> whole = Reader::open_bytes(file, "a.ovl");
    ASSERT_TRUE(whole);
    for (size_t at = kFirstSectionOffset; at < file.size(); at++) {
        bool in_section = std::ranges::any_of(whole->sections(), [&](const Section& section) {
            return at >= section.offset && at < section.offset + section.stored_bytes;
        });
        for (int flip = 1; flip < 256; flip++) {
            file[at] ^= std::byte(flip);
            Result<void> read = read_everything(file, "a.ovl");
            file[at] ^= std::byte(flip);
            ASSERT_FALSE(read) << "byte " << at << " xor " << flip;
            ASSERT_EQ(rule_in(read.error().message), in_section ? 20 : 18) << read.error().message;
        }
    }
}

}  // namespace
}  // namespace overlook::container::fixtures
