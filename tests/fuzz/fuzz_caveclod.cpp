// Any bytes as a baked mesh: nothing may crash, leak or take memory without bound; what is read keeps its promises, can be
// written again, and refined.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "formats/caveclod_layout.h"
#include "runtime/caveclod/refine.h"
#include "tests/fuzz/fuzz_sections.h"

namespace {

using namespace overlook;
using namespace overlook::container;

constexpr uint64_t kMostRawSurfaceBytes = 1 << 20;

bool is_small(std::span<std::byte> file) {
    bool small = true;
    fuzz::visit_sections(file, [&](size_t entry, Tag tag, std::span<std::byte>) {
        if (tag == caveclod::kSurfacesTag && load_le<uint64_t>(file, entry + entry_at::raw_bytes) > kMostRawSurfaceBytes)
            small = false;
    });
    return small;
}

namespace at = caveclod::directory_at;
constexpr fuzz::Blocks kBlocks{caveclod::kKind, caveclod::kDirectoryTag, caveclod::kBlocksTag, at::entry_bytes,
                               at::offset,      at::stored_bytes,        at::checksum,         caveclod::block_checksum};

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
    fuzz::read_both({reinterpret_cast<const std::byte*>(data), size}, kBlocks, is_small, read_all);
    return 0;
}
