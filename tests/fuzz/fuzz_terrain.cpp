// Any bytes as a baked terrain: nothing may crash, leak or take memory without bound; and what is read keeps its promises and can
// be written again.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "formats/terrain_blocks.h"
#include "formats/terrain_check.h"
#include "formats/terrain_layout.h"
#include "tests/fuzz/fuzz_sections.h"

namespace {

using namespace overlook;
using namespace overlook::container;

constexpr uint64_t kMostSamples = 1 << 18;  // the format allows many in few bytes; here time is for other things

bool is_small(std::span<std::byte> file) {
    bool small = true;
    fuzz::visit_sections(file, [&](size_t, Tag tag, std::span<std::byte> bytes) {
        if (tag != terrain::kInfoTag || bytes.size() < 8) return;
        small = uint64_t(load_le<uint32_t>(bytes, 0)) * load_le<uint32_t>(bytes, 4) <= kMostSamples;
    });
    fuzz::visit_sections(file, [&](size_t entry, Tag tag, std::span<std::byte>) {
        if (tag == terrain::kTextureTag && load_le<uint64_t>(file, entry + entry_at::raw_bytes) > 1 << 20) small = false;
    });
    return small;
}

namespace at = terrain::directory_at;
constexpr fuzz::Blocks kBlocks{terrain::kKind, terrain::kDirectoryTag, terrain::kBlocksTag, at::entry_bytes,
                               at::offset,     at::stored_bytes,       at::checksum,        terrain::block_checksum};

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
    fuzz::read_both({reinterpret_cast<const std::byte*>(data), size}, kBlocks, is_small, read_all);
    return 0;
}
