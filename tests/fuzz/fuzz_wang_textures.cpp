// Any bytes as directional textures: nothing may crash, leak or take memory without bound; what is read keeps its promises and
// packs into the same again.
#include <cstdint>
#include <vector>

#include "formats/wang_textures_layout.h"
#include "tests/fuzz/fuzz_sections.h"

namespace {

using namespace overlook;
using namespace overlook::container;

constexpr uint64_t kMostRawBytes = 1 << 20;

bool is_small(std::span<std::byte> file) {
    bool small = true;
    fuzz::visit_sections(file, [&](size_t entry, Tag, std::span<std::byte>) {
        if (load_le<uint64_t>(file, entry + entry_at::raw_bytes) > kMostRawBytes) small = false;
    });
    return small;
}

constexpr fuzz::Blocks kBlocks{container::tag("WANG"), 0, 0, 64, 0, 0, 0, nullptr};

void require(bool holds) {
    if (!holds) __builtin_trap();
}

void require_same_again(const wang_ldi::TextureSet& set, const wang_ldi::ImageSet& images) {
    std::vector<std::byte> raw = bytes_of_textures(set);
    wang_ldi::TextureSet again;
    require(raw.size() == texture_bytes_of(set) && !textures_of_bytes(raw, images, again));
    require(bytes_of_textures(again) == raw);
}

void read_all(std::span<const std::byte> bytes) {
    Result<Reader> file = Reader::open_bytes(bytes, "fuzz");
    if (!file) return;
    auto images = wang_ldi::ImageReader::open(*file);
    if (!images) return require(images.error().exit != Exit::our_bug);
    auto textures = wang_ldi::read_textures(*file, images->set());
    if (!textures) return require(textures.error().exit != Exit::our_bug);
    require(!fault_of_texture_counts(*textures) && !fault_of_texture_places(*textures));
    require_same_again(*textures, images->set());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    std::vector<std::byte> given(size);
    for (size_t i = 0; i < size; ++i) given[i] = std::byte(data[i]);
    fuzz::read_both(given, kBlocks, is_small, read_all);
    // The bytes by themselves, as a section's: what no container's compression would let through.
    wang_ldi::TextureSet set;
    wang_ldi::ImageSet images;
    images.tile_m = 2, images.high_m = 1.5, images.tile_count = images.direction_count = 1, images.has_normals = true;
    if (given.size() < kMostRawBytes && !textures_of_bytes(given, images, set)) require_same_again(set, images);
    return 0;
}
