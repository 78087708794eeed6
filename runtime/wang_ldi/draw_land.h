// Planted ground with what it stands on: as a scene says it, or a baked file by itself on a plain.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "formats/scene.h"
#include "runtime/terrain/draw.h"
#include "runtime/terrain/refine.h"
#include "runtime/wang_ldi/draw_frames.h"
#include "runtime/wang_ldi/planted_field.h"

namespace overlook::wang_ldi {

// Must go before the context that it was uploaded to.
class PlantedLand {
  public:
    // file: of kKind. terrain: what it stands on; none: a plain at height 0. scene_path: the scene's, for the files that
    // `planting` names. Needs no OpenGL. Fails as PlantedField::open, MappedFile::open and decode_png.
    static Result<std::unique_ptr<PlantedLand>> read(container::Reader file, std::optional<terrain::Terrain> terrain,
                                                     const scene::Planting& planting, const std::string& scene_path);
    // Puts the terrain on the graphics card, once; needs a current context. Fails as terrain::Drawing::make.
    Result<void> upload();

    const PlantedField& planted() const { return *planted_; }
    const terrain::Terrain& terrain() const { return *terrain_; }
    bool is_plain() const { return is_plain_; }
    Land land() { return {terrain_.get(), &*refiner_, &*drawing_, is_plain_}; }

    // An eye in the middle of the ground, as high as images were sampled for.
    view::Camera overview(uint32_t width_px, uint32_t height_px) const;
    double eye_height_m() const;  // above the ground, in the middle of the cell

  private:
    PlantedLand() = default;

    std::unique_ptr<const terrain::Terrain> terrain_;
    bool is_plain_ = false;
    std::optional<terrain::Refiner> refiner_;
    std::unique_ptr<PlantedField> planted_;
    std::optional<terrain::Drawing> drawing_;
};

// So near that nothing is cut off that can be seen of plants round the eye.
constexpr double kPlantedNear_m = 0.05;

}  // namespace overlook::wang_ldi
