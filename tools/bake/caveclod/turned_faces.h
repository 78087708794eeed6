// What a turned face is. The baker makes none, and whoever judges a cut counts them, by this one definition.
#pragma once

#include <cstdint>
#include <span>

#include "tools/bake/caveclod/triangle_tree.h"

namespace overlook::caveclod {

// A drawn face is turned if it looks away from the source under it (of its own part: source_parts.h): at seven places spread over
// the face (its middle, and near its corners and sides), the source nearest to each has a unit normal; the mean of the seven and
// the face's own normal make more than 90 degrees. Where several of the source's triangles are nearest (within slack_m), as at an
// edge or where two sheets lie in one place, the one that faces the drawn face best counts, so that no face of the source itself
// is turned. A face without area is not turned. slack_m: what positions are rounded by. `guess`: a triangle of the source that
// may be near the face (kNoGuess: none is known); the better it is, the sooner the same answer is found.
constexpr uint32_t kNoGuess = 0xffffffff;
bool is_turned(const TriangleTree& source, const Triangle& face, double slack_m, uint32_t guess = kNoGuess);

// The first of the faces that is_turned; faces.size() if none is. Every point of them is known to have some source within away_m:
// where all the source that near to them faces them, that is the answer, several times faster found. guesses: [faces], or empty.
size_t first_turned(const TriangleTree& source, std::span<const Triangle> faces, double away_m, double slack_m,
                    std::span<const uint32_t> guesses = {});

// The slack for meshes with positions in float32: a millionth of the size of their box.
double turn_slack_m(std::span<const glm::vec3> positions_m);

}  // namespace overlook::caveclod
