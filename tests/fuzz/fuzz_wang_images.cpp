// Any bytes as layered depth images: nothing may crash, leak or take memory without bound; what is read keeps its promises and
// packs into the same again.
#include <cstdint>
#include <vector>

#include "formats/wang_ldi_grouped.h"
#include "formats/wang_ldi_layout.h"
#include "tests/fuzz/fuzz_sections.h"

namespace {

using namespace overlook;
using namespace overlook::container;
using fuzz::require;

constexpr uint64_t kMostRawBytes = 1 << 20;

// Entries stand after a head whose length is not fixed: their checksums are mended by mend_images below.
constexpr fuzz::Blocks kBlocks{container::tag("WANG"), 0, 0, 64, 0, 0, 0, nullptr};

void mend_images(std::span<std::byte> file) {
    std::span<std::byte> directory, images;
    fuzz::visit_sections(file, [&](size_t, Tag tag, std::span<std::byte> bytes) {
        if (tag == wang_ldi::kDirectoryTag) directory = bytes;
        if (tag == wang_ldi::kImagesTag) images = bytes;
    });
    if (directory.size() < wang_ldi::head_at::bytes) return;
    uint64_t levels = load_le<uint32_t>(directory, wang_ldi::head_at::levels);
    size_t at = wang_ldi::head_at::bytes + wang_ldi::level_at::entry_bytes * std::min<size_t>(levels, 32);
    for (; at + wang_ldi::ldi_at::entry_bytes <= directory.size(); at += wang_ldi::ldi_at::entry_bytes) {
        auto offset = load_le<uint64_t>(directory, at);
        auto stored = load_le<uint32_t>(directory, at + wang_ldi::ldi_at::stored_bytes);
        if (offset > images.size() || stored > images.size() - offset) continue;
        store_le<uint64_t>(directory, at + wang_ldi::ldi_at::checksum, checksum_of(images.subspan(size_t(offset), stored)));
    }
}

void read_all(std::span<const std::byte> bytes) {
    Result<Reader> file = Reader::open_bytes(bytes, "fuzz");
    if (!file) return;
    auto images = wang_ldi::ImageReader::open(*file);
    if (!images) return require(images.error().exit != Exit::our_bug);
    const wang_ldi::ImageSet& set = images->set();
    require(!fault_of_places(set) && !fault_of_levels(set));
    for (uint64_t i = 0; i < std::min<uint64_t>(set.ldi_count(), 64); ++i) {
        if (images->entries()[i].raw_bytes > kMostRawBytes) continue;
        auto ldi = images->read(i);
        if (!ldi) return require(ldi.error().exit != Exit::our_bug);
        uint32_t level = which_of(set, i).level;
        std::vector<std::byte> raw = set.is_grouped ? grouped_bytes_of(set, level, *ldi).bytes : bytes_of_ldi(set, *ldi);
        wang_ldi::Ldi again;
        require(!ldi_of_bytes(raw, set, level, images->entries()[i], again) && again == *ldi);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    std::vector<std::byte> given(size);
    for (size_t i = 0; i < size; ++i) given[i] = std::byte(data[i]);
    if (given.size() >= kFirstSectionOffset && fuzz::has_small_sections(given)) mend_images(given);
    fuzz::read_both(given, kBlocks, fuzz::has_small_sections, read_all);
    return 0;
}
