// Which half-edge collapses keep the surface, its groups and its orientation.
#pragma once

#include <array>
#include <cstdint>

#include "tools/bake/caveclod/working_mesh.h"

namespace overlook::caveclod {

// The render vertex that each turned corner of a fan has at the position that stays; [i] belongs to face i.
using TurnedVertices = std::array<uint32_t, kMostValence>;

// Whether the result is a surface of the same kind: link condition (Dey, Edelsbrunner, Guha, Nekhayev 1999), no face doubled, no
// closed border or feature curve of three edges folded away, valences below kMostValence.
bool keeps_topology(const WorkingMesh& mesh, const Fan& fan);

// The rules of Kram and Shaw 2002, 3.3, by wedge: a free position may go anywhere, a sharp one along a feature edge only (of
// which the other end is then sharp or rigid), a rigid one nowhere; and every turned corner finds at the kept position a render
// vertex of its own group that its own render vertex shares a going face with. Fills `turned` if so. Where seams move, only rigid
// ones are held, and a corner that finds none carries its attributes along (kCarried).
bool keeps_groups(const WorkingMesh& mesh, const Fan& fan, TurnedVertices& turned);

// Whether no turned face degenerates (as seen in float32) or turns its normal by more than about 75 degrees; one that had no area
// may do as it likes.
bool keeps_orientation(const WorkingMesh& mesh, const Fan& fan);

// What keeps a position in a cut. Of one that nothing may be done with any more: the rule that its collapse comes to, taking of
// all its edges the one that comes farthest, and where all rules are kept what was measured. Of the others, what they cost.
enum class Hindrance : uint8_t {
    fixed,        // the position must stay
    seams,        // keeps_groups
    topology,     // keeps_topology, or too many faces
    orientation,  // keeps_orientation
    turned,       // a face would look away from its source
    texels,       // a seam's budget would be passed
    degrees,      // likewise
    error,        // it goes, but what its collapse makes is farther off than the cut may be
    order         // it goes for less, but one that is too dear goes before it
};
constexpr size_t kHindranceCount = 9;
using HindranceCounts = std::array<uint64_t, kHindranceCount>;

// One of the first four; turned where they all are kept.
Hindrance hindrance_of(const WorkingMesh& mesh, uint32_t position);

}  // namespace overlook::caveclod
