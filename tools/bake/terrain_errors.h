// How far each triangle of the hierarchy is from every sample that it covers.
#pragma once

#include <span>
#include <vector>

#include "formats/terrain.h"

namespace overlook::terrain {

// For every split vertex of every level (laid out as Terrain::codes) the greatest vertical distance, in height steps, between the
// triangles of its diamond left unsplit and any sample that they cover (borders counted in), of it and of all its descendants;
// infinity where they cover a void. Rounded up to float.
//
// heights: [height, width] row-major in steps, |h| <= 2^28 or kVoid. Cost: O(samples * levels) time, 5.4 bytes a sample.
// Saturation over both triangles of a diamond and all descendants makes the test "error > tolerance" nested, hence every cut
// crack-free (Lindstrom and Pascucci 2001, section 4); measuring every covered sample rather than the midpoint alone makes it a
// bound on the distance to the data, which one-step errors (Lindstrom et al. 1996) are not.
std::vector<std::vector<float>> measure_split_errors(const Shape& shape, std::span<const int32_t> heights);

}  // namespace overlook::terrain
