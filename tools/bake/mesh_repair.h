// A mesh of any triangles made one that every library of halfedges takes, losing no face in silence.
#pragma once

#include "tools/bake/mesh.h"
#include "tools/bake/mesh_report.h"

namespace overlook::mesh {

// Repairs a mesh whose positions are finite and distinct and whose indices are in range; afterwards it keeps all that Mesh says.
//  1. Faces with a repeated position, without area (three positions on one line, decided exactly) and those that stand in the
//  mesh
//     already, the same way round, are dropped, each with its reason. A face that stands there the other way round is a back
//     side: it stays, on a sheet of its own.
//  2. Faces are turned so that neighbours agree, over edges of exactly two faces. A face that agrees with its own normals at all
//     corners is never turned: the file has said twice where its outside is. Of the two ways to turn a piece of others the one
//     that turns fewer faces is taken, so what the file has right stays; where the file is undecided (a third or more against)
//     and the piece closed, the one that encloses a positive volume. Edges where faces do not agree in the end are cut.
//  3. At an edge of more faces those that continue each other flattest, and on the same surface rather than on another, stay
//  joined
//     in pairs; all others are cut apart.
//  4. Where faces at a position form more than one fan it is split, one for each fan; `link` tells that they were one. What is
//     still joined wrongly (an edge cut in the middle of a sheet) is taken apart at one of its ends.
// `report` must have its `dropped` of reading; its counts are added to. Deterministic. Cost O(F) on meshes as they are, memory
// some 60 bytes a face. Sources: A. Gueziec, G. Taubin, F. Lazarus, B. Horn, "Cutting and Stitching: Converting Sets of Polygons
// to Manifold Surfaces", IEEE TVCG 7(2), 2001, sections 4-5 (cutting by joining corners over edges that stay; ours joins the
// flattest pairs first instead of cutting all and stitching by edge length); J. R. Shewchuk, "Adaptive Precision Floating-Point
// Arithmetic and Fast Robust Geometric Predicates", 1997 (exact sums).
void repair(Mesh& mesh, MeshReport& report);

// The first law of Mesh that does not hold, as a sentence ("edge 3-7 has 3 faces"), or "". O(F).
std::string first_fault(const Mesh& mesh);

}  // namespace overlook::mesh
