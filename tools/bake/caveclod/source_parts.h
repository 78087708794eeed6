// The source by its parts, so that a face is judged by what it stands for and not by whatever lies near.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "tools/bake/caveclod/turned_faces.h"

namespace overlook::caveclod {

// A part is what hangs together over positions; no collapse ever joins two. Where two touch, as a box on a table, their surfaces
// lie in one place and face each other: the nearest source to a face that is as far off as it may be would as well be the other
// part's.
class SourceParts {
  public:
    // faces: [F] of ids below positions_m.size(). O(F log F).
    SourceParts(std::span<const glm::vec3> positions_m, std::span<const std::array<uint32_t, 3>> faces);

    // first_turned, held against the part that the faces belong to. guesses: [faces, at least one] faces of the source, of that
    // part.
    size_t first_turned(std::span<const Triangle> faces, double away_m, double slack_m, std::span<const uint32_t> guesses) const;

    // Whether a drawn face is_turned from the part that it belongs to. guess: a face of the source, of that part. How near the
    // source is to the face is measured, from the face's middle, and nobody's word for it taken.
    bool is_turned(const Triangle& face, double slack_m, uint32_t guess) const;

    size_t count() const { return trees_.size(); }

  private:
    std::vector<uint32_t> part_, place_;  // [F] each face's, and its number in the part's tree
    std::vector<TriangleTree> trees_;     // [parts]
};

}  // namespace overlook::caveclod
