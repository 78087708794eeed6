// Every rule of the sections of layered depth images has files that break it, and each is refused by its rule; so is every damage
// of whole ones.
#include <gtest/gtest.h>

#include "tests/corrupt/laws.h"
#include "tests/corrupt/wang_images_fixtures.h"

namespace overlook::wang_ldi::image_fixtures {
namespace {

using namespace container::fixtures;

Result<void> read_bytes(std::span<const std::byte> bytes, const std::string& name) {
    Result<container::Reader> file = container::Reader::open_bytes(bytes, name);
    if (!file) return tl::unexpected(file.error());
    Result<ImageReader> images = ImageReader::open(*file);
    if (!images) return tl::unexpected(images.error());
    for (uint64_t i = 0; i < images->set().ldi_count(); ++i)
        if (auto ldi = images->read(i); !ldi) return tl::unexpected(ldi.error());
    return {};
}

const container::fixtures::Kind kKind{
    "wang_images",   'L', wang_ldi::image_fixtures::whole_files, wang_ldi::image_fixtures::corrupt_files, read_bytes,
    image_rule_count};

class CorruptImages : public testing::TestWithParam<Fixture> {};

TEST_P(CorruptImages, AreRefusedByTheirRule) {
    expect_refused_by_its_rule(kKind, GetParam());
}
TEST_P(CorruptImages, AreAWholeContainer) {
    Result<container::Reader> file = container::Reader::open_bytes(GetParam().bytes, GetParam().name);
    ASSERT_TRUE(file) << file.error().message;
}
TEST_P(CorruptImages, StandInTheRepositoryAsTheyAreMade) {
    expect_in_repository_as_made(kKind, GetParam());
}
INSTANTIATE_TEST_SUITE_P(Rule, CorruptImages, testing::ValuesIn(wang_ldi::image_fixtures::corrupt_files()),
                         [](const auto& fixture) { return test_name(kKind, fixture.param); });

TEST(CorruptImageFiles, ThereIsOneForEveryRule) {
    expect_one_for_every_rule(kKind);
}
TEST(CorruptImageFiles, NoOtherFilesStandInTheFolder) {
    expect_no_other_files(kKind);
}
TEST(WholeImages, AreAcceptedAndStandInTheCorpusAsTheyAreMade) {
    expect_whole_ones_accepted(kKind);
    expect_whole_ones_in_corpus(kKind);
}
TEST(DamagedImages, AreRefusedAtEveryTruncatedLength) {
    expect_refused_at_every_length(kKind, "post.ovl");
}
TEST(DamagedImages, AreRefusedAtEveryBitOfEveryByteOfTheirSections) {
    expect_refused_at_every_bit(kKind, "post.ovl");
}

}  // namespace
}  // namespace overlook::wang_ldi::image_fixtures
