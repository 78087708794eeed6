// Which tiles and blocks of tiles a field's list has, from back to front.
#pragma once

#include <array>
#include <functional>
#include <utility>

#include "runtime/wang_ldi/field.h"

namespace overlook::wang_ldi {

// The quarters of a square cut in its middle, from the one farthest behind the two cuts to the one the eye is over: 0 or 1
// east and north.
inline std::array<std::pair<int, int>, 4> quarters_towards(const glm::dvec2& eye, const glm::dvec2& middle) {
    int near_x = eye.x >= middle.x, near_y = eye.y >= middle.y;
    return {{{1 - near_x, 1 - near_y}, {1 - near_x, near_y}, {near_x, 1 - near_y}, {near_x, near_y}}};
}

// Through the tree of blocks, whose cuts are vertical: all that is behind a cut comes before all that is before it.
class FieldWalk {
  public:
    // The field must outlive it.
    FieldWalk(const Field& field, const view::Camera& camera);
    // Adds to counts what was tested.
    void run(FieldCounts& counts, const std::function<void(const Found&)>& take);

  private:
    void visit(int64_t i, int64_t j, uint8_t log2);
    bool is_in_sight(const Rect& rect, const GroundRange& ground) const;

    const Field& field_;
    const ImageSet& images_;
    const Placement& placement_;
    std::array<glm::dvec3, 4> sides_;
    glm::dvec3 forward_, eye_m_;
    double near_m_;
    FieldCounts* counts_ = nullptr;
    const std::function<void(const Found&)>* take_ = nullptr;
};

}  // namespace overlook::wang_ldi
