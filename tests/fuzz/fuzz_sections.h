// What the fuzz targets of baked sections share: finding the sections of any bytes, and making right what chance never would.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "formats/container_rules.h"
#include "formats/little_endian.h"

namespace overlook::container::fuzz {

// Calls visit(entry offset, tag, section's bytes) for each section that lies within the file.
template <class Visit>
void visit_sections(std::span<std::byte> file, const Visit& visit) {
    for (size_t i = 0; i < kMaxSections; i++) {
        size_t entry = kHeaderBytes + i * kEntryBytes;
        auto offset = load_le<uint64_t>(file, entry + entry_at::offset);
        auto stored = load_le<uint64_t>(file, entry + entry_at::stored_bytes);
        if (offset < kFirstSectionOffset || offset > file.size() || stored > file.size() - offset) continue;
        visit(entry, load_le<uint32_t>(file, entry + entry_at::tag), file.subspan(size_t(offset), size_t(stored)));
    }
}

// Whether no section says that it has more raw bytes than time is for.
inline bool has_small_sections(std::span<std::byte> file) {
    constexpr uint64_t kMostRawBytes = 1 << 20;
    bool small = true;
    visit_sections(file, [&](size_t entry, Tag, std::span<std::byte>) {
        if (load_le<uint64_t>(file, entry + entry_at::raw_bytes) > kMostRawBytes) small = false;
    });
    return small;
}

inline void require(bool holds) {
    if (!holds) __builtin_trap();
}

// Magic, version, length, and the checksums of sections and head.
inline void mend(std::span<std::byte> file) {
    visit_sections(file, [&](size_t entry, Tag, std::span<std::byte> bytes) {
        store_le<uint64_t>(file, entry + entry_at::checksum, checksum_of(bytes));
    });
    for (size_t i = 0; i < kMagic.size(); i++) file[i] = std::byte(kMagic[i]);
    store_le<uint16_t>(file, header_at::major, kMajor);
    store_le<uint64_t>(file, header_at::file_bytes, file.size());
    store_le<uint64_t>(file, header_at::checksum, checksum_of_head(file.first(kFirstSectionOffset)));
}

// How a kind of file keeps its blocks: a directory of entries, and a section of blocks. A kind that has none has no checksum.
struct Blocks {
    uint32_t kind;
    Tag directory, blocks;
    size_t entry_bytes, offset_at, stored_bytes_at, checksum_at;  // of a directory's entry
    uint64_t (*checksum)(std::span<const std::byte> stored);
};

// The same, and the file's kind and its blocks' checksums.
inline void mend(std::span<std::byte> file, const Blocks& kind) {
    std::span<std::byte> directory, blocks;
    visit_sections(file, [&](size_t, Tag tag, std::span<std::byte> bytes) {
        if (!kind.checksum) return;
        if (tag == kind.directory) directory = bytes;
        if (tag == kind.blocks) blocks = bytes;
    });
    for (size_t entry = 0; entry + kind.entry_bytes <= directory.size(); entry += kind.entry_bytes) {
        auto offset = load_le<uint64_t>(directory, entry + kind.offset_at);
        auto stored = load_le<uint32_t>(directory, entry + kind.stored_bytes_at);
        if (offset > blocks.size() || stored > blocks.size() - offset) continue;
        store_le<uint64_t>(directory, entry + kind.checksum_at, kind.checksum(blocks.subspan(size_t(offset), stored)));
    }
    store_le<uint32_t>(file, header_at::kind, kind.kind);
    mend(file);
}

// read_all(bytes): the bytes as they are and, if they are long enough, mended.
template <class Read>
void read_both(std::span<const std::byte> given, const Blocks& kind, bool (*is_small)(std::span<std::byte> file),
               const Read& read_all) {
    std::vector<std::byte> mended(given.begin(), given.end());
    if (mended.size() >= kFirstSectionOffset && !is_small(mended)) return;
    read_all(given);
    if (mended.size() < kFirstSectionOffset) return;
    mend(mended, kind);
    read_all(mended);
}

}  // namespace overlook::container::fuzz
