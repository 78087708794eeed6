// Every rule of the terrain's sections has files that break it, and each is refused by its rule; so is every damage of whole
// ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "formats/container_rules.h"
#include "formats/little_endian.h"
#include "tests/corrupt/terrain_fixtures.h"

namespace overlook::terrain::fixtures {
namespace {

const std::string kCorruptFolder = OVERLOOK_SOURCE_DIR "/tests/corrupt/terrain";
const std::string kWholeFolder = OVERLOOK_SOURCE_DIR "/tests/fuzz/corpus/terrain";

Result<Terrain> read_bytes(std::span<const std::byte> bytes, const std::string& name) {
    Result<container::Reader> file = container::Reader::open_bytes(bytes, name);
    if (!file) return tl::unexpected(file.error());
    return read(*file);
}

class CorruptTerrain : public testing::TestWithParam<Fixture> {};

TEST_P(CorruptTerrain, IsRefusedByItsRule) {
    const Fixture& fixture = GetParam();
    ASSERT_EQ(fixture.name.substr(0, 4), fmt::format("t{:02}_", fixture.rule));
    Result<Terrain> read = read_bytes(fixture.bytes, fixture.name);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().exit, Exit::bad_input);
    EXPECT_EQ(rule_in(read.error().message), fixture.rule) << read.error().message;
    EXPECT_EQ(read.error().message.rfind(fixture.name + ": T", 0), 0u) << read.error().message;
    EXPECT_EQ(read.error().message.find('\n'), std::string::npos);
}

TEST_P(CorruptTerrain, IsAWholeContainer) {
    Result<container::Reader> file = container::Reader::open_bytes(GetParam().bytes, GetParam().name);
    ASSERT_TRUE(file) << file.error().message;
    for (const container::Section& section : file->sections()) EXPECT_TRUE(file->check(section));
}

TEST_P(CorruptTerrain, StandsInTheRepositoryAsItIsMade) {
    Result<MappedFile> file = MappedFile::open(kCorruptFolder + "/" + GetParam().name);
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_TRUE(std::ranges::equal(file->bytes(), GetParam().bytes)) << "make_terrain_fixtures writes them anew";
}

std::string test_name(const testing::TestParamInfo<Fixture>& fixture) {
    std::string name = fixture.param.name.substr(0, fixture.param.name.size() - 4);
    name[0] = 'T';
    return name;
}
INSTANTIATE_TEST_SUITE_P(Rule, CorruptTerrain, testing::ValuesIn(corrupt_files()), test_name);

TEST(CorruptTerrains, ThereIsOneForEveryRule) {
    std::set<int> rules, expected;
    for (const Fixture& fixture : corrupt_files()) rules.insert(fixture.rule);
    for (int rule = 1; rule <= rule_count(); rule++) expected.insert(rule);
    EXPECT_EQ(rules, expected);
}

TEST(CorruptTerrains, NoOtherFilesStandInTheFolder) {
    std::set<std::string> names, expected;
    for (const Fixture& fixture : corrupt_files()) expected.insert(fixture.name);
    for (const auto& file : std::filesystem::directory_iterator(kCorruptFolder)) names.insert(file.path().filename());
    EXPECT_EQ(names, expected);
}

TEST(WholeTerrains, AreAcceptedAndStandInTheCorpusAsTheyAreMade) {
    for (const Fixture& fixture : whole_files()) {
        Result<Terrain> terrain = read_bytes(fixture.bytes, fixture.name);
        EXPECT_TRUE(terrain) << terrain.error().message;
        Result<MappedFile> file = MappedFile::open(kWholeFolder + "/" + fixture.name);
        ASSERT_TRUE(file) << file.error().message;
        EXPECT_TRUE(std::ranges::equal(file->bytes(), fixture.bytes)) << fixture.name;
    }
}

Bytes whole_file(const std::string& name) {
    for (Fixture& fixture : whole_files())
        if (fixture.name == name) return fixture.bytes;
    return {};
}

TEST(DamagedTerrain, IsRefusedAtEveryTruncatedLength) {
    Bytes file = whole_file("two_levels_squeezed.ovl");
    ASSERT_TRUE(read_bytes(file, "a.ovl"));
    for (size_t size = 0; size < file.size(); size++) {
        Bytes cut(file.begin(),
                  file.begin() + long(size));  // of exactly this size, so that a sanitizer sees a read behind the end
        ASSERT_FALSE(read_bytes(cut, "a.ovl")) << "cut to " << size << " bytes";
    }
}

TEST(DamagedTerrain, IsRefusedAtEveryBitOfEveryByteOfItsSections) {
    Bytes file = whole_file("two_levels_squeezed.ovl");
    for (size_t at = container::kFirstSectionOffset; at < file.size(); at++) {
        for (int bit = 0; bit < 8; bit++) {
            file[at] ^= std::byte(1 << bit);
            Result<Terrain> read = read_bytes(file, "a.ovl");
            file[at] ^= std::byte(1 << bit);
            ASSERT_FALSE(read) << "byte " << at << " bit " << bit;
        }
    }
}

// The same with the container's checksums made right again: nothing of a directory's entry is free.
TEST(DamagedTerrain, IsRefusedAtEveryBitOfItsDirectoryByATerrainRuleAlone) {
    Bytes file = whole_file("flat_with_two_stages.ovl");
    Result<container::Reader> whole = container::Reader::open_bytes(file, "a.ovl");
    ASSERT_TRUE(whole);
    size_t index = 0;
    while (whole->sections()[index].tag != container::tag("TDIR")) index++;
    container::Section directory = whole->sections()[index];
    for (size_t at = directory.offset; at < directory.offset + directory.stored_bytes; at++) {
        for (int bit = 0; bit < 8; bit++) {
            Bytes damaged = file;
            damaged[at] ^= std::byte(1 << bit);
            uint64_t checksum = container::checksum_of(std::span(damaged).subspan(directory.offset, directory.stored_bytes));
            store_le<uint64_t>(damaged, 64 + 64 * index + 40, checksum);
            container::fixtures::seal(damaged);
            Result<Terrain> read = read_bytes(damaged, "a.ovl");
            ASSERT_FALSE(read) << "byte " << at << " bit " << bit;
            int rule = rule_in(read.error().message);
            ASSERT_TRUE(rule >= 10 && rule <= 13) << read.error().message;
        }
    }
}

}  // namespace
}  // namespace overlook::terrain::fixtures
