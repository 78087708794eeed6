#include "tests/corrupt/container_fixtures.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <ostream>

#include "formats/container_rules.h"
#include "formats/little_endian.h"

namespace overlook::container::fixtures {
namespace {

constexpr size_t kTable = 64, kFirst = 4096;

size_t entry(size_t index) {
    return kTable + 64 * index;
}

void put(Bytes& file, size_t offset, std::string_view text) {
    for (size_t i = 0; i < text.size(); i++) file[offset + i] = std::byte(text[i]);
}

void pad(Bytes& file) {
    file.resize((file.size() + 63) / 64 * 64);
}

Bytes join(std::initializer_list<std::string_view> parts) {
    Bytes all;
    for (std::string_view part : parts) {
        for (char c : part) all.push_back(std::byte(c));
    }
    return all;
}

using namespace std::string_view_literals;

// Zstandard frames by hand (RFC 8878), so that no version of the library changes a fixture.
constexpr std::string_view kFrameMagic = "\x28\xb5\x2f\xfd"sv;
constexpr std::string_view kTinySize = "\x20"sv;  // single segment, content size in one byte

// One raw block, "echo\n" (5 bytes).
Bytes echo_frame() {
    return join({kFrameMagic, kTinySize, "\x05"sv, "\x29\x00\x00"sv, "echo\n"sv});
}

// `blocks` blocks of 128 KiB, each a repeated byte; states `stated` bytes of content.
Bytes long_frame(uint32_t blocks, uint32_t stated) {
    Bytes frame = join({kFrameMagic, "\xa0"sv});  // single segment, content size in four bytes
    frame.resize(frame.size() + 4);
    store_le<uint32_t>(frame, 5, stated);
    for (uint32_t i = 0; i < blocks; i++) {
        uint32_t header = (131072u << 3) | (1u << 1) | (i + 1 == blocks ? 1u : 0u);
        for (int shift = 0; shift < 24; shift += 8) frame.push_back(std::byte((header >> shift) & 0xff));
        frame.push_back(std::byte('x'));
    }
    return frame;
}

constexpr std::string_view kProvenanceText = R"({"inputs":[{"hash":"0123456789abcdef0123456789abcdef","name":"valley.tif"}],)"
                                             R"("options":{"error":"0.5 m"},"program":"demo","version":"0.1.0"})";

RawSection plain(std::string_view tag, std::string_view text, uint32_t flags = 0) {
    return {tag, flags, 0, bytes_of(text), text.size()};
}
RawSection note() {
    return plain("NOTE", "Hello, valley\n", 1);
}
RawSection zipped(Bytes frame, uint64_t raw_bytes) {
    return {"ZIPD", 0, 1, std::move(frame), raw_bytes};
}
RawSection origin(std::string_view text = kProvenanceText) {
    return plain("PROV", text);
}

// The whole file that most corrupt ones begin as.
Bytes whole() {
    return file_of(std::array{note(), zipped(echo_frame(), 5), origin()});
}

template <class T>
Bytes with(size_t offset, T value) {
    Bytes file = whole();
    store_le<T>(file, offset, value);
    seal(file);
    return file;
}

Bytes with_frame(Bytes frame, uint64_t raw_bytes) {
    return file_of(std::array{note(), zipped(std::move(frame), raw_bytes), origin()});
}
Bytes with_origin(std::string_view text) {
    return file_of(std::array{note(), origin(text)});
}

Bytes resized(size_t size) {
    Bytes file = whole();
    file.resize(size);
    return file;
}

// One more block of zeros at the end, which the header knows of.
Bytes with_loose_end() {
    Bytes file = whole();
    file.resize(file.size() + 64);
    store_le<uint64_t>(file, 16, file.size());
    seal(file);
    return file;
}

Bytes with_text_line_ends() {
    Bytes file = whole();
    file.erase(file.begin() + 4);
    file.push_back(std::byte(0));
    return file;
}

Bytes with_entries_swapped() {
    Bytes file = whole();
    std::swap_ranges(file.begin() + long(entry(0)), file.begin() + long(entry(1)), file.begin() + long(entry(1)));
    seal(file);
    return file;
}

Bytes with_gap() {
    Bytes file = whole();
    file.insert(file.begin() + kFirst + 64, 64, std::byte(0));
    store_le<uint64_t>(file, 16, file.size());
    for (size_t i : {1u, 2u}) store_le<uint64_t>(file, entry(i) + 8, load_le<uint64_t>(file, entry(i) + 8) + 64);
    seal(file);
    return file;
}

Bytes with_sizes(size_t index, uint64_t bytes) {
    Bytes file = whole();
    store_le<uint64_t>(file, entry(index) + 16, bytes);
    store_le<uint64_t>(file, entry(index) + 24, bytes);
    seal(file);
    return file;
}

Bytes with_byte(size_t offset, uint8_t value) {
    Bytes file = whole();
    file[offset] = std::byte(value);
    return file;
}

std::vector<Fixture> broken_headers() {
    return {{"c01_empty.ovl", 1, {}},
            {"c01_shorter_than_magic.ovl", 1, resized(5)},
            {"c01_not_baked.ovl", 1, bytes_of("P6\n1 1\n255\nabc")},
            {"c01_text_mode.ovl", 1, with_text_line_ends()},
            {"c02_cut_in_header.ovl", 2, resized(20)},
            {"c02_cut_in_table.ovl", 2, resized(4095)},
            {"c03_major_2.ovl", 3, with<uint16_t>(8, 2)},
            {"c04_cut_short.ovl", 4, resized(whole().size() - 64)},
            {"c04_appended.ovl", 4, resized(whole().size() + 64)},
            {"c04_length_zero.ovl", 4, with<uint64_t>(16, 0)},
            {"c05_checksum.ovl", 5, with_byte(24, 0x55)},
            {"c05_table_bit.ovl", 5, with_byte(entry(0) + 40, 0x55)},
            {"c06_64_sections.ovl", 6, with<uint32_t>(12, 64)},
            {"c06_most_sections.ovl", 6, with<uint32_t>(12, 0xffffffff)},
            {"c07_header_reserved.ovl", 7, with<uint8_t>(63, 1)},
            {"c07_entry_word.ovl", 7, with<uint32_t>(entry(1) + 36, 1)},
            {"c07_entry_tail.ovl", 7, with<uint64_t>(entry(2) + 48, 1)},
            {"c07_unused_entry.ovl", 7, with<uint8_t>(entry(62) + 63, 1)},
            {"c08_kind.ovl", 8, with<uint32_t>(32, 0)},
            {"c08_tag.ovl", 8, with<uint8_t>(entry(0) + 3, 0x7f)}};
}

std::vector<Fixture> broken_tables() {
    return {{"c09_tag_twice.ovl", 9, with<uint32_t>(entry(1), tag("NOTE"))},
            {"c10_flag_4.ovl", 10, with<uint32_t>(entry(0) + 4, 4)},
            {"c10_highest_flag.ovl", 10, with<uint32_t>(entry(2) + 4, 0x80000000)},
            {"c11_codec_2.ovl", 11, with<uint32_t>(entry(1) + 32, 2)},
            {"c12_parts_compressed.ovl", 12, with<uint32_t>(entry(1) + 4, 2)},
            {"c13_sizes_differ.ovl", 13, with<uint64_t>(entry(0) + 24, 15)},
            {"c14_not_aligned.ovl", 14, with<uint64_t>(entry(1) + 8, kFirst + 65)},
            {"c15_overlap.ovl", 15, with<uint64_t>(entry(1) + 8, kFirst)},
            {"c15_in_table.ovl", 15, with<uint64_t>(entry(0) + 8, 0)},
            {"c15_gap.ovl", 15, with_gap()},
            {"c15_out_of_order.ovl", 15, with_entries_swapped()},
            {"c16_one_byte_over.ovl", 16, with_sizes(2, whole().size() - (kFirst + 128) + 1)},
            {"c16_sum_wraps.ovl", 16, with_sizes(2, uint64_t(0) - kFirst)},
            {"c16_most_bytes.ovl", 16, with_sizes(0, ~uint64_t(0))},
            {"c17_loose_end.ovl", 17, with_loose_end()},
            {"c18_after_first.ovl", 18, with_byte(kFirst + 14, 1)},
            {"c18_last_byte.ovl", 18, with_byte(whole().size() - 1, 1)}};
}

std::vector<Fixture> broken_sections() {
    std::string deep = std::string(100000, '[');
    return {
        {"c19_two_mebibytes.ovl", 19, with_frame(long_frame(16, 1 << 21), 1 << 21)},
        {"c20_first_byte.ovl", 20, with_byte(kFirst, 'J')},
        {"c20_in_frame.ovl", 20, with_byte(kFirst + 64 + 9, 'E')},
        {"c21_not_zstd.ovl", 21, with_frame(bytes_of("not a frame"), 11)},
        {"c21_no_bytes.ovl", 21, with_frame({}, 0)},
        {"c21_skippable_frame.ovl", 21, with_frame(join({"\x50\x2a\x4d\x18\x00\x00\x00\x00"sv}), 0)},
        {"c21_other_size.ovl", 21, with_frame(echo_frame(), 6)},
        {"c21_size_not_stated.ovl", 21, with_frame(join({kFrameMagic, "\x00\x00"sv, "\x29\x00\x00"sv, "echo\n"sv}), 5)},
        {"c21_frame_cut.ovl", 21, with_frame(join({kFrameMagic, kTinySize, "\x05"sv, "\x29\x00\x00"sv, "echo"sv}), 5)},
        {"c21_bytes_after_frame.ovl", 21, with_frame(join({kFrameMagic, kTinySize, "\x05"sv, "\x29\x00\x00"sv, "echo\n!"sv}), 5)},
        {"c21_fewer_bytes.ovl", 21, with_frame(join({kFrameMagic, kTinySize, "\x06"sv, "\x29\x00\x00"sv, "echo\n"sv}), 6)},
        {"c21_cannot_expand_so_far.ovl", 21, with_frame(long_frame(1, 1 << 20), 1 << 20)},
        {"c22_unknown_section.ovl", 22, file_of(std::array{plain("NEWS", "later", 1), origin()})},
        {"c23_none.ovl", 23, file_of(std::array{note()})},
        {"c23_not_json.ovl", 23, with_origin("{\"inputs\":[")},
        {"c23_deep.ovl", 23, with_origin(deep)},
        {"c23_not_utf8.ovl", 23, with_origin("{\"inputs\":[],\"options\":{},\"program\":\"\xff\",\"version\":\"1\"}")},
        {"c23_key_more.ovl", 23, with_origin(R"({"date":"today","inputs":[],"options":{},"program":"demo","version":"1"})")},
        {"c23_key_twice.ovl", 23, with_origin(R"({"inputs":[],"options":{},"program":"a","program":"b","version":"1"})")},
        {"c23_keys_not_in_order.ovl", 23, with_origin(R"({"inputs":[],"options":{},"version":"1","program":"demo"})")},
        {"c23_white_space.ovl", 23, with_origin(R"({"inputs": [],"options":{},"program":"demo","version":"1"})")},
        {"c23_number_as_option.ovl", 23, with_origin(R"({"inputs":[],"options":{"error":0.5},"program":"demo","version":"1"})")},
        {"c23_short_hash.ovl", 23,
         with_origin(R"({"inputs":[{"hash":"00","name":"a"}],"options":{},"program":"demo","version":"1"})")},
        {"c23_name_with_folder.ovl", 23,
         with_origin(R"({"inputs":[{"hash":"0123456789abcdef0123456789abcdef","name":"/home/a"}],)"
                     R"("options":{},"program":"demo","version":"1"})")}};
}

}  // namespace

Bytes bytes_of(std::string_view text) {
    return join({text});
}

void seal(Bytes& file) {
    store_le<uint64_t>(file, 24, checksum_of_head(file));
}

Bytes file_of(std::span<const RawSection> sections) {
    Bytes file(kFirst);
    put(file, 0, "\x89OVL\r\n\x1a\n");
    store_le<uint16_t>(file, 8, 1);
    store_le<uint32_t>(file, 12, uint32_t(sections.size()));
    put(file, 32, "DEMO");
    for (size_t i = 0; i < sections.size(); i++) {
        const RawSection& section = sections[i];
        put(file, entry(i), section.tag);
        store_le<uint32_t>(file, entry(i) + 4, section.flags);
        store_le<uint64_t>(file, entry(i) + 8, file.size());
        store_le<uint64_t>(file, entry(i) + 16, section.stored.size());
        store_le<uint64_t>(file, entry(i) + 24, section.raw_bytes);
        store_le<uint32_t>(file, entry(i) + 32, section.codec);
        store_le<uint64_t>(file, entry(i) + 40, checksum_of(section.stored));
        file.insert(file.end(), section.stored.begin(), section.stored.end());
        pad(file);
    }
    store_le<uint64_t>(file, 16, file.size());
    seal(file);
    return file;
}

void PrintTo(const Fixture& fixture, std::ostream* out) {
    *out << fixture.name;
}

std::vector<Fixture> whole_files() {
    return {{"hello.ovl", 0, file_of(std::array{note(), origin()})},
            {"no_sections.ovl", 0, file_of({})},
            {"compressed.ovl", 0, whole()},
            {"one_mebibyte.ovl", 0, with_frame(long_frame(8, 1 << 20), 1 << 20)},
            {"parts_and_empty.ovl", 0, file_of(std::array{plain("PART", std::string(64, 'p'), 2), plain("NONE", ""), origin()})}};
}

std::vector<Fixture> corrupt_files() {
    std::vector<Fixture> all = broken_headers();
    for (auto make : {broken_tables, broken_sections}) {
        for (Fixture& fixture : make()) all.push_back(std::move(fixture));
    }
    return all;
}

Result<void> read_everything(std::span<const std::byte> file, const std::string& name) {
    constexpr std::array kKnown{tag("NOTE"), tag("ZIPD"), tag("PROV")};
    Result<Reader> reader = Reader::open_bytes(file, name);
    if (!reader) return tl::unexpected(reader.error());
    if (Result<void> known = reader->require_known(kKnown); !known) return known;
    for (const Section& section : reader->sections()) {
        Result<Bytes> raw = reader->read(section, kMostRawBytes);
        if (!raw) return tl::unexpected(raw.error());
    }
    Result<Provenance> provenance = reader->provenance();
    if (!provenance) return tl::unexpected(provenance.error());
    return {};
}

int rule_in(char letter, const std::string& message) {
    size_t at = message.find(std::string(": ") + letter);
    if (at == std::string::npos) return 0;
    int rule = 0;
    for (at += 3; at < message.size() && std::isdigit(uint8_t(message[at])) != 0; at++) rule = rule * 10 + (message[at] - '0');
    return at < message.size() && message[at] == ':' ? rule : 0;
}

}  // namespace overlook::container::fixtures
