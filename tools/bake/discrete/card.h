// A card: a flat picture of a part of a thing, made by casting rays at it.
//
// Based on: X. Decoret, F. Durand, F. Sillion, J. Dorsey, Billboard Clouds for Extreme Model Simplification, 2003. Different
// here: opacity is all or nothing, spread so that the area stays, so that what is drawn of a card can be proven to lie near the
// thing.
#pragma once

#include <vector>

#include "tools/bake/discrete/looks.h"
#include "tools/bake/discrete/ray_scene.h"

namespace overlook::discrete {

// right, up and normal are of length 1, at right angles, right-handed.
struct CardPlane {
    glm::dvec3 middle_m{0}, right{1, 0, 0}, up{0, 0, 1}, normal{0, -1, 0};
};
// A plane with a normal, upright where it can be.
CardPlane plane_of(const glm::dvec3& middle_m, const glm::dvec3& normal);

// What is to be seen on a card.
struct CardOrder {
    CardPlane plane;
    uint32_t part = 0;
    double reach_m = 0;          // what lies farther from the plane is not seen
    double least_cosine = 0;     // .. nor are faces that look more aside than this
    std::vector<uint8_t> takes;  // [F] whether a face is seen; empty: all are
    uint64_t seed = 0;
    int side = 0;  // colours and normals: 1 as seen from the front, -1 from behind, 0 the mean of both
};

struct Card {
    CardPlane plane;
    uint32_t part = 0;
    double texel_m = 0;
    // Texels from (0, 0) at low_m along right and up; rows from the top. The rim is not opaque.
    glm::dvec2 low_m{0};
    uint32_t width = 0, height = 0;      // 0: nothing is seen
    std::vector<uint8_t> is_opaque;      // [height, width]
    std::vector<glm::dvec3> colour;      // [height, width] linear, beyond what is opaque as beside it
    std::array<glm::vec3, 4> normals{};  // of length 1, at the corners: lower left, lower right, upper right, upper left
    double difference = 0;  // of the colours seen from the front and from behind, on the mean over what is opaque, 0..1
    glm::dvec3 at_m(double x, double y) const {  // in texels, y from the top
        return plane.middle_m + (low_m.x + x * texel_m) * plane.right + (low_m.y + (height - y) * texel_m) * plane.up;
    }
};

// What cards are made from.
struct CardSource {
    const Shape& shape;    // of one part or of several
    const RayScene& rays;  // of its triangles
    const Looks& looks;
};

// Casts kRaysPerTexel rays through each texel, spread over it, half of them from either side; what they hit gives its colour and,
// by how many do, its opacity, which is then made all or nothing by spreading what is lost or won over the neighbours (R. Floyd,
// L. Steinberg, An Adaptive Algorithm for Spatial Greyscale, 1976). A texel that no ray hits is never opaque, one that all hit
// always is. Trimmed to what is opaque, with a rim. Same arguments, same card, for any number of threads.
Card cast_card(const CardSource& source, const CardOrder& order, double texel_m);
constexpr int kRaysPerTexel = 16;
// Texels that cast_card would cast rays through, before it trims.
uint64_t texels_of_card(const Shape& shape, const CardOrder& order, double texel_m);

}  // namespace overlook::discrete
