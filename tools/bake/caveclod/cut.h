// Legal cuts of a hierarchy as what they draw, and random ones to test with.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "formats/caveclod.h"

namespace overlook::caveclod {

// Which splits are applied; legal if it holds, with each split, all that it needs.
using Applied = std::vector<uint8_t>;  // [S]

bool is_legal(const Hierarchy& hierarchy, const Applied& applied);

// What a legal cut draws, in the order of the hierarchy's faces.
struct CutFaces {
    std::vector<uint32_t> face;                      // [n] number in the hierarchy
    std::vector<std::array<uint32_t, 3>> positions;  // [n]
    std::vector<std::array<uint32_t, 3>> vertices;   // [n] render vertices
};
CutFaces faces_of(const Hierarchy& hierarchy, const Applied& applied);

// The promise: the greatest error of a split that is not applied; finest_error_m if all are.
double stated_error_m(const Hierarchy& hierarchy, const Applied& applied);

// How many faces the coarsest cut has whose stated error is at most error_m; the finest cut's where none keeps it.
uint64_t face_count_at(const Hierarchy& hierarchy, double error_m);

// About face_count faces, unevenly fine: refined by error times a weight that falls off from a random place, so that fine and
// coarse meet anywhere. Same seed, same cut. O(S log S).
Applied random_cut(const Hierarchy& hierarchy, uint64_t face_count, uint64_t seed);

// The first law that the hierarchy breaks, or "": rows and ranges; needs before who needs them; errors falling along needs; each
// split turning faces that stand at its owner in the very version that its needs left behind; each turned or added corner having
// a render vertex of its position; each added face at owner and new position. O(size).
std::string broken_law(const Hierarchy& hierarchy);

}  // namespace overlook::caveclod
