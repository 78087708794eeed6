// The terrain's own method: refined to a promised error in pixels.
#pragma once

#include <memory>

#include "runtime/view/error_budget.h"
#include "tools/measure/method.h"
#include "tools/measure/world.h"

namespace overlook::measure {

// The coarsest cut whose bound stays under budget.least_error_px (runtime/terrain/refine.h), or, as the player's --triangles,
// under the error that the frames before leave room for in budget.cost triangles. morph: as Refiner::cut_by_pixels takes it, 0 =
// hard switching.
std::unique_ptr<Method> make_terrain_method(World& world, const view::ErrorBudget& budget, double morph);

// Every triangle of the raster, whether in view or not.
terrain::Cut full_cut(const World& world);

// Draws a cut and counts what that takes. resident_bytes: of the drawing in the renderer's memory, without the cut's own.
Counters draw_cut(terrain::Drawing& drawing, uint64_t resident_bytes, const gl::Target& target, const terrain::Cut& cut,
                  const view::Camera& camera, const terrain::DrawOptions& look);

}  // namespace overlook::measure
