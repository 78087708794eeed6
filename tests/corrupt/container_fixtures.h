// Small container files made byte by byte, without the writer: whole ones, and for every rule files that break it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/container.h"

namespace overlook::container::fixtures {

using Bytes = std::vector<std::byte>;

Bytes bytes_of(std::string_view text);

// A section as it is laid out: any nonsense is allowed.
struct RawSection {
    std::string_view tag;  // four bytes
    uint32_t flags = 0;
    uint32_t codec = 0;
    Bytes stored;
    uint64_t raw_bytes = 0;
};

// A file of kind DEMO with sections one after another, as formats/spec/container.md says.
Bytes file_of(std::span<const RawSection> sections);

// Fills in the header's checksum.
void seal(Bytes& file);

struct Fixture {
    std::string name;  // of the file; a corrupt one begins with its rule: "c05_checksum.ovl"
    int rule = 0;      // the rule it breaks; 0 = none
    Bytes bytes;
};

// The name in a test's listing.
void PrintTo(const Fixture& fixture, std::ostream* out);

std::vector<Fixture> whole_files();
std::vector<Fixture> corrupt_files();

// What a careful program does with a file of kind DEMO: open it, refuse unknown sections, read all (each at most
// kMostRawBytes), read where it came from. The first failure is returned.
constexpr uint64_t kMostRawBytes = 1 << 20;
Result<void> read_everything(std::span<const std::byte> file, const std::string& name);

// The rule that a message names (with letter 'C': "a.ovl: C5: ..." -> 5), 0 if none.
int rule_in(char letter, const std::string& message);

}  // namespace overlook::container::fixtures
