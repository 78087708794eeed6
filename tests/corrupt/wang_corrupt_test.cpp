// Every rule of the Wang sections has files that break it, and each is refused by its rule; so is every damage of whole
// ones.
#include <gtest/gtest.h>

#include "tests/corrupt/laws.h"
#include "tests/corrupt/wang_fixtures.h"

namespace overlook::wang_ldi::fixtures {
namespace {

using namespace container::fixtures;

Result<void> read_bytes(std::span<const std::byte> bytes, const std::string& name) {
    Result<container::Reader> file = container::Reader::open_bytes(bytes, name);
    if (!file) return tl::unexpected(file.error());
    Result<PlantedTiles> made = read(*file);
    if (!made) return tl::unexpected(made.error());
    return {};
}

const container::fixtures::Kind kKind{
    "wang_ldi", 'W', wang_ldi::fixtures::whole_files, wang_ldi::fixtures::corrupt_files, read_bytes, wang_ldi::rule_count};

class CorruptGround : public testing::TestWithParam<Fixture> {};

TEST_P(CorruptGround, IsRefusedByItsRule) {
    expect_refused_by_its_rule(kKind, GetParam());
}
TEST_P(CorruptGround, IsAWholeContainer) {
    expect_whole_container(GetParam());
}
TEST_P(CorruptGround, StandsInTheRepositoryAsItIsMade) {
    expect_in_repository_as_made(kKind, GetParam());
}
INSTANTIATE_TEST_SUITE_P(Rule, CorruptGround, testing::ValuesIn(wang_ldi::fixtures::corrupt_files()),
                         [](const auto& fixture) { return test_name(kKind, fixture.param); });

TEST(CorruptGrounds, ThereIsOneForEveryRule) {
    expect_one_for_every_rule(kKind);
}
TEST(CorruptGrounds, NoOtherFilesStandInTheFolder) {
    expect_no_other_files(kKind);
}
TEST(WholeGrounds, AreAcceptedAndStandInTheCorpusAsTheyAreMade) {
    expect_whole_ones_accepted(kKind);
    expect_whole_ones_in_corpus(kKind);
}
TEST(DamagedGround, IsRefusedAtEveryTruncatedLength) {
    expect_refused_at_every_length(kKind, "tulips.ovl");
}
TEST(DamagedGround, IsRefusedAtEveryBitOfEveryByteOfItsSections) {
    expect_refused_at_every_bit(kKind, "tulips.ovl");
}

}  // namespace
}  // namespace overlook::wang_ldi::fixtures
