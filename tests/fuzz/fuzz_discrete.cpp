// Any bytes as a chain of levels: nothing may crash, leak or take memory without bound; what is read keeps its promises, has a
// pose at any time, and packs into the same again.
#include <cmath>
#include <cstdint>
#include <vector>

#include "formats/discrete_layout.h"
#include "tests/fuzz/fuzz_sections.h"

namespace {

using namespace overlook;
using namespace overlook::container;
using fuzz::require;

// A chain has no directory of blocks: there is nothing more to mend than the kind.
constexpr fuzz::Blocks kBlocks{discrete::kKind, 0, 0, 64, 0, 0, 0, nullptr};

// What the rules promise to whoever draws it.
void use(const discrete::Chain& chain) {
    require(!discrete::fault_of_places(chain) && !discrete::fault_of_errors(chain) && !discrete::fault_of_sphere(chain));
    auto parts = uint32_t(chain.parts.size()), surfaces = uint32_t(chain.surfaces.size());
    for (const discrete::Level& level : chain.levels) {
        discrete::LevelSize size;
        std::vector<std::byte> bytes = discrete::bytes_of_level(level, size);
        require(size.bytes() == bytes.size());
        discrete::Level again;
        require(!discrete::level_of_bytes(bytes, size, parts, surfaces, again));
        require(again.vertices == level.vertices && again.draws == level.draws);
    }
    for (const discrete::Part& part : chain.parts)
        for (double at_s : {0.0, 0.3 * chain.clip_s, chain.clip_s, -1e9, 1e300}) {
            discrete::Pose pose = discrete::pose_at(part, chain.clip_s, at_s);
            require(std::abs(double(glm::length(pose.turn)) - 1) < 1e-3 &&
                    std::isfinite(pose.move_m.x + pose.move_m.y + pose.move_m.z));
        }
}

void read_all(std::span<const std::byte> bytes) {
    Result<Reader> file = Reader::open_bytes(bytes, "fuzz");
    if (!file) return;
    Result<discrete::Chain> read = discrete::read(*file);
    if (read) use(*read);
    if (!read) require(read.error().exit != Exit::our_bug);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    fuzz::read_both({reinterpret_cast<const std::byte*>(data), size}, kBlocks, fuzz::has_small_sections, read_all);
    return 0;
}
