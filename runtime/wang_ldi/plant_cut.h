// Triangles cut at planes, before they are brought to the picture.
//
// Based on: I. E. Sutherland, G. W. Hodgman, Reentrant Polygon Clipping, 1974.
#pragma once

#include <array>
#include <cstddef>

#include "runtime/wang_ldi/plant_fill.h"

namespace overlook::wang_ldi {

// Of a triangle that is cut: as Eye::seen, and what changes evenly along it.
struct CutCorner {
    glm::vec3 seen{0};
    std::array<float, 2> uv{};
    Four colour{};
};
// A triangle cut by five planes has eight at most, unless rounding bends it: what there is no room for is left out.
struct Polygon {
    std::array<CutCorner, 16> corners;
    int count = 0;

    void add(const CutCorner& corner) {
        if (size_t(count) < corners.size()) corners[size_t(count++)] = corner;
    }
};

// From a corner that is seen to one that is not, so that both triangles of an edge are cut at the same place.
inline CutCorner between(const CutCorner& in, const CutCorner& out, float in_side, float out_side) {
    float share = in_side / (in_side - out_side);
    CutCorner made;
    made.seen = in.seen + share * (out.seen - in.seen);
    for (size_t k = 0; k < 2; ++k) made.uv[k] = in.uv[k] + share * (out.uv[k] - in.uv[k]);
    made.colour = in.colour + share * (out.colour - in.colour);
    return made;
}

// What of it is on the side where side(seen) is at least 0.
template <class Side>
Polygon cut(const Polygon& from, const Side& side) {
    Polygon made;
    for (int k = 0; k < from.count; ++k) {
        const CutCorner &one = from.corners[size_t(k)], &next = from.corners[size_t((k + 1) % from.count)];
        float here = side(one.seen), there = side(next.seen);
        if (here >= 0) made.add(one);
        if (here >= 0 && there < 0) made.add(between(one, next, here, there));
        if (here < 0 && there >= 0) made.add(between(next, one, there, here));
    }
    return made;
}

}  // namespace overlook::wang_ldi
