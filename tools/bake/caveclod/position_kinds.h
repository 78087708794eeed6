// Feature edges and the class of each position, from the edges across which nothing may be smoothed.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tools/bake/caveclod/groups.h"
#include "tools/bake/caveclod/mesh_edges.h"

namespace overlook::caveclod {

// The kind of every position and the feature edges with their rows, into `groups`, whose face_group stands. is_smooth: [3F] edges
// (by their corner) across which the surface group goes on. link: as Mesh::link. O(F + P).
void classify_positions(Corners faces, const MeshEdges& edges, std::span<const uint8_t> is_smooth, std::span<const uint32_t> link,
                        uint32_t position_count, Groups& groups);

// How many faces any coarsest mesh must at least keep under the strict rule, topology kept: what Euler's formula leaves, piece by
// piece, when no position is left but the rigid ones and, of each boundary curve, so few sharp ones that it stays a curve of
// edges that differ from all others (three to a loop of its own, two to one that returns to its only rigid position, one to a
// second way between the same two). O(F + P), but O(n log n) for the n curves.
uint64_t least_face_count(Corners faces, const MeshEdges& edges, const Groups& groups);

// What of `groups` least_face_count looks at, as it is where seams may move: only borders bound, and only is_fixed is rigid. O(F
// + P).
Groups with_borders_alone(const Groups& groups);

}  // namespace overlook::caveclod
