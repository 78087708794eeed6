// How thick things are where their surface is.
#pragma once

#include <vector>

#include "tools/bake/caveclod/source_parts.h"
#include "tools/bake/caveclod/working_mesh.h"

namespace overlook::caveclod {

// Of what stands on both sides of a thing, each may take this share of its thickness, so that a third of it stays at the least.
constexpr double kMostThinning = 1.0 / 3;
// What takes more is stated at so many times what it takes: by the time that comes to a pixel, a sixteenth of a pixel is lost on
// either side, an eighth of the picture's contrast.
constexpr double kThinningWeight = 16;

// Thin is what is no thicker than this share of the mesh's size (the diagonal of the box round it): what may be less than a pixel
// wide where the mesh is a hundred. All else becomes that thin when the whole mesh is hardly to be seen, and is stated as it is.
constexpr double kThinnestShare = 0.01;

// [P] metres, along the inward normal of each position (of the faces round it, by area) to the wall that the ray leaves the same
// part of the source through; infinite where there is none, where it is not looked at from within (turned by more than 60 degrees
// from the ray), where it is farther than most_m, and within slack_m of the position. source: of the mesh's faces, by their
// numbers. Surfaces that enclose nothing have no thickness, and parts that reach into one another each their own. Related: L.
// Shapira, A. Shamir, D. Cohen-Or, Consistent Mesh Partitioning and Skeletonisation using the Shape Diameter Function, 2008 (the
// mean of a cone of rays, where this is one). O(P log F), any number of threads.
std::vector<float> thickness_of_positions(const WorkingMesh& mesh, const SourceParts& source, double slack_m, double most_m);

}  // namespace overlook::caveclod
