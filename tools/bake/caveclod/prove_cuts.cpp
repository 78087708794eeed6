#include "tools/bake/caveclod/prove_cuts.h"

#include <algorithm>
#include <cmath>

#include "formats/parallel.h"
#include "tools/bake/caveclod/source_parts.h"
#include "tools/bake/caveclod/surface_distance.h"

namespace overlook::caveclod {
namespace {

// Of the mesh's size: what float32 positions and double arithmetic cannot tell apart.
constexpr double kRoundingShare = 1e-7;
constexpr uint64_t kCutsAtOnce = 16;  // between two words of progress

Triangle triangle_of(const Hierarchy& h, const std::array<uint32_t, 3>& f) {
    return {glm::dvec3(h.positions_m[f[0]]), glm::dvec3(h.positions_m[f[1]]), glm::dvec3(h.positions_m[f[2]])};
}

TriangleTree tree_of(const Hierarchy& h, const CutFaces& cut) {
    std::vector<Triangle> triangles;
    triangles.reserve(cut.positions.size());
    for (const auto& f : cut.positions) triangles.push_back(triangle_of(h, f));
    return TriangleTree(triangles);
}

double size_m(const Hierarchy& h) {
    glm::dvec3 low(1e300), high(-1e300);
    for (const glm::vec3& p : h.positions_m) low = glm::min(low, glm::dvec3(p)), high = glm::max(high, glm::dvec3(p));
    return h.positions_m.empty() ? 0 : glm::length(high - low);
}

// The finest cut, which stands for the source; its face i is the hierarchy's face i.
struct Source {
    CutFaces finest;
    TriangleTree tree;
    SourceParts parts;
    double rounding_m = 0, slack_m = 0;
};

struct Measured {
    double stated_m = 0, distance_m = 0;
    uint64_t face_count = 0, turned_count = 0;
};

// Faces that are as in the source are not turned from it.
uint64_t turned_count(const Hierarchy& h, const Source& source, const CutFaces& cut) {
    uint64_t count = 0;
    for (size_t f = 0; f < cut.face.size(); ++f) {
        if (cut.positions[f] == source.finest.positions[cut.face[f]]) continue;
        count += source.parts.is_turned(triangle_of(h, cut.positions[f]), source.slack_m, cut.face[f]);
    }
    return count;
}

Measured measure(const Hierarchy& h, const Source& source, const ProofOptions& options, uint64_t i) {
    Applied applied = proof_cut(h, options, i);
    CutFaces cut = faces_of(h, applied);
    double stated_m = stated_error_m(h, applied);
    Distance distance = two_sided_distance(tree_of(h, cut), source.tree, 0.02, source.rounding_m, options.steps);
    return {stated_m, distance.least_m, cut.face.size(), turned_count(h, source, cut)};
}

}  // namespace

Applied proof_cut(const Hierarchy& h, const ProofOptions& options, uint64_t i) {
    // The golden ratio's multiples fill the range evenly, however many cuts are drawn.
    double place = std::fmod(double(i + 1) * 0.6180339887498949, 1.0);
    double share = options.least_share * std::pow(options.most_share / options.least_share, place);
    return random_cut(h, uint64_t(share * double(h.face_positions.size())) + 1, options.seed + i);
}

CutsProof prove_cuts(const Hierarchy& h, const ProofOptions& options, const std::function<void(double)>& progress) {
    CutFaces finest = faces_of(h, Applied(h.split_count(), 1));
    TriangleTree tree = tree_of(h, finest);
    SourceParts parts(h.positions_m, finest.positions);
    Source source{std::move(finest), std::move(tree), std::move(parts), kRoundingShare * size_m(h), turn_slack_m(h.positions_m)};
    std::vector<Measured> cuts(options.cut_count);
    for (uint64_t begin = 0; begin < options.cut_count; begin += kCutsAtOnce) {
        progress(double(begin) / double(options.cut_count));
        uint64_t count = std::min<uint64_t>(kCutsAtOnce, options.cut_count - begin);
        parallel_ranges(count, 1, [&](size_t i, size_t) { cuts[begin + i] = measure(h, source, options, begin + i); });
    }
    CutsProof proof;
    proof.cut_count = options.cut_count;
    std::vector<double> ratios;
    for (size_t i = 0; i < options.cut_count; ++i) {
        const Measured& cut = cuts[i];
        proof.face_count += cut.face_count, proof.turned_count += cut.turned_count;
        bool is_broken = cut.distance_m > cut.stated_m * (1 + 1e-6) + source.rounding_m;
        if (is_broken && proof.broken_count++ == 0) proof.first_broken_seed = options.seed + i;
        if (cut.distance_m <= 10 * source.rounding_m) continue;
        ratios.push_back(cut.stated_m / cut.distance_m);
        proof.greatest_measured_share =
            std::max(proof.greatest_measured_share, cut.distance_m / std::max(cut.stated_m, source.rounding_m));
    }
    std::sort(ratios.begin(), ratios.end());
    if (!ratios.empty())
        proof.median_stated_over_measured = ratios[ratios.size() / 2], proof.greatest_stated_over_measured = ratios.back();
    return proof;
}

}  // namespace overlook::caveclod
