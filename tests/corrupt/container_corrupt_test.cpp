// Every rule of the container has files that break it, and each is refused by its rule.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/corrupt/laws.h"

namespace overlook::container::fixtures {
namespace {

const Kind kKind{"container", 'C', whole_files, corrupt_files, read_everything, rule_count};

class CorruptContainer : public testing::TestWithParam<Fixture> {};

TEST_P(CorruptContainer, IsRefusedByItsRule) {
    expect_refused_by_its_rule(kKind, GetParam());
}

// Sections' bytes are not looked at before they are asked for: rules C1..C18 are of opening, C19..C23 of reading.
TEST_P(CorruptContainer, IsRefusedOnOpeningIfItsHeadIsBroken) {
    EXPECT_EQ(Reader::open_bytes(GetParam().bytes, GetParam().name).has_value(), GetParam().rule >= 19);
}

TEST_P(CorruptContainer, StandsInTheRepositoryAsItIsMade) {
    expect_in_repository_as_made(kKind, GetParam());
}
INSTANTIATE_TEST_SUITE_P(Rule, CorruptContainer, testing::ValuesIn(corrupt_files()),
                         [](const auto& fixture) { return test_name(kKind, fixture.param); });

TEST(CorruptContainers, ThereIsOneForEveryRule) {
    expect_one_for_every_rule(kKind);
}
TEST(CorruptContainers, NoOtherFilesStandInTheFolder) {
    expect_no_other_files(kKind);
}

TEST(WholeContainers, AreAcceptedAndStandInTheCorpusAsTheyAreMade) {
    expect_whole_ones_in_corpus(kKind);
    for (const Fixture& fixture : whole_files()) {
        Result<Reader> reader = Reader::open_bytes(fixture.bytes, fixture.name);
        ASSERT_TRUE(reader) << reader.error().message;
        for (const Section& section : reader->sections()) {
            Result<Bytes> raw = reader->read(section, kMostRawBytes);
            ASSERT_TRUE(raw) << raw.error().message;
            EXPECT_EQ(raw->size(), section.raw_bytes);
        }
    }
}

// Few sections, so that all values of all bytes are cheap.
Bytes small_file() {
    return whole_file(kKind, "compressed.ovl");
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
        ASSERT_EQ(rule_in('C', reader.error().message), expected) << reader.error().message;
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
            ASSERT_EQ(rule_in('C', reader.error().message), expected) << reader.error().message;
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
            ASSERT_EQ(rule_in('C', read.error().message), in_section ? 20 : 18) << read.error().message;
        }
    }
}

}  // namespace
}  // namespace overlook::container::fixtures
