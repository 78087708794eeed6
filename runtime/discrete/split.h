// One thing's change of level shared out between even and odd frames: a plane through the eye divides what is seen of it, and on
// either side the other level is drawn in turn.
//
// Every pixel lies on one side, so that nothing gapes where the levels do not meet; and it sees the two levels in turn, as of a
// thing that is not divided.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "formats/discrete.h"

namespace overlook::discrete {

struct Placement;

// Neighbouring triangles of a level, in the level's order, and a box round them.
struct Bunch {
    glm::dvec3 middle_m{0};                        // of the chain's own world
    glm::dvec3 half_m{0};                          // from there to the box's sides; infinite: parts move it
    uint32_t draw = 0;                             // of Level::draws
    uint32_t first_index = 0, triangle_count = 0;  // from the draw's own first
};
// At most about 4,096 of them.
std::vector<Bunch> bunches_of(const Chain& chain, const Level& level);

// Triangles of a level that stand one after the other; of one draw of Level::draws, from that draw's first index.
struct TriangleRun {
    uint32_t draw = 0, first_index = 0, index_count = 0;

    bool operator==(const TriangleRun&) const = default;
};

// In the chain's own world: it goes through the anchor and the eye.
struct Split {
    glm::dvec3 anchor_m{0}, normal{0};  // normal: of length 1, as it was last
};

// Planes through the eye, by what points from them, in the world: something is seen if a part of it lies on that side of each.
using Sides = std::span<const glm::dvec3>;

// Such that even and odd frames draw about as many triangles of what is seen. way_m: where the eye goes; the plane holds this
// direction as well as it can, and then divides the thing in the next frame where it does in this one. None if the eye lies
// within 1.2 radii of the middle, or nothing is seen.
std::optional<Split> split_of(std::span<const Bunch> finer, std::span<const Bunch> coarser, const Placement& placement,
                              const glm::dvec3& middle_m, double radius_m, const glm::dvec3& eye_m, const glm::dvec3& way_m,
                              Sides sides = {});

// The plane's normal in the world, of length 1, now that the eye is there; split keeps it.
glm::dvec3 turn_to_eye(Split& split, const Placement& placement, const glm::dvec3& eye_m);

// Appends the bunches that may be seen, as few runs. Returns how many triangles.
uint64_t append_seen(std::span<const Bunch> bunches, const Placement& placement, const glm::dvec3& eye_m, Sides sides,
                     std::vector<TriangleRun>& runs);
// The same, only counted.
uint64_t seen_count(std::span<const Bunch> bunches, const Placement& placement, const glm::dvec3& eye_m, Sides sides);

// (x, y, 1) of a pixel in gl_FragCoord's way times this is 0 on the plane, and above where its normal points; for a picture of so
// many pixels and a normal to the right, up and forward.
glm::dvec3 line_of(const glm::dvec3& normal_in_eye, double focal_px, uint32_t width_px, uint32_t height_px);

}  // namespace overlook::discrete
