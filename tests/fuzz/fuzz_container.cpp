// Any bytes as a baked file: opened, every section read, provenance read. Nothing may crash, leak or take memory without bound.
#include <cstdint>
#include <vector>

#include "tests/fuzz/fuzz_sections.h"

namespace {

using namespace overlook;
using namespace overlook::container;

constexpr uint64_t kMostRawBytes = 1 << 20;

void read_all(std::span<const std::byte> bytes) {
    Result<Reader> reader = Reader::open_bytes(bytes, "fuzz");
    if (!reader) return;
    const Tag known[] = {kProvenanceTag};
    bool is_known = reader->require_known(known).has_value();
    for (const Section& section : reader->sections()) {
        Result<std::vector<std::byte>> raw = reader->read(section, kMostRawBytes);
        if (raw && raw->size() != section.raw_bytes) __builtin_trap();
        if (raw && !reader->check(section)) __builtin_trap();
    }
    Result<Provenance> provenance = reader->provenance();
    if (is_known && provenance && !json_from_provenance(*provenance)) __builtin_trap();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    std::span<const std::byte> given(reinterpret_cast<const std::byte*>(data), size);
    read_all(given);
    std::vector<std::byte> mended(given.begin(), given.end());
    if (size < kFirstSectionOffset) return 0;
    fuzz::mend(mended);
    read_all(mended);
    return 0;
}
