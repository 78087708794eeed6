// A near plane that cuts nothing off the ground, however low the eye.
#pragma once

#include "formats/terrain.h"
#include "runtime/view/camera.h"

namespace overlook::terrain {

class Tiles;

// The least distance in metres from a place in the terrain's frame to the surface of its finest triangles, as far as within_m;
// within_m if there is none nearer. Cost O(cells within within_m).
double distance_to_ground_m(const Terrain& terrain, const glm::dvec3& place_m, double within_m);
// Where the finest tiles are not there, what they can hold lies within the ranges of those that are: 0 if the place may be nearer
// than within_m.
double distance_to_ground_m(const Tiles& tiles, const glm::dvec3& place_m, double within_m);

// The camera with its near plane drawn in as far as the ground needs: everything before the near plane and in the frame lies
// nearer to the eye than near_m times the secant of the frame's corner, so that near plane is taken whose corner reaches no more
// than kNearShare of the distance to the ground (what is left is for the error of what is drawn), but not below
// kLeastNear_m. Depths are reversed floats: a nearer near plane loses no precision.
inline constexpr double kNearShare = 0.75, kLeastNear_m = 1e-4;
view::Camera with_clear_near_plane(const Terrain& terrain, const view::Camera& camera);
view::Camera with_clear_near_plane(const Tiles& tiles, const view::Camera& camera);

}  // namespace overlook::terrain
