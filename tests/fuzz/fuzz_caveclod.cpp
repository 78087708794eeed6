// Any bytes as a baked mesh: nothing may crash, leak or take memory without bound; what is read keeps its promises, can be
// written again, and refined.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "formats/caveclod_layout.h"
#include "formats/container_rules.h"
#include "formats/little_endian.h"
#include "runtime/caveclod/refine.h"

namespace {

using namespace overlook;
using namespace overlook::container;

constexpr uint64_t kMostRawSurfaceBytes = 1 << 20;

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
    visit_sections(file, [&](size_t entry, Tag tag, std::span<std::byte>) {
        if (tag == caveclod::kSurfacesTag && load_le<uint64_t>(file, entry + entry_at::raw_bytes) > kMostRawSurfaceBytes)
            small = false;
    });
    return small;
}

// Makes right what chance never would: the checksums of blocks, sections and head.
void mend(std::span<std::byte> file) {
    std::span<std::byte> directory, blocks;
    visit_sections(file, [&](size_t, Tag tag, std::span<std::byte> bytes) {
        if (tag == caveclod::kDirectoryTag) directory = bytes;
        if (tag == caveclod::kBlocksTag) blocks = bytes;
    });
    namespace at = caveclod::directory_at;
    for (size_t entry = 0; entry + at::entry_bytes <= directory.size(); entry += at::entry_bytes) {
        auto offset = load_le<uint64_t>(directory, entry + at::offset);
        auto stored = load_le<uint32_t>(directory, entry + at::stored_bytes);
        if (offset > blocks.size() || stored > blocks.size() - offset) continue;
        store_le<uint64_t>(directory, entry + at::checksum, caveclod::block_checksum(blocks.subspan(size_t(offset), stored)));
    }
    visit_sections(file, [&](size_t entry, Tag, std::span<std::byte> bytes) {
        store_le<uint64_t>(file, entry + entry_at::checksum, checksum_of(bytes));
    });
    for (size_t i = 0; i < kMagic.size(); i++) file[i] = std::byte(kMagic[i]);
    store_le<uint16_t>(file, header_at::major, kMajor);
    store_le<uint64_t>(file, header_at::file_bytes, file.size());
    store_le<uint32_t>(file, header_at::kind, caveclod::kKind);
    store_le<uint64_t>(file, header_at::checksum, checksum_of_head(file.first(kFirstSectionOffset)));
}

// What the rules promise to whoever packs and refines it.
void use(const caveclod::Hierarchy& h) {
    caveclod::Packer packer(h);
    caveclod::Rows rows;
    if (packer.base(rows) != nullptr) __builtin_trap();
    for (uint32_t i = 0; i < h.split_count(); ++i)
        if (packer.split(i, rows) != nullptr) __builtin_trap();

    Result<caveclod::Mesh> mesh = caveclod::Mesh::make(h);
    if (!mesh) return;
    caveclod::Refinement refinement(*mesh);
    view::Camera camera;
    camera.position_m = h.origin_m - glm::dvec3(0, 10, 0);
    caveclod::Settings settings;
    settings.error_px = 0.01, settings.most_operations = 0;
    refinement.refine(camera, settings, 0.02);
    camera.heading_deg = 180;
    refinement.refine(camera, settings, 0.5);
}

void read_all(std::span<const std::byte> bytes) {
    Result<Reader> file = Reader::open_bytes(bytes, "fuzz");
    if (!file) return;
    Result<caveclod::Hierarchy> read = caveclod::read(*file);
    if (read) use(*read);
    if (!read && read.error().exit == Exit::our_bug) __builtin_trap();
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
