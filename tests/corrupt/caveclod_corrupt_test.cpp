// Every rule of the mesh's sections has files that break it, and each is refused by its rule; so is every damage of whole
// ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "tests/corrupt/caveclod_fixtures.h"

namespace overlook::caveclod::fixtures {
namespace {

const std::string kCorruptFolder = OVERLOOK_SOURCE_DIR "/tests/corrupt/caveclod";
const std::string kWholeFolder = OVERLOOK_SOURCE_DIR "/tests/fuzz/corpus/caveclod";

Result<Hierarchy> read_bytes(std::span<const std::byte> bytes, const std::string& name) {
    Result<container::Reader> file = container::Reader::open_bytes(bytes, name);
    if (!file) return tl::unexpected(file.error());
    return read(*file);
}

class CorruptMesh : public testing::TestWithParam<Fixture> {};

TEST_P(CorruptMesh, IsRefusedByItsRule) {
    const Fixture& fixture = GetParam();
    ASSERT_EQ(fixture.name.substr(0, 4), fmt::format("m{:02}_", fixture.rule));
    Result<Hierarchy> read = read_bytes(fixture.bytes, fixture.name);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().exit, Exit::bad_input);
    EXPECT_EQ(rule_in(read.error().message), fixture.rule) << read.error().message;
    EXPECT_EQ(read.error().message.rfind(fixture.name + ": M", 0), 0u) << read.error().message;
    EXPECT_EQ(read.error().message.find('\n'), std::string::npos);
}

TEST_P(CorruptMesh, IsAWholeContainer) {
    Result<container::Reader> file = container::Reader::open_bytes(GetParam().bytes, GetParam().name);
    ASSERT_TRUE(file) << file.error().message;
    for (const container::Section& section : file->sections()) EXPECT_TRUE(file->check(section));
}

TEST_P(CorruptMesh, StandsInTheRepositoryAsItIsMade) {
    Result<MappedFile> file = MappedFile::open(kCorruptFolder + "/" + GetParam().name);
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_TRUE(std::ranges::equal(file->bytes(), GetParam().bytes)) << "make_caveclod_fixtures writes them anew";
}

std::string test_name(const testing::TestParamInfo<Fixture>& fixture) {
    std::string name = fixture.param.name.substr(0, fixture.param.name.size() - 4);
    name[0] = 'M';
    return name;
}
INSTANTIATE_TEST_SUITE_P(Rule, CorruptMesh, testing::ValuesIn(corrupt_files()), test_name);

TEST(CorruptMeshes, ThereIsOneForEveryRule) {
    std::set<int> rules, expected;
    for (const Fixture& fixture : corrupt_files()) rules.insert(fixture.rule);
    for (int rule = 1; rule <= rule_count(); rule++) expected.insert(rule);
    EXPECT_EQ(rules, expected);
}

TEST(CorruptMeshes, NoOtherFilesStandInTheFolder) {
    std::set<std::string> names, expected;
    for (const Fixture& fixture : corrupt_files()) expected.insert(fixture.name);
    for (const auto& file : std::filesystem::directory_iterator(kCorruptFolder)) names.insert(file.path().filename());
    EXPECT_EQ(names, expected);
}

TEST(WholeMeshes, AreAcceptedAndStandInTheCorpusAsTheyAreMade) {
    for (const Fixture& fixture : whole_files()) {
        Result<Hierarchy> mesh = read_bytes(fixture.bytes, fixture.name);
        EXPECT_TRUE(mesh) << mesh.error().message;
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

TEST(DamagedMesh, IsRefusedAtEveryTruncatedLength) {
    Bytes file = whole_file("hexagon.ovl");
    ASSERT_TRUE(read_bytes(file, "a.ovl"));
    for (size_t size = 0; size < file.size(); size++) {
        Bytes cut(file.begin(),
                  file.begin() + long(size));  // of exactly this size, so that a sanitizer sees a read behind the end
        ASSERT_FALSE(read_bytes(cut, "a.ovl")) << "cut to " << size << " bytes";
    }
}

TEST(DamagedMesh, IsRefusedAtEveryBitOfEveryByteOfItsSections) {
    Bytes file = whole_file("hexagon.ovl");
    for (size_t at = container::kFirstSectionOffset; at < file.size(); at++) {
        for (int bit = 0; bit < 8; bit++) {
            file[at] ^= std::byte(1 << bit);
            Result<Hierarchy> read = read_bytes(file, "a.ovl");
            file[at] ^= std::byte(1 << bit);
            ASSERT_FALSE(read) << "byte " << at << " bit " << bit;
        }
    }
}

}  // namespace
}  // namespace overlook::caveclod::fixtures
