// How wrong attributes become where a position goes.
#pragma once

#include "tools/bake/caveclod/collapse_rules.h"
#include "tools/bake/caveclod/working_mesh.h"

namespace overlook::caveclod {

// What interpolation over face `place` of the collapsed fan gives at the gone position, against the render vertex that was there,
// as a length: how far the texture slides, and for normals and colours what difference they make over the fan's width (as the
// attribute distance of H. Hoppe, New Quadric Metric for Simplifying Meshes with Appearance Attributes, 1999, section 4, but
// measured where the position was and not against a fitted gradient). Metres; 0 where attributes are linear. No bound: it only
// orders collapses.
double attribute_deviation_m(const WorkingMesh& mesh, const Fan& fan, const TurnedVertices& turned, uint32_t place);

}  // namespace overlook::caveclod
