// Plants' triangles drawn by the processor, for renderers that are processors themselves: many are no larger than a pixel, for
// which a renderer that can draw anything does most of its work for nothing.
//
// Based on: J. Pineda, A Parallel Algorithm for Polygon Rasterization, 1988 (edge functions); H. Gouraud, Continuous Shading of
// Curved Surfaces, 1971 (light at corners). Ours: each thread draws the plants of one strip of the picture after the other, the
// nearest first, and leaves out what is hidden, bunch of triangles by bunch.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "runtime/wang_ldi/plant_levels.h"
#include "runtime/wang_ldi/plant_light.h"
#include "runtime/wang_ldi/plant_shapes.h"
#include "runtime/wang_ldi/warp.h"

namespace overlook::wang_ldi {

class Canvas;

// Keeps a canvas from picture to picture; one for each thread that draws pictures at the same time.
class PlantRaster {
  public:
    PlantRaster();
    ~PlantRaster();
    PlantRaster(const PlantRaster&) = delete;
    PlantRaster& operator=(const PlantRaster&) = delete;

    // Draws a picture of their own: a pixel shows what its middle is in. Same picture with any number of threads. shapes: one a
    // model. Memory: 8 bytes for each pixel, kept.
    void draw(const view::Camera& camera, std::span<const PlantShape> shapes, const PlantLight& light,
              std::span<const PlantList> lists);
    // Lays it over what another of the same size shows, by depth: of what is equally deep the other's stays. Once.
    void lay_over(Warped& picture);

  private:
    std::unique_ptr<Canvas> canvas_;
    bool is_empty_ = true;
};

}  // namespace overlook::wang_ldi
