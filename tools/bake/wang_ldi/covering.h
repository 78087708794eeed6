// What is thinner than a sample is drawn wide has fewer samples than eyes meet of it, or it would be drawn wider than it is: as
// many as cover, drawn, as much of a picture as it does.
//
// Based on: E. Enderton, E. Sintorn, P. Shirley, D. Luebke, Stochastic Transparency, 2010 (what covers a pixel in part is drawn
// there or not, as often as it covers it). Different: decided once for each sample, by numbers spread evenly over space, so that
// nothing flickers; and by as much as samples beside each other fall on each other.
#pragma once

#include <span>

#include "tools/bake/wang_ldi/sample.h"

namespace overlook::wang_ldi {

// Of a window three pixels wide round each sample, at its depth, as an eye in the middle of the wedge looks at it: how much rays
// meet, and how much samples would cover. A sample is kept whatever else where about half of its own places are met (nearly two
// pixels wide), or fewer where a quarter of the window is: without, grass covers 1.1 times what it should, for 1.6 (of all
// samples 2.6 times), but where it is dense 2.6 % of its pixels stay empty when small holes are filled, for 0.03 %. Into a wedge
// wider than 60 degrees to both sides, whose middle eye does not tell how a thing looks to the others, sixteen look: each sample
// is kept whatever else by what the one sees that it faces most, else by what any of them sees. Same arguments, same samples. 25
// rays a sample at most, 34 of a wide wedge.
// focal_px: of the picture that the image is for, in which samples are drawn in whole pixels, one at least.
Sampled covering(std::span<const TraceStage> stages, const Wedge& wedge, double focal_px, Sampled all, uint64_t seed);

// The share of samples to keep (1 of no place) so that on average as much of a window is covered as `wanted`, 0..1.
// covered_by[n]: places of it that n samples cover of which that share is kept; solid: those that one covers which is kept in any
// case.
double share_covering(double wanted, std::span<const uint32_t> covered_by, uint32_t solid);

}  // namespace overlook::wang_ldi
