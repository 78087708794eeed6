// Planted ground with what it stands on: as a scene says it, or a baked file by itself on a plain.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "formats/scene.h"
#include "runtime/terrain/draw.h"
#include "runtime/terrain/refine.h"
#include "runtime/wang_ldi/draw_frames.h"
#include "runtime/wang_ldi/draw_plants.h"
#include "runtime/wang_ldi/planted_field.h"

namespace overlook::wang_ldi {

// Must go before the context that it was uploaded to.
class PlantedLand {
  public:
    // file: of kKind. terrain: what it stands on; none: a plain at height 0. scene_path: the scene's, for the files that
    // `planting` names. Needs no OpenGL. Fails as PlantedField::open, MappedFile::open and decode_png.
    static Result<std::unique_ptr<PlantedLand>> read(container::Reader file, std::optional<terrain::Terrain> terrain,
                                                     const scene::Planting& planting, const std::string& scene_path);
    // Whether all chains that `planting` names are there to be read; false if it names none.
    bool has_models() const;
    // The chains that `planting` names, for drawing plants as geometry, once. Fails as discrete::read, and with Exit::bad_input:
    //   "field.json: names 3 models, and meadow.ovl plants 11"
    //   "field.json: names no models of what meadow.ovl plants; they are chains of levels (bake-lod discrete)"
    Result<void> read_models();
    // Puts the terrain, and models that were read, on the graphics card, once; needs a current context. Fails as
    // terrain::Drawing::make and Plants::make.
    Result<void> upload();

    // Before it is uploaded: one colour (sRGB-encoded) all over the terrain in place of its texture.
    void paint_ground(const std::array<uint8_t, 3>& colour);

    const PlantedField& planted() const { return *planted_; }
    const terrain::Terrain& terrain() const { return *terrain_; }
    bool is_plain() const { return is_plain_; }
    Land land() { return {terrain_.get(), &*refiner_, &*drawing_, is_plain_, plants()}; }
    const std::vector<discrete::Chain>& models() const { return models_; }  // those that were read
    Plants* plants() { return plants_ ? &*plants_ : nullptr; }  // null unless models were read

    // An eye in the middle of the ground, as high as images were sampled for.
    view::Camera overview(uint32_t width_px, uint32_t height_px) const;
    double eye_height_m() const;  // above the ground, in the middle of the cell

  private:
    PlantedLand() = default;

    std::unique_ptr<terrain::Terrain> terrain_;
    bool is_plain_ = false;
    std::optional<terrain::Refiner> refiner_;
    std::unique_ptr<PlantedField> planted_;
    scene::Planting described_;
    std::string scene_path_;
    std::vector<discrete::Chain> models_;
    std::optional<terrain::Drawing> drawing_;
    std::optional<Plants> plants_;
};

// So near that nothing is cut off that can be seen of plants round the eye.
constexpr double kPlantedNear_m = 0.05;

}  // namespace overlook::wang_ldi
