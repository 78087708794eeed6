// How far what images and far points show of planted ground stands, in a picture, from where it should: proven bounds.
#pragma once

#include "runtime/view/camera.h"
#include "runtime/wang_ldi/field.h"

namespace overlook::wang_ldi {

constexpr double kStrip_px = 0.25;  // rows of far tiles so close in the picture are drawn as one

// A sample stands in the middle of its pixel of the image, at a whole step of height: so many metres at most from the place of
// the surface that it is of.
double sample_error_m(const ImageSet& images, uint32_t level);

// Of all that a list of the field shows for the camera but for geometry, in pixels: of samples, what they stand off their surface
// and their tile off its ground; of far points, half a texel and what rows of tiles are drawn too close together. Against what is
// planted as its tile is sheared onto the ground. 0 of nothing; infinite where a sample may reach the eye. O(items).
double planting_error_px(const Field& field, const FieldList& list, const view::Camera& camera);

// From so many metres on, for each metre of a texel's side, the texels' points keep an error anywhere in the camera's picture,
// fades of this share of the distance included; of images' samples the same for each metre of their error.
double texels_from(const view::Camera& camera, double error_px, double fade_share);
double samples_from(const view::Camera& camera, double error_px, double fade_share);

}  // namespace overlook::wang_ldi
