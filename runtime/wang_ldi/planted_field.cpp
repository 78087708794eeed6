#include "runtime/wang_ldi/planted_field.h"

#include <algorithm>

#include "formats/wang_ldi_layout.h"

namespace overlook::wang_ldi {
namespace {

// The tiles that touch the ground, or kMostRowTiles a side about its middle.
RowTiling::Rect rows_of(const Ground& ground, double tile_m) {
    glm::dvec2 low = glm::floor(ground.extent().low_m / tile_m), high = glm::ceil(ground.extent().high_m / tile_m);
    glm::dvec2 count = glm::clamp(high - low, glm::dvec2(1), glm::dvec2(kMostRowTiles));
    low = glm::floor((low + high - count) / 2.0);
    return {int64_t(low.x), int64_t(low.y), uint32_t(count.x), uint32_t(count.y)};
}

}  // namespace

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

    greatest_scales_.assign(planting_.models.size(), 0);
    for (const auto& tile : planting_.tiles)
        for (const Planted& object : tile)
            greatest_scales_[object.model] = std::max(greatest_scales_[object.model], double(object.scale));

    Result<Placement> placement = Placement::of(ground_, shared.tile_m, options.placement);
    if (!placement) return tl::unexpected(placement.error());
    placement_.emplace(std::move(*placement));
    return tile(options);
}

Result<void> PlantedField::tile(const PlantedOptions& options) {
    CornerAt corner_at = placement_->corners(set_, options.seed);
    if (options.tiling != TilingKind::row_by_row) {
        Result<RandomTiling> tiling = RandomTiling::of(set_, options.seed, corner_at);
        if (tiling) {
            tiling_ = std::make_unique<RandomTiling>(std::move(*tiling));
            return {};
        }
        if (options.tiling == TilingKind::random_access || tiling.error().exit != Exit::impossible)
            return tl::unexpected(Error{tiling.error().exit, fmt::format("{}: {}", name(), tiling.error().message)});
    }
    TilingOptions rows;
    rows.seed = options.seed, rows.avoids_equal_neighbours = false, rows.corner_at = corner_at;
    Result<RowTiling> tiling = RowTiling::of(set_, rows_of(ground_, placement_->tile_m()), rows);
    if (!tiling) return tl::unexpected(Error{tiling.error().exit, fmt::format("{}: {}", name(), tiling.error().message)});
    tiling_ = std::make_unique<RowTiling>(std::move(*tiling));
    return {};
}

}  // namespace overlook::wang_ldi
