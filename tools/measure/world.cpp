#include "tools/measure/world.h"

#include <algorithm>

#include "formats/mapped_file.h"

namespace overlook::measure {
namespace {

// 4 bytes a sample and a texel, and a third more for the texture's coarser levels.
uint64_t bytes_on_card(const terrain::Terrain& terrain) {
    uint64_t texels = uint64_t(terrain.texture.width) * terrain.texture.height;
    return 4 * uint64_t(terrain.heights.size()) + 4 * texels * 4 / 3;
}

}  // namespace

Result<World> read_world(const std::string& path) {
    Result<MappedFile> file = MappedFile::open(path);
    if (!file) return tl::unexpected(file.error());
    Result<terrain::Terrain> terrain = terrain::read(path);
    if (!terrain) return tl::unexpected(terrain.error());

    World world;
    world.name = path.substr(path.rfind('/') + 1);
    world.content_hash = content_hash(file->bytes());
    world.terrain = std::make_unique<terrain::Terrain>(std::move(*terrain));
    world.refiner.emplace(*world.terrain);
    world.resident_bytes = bytes_on_card(*world.terrain);
    // So near that nothing above the ground is cut off, whatever the size of the cells.
    world.near_m = std::min(0.5, 0.25 * std::min(world.terrain->frame.metres_per_column, world.terrain->frame.metres_per_row));
    return world;
}

Result<void> upload(World& world) {
    Result<terrain::Drawing> drawing = terrain::Drawing::make(*world.terrain);
    if (!drawing) return tl::unexpected(drawing.error());
    world.drawing.emplace(std::move(*drawing));
    return {};
}

}  // namespace overlook::measure
