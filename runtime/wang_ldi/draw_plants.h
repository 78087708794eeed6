// What is planted as geometry: instances of chains of levels on their ground, each at a level within the error asked.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "formats/discrete.h"
#include "formats/wang_tiles.h"
#include "runtime/discrete/draw.h"
#include "runtime/gl/target.h"
#include "runtime/wang_ldi/plant_levels.h"
#include "runtime/wang_ldi/plant_light.h"
#include "runtime/wang_ldi/plant_shapes.h"
#include "runtime/wang_ldi/plants.h"

namespace overlook::wang_ldi {

struct PlantCounts {
    uint64_t plant_count = 0;     // in view
    uint64_t triangle_count = 0;  // submitted
    uint64_t draw_call_count = 0, uploaded_bytes = 0;
    double error_px = 0;  // nothing of them is displaced by more in the picture: proven of each level, against the chain's source
};
// But for draw calls and bytes.
PlantCounts counts_of(std::span<const PlantList> lists);

// All that says what a plant looks like beside its chain: what pictures that are kept depend on.
std::string plant_look_text();

// A context must be current.
class Plants {
  public:
    // chains: one a model of the planting, which must outlive this. to_sun: of the images, whose light they are drawn in: sun and
    // sky as far as they are seen amid the planting; 0: in their own colours, as images are whose colours are unlit. Fails as
    // discrete::Drawing::make.
    static Result<Plants> make(std::span<const discrete::Chain> chains, const Planting& planting, const glm::dvec3& to_sun);

    const std::vector<PlantForm>& forms() const { return forms_; }  // of each model
    // Draws over what the target holds, by depth; does not resolve. haze_per_m: of the air before them, as terrain::Drawing's; 0:
    // none, as they are drawn by a PlantRaster, before whose picture a Composite puts it. part: of the camera's picture, that the
    // target shows; the whole of it if not said.
    PlantCounts draw(const gl::Target& target, const view::Camera& camera, std::span<const PlantList> lists, double haze_per_m,
                     const std::optional<view::Part>& part = std::nullopt);
    // For a PlantRaster, made when first asked for: one a model; none if one of them cannot be shaped.
    std::span<const PlantShape> shapes();
    const PlantLight& light() const { return light_; }
    uint64_t bytes() const;  // on the card

  private:
    struct Model {
        discrete::Drawing drawing;
        std::vector<gl::Program> programs;  // of what is whole, and behind a screen door
        discrete::ListBuffers buffers;
    };
    void draw_list(const PlantList& list, const view::Camera& camera, double haze_per_m, const discrete::DrawOptions& options,
                   PlantCounts& counts);

    PlantLight light_;
    std::vector<PlantForm> forms_;
    std::vector<PlantShape> shapes_;  // of each model, once they are wanted
    std::vector<std::unique_ptr<Model>> models_;
};

}  // namespace overlook::wang_ldi
