// Every rule of the mesh's sections has files that break it, and each is refused by its rule; so is every damage of whole
// ones.
#include <gtest/gtest.h>

#include "tests/corrupt/caveclod_fixtures.h"
#include "tests/corrupt/laws.h"

namespace overlook::caveclod::fixtures {
namespace {

using namespace container::fixtures;

Result<void> read_bytes(std::span<const std::byte> bytes, const std::string& name) {
    Result<container::Reader> file = container::Reader::open_bytes(bytes, name);
    if (!file) return tl::unexpected(file.error());
    Result<Hierarchy> made = read(*file);
    if (!made) return tl::unexpected(made.error());
    return {};
}

const container::fixtures::Kind kKind{
    "caveclod", 'M', caveclod::fixtures::whole_files, caveclod::fixtures::corrupt_files, read_bytes, caveclod::rule_count};

class CorruptMesh : public testing::TestWithParam<Fixture> {};

TEST_P(CorruptMesh, IsRefusedByItsRule) {
    expect_refused_by_its_rule(kKind, GetParam());
}
TEST_P(CorruptMesh, IsAWholeContainer) {
    expect_whole_container(GetParam());
}
TEST_P(CorruptMesh, StandsInTheRepositoryAsItIsMade) {
    expect_in_repository_as_made(kKind, GetParam());
}
INSTANTIATE_TEST_SUITE_P(Rule, CorruptMesh, testing::ValuesIn(caveclod::fixtures::corrupt_files()),
                         [](const auto& fixture) { return test_name(kKind, fixture.param); });

TEST(CorruptMeshes, ThereIsOneForEveryRule) {
    expect_one_for_every_rule(kKind);
}
TEST(CorruptMeshes, NoOtherFilesStandInTheFolder) {
    expect_no_other_files(kKind);
}
TEST(WholeMeshes, AreAcceptedAndStandInTheCorpusAsTheyAreMade) {
    expect_whole_ones_accepted(kKind);
    expect_whole_ones_in_corpus(kKind);
}
TEST(DamagedMesh, IsRefusedAtEveryTruncatedLength) {
    expect_refused_at_every_length(kKind, "hexagon.ovl");
}
TEST(DamagedMesh, IsRefusedAtEveryBitOfEveryByteOfItsSections) {
    expect_refused_at_every_bit(kKind, "hexagon.ovl");
}

}  // namespace
}  // namespace overlook::caveclod::fixtures
