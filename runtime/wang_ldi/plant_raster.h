// Plants' triangles drawn by the processor, for renderers that are processors themselves: many are no larger than a pixel, for
// which a renderer that can draw anything does most of its work for nothing.
//
// Based on: J. Pineda, A Parallel Algorithm for Polygon Rasterization, 1988 (edge functions); H. Gouraud, Continuous Shading of
// Curved Surfaces, 1971 (light at corners). Ours: colours and depths go into the warper's canvases, so that threads draw whole
// plants in any order and the picture is the same.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "runtime/wang_ldi/plant_levels.h"
#include "runtime/wang_ldi/plant_light.h"
#include "runtime/wang_ldi/plant_shapes.h"
#include "runtime/wang_ldi/warp.h"

namespace overlook::wang_ldi {

// Keeps canvases from picture to picture; one for each thread that draws at the same time.
class PlantRaster {
  public:
    PlantRaster();
    ~PlantRaster();
    PlantRaster(const PlantRaster&) = delete;
    PlantRaster& operator=(const PlantRaster&) = delete;

    // Draws over what the picture, which has the camera's size, shows, by depth: a pixel shows what its middle is in. Same
    // picture with any number of threads. shapes: one a model. Memory: 8 bytes for each pixel and thread, kept.
    void draw(const view::Camera& camera, std::span<const PlantShape> shapes, const PlantLight& light,
              std::span<const PlantList> lists, Warped& picture);

  private:
    struct Threads;
    std::unique_ptr<Threads> threads_;
};

}  // namespace overlook::wang_ldi
