#include "formats/container_rules.h"

#include <xxhash.h>

#include <algorithm>
#include <array>

#include "formats/little_endian.h"

namespace overlook::container {
namespace {

// The sentences of formats/spec/container.md, in the order in which a reader checks them.
constexpr std::array<std::string_view, 23> kRules = {
    // The header: whoever breaks one of these says nothing about the rest.
    "The file begins with the eight bytes 89 4F 56 4C 0D 0A 1A 0A.",
    "The file is at least 4,096 bytes long, the room of its header and its table.",
    "The major version is 1.",
    "The header's file length is the length of the file.",
    "The header's checksum is the XXH3-64 of the first 4,096 bytes with its own eight bytes taken as zero.",
    "The section count is at most 63.",
    "Reserved bytes are zero: in the header, in every entry, and in the whole of every entry beyond the section count.",
    "The kind and every tag are four printable ASCII characters (20 to 7E).",
    // The table, entry by entry.
    "No tag stands in the table twice.",
    "Only the flags 1 (must understand) and 2 (checked in parts) are set.",
    "The codec is 0 (none) or 1 (zstd).",
    "A section checked in parts has codec 0.",
    "A section with codec 0 has as many stored bytes as raw bytes.",
    "A section's offset is a multiple of 64.",
    "A section begins where the one before it ends, rounded up to 64; the first begins at 4,096.",
    "A section ends within the file.",
    "The file ends where its last section ends, rounded up to 64; at 4,096 if it has none.",
    "The bytes between a section's end and the next multiple of 64 are zero.",
    // When a section is read.
    "A section's raw bytes are at most what the format of the section allows.",
    "A section's checksum is the XXH3-64 of its stored bytes.",
    "A section with codec 1 is one zstd frame that states its content size and decodes to exactly the raw bytes.",
    "A section flagged 1 (must understand) has a tag that the reader knows.",
    "Provenance is canonical JSON of exactly the keys inputs, options, program and version.",
};

}  // namespace

std::string_view rule_text(int rule) {
    return rule >= 1 && rule <= rule_count() ? kRules[size_t(rule - 1)] : std::string_view();
}

int rule_count() {
    return int(kRules.size());
}

bool is_printable(Tag tag) {
    for (int shift = 0; shift < 32; shift += 8) {
        uint32_t character = (tag >> shift) & 0xff;
        if (character < 0x20 || character > 0x7e) return false;
    }
    return true;
}

std::string tag_text(Tag tag) {
    std::string text;
    for (int shift = 0; shift < 32; shift += 8) {
        uint32_t character = (tag >> shift) & 0xff;
        text += character < 0x20 || character > 0x7e ? '?' : char(character);
    }
    return text;
}

uint64_t checksum_of(std::span<const std::byte> bytes) {
    return XXH3_64bits(bytes.data(), bytes.size());
}

uint64_t checksum_of_head(std::span<const std::byte> head) {
    std::array<std::byte, kFirstSectionOffset> copy;
    std::copy_n(head.begin(), copy.size(), copy.begin());
    store_le<uint64_t>(copy, header_at::checksum, 0);
    return checksum_of(copy);
}

}  // namespace overlook::container
