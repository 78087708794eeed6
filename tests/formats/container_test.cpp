#include "formats/container.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <sstream>

#include "tests/formats/scratch_folder.h"

namespace overlook::container {
namespace {

using Bytes = std::vector<std::byte>;

std::span<const std::byte> bytes_of(std::string_view text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

std::string text_of(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Provenance example_provenance() {
    return {.program = "demo",
            .version = "0.1.0",
            .options = {{"error", "0.5 m"}},
            .inputs = {{"valley.tif", "0123456789abcdef0123456789abcdef"}}};
}

Result<uint64_t> write_example(const std::string& path) {
    Result<Writer> writer = Writer::create(path, tag("DEMO"));
    if (!writer) return tl::unexpected(writer.error());
    if (auto added = writer->add(tag("NOTE"), kMustUnderstand, Codec::none, bytes_of("Hello, valley\n")); !added) {
        return tl::unexpected(added.error());
    }
    if (auto added = writer->add_provenance(example_provenance()); !added) return tl::unexpected(added.error());
    return writer->commit();
}

// Numbers that repeat only roughly, as baked ones do; the same on every machine.
Bytes test_numbers(size_t count) {
    Bytes bytes(count);
    uint32_t state = 1;
    for (std::byte& b : bytes) {
        state = state * 1664525u + 1013904223u;
        b = std::byte((state >> 24) & (state >> 16) & 0x1f);
    }
    return bytes;
}

// The block ```hexdump of the document as bytes.
Bytes bytes_of_documented_example(const std::string& document) {
    std::istringstream lines(document.substr(document.find("```hexdump\n") + 11));
    Bytes bytes;
    bool repeats = false;
    for (std::string line; std::getline(lines, line) && line != "```";) {
        if (line == "*") {
            repeats = true;
            continue;
        }
        size_t offset = std::strtoull(line.c_str(), nullptr, 16);
        while (repeats && bytes.size() >= 16 && bytes.size() < offset) {
            Bytes last(bytes.end() - 16, bytes.end());
            bytes.insert(bytes.end(), last.begin(), last.end());
        }
        repeats = false;
        EXPECT_EQ(bytes.size(), offset);
        if (line.size() < 60) continue;  // the last line is an offset alone
        std::istringstream digits(line.substr(8, line.find('|') - 8));
        for (std::string pair; digits >> pair;) bytes.push_back(std::byte(std::stoul(pair, nullptr, 16)));
    }
    return bytes;
}

TEST(ContainerDocument, ShowsTheVeryBytesThatTheWriterWrites) {
    Bytes documented = bytes_of_documented_example(text_of_file(OVERLOOK_SOURCE_DIR "/formats/spec/container.md"));
    ScratchFolder folder;
    Result<uint64_t> size = write_example(folder / "hello.ovl");
    ASSERT_TRUE(size) << size.error().message;
    EXPECT_EQ(*size, documented.size());
    EXPECT_EQ(text_of_file(folder / "hello.ovl"), text_of(documented));

    Result<Reader> reader = Reader::open_bytes(documented, "container.md");
    ASSERT_TRUE(reader) << reader.error().message;
    EXPECT_EQ(text_of(*reader->read(*reader->find(tag("NOTE")), 100)), "Hello, valley\n");
    EXPECT_TRUE(reader->provenance());
}

TEST(ContainerDocument, HasTheSentenceOfEveryRule) {
    std::string document = text_of_file(OVERLOOK_SOURCE_DIR "/formats/spec/container.md");
    for (int rule = 1; rule <= rule_count(); rule++) {
        std::string row = fmt::format("\n| C{} | {} | {} |", rule, rule <= 18 ? "open" : "read", rule_text(rule));
        EXPECT_NE(document.find(row), std::string::npos) << row;
    }
    EXPECT_EQ(document.find(fmt::format("| C{} |", rule_count() + 1)), std::string::npos);
    EXPECT_EQ(rule_text(0), "");
    EXPECT_EQ(rule_text(rule_count() + 1), "");
}

TEST(Container, GivesBackWhatWasWritten) {
    ScratchFolder folder;
    Bytes numbers = test_numbers(300000);
    {
        Result<Writer> writer = Writer::create(folder / "a.ovl", tag("DEMO"));
        ASSERT_TRUE(writer);
        ASSERT_TRUE(writer->add(tag("NONE"), 0, Codec::none, {}));
        ASSERT_TRUE(writer->add(tag("ZERO"), 0, Codec::zstd, {}));
        ASSERT_TRUE(writer->add(tag("NUMS"), kMustUnderstand, Codec::zstd, numbers));
        ASSERT_TRUE(writer->begin(tag("PART"), kCheckedInParts));
        for (size_t at = 0; at < numbers.size(); at += 70001) {
            ASSERT_TRUE(writer->append(std::span(numbers).subspan(at, std::min<size_t>(70001, numbers.size() - at))));
            ASSERT_TRUE(writer->append({}));
        }
        ASSERT_TRUE(writer->end());
        ASSERT_TRUE(writer->commit());
    }

    Result<Reader> reader = Reader::open(folder / "a.ovl");
    ASSERT_TRUE(reader) << reader.error().message;
    EXPECT_EQ(reader->kind(), tag("DEMO"));
    EXPECT_EQ(reader->file_bytes(), std::filesystem::file_size(folder / "a.ovl"));
    ASSERT_EQ(reader->sections().size(), 4u);
    EXPECT_TRUE(reader->read(*reader->find(tag("NONE")), 0)->empty());
    EXPECT_TRUE(reader->read(*reader->find(tag("ZERO")), 0)->empty());
    EXPECT_EQ(*reader->read(*reader->find(tag("NUMS")), numbers.size()), numbers);
    EXPECT_LT(reader->find(tag("NUMS"))->stored_bytes, numbers.size() * 3 / 4);

    const Section& parts = *reader->find(tag("PART"));
    EXPECT_EQ(parts.flags, kCheckedInParts);
    EXPECT_TRUE(reader->check(parts));
    EXPECT_TRUE(std::ranges::equal(reader->stored(parts), numbers));
    EXPECT_EQ(reader->find(tag("LOST")), nullptr);
}

TEST(Container, StaysReadableWhenItsReaderMoves) {
    ScratchFolder folder;
    ASSERT_TRUE(write_example(folder / "a.ovl"));
    Result<Reader> reader = Reader::open(folder / "a.ovl");
    ASSERT_TRUE(reader);
    Reader moved = std::move(*reader);
    EXPECT_EQ(text_of(*moved.read(*moved.find(tag("NOTE")), 100)), "Hello, valley\n");
}

TEST(Container, IsTheSameBytesEachTimeAndUnderEachName) {
    ScratchFolder folder;
    for (const char* name : {"a.ovl", "other name.ovl"}) {
        Result<Writer> writer = Writer::create(folder / name, tag("DEMO"));
        ASSERT_TRUE(writer);
        ASSERT_TRUE(writer->add(tag("NUMS"), 0, Codec::zstd, test_numbers(100000)));
        ASSERT_TRUE(writer->add_provenance(example_provenance()));
        ASSERT_TRUE(writer->commit());
    }
    EXPECT_EQ(text_of_file(folder / "a.ovl"), text_of_file(folder / "other name.ovl"));
}

TEST(Container, HoldsAsManySectionsAsItsTableHasRoomFor) {
    ScratchFolder folder;
    Result<Writer> writer = Writer::create(folder / "a.ovl", tag("DEMO"));
    ASSERT_TRUE(writer);
    for (uint32_t i = 0; i < kMaxSections; i++) {
        ASSERT_TRUE(writer->add(tag("S000") + (i << 24), 0, Codec::none, bytes_of(std::string(i, 's'))));
    }
    Result<void> more = writer->add(tag("MORE"), 0, Codec::none, {});
    ASSERT_FALSE(more);
    EXPECT_EQ(more.error().exit, Exit::our_bug);
    ASSERT_TRUE(writer->commit());
    Result<Reader> reader = Reader::open(folder / "a.ovl");
    ASSERT_TRUE(reader) << reader.error().message;
    ASSERT_EQ(reader->sections().size(), kMaxSections);
    for (uint32_t i = 0; i < kMaxSections; i++) EXPECT_EQ(reader->sections()[i].raw_bytes, i);
}

TEST(ContainerWriter, RefusesToBreakARule) {
    ScratchFolder folder;
    Result<Writer> writer = Writer::create(folder / "a.ovl", tag("DEMO"));
    ASSERT_TRUE(writer);
    ASSERT_TRUE(writer->add(tag("NOTE"), 0, Codec::none, {}));
    auto expect_our_bug = [&](Result<void> done, const std::string& words) {
        ASSERT_FALSE(done) << words;
        EXPECT_EQ(done.error().exit, Exit::our_bug);
        EXPECT_NE(done.error().message.find(words), std::string::npos) << done.error().message;
    };
    expect_our_bug(writer->add(tag("NOTE"), 0, Codec::none, {}), "C9");
    expect_our_bug(writer->add(tag("N\tTE"), 0, Codec::none, {}), "C8");
    expect_our_bug(writer->add(tag("MORE"), 4, Codec::none, {}), "C10");
    expect_our_bug(writer->add(tag("MORE"), 0, Codec(2), {}), "C11");
    expect_our_bug(writer->add(tag("MORE"), kCheckedInParts, Codec::zstd, {}), "C12");
    expect_our_bug(writer->append({}), "outside a section");
    expect_our_bug(writer->end(), "not begun");
    ASSERT_TRUE(writer->begin(tag("OPEN"), 0));
    expect_our_bug(writer->begin(tag("MORE"), 0), "inside another");
    EXPECT_EQ(writer->commit().error().exit, Exit::our_bug);
    ASSERT_TRUE(writer->end());
    ASSERT_TRUE(writer->commit());
    EXPECT_TRUE(Reader::open(folder / "a.ovl"));
    EXPECT_EQ(Writer::create(folder / "b.ovl", 0).error().exit, Exit::our_bug);
}

TEST(ContainerWriter, LeavesTheOldFileIfNotCommitted) {
    ScratchFolder folder;
    ASSERT_TRUE(write_example(folder / "a.ovl"));
    std::string before = text_of_file(folder / "a.ovl");
    {
        Result<Writer> writer = Writer::create(folder / "a.ovl", tag("DEMO"));
        ASSERT_TRUE(writer->begin(tag("OPEN"), 0));
        ASSERT_TRUE(writer->append(bytes_of("half a section")));
    }
    EXPECT_EQ(text_of_file(folder / "a.ovl"), before);
    EXPECT_EQ(folder.names(), std::set<std::string>{"a.ovl"});
}

TEST(ContainerWriter, PassesOnThatItCannotWrite) {
    ScratchFolder folder;
    Result<uint64_t> size = write_example(folder / "none/a.ovl");
    ASSERT_FALSE(size);
    EXPECT_EQ(size.error().exit, Exit::cannot_write);
}

TEST(ContainerReader, SaysWhatItCouldNotOpen) {
    ScratchFolder folder;
    Result<Reader> reader = Reader::open(folder / "none.ovl");
    ASSERT_FALSE(reader);
    EXPECT_EQ(reader.error().exit, Exit::bad_input);
    EXPECT_EQ(reader.error().message, folder.path() + "/none.ovl: No such file or directory");
}

TEST(ContainerReader, LetsUnknownSectionsPassUnlessTheyMustBeUnderstood) {
    ScratchFolder folder;
    ASSERT_TRUE(write_example(folder / "a.ovl"));
    Result<Reader> reader = Reader::open(folder / "a.ovl");
    ASSERT_TRUE(reader);
    EXPECT_TRUE(reader->require_known(std::array{tag("NOTE")}));  // PROV is not, and need not be
    EXPECT_FALSE(reader->require_known(std::array{tag("PROV")}));
}

TEST(Provenance, ComesBackWithItsOptionsInOrder) {
    ScratchFolder folder;
    Provenance given = example_provenance();
    given.options = {{"z", "1"}, {"a", "two \"words\"\n"}, {"", ""}};
    given.inputs.push_back({"a.tif", std::string(32, '0')});
    Result<Writer> writer = Writer::create(folder / "a.ovl", tag("DEMO"));
    ASSERT_TRUE(writer);
    ASSERT_TRUE(writer->add_provenance(given));
    ASSERT_TRUE(writer->commit());

    Result<Provenance> read = Reader::open(folder / "a.ovl")->provenance();
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->program, given.program);
    EXPECT_EQ(read->version, given.version);
    std::sort(given.options.begin(), given.options.end());
    EXPECT_EQ(read->options, given.options);
    ASSERT_EQ(read->inputs.size(), 2u);
    EXPECT_EQ(read->inputs[0].name, "valley.tif");
    EXPECT_EQ(read->inputs[1].name, "a.tif");
    EXPECT_EQ(read->inputs[1].hash, std::string(32, '0'));
}

TEST(Provenance, OfANameThatIsNotUtf8IsReadableAllTheSame) {
    ScratchFolder folder;
    Provenance given = example_provenance();
    given.inputs[0].name = "val\xffley.tif";
    Result<Writer> writer = Writer::create(folder / "a.ovl", tag("DEMO"));
    ASSERT_TRUE(writer->add_provenance(given));
    ASSERT_TRUE(writer->commit());
    Result<Provenance> read = Reader::open(folder / "a.ovl")->provenance();
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->inputs[0].name, "val\xef\xbf\xbdley.tif");
}

TEST(Provenance, ThatCouldNotBeReadIsNotWritten) {
    ScratchFolder folder;
    Result<Writer> writer = Writer::create(folder / "a.ovl", tag("DEMO"));
    ASSERT_TRUE(writer);
    auto exit_of = [&](auto change) {
        Provenance given = example_provenance();
        change(given);
        Result<void> added = writer->add_provenance(given);
        return added ? Exit::done : added.error().exit;
    };
    EXPECT_EQ(exit_of([](Provenance& p) { p.inputs[0].hash = "00"; }), Exit::our_bug);
    EXPECT_EQ(exit_of([](Provenance& p) { p.inputs[0].name = "folder/valley.tif"; }), Exit::our_bug);
    EXPECT_EQ(exit_of([](Provenance& p) { p.options.push_back(p.options[0]); }), Exit::our_bug);
    EXPECT_EQ(exit_of([](Provenance& p) { p.program = std::string(kMaxProvenanceBytes, 'p'); }), Exit::our_bug);
    EXPECT_EQ(exit_of([](Provenance&) {}), Exit::done);
}

TEST(Tags, ReadWellInTextAndInTheFile) {
    EXPECT_EQ(tag("TERR"), 0x52524554u);
    EXPECT_EQ(tag_text(tag("TERR")), "TERR");
    EXPECT_EQ(tag_text(0x7f20004eu), "N? ?");
}

}  // namespace
}  // namespace overlook::container
