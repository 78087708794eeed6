#include "tests/corrupt/laws.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>

#include "formats/container_rules.h"

namespace overlook::container::fixtures {
namespace {

std::string corrupt_folder(const Kind& kind) {
    return OVERLOOK_SOURCE_DIR "/tests/corrupt/" + kind.name;
}

void expect_same_bytes(const std::string& path, const Fixture& fixture, const Kind& kind) {
    Result<MappedFile> file = MappedFile::open(path);
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_TRUE(std::ranges::equal(file->bytes(), fixture.bytes)) << "make_" << kind.name << "_fixtures writes them anew";
}

}  // namespace

void expect_refused_by_its_rule(const Kind& kind, const Fixture& fixture) {
    ASSERT_EQ(fixture.name.substr(0, 4), fmt::format("{}{:02}_", char(std::tolower(kind.letter)), fixture.rule));
    Result<void> read = kind.read(fixture.bytes, fixture.name);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().exit, Exit::bad_input);
    EXPECT_EQ(rule_in(kind.letter, read.error().message), fixture.rule) << read.error().message;
    EXPECT_EQ(read.error().message.rfind(fixture.name + ": " + kind.letter, 0), 0u) << read.error().message;
    EXPECT_EQ(read.error().message.find('\n'), std::string::npos);
}

void expect_whole_container(const Fixture& fixture) {
    Result<Reader> file = Reader::open_bytes(fixture.bytes, fixture.name);
    ASSERT_TRUE(file) << file.error().message;
    for (const Section& section : file->sections()) EXPECT_TRUE(file->check(section));
}

void expect_in_repository_as_made(const Kind& kind, const Fixture& fixture) {
    expect_same_bytes(corrupt_folder(kind) + "/" + fixture.name, fixture, kind);
}

std::string test_name(const Kind& kind, const Fixture& fixture) {
    return kind.letter + fixture.name.substr(1, fixture.name.size() - 5);
}

void expect_one_for_every_rule(const Kind& kind) {
    std::set<int> rules, expected;
    for (const Fixture& fixture : kind.corrupt_files()) rules.insert(fixture.rule);
    for (int rule = 1; rule <= kind.rule_count(); rule++) expected.insert(rule);
    EXPECT_EQ(rules, expected);
}

void expect_no_other_files(const Kind& kind) {
    std::set<std::string> names, expected;
    for (const Fixture& fixture : kind.corrupt_files()) expected.insert(fixture.name);
    for (const auto& file : std::filesystem::directory_iterator(corrupt_folder(kind))) names.insert(file.path().filename());
    EXPECT_EQ(names, expected);
}

void expect_whole_ones_accepted(const Kind& kind) {
    for (const Fixture& fixture : kind.whole_files()) {
        Result<void> read = kind.read(fixture.bytes, fixture.name);
        EXPECT_TRUE(read) << read.error().message;
    }
}

void expect_whole_ones_in_corpus(const Kind& kind) {
    for (const Fixture& fixture : kind.whole_files()) {
        SCOPED_TRACE(fixture.name);
        expect_same_bytes(OVERLOOK_SOURCE_DIR "/tests/fuzz/corpus/" + kind.name + "/" + fixture.name, fixture, kind);
    }
}

Bytes whole_file(const Kind& kind, const std::string& name) {
    for (Fixture& fixture : kind.whole_files())
        if (fixture.name == name) return fixture.bytes;
    ADD_FAILURE() << name << " is no fixture";
    return {};
}

void expect_refused_at_every_length(const Kind& kind, const std::string& name) {
    Bytes file = whole_file(kind, name);
    ASSERT_TRUE(kind.read(file, "a.ovl"));
    for (size_t size = 0; size < file.size(); size++) {
        // Memory of exactly this size, so that a sanitizer sees a read behind the end.
        Bytes cut(file.begin(), file.begin() + long(size));
        ASSERT_FALSE(kind.read(cut, "a.ovl")) << "cut to " << size << " bytes";
    }
}

void expect_refused_at_every_bit(const Kind& kind, const std::string& name) {
    Bytes file = whole_file(kind, name);
    for (size_t at = kFirstSectionOffset; at < file.size(); at++) {
        for (int bit = 0; bit < 8; bit++) {
            file[at] ^= std::byte(1 << bit);
            Result<void> read = kind.read(file, "a.ovl");
            file[at] ^= std::byte(1 << bit);
            ASSERT_FALSE(read) << "byte " << at << " bit " << bit;
        }
    }
}

}  // namespace overlook::container::fixtures
