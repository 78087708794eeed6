// Baked tiles as they stand on a ground: a file's images with all that a field of them refers to.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "formats/wang_ground.h"
#include "formats/wang_ldi.h"
#include "formats/wang_textures.h"
#include "runtime/wang_ldi/field.h"
#include "runtime/wang_ldi/ground.h"
#include "runtime/wang_ldi/placement.h"
#include "runtime/wang_ldi/tiling.h"

namespace overlook::wang_ldi {

// How the ground's tiles are chosen.
enum class TilingKind {
    either,         // by random access, or row by row where the set of tiles permits none
    random_access,  // tile by tile, by hashes of their places
    row_by_row,  // as the paper; equal tiles may stand side by side. Kept whole: the ground, or kMostRowTiles tiles a side of it
};
constexpr uint32_t kMostRowTiles = 2048;

struct PlantedOptions {
    PlacementOptions placement;
    uint64_t seed = 1;  // of the tiling
    TilingKind tiling = TilingKind::either;
};

// Stays where it is, since its parts know each other.
class PlantedField {
  public:
    // Reads the set of tiles, the planting, the images' directory and the textures; none of the images. on: what the tiles stand
    // on, whose terrain must outlive this. The file may be hostile. Fails as wang_ldi::read, ImageReader::open, read_textures,
    // Placement::of and RandomTiling::of or RowTiling::of, and with Exit::bad_input:
    //   "meadow.ovl: holds a planting without images; bake it without --only planting to draw it"
    //   "meadow.ovl: has images of 3 tiles of 2 m for a planting of 12 tiles of 3 m"
    static Result<std::unique_ptr<PlantedField>> open(container::Reader file, Ground on, const PlantedOptions& options);
    PlantedField(const PlantedField&) = delete;
    PlantedField& operator=(const PlantedField&) = delete;

    const std::string& name() const { return file_.name(); }
    const ImageReader& images() const { return *images_; }
    const std::optional<TextureSet>& textures() const { return textures_; }  // none if the file has none
    const TileSet& set() const { return set_; }
    const Planting& planting() const { return planting_; }
    const PlaneTiling& tiling() const { return *tiling_; }
    const Placement& placement() const { return *placement_; }
    const Ground& ground() const { return ground_; }
    const std::vector<double>& greatest_scales() const { return greatest_scales_; }  // [models] of the planting's objects
    // Without what only those know who draw plants as geometry: overhang_m and plants_high_m.
    FieldParts parts() const { return {&images_->set(), sample_counts_, &set_, tiling_.get(), &*placement_}; }

  private:
    PlantedField(container::Reader file, Ground on) : file_(std::move(file)), ground_(std::move(on)) {}
    Result<void> make_parts(const PlantedOptions& options);
    Result<void> tile(const PlantedOptions& options);

    container::Reader file_;
    Ground ground_;
    TileSet set_;
    Planting planting_;
    std::optional<ImageReader> images_;
    std::optional<TextureSet> textures_;
    std::vector<uint32_t> sample_counts_;
    std::vector<double> greatest_scales_;
    std::optional<Placement> placement_;
    std::unique_ptr<const PlaneTiling> tiling_;
};

}  // namespace overlook::wang_ldi
