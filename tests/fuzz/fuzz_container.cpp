// Any bytes as a baked file: opened, every section read, provenance read. Nothing may crash, leak or take memory without bound.
#include <cstdint>
#include <vector>

#include "formats/container_rules.h"
#include "formats/little_endian.h"

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

// Makes right what chance never would: magic, version, length, checksums. So the fuzzer gets at what lies behind them.
void mend(std::vector<std::byte>& bytes) {
    if (bytes.size() < kFirstSectionOffset) return;
    for (size_t i = 0; i < kMagic.size(); i++) bytes[i] = std::byte(kMagic[i]);
    store_le<uint16_t>(bytes, header_at::major, kMajor);
    store_le<uint64_t>(bytes, header_at::file_bytes, bytes.size());
    for (size_t i = 0; i < kMaxSections; i++) {
        size_t entry = kHeaderBytes + i * kEntryBytes;
        auto offset = load_le<uint64_t>(bytes, entry + entry_at::offset);
        auto stored = load_le<uint64_t>(bytes, entry + entry_at::stored_bytes);
        if (offset == 0 || offset > bytes.size() || stored > bytes.size() - offset) continue;
        uint64_t checksum = checksum_of(std::span(bytes).subspan(size_t(offset), size_t(stored)));
        store_le<uint64_t>(bytes, entry + entry_at::checksum, checksum);
    }
    store_le<uint64_t>(bytes, header_at::checksum, checksum_of_head(std::span(bytes).first(kFirstSectionOffset)));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    std::span<const std::byte> given(reinterpret_cast<const std::byte*>(data), size);
    read_all(given);
    std::vector<std::byte> mended(given.begin(), given.end());
    mend(mended);
    read_all(mended);
    return 0;
}
