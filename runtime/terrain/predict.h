// What a cut promises of each triangle that it draws.
#pragma once

#include <vector>

#include "formats/terrain.h"
#include "runtime/terrain/refine.h"
#include "runtime/view/camera.h"

namespace overlook::terrain {

// For every triangle of a cut made with wants_codes for this camera: how many pixels any sample that it covers, and that is in
// the frame with the sample or its drawn point, can be displaced. Of a triangle at rest its stored error at its own nearest
// place; of one with a morphing corner the error_px asked, which the mean of the cuts keeps. predicted_px: [n]; infinite where
// the error can reach the eye, 0 where there is none.
void predict_triangles(const Terrain& terrain, const Cut& cut, const view::Camera& camera, double error_px,
                       std::vector<float>& predicted_px);

}  // namespace overlook::terrain
