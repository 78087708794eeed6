// Every rule of the terrain's sections has files that break it, and each is refused by its rule; so is every damage of whole
// ones.
#include <gtest/gtest.h>

#include "formats/container_rules.h"
#include "formats/little_endian.h"
#include "tests/corrupt/laws.h"
#include "tests/corrupt/terrain_fixtures.h"

namespace overlook::terrain::fixtures {
namespace {

using namespace container::fixtures;

Result<void> read_bytes(std::span<const std::byte> bytes, const std::string& name) {
    Result<container::Reader> file = container::Reader::open_bytes(bytes, name);
    if (!file) return tl::unexpected(file.error());
    Result<Terrain> made = read(*file);
    if (!made) return tl::unexpected(made.error());
    return {};
}

const container::fixtures::Kind kKind{
    "terrain", 'T', terrain::fixtures::whole_files, terrain::fixtures::corrupt_files, read_bytes, terrain::rule_count};

class CorruptTerrain : public testing::TestWithParam<Fixture> {};

TEST_P(CorruptTerrain, IsRefusedByItsRule) {
    expect_refused_by_its_rule(kKind, GetParam());
}
TEST_P(CorruptTerrain, IsAWholeContainer) {
    expect_whole_container(GetParam());
}
TEST_P(CorruptTerrain, StandsInTheRepositoryAsItIsMade) {
    expect_in_repository_as_made(kKind, GetParam());
}
INSTANTIATE_TEST_SUITE_P(Rule, CorruptTerrain, testing::ValuesIn(terrain::fixtures::corrupt_files()),
                         [](const auto& fixture) { return test_name(kKind, fixture.param); });

TEST(CorruptTerrains, ThereIsOneForEveryRule) {
    expect_one_for_every_rule(kKind);
}
TEST(CorruptTerrains, NoOtherFilesStandInTheFolder) {
    expect_no_other_files(kKind);
}
TEST(WholeTerrains, AreAcceptedAndStandInTheCorpusAsTheyAreMade) {
    expect_whole_ones_accepted(kKind);
    expect_whole_ones_in_corpus(kKind);
}
TEST(DamagedTerrain, IsRefusedAtEveryTruncatedLength) {
    expect_refused_at_every_length(kKind, "two_levels_squeezed.ovl");
}
TEST(DamagedTerrain, IsRefusedAtEveryBitOfEveryByteOfItsSections) {
    expect_refused_at_every_bit(kKind, "two_levels_squeezed.ovl");
}

// The same with the container's checksums made right again: nothing of a directory's entry is free.
TEST(DamagedTerrain, IsRefusedAtEveryBitOfItsDirectoryByATerrainRuleAlone) {
    Bytes file = whole_file(kKind, "flat_with_two_stages.ovl");
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
            seal(damaged);
            Result<void> read = read_bytes(damaged, "a.ovl");
            ASSERT_FALSE(read) << "byte " << at << " bit " << bit;
            int rule = rule_in('T', read.error().message);
            ASSERT_TRUE(rule >= 10 && rule <= 13) << read.error().message;
        }
    }
}

}  // namespace
}  // namespace overlook::terrain::fixtures
