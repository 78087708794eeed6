// The plain that tiles stand on where there is no terrain: a terrain too, flat, so that it is drawn as any other.
#pragma once

#include <glm/glm.hpp>

#include "formats/terrain.h"

namespace overlook::wang_ldi {

// A square of plain_side_m(), at height 0, of one colour of earth.
terrain::Terrain plain_terrain();
double plain_side_m();

// Where the origin of plain_terrain() (its north-western corner) has to lie for its middle to be at the eye, in whole cells, so
// that the plain has no end.
glm::dvec3 plain_origin_m(const glm::dvec3& eye_m);

}  // namespace overlook::wang_ldi
