#include "tools/bake/caveclod/prove_cuts.h"

#include <algorithm>
#include <cmath>

#include "formats/parallel.h"
#include "tools/bake/caveclod/surface_distance.h"

namespace overlook::caveclod {
namespace {

// Of the mesh's size: what float32 positions and double arithmetic cannot tell apart.
constexpr double kRoundingShare = 1e-7;

TriangleTree tree_of(const Hierarchy& h, const Applied& applied) {
    std::vector<Triangle> triangles;
    for (const auto& f : faces_of(h, applied).positions)
        triangles.push_back({glm::dvec3(h.positions_m[f[0]]), glm::dvec3(h.positions_m[f[1]]), glm::dvec3(h.positions_m[f[2]])});
    return TriangleTree(triangles);
}

double size_m(const Hierarchy& h) {
    glm::dvec3 low(1e300), high(-1e300);
    for (const glm::vec3& p : h.positions_m) low = glm::min(low, glm::dvec3(p)), high = glm::max(high, glm::dvec3(p));
    return h.positions_m.empty() ? 0 : glm::length(high - low);
}

}  // namespace

CutsProof prove_cuts(const Hierarchy& h, const ProofOptions& options) {
    TriangleTree source = tree_of(h, Applied(h.split_count(), 1));
    double rounding_m = kRoundingShare * size_m(h);
    std::vector<double> stated_m(options.cut_count), measured_m(options.cut_count);
    parallel_ranges(options.cut_count, 1, [&](size_t i, size_t) {
        // The golden ratio's multiples fill the range evenly, however many cuts are drawn.
        double place = std::fmod(double(i + 1) * 0.6180339887498949, 1.0);
        double share = options.least_share * std::pow(options.most_share / options.least_share, place);
        Applied applied = random_cut(h, uint64_t(share * double(h.face_positions.size())) + 1, options.seed + i);
        stated_m[i] = stated_error_m(h, applied);
        measured_m[i] = two_sided_distance(tree_of(h, applied), source, 0.02, rounding_m, options.steps).least_m;
    });
    CutsProof proof;
    proof.cut_count = options.cut_count;
    std::vector<double> ratios;
    for (size_t i = 0; i < options.cut_count; ++i) {
        bool is_broken = measured_m[i] > stated_m[i] * (1 + 1e-6) + rounding_m;
        if (is_broken && proof.broken_count++ == 0) proof.first_broken_seed = options.seed + i;
        if (measured_m[i] <= 10 * rounding_m) continue;
        ratios.push_back(stated_m[i] / measured_m[i]);
        proof.greatest_measured_share =
            std::max(proof.greatest_measured_share, measured_m[i] / std::max(stated_m[i], rounding_m));
    }
    std::sort(ratios.begin(), ratios.end());
    if (!ratios.empty())
        proof.median_stated_over_measured = ratios[ratios.size() / 2], proof.greatest_stated_over_measured = ratios.back();
    return proof;
}

}  // namespace overlook::caveclod
