#include "runtime/wang_ldi/planted_field.h"

#include <algorithm>

#include "formats/wang_ldi_layout.h"

namespace overlook::wang_ldi {

Result<std::unique_ptr<PlantedField>> PlantedField::open(container::Reader file, Ground on, const PlantedOptions& options) {
    std::unique_ptr<PlantedField> made(new PlantedField(std::move(file), std::move(on)));
    Result<void> parts = made->make_parts(options);
    if (!parts) return tl::unexpected(parts.error());
    return made;
}

Result<void> PlantedField::make_parts(const PlantedOptions& options) {
    Result<PlantedTiles> tiles = read(file_);
    if (!tiles) return tl::unexpected(tiles.error());
    set_ = std::move(tiles->set), planting_ = std::move(tiles->planting);
    if (file_.find(kDirectoryTag) == nullptr)
        return bad_input("{}: holds a planting without images; bake it without --only planting to draw it", name());
    Result<ImageReader> images = ImageReader::open(file_);
    if (!images) return tl::unexpected(images.error());
    images_.emplace(std::move(*images));
    const ImageSet& shared = images_->set();
    if (shared.tile_count != set_.tiles.size() || shared.tile_m != planting_.tile_size_m)
        return bad_input("{}: has images of {} tiles of {} m for a planting of {} tiles of {} m", name(), shared.tile_count,
                         shared.tile_m, set_.tiles.size(), planting_.tile_size_m);
    if (has_textures(file_)) {
        Result<TextureSet> textures = read_textures(file_, shared);
        if (!textures) return tl::unexpected(textures.error());
        textures_.emplace(std::move(*textures));
    }
    for (const Entry& entry : images_->entries()) sample_counts_.push_back(entry.sample_count);

    for (const auto& tile : planting_.tiles)
        for (const Planted& object : tile)
            if (object.owner != Owner::interior)
                overhang_m_ = std::max(overhang_m_, double(planting_.models[object.model].tight_radius_m) * double(object.scale));

    Result<Placement> placement = Placement::of(ground_, shared.tile_m, options.placement);
    if (!placement) return tl::unexpected(placement.error());
    placement_.emplace(std::move(*placement));
    Result<RandomTiling> tiling = RandomTiling::of(set_, options.seed, placement_->corners(set_, options.seed));
    if (!tiling) return tl::unexpected(Error{tiling.error().exit, fmt::format("{}: {}", name(), tiling.error().message)});
    tiling_.emplace(std::move(*tiling));
    return {};
}

}  // namespace overlook::wang_ldi
