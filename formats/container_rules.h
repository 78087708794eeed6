// What the container's writer and reader share: where each field stands, the checksum, and how a broken rule is said.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "formats/container.h"
#include "formats/numbers.h"

namespace overlook::container {

// A text-mode copy turns CR LF or LF into something else, an 8-bit-unclean one clears the first byte's top bit.
inline constexpr std::string_view kMagic{"\x89OVL\r\n\x1a\n", 8};

// Offsets within the header, in bytes.
namespace header_at {
constexpr size_t major = 8, minor = 10, section_count = 12, file_bytes = 16, checksum = 24, kind = 32, reserved = 36;
}
// Offsets within a table entry, in bytes.
namespace entry_at {
constexpr size_t tag = 0, flags = 4, offset = 8, stored_bytes = 16, raw_bytes = 24, codec = 32, reserved_word = 36, checksum = 40,
                 reserved = 48;
}

constexpr uint64_t padded(uint64_t bytes) {
    return (bytes + (kAlignment - 1)) / kAlignment * kAlignment;
}

// Whether all four bytes are printable ASCII, space to '~'.
bool is_printable(Tag tag);

// XXH3-64 of header and table (kFirstSectionOffset bytes), the checksum's own eight bytes taken as zero.
uint64_t checksum_of_head(std::span<const std::byte> head);
uint64_t checksum_of(std::span<const std::byte> bytes);

// The error of a broken rule: "NAME: C5: TEXT".
template <class... Args>
tl::unexpected<Error> broken(int rule, const std::string& name, fmt::format_string<Args...> text, Args&&... args) {
    return bad_input("{}: C{}: {}", name, rule, fmt::format(text, std::forward<Args>(args)...));
}

// Provenance as canonical JSON: keys in order, no white space, UTF-8. Fails with Exit::our_bug if an option's name stands twice.
Result<std::string> json_from_provenance(const Provenance& provenance);
// `reason` of the failure stands in a C23 message. The text may be hostile; at most kMaxProvenanceBytes.
tl::expected<Provenance, std::string> provenance_from_json(std::string_view text);

}  // namespace overlook::container
