// Any bytes as a baked terrain: nothing may crash, leak or take memory without bound; and what is read keeps its promises and can
// be written again.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "formats/container_rules.h"
#include "formats/little_endian.h"
#include "formats/terrain_blocks.h"
#include "formats/terrain_check.h"
#include "formats/terrain_layout.h"

namespace {

using namespace overlook;
using namespace overlook::container;

constexpr uint64_t kMostSamples = 1 << 18;  // the format allows many in few bytes; here time is for other things

size_t entry_of(size_t index) {
    return kHeaderBytes + index * kEntryBytes;
}

// Calls visit(entry offset, tag, section's bytes) for each section that lies within the file.
template <class Visit>
void visit_sections(std::span<std::byte> file, const Visit& visit) {
    for (size_t i = 0; i < kMaxSections; i++) {
        auto offset = load_le<uint64_t>(file, entry_of(i) + entry_at::offset);
        auto stored = load_le<uint64_t>(file, entry_of(i) + entry_at::stored_bytes);
        if (offset < kFirstSectionOffset || offset > file.size() || stored > file.size() - offset) continue;
        visit(entry_of(i), load_le<uint32_t>(file, entry_of(i) + entry_at::tag), file.subspan(size_t(offset), size_t(stored)));
    }
}

bool is_small(std::span<std::byte> file) {
    bool small = true;
    visit_sections(file, [&](size_t, Tag tag, std::span<std::byte> bytes) {
        if (tag != terrain::kInfoTag || bytes.size() < 8) return;
        small = uint64_t(load_le<uint32_t>(bytes, 0)) * load_le<uint32_t>(bytes, 4) <= kMostSamples;
    });
    visit_sections(file, [&](size_t entry, Tag tag, std::span<std::byte>) {
        if (tag == terrain::kTextureTag && load_le<uint64_t>(file, entry + entry_at::raw_bytes) > 1 << 20) small = false;
    });
    return small;
}

// Makes right what chance never would: the checksums of blocks, sections and head.
void mend(std::span<std::byte> file) {
    std::span<std::byte> directory, blocks;
    visit_sections(file, [&](size_t, Tag tag, std::span<std::byte> bytes) {
        if (tag == terrain::kDirectoryTag) directory = bytes;
        if (tag == terrain::kBlocksTag) blocks = bytes;
    });
    for (size_t at = 0; at + terrain::directory_at::entry_bytes <= directory.size(); at += terrain::directory_at::entry_bytes) {
        auto offset = load_le<uint64_t>(directory, at + terrain::directory_at::offset);
        auto stored = load_le<uint32_t>(directory, at + terrain::directory_at::stored_bytes);
        if (offset > blocks.size() || stored > blocks.size() - offset) continue;
        store_le<uint64_t>(directory, at + terrain::directory_at::checksum,
                           terrain::block_checksum(blocks.subspan(size_t(offset), stored)));
    }
    visit_sections(file, [&](size_t entry, Tag, std::span<std::byte> bytes) {
        store_le<uint64_t>(file, entry + entry_at::checksum, checksum_of(bytes));
    });
    for (size_t i = 0; i < kMagic.size(); i++) file[i] = std::byte(kMagic[i]);
    store_le<uint16_t>(file, header_at::major, kMajor);
    store_le<uint64_t>(file, header_at::file_bytes, file.size());
    store_le<uint32_t>(file, header_at::kind, terrain::kKind);
    store_le<uint64_t>(file, header_at::checksum, checksum_of_head(file.first(kFirstSectionOffset)));
}

// What the rules promise to whoever draws it.
void use(const terrain::Terrain& read) {
    if (read.heights.size() != uint64_t(read.shape.width) * read.shape.height || read.codes.size() != read.shape.root_log2)
        __builtin_trap();
    if (terrain::find_code_above_parent(read) || terrain::find_unmarked_void(read)) __builtin_trap();

    terrain::Terrain again = read;
    for (auto& level : again.codes) std::fill(level.begin(), level.end(), uint8_t(0));
    std::fill(again.heights.begin(), again.heights.end(), 0);
    for (const terrain::Block& block : terrain::blocks_of(read.shape)) {
        std::vector<std::byte> raw = terrain::pack_block(read, block);
        if (raw.size() > terrain::packed_bytes_max(read.shape, block) || terrain::unpack_block(raw, block, again) != nullptr)
            __builtin_trap();
    }
    if (again.heights != read.heights || again.codes != read.codes) __builtin_trap();
}

void read_all(std::span<const std::byte> bytes) {
    Result<Reader> file = Reader::open_bytes(bytes, "fuzz");
    if (!file) return;
    Result<terrain::Terrain> read = terrain::read(*file);
    if (read) use(*read);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    std::span<const std::byte> given(reinterpret_cast<const std::byte*>(data), size);
    std::vector<std::byte> mended(given.begin(), given.end());
    if (size >= kFirstSectionOffset && !is_small(mended)) return 0;
    read_all(given);
    if (size < kFirstSectionOffset) return 0;
    mend(mended);
    read_all(mended);
    return 0;
}
