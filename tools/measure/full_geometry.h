// Everything that there is of a world, drawn: what the reference shows, and the floor of all methods. Of planted ground all
// plants up to kPlantsUpTo_m from the eye, each upon its foot, at the coarsest level that is within kPlantError_px of the finest
// in pixels of the target: hundreds of millions of triangles are more than any renderer draws.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "tools/measure/method.h"
#include "tools/measure/world.h"

namespace overlook::measure {

constexpr double kPlantError_px = 0.5, kPlantsUpTo_m = 400;

// The world must be uploaded and outlive it.
class FullGeometry {
  public:
    explicit FullGeometry(World& world);

    // Resolves the target. part: of the camera's picture, that the target shows; the whole of it if not said.
    Counters draw(const gl::Target& target, const view::Camera& camera, const std::optional<view::Part>& part = std::nullopt);

  private:
    Counters draw_planted(const gl::Target& target, const view::Camera& camera, const std::optional<view::Part>& part);
    Counters draw_chains(const gl::Target& target, const view::Camera& camera, const std::optional<view::Part>& part);

    World* world_;
    terrain::Cut cut_;                                  // of a terrain: every triangle of the raster
    std::unique_ptr<caveclod::CameraBuffers> buffers_;  // of a mesh: every face
    std::vector<discrete::ListBuffers> lists_;          // of each chain: the finest level of all instances in view
};

std::unique_ptr<Method> make_full_method(World& world);

}  // namespace overlook::measure
