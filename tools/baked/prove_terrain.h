// Re-proves the promises of a baked terrain against its source, by other means than those that made them.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "tools/bake/dem.h"
#include "tools/baked/cut_geometry.h"

namespace overlook::terrain {

struct CutProof {
    double tolerance_m = 0;
    uint64_t void_rim_triangle_count = 0;
    CutReport report;
};

struct Proof {
    uint64_t sample_count = 0, void_count = 0, triangle_count = 0;  // triangles of the whole hierarchy, each checked
    double greatest_stored_m = 0;                                   // of stored heights from the source's
    double tightest = 0, mean_tightness = 0;  // measured / promised over the hierarchy's triangles (1 = exact)
    Places heights;                           // samples further from the source than the finest error
    Places triangles;                         // triangles further from a sample than their code allows
    uint64_t codes_above_parent = 0;          // 0 or 1: reading stops at the first
    std::vector<CutProof> cuts;
    bool holds() const;
};

// Source heights in metres of an elevation model.
Source source_of(const dem::Raster& dem);

// Checks (1) every stored height; (2) every triangle of every diamond of the hierarchy against every sample that it covers: any
// cut is made of these, so any cut keeps its tolerance; (3) whole cuts at each tolerance: every sample, every edge, every finest
// cell. Source and terrain must have the same size. O(samples * log samples).
Proof prove(const Terrain& terrain, const Source& source, std::span<const double> tolerances_m,
            const std::function<void(double)>& progress);

}  // namespace overlook::terrain
