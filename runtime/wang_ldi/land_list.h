// What is drawn of planted ground for a camera: triangles of what it stands on, tiles by images or as what is planted on them,
// and plants each at its level. Counted before it is drawn, without the images.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "runtime/terrain/refine.h"
#include "runtime/view/counted_error.h"
#include "runtime/wang_ldi/plant_levels.h"
#include "runtime/wang_ldi/planted_field.h"
#include "runtime/wang_ldi/settings.h"

namespace overlook::wang_ldi {

struct LandList {
    std::optional<Field> field;
    FieldList list;  // of field
    terrain::Cut cut;
    std::vector<PlantList> plants;  // drawn as geometry
    FieldScratch scratch;

    // Of terrain and plants, vertices and plants that are on their way included.
    uint64_t triangle_count() const;
};

class LandLister {
  public:
    // All must outlive this. forms: of the planting's models; null: nothing is drawn as geometry.
    LandLister(const PlantedField& planted, const terrain::Refiner& refiner, const std::vector<PlantForm>* forms)
        : planted_(planted), refiner_(refiner), forms_(forms) {}

    // Replaces what is in the list, whose memory is kept. Same arguments, same list. origin_m: of the terrain, in the camera's
    // world. options: with the error asked. texture_side_px: of far images. morph: as Refiner::cut_by_pixels. Fails as Field::of.
    // O(terrain's triangles + tiles to where textures begin + plants as geometry).
    Result<void> list(const view::Camera& camera, const glm::dvec3& origin_m, const FrameOptions& options,
                      uint32_t texture_side_px, double morph, LandList& out) const;
    // Its terrain alone anew, as the budget's filled_px says, from finest_px on. error_px: at which it was listed. O(terrain's
    // triangles).
    void fill_with_ground(const view::Camera& camera, const glm::dvec3& origin_m, double finest_px, double error_px,
                          const view::CountedError& budget, double morph, LandList& out) const;

  private:
    FieldParts parts(const FrameOptions& options) const;
    void cut_ground(const view::Camera& camera, const glm::dvec3& origin_m, double error_px, double morph, LandList& out) const;
    void list_plants(const view::Camera& camera, const PlantAccuracy& accuracy, LandList& out) const;

    const PlantedField& planted_;
    const terrain::Refiner& refiner_;
    const std::vector<PlantForm>* forms_;
};

}  // namespace overlook::wang_ldi
