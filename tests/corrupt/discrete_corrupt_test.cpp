// Every rule of the discrete sections has files that break it, and each is refused by its rule; so is every damage of whole
// ones.
#include <gtest/gtest.h>

#include "tests/corrupt/discrete_fixtures.h"
#include "tests/corrupt/laws.h"

namespace overlook::discrete::fixtures {
namespace {

using namespace container::fixtures;

Result<void> read_bytes(std::span<const std::byte> bytes, const std::string& name) {
    Result<container::Reader> file = container::Reader::open_bytes(bytes, name);
    if (!file) return tl::unexpected(file.error());
    Result<Chain> made = read(*file);
    if (!made) return tl::unexpected(made.error());
    return {};
}

const container::fixtures::Kind kKind{
    "discrete", 'D', discrete::fixtures::whole_files, discrete::fixtures::corrupt_files, read_bytes, discrete::rule_count};

class CorruptChain : public testing::TestWithParam<Fixture> {};

TEST_P(CorruptChain, IsRefusedByItsRule) {
    expect_refused_by_its_rule(kKind, GetParam());
}
TEST_P(CorruptChain, IsAWholeContainer) {
    expect_whole_container(GetParam());
}
TEST_P(CorruptChain, StandsInTheRepositoryAsItIsMade) {
    expect_in_repository_as_made(kKind, GetParam());
}
INSTANTIATE_TEST_SUITE_P(Rule, CorruptChain, testing::ValuesIn(discrete::fixtures::corrupt_files()),
                         [](const auto& fixture) { return test_name(kKind, fixture.param); });

TEST(CorruptChains, ThereIsOneForEveryRule) {
    expect_one_for_every_rule(kKind);
}
TEST(CorruptChains, NoOtherFilesStandInTheFolder) {
    expect_no_other_files(kKind);
}
TEST(WholeChains, AreAcceptedAndStandInTheCorpusAsTheyAreMade) {
    expect_whole_ones_accepted(kKind);
    expect_whole_ones_in_corpus(kKind);
}
TEST(DamagedChain, IsRefusedAtEveryTruncatedLength) {
    expect_refused_at_every_length(kKind, "pyramid.ovl");
}
TEST(DamagedChain, IsRefusedAtEveryBitOfEveryByteOfItsSections) {
    expect_refused_at_every_bit(kKind, "pyramid.ovl");
}

}  // namespace
}  // namespace overlook::discrete::fixtures
