// Any bytes as a scene: nothing may crash, leak or take memory without bound; what is read keeps its promises and packs into the
// same again.
#include <cstdint>
#include <vector>

#include "formats/wang_scene_layout.h"
#include "tests/fuzz/fuzz_sections.h"

namespace {

using namespace overlook;
using namespace overlook::container;

constexpr uint64_t kMostRawBytes = 1 << 20;
constexpr uint32_t kTileCount = 3;

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

void require_same_again(const wang_ldi::Scene& scene) {
    std::vector<std::byte> image = bytes_of_scene(scene), pictures = bytes_of_scene_pictures(scene);
    wang_ldi::Scene again;
    require(!scene_of_bytes(image, kTileCount, again) && !scene_pictures_of_bytes(pictures, again));
    require(bytes_of_scene(again) == image && bytes_of_scene_pictures(again) == pictures);
}

void read_all(std::span<const std::byte> bytes) {
    Result<Reader> file = Reader::open_bytes(bytes, "fuzz");
    if (!file) return;
    auto scene = wang_ldi::read_scene(*file, kTileCount);
    if (!scene) return require(scene.error().exit != Exit::our_bug);
    require(!fault_of_scene_tiles(*scene, kTileCount) && !fault_of_view(scene->image) && !fault_of_samples(scene->image));
    require_same_again(*scene);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    std::vector<std::byte> given(size);
    for (size_t i = 0; i < size; ++i) given[i] = std::byte(data[i]);
    fuzz::read_both(given, kBlocks, is_small, read_all);
    // The bytes by themselves, as either section's: what no container's compression would let through.
    wang_ldi::Scene scene;
    if (given.size() < kMostRawBytes && !scene_of_bytes(given, kTileCount, scene)) require_same_again(scene);
    wang_ldi::Scene pictures;
    pictures.columns = pictures.rows = 1, pictures.tiles = {0};
    pictures.image.view.width_px = pictures.image.view.height_px = 1, pictures.image.first = {0, 0};
    if (given.size() < kMostRawBytes && !scene_pictures_of_bytes(given, pictures)) require_same_again(pictures);
    return 0;
}
