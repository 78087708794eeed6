// How far what images show of planted ground stands, in a picture, from where it should: a proven bound. What far points show: an
// estimate.
#pragma once

#include "runtime/view/camera.h"
#include "runtime/wang_ldi/field.h"

namespace overlook::wang_ldi {

constexpr double kStrip_px = 0.25;  // rows of far tiles so close in the picture are drawn as one

// A sample stands in the middle of its pixel of the image, at a whole step of height above its tile there: so many metres at most
// from the place of the surface that it is of. slope: of the tile's plane, as a rise for a way, >= 0.
double sample_error_m(const ImageSet& images, uint32_t level, double slope);
// The steepest that a tile's pieces are; 0 of none.
double steepest(std::span<const Half> halves);

// Of all that a list of the field shows for the camera but for geometry, in pixels: of samples, what they stand off their surface
// and their tile off its ground. Against what is planted as its tile is sheared onto the ground. Of far points it is estimated,
// not proven, by half a texel sideways and what rows of tiles are drawn too close together: their steps of height, tiles that one
// colour stands for and the places of rows along themselves are not in it. 0 of nothing; infinite where a sample may reach the
// eye. O(items).
double planting_error_px(const Field& field, const FieldList& list, const view::Camera& camera);

// From so many metres on, for each metre of a texel's side, the texels' points keep an error anywhere in the camera's picture,
// fades of this share of the distance included; of images' samples the same for each metre of their error.
double texels_from(const view::Camera& camera, double error_px, double fade_share);
double samples_from(const view::Camera& camera, double error_px, double fade_share);

}  // namespace overlook::wang_ldi
