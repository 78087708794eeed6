#include "tools/baked/prove_caveclod.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "formats/parallel.h"
#include "tools/bake/caveclod/cut.h"
#include "tools/bake/caveclod/surface_distance.h"

namespace overlook::caveclod {
namespace {

constexpr double kGap = 0.05;
constexpr uint64_t kMostSteps = 50'000'000;
constexpr double kLeastShare = 0.001, kMostShare = 0.5;

std::vector<Triangle> triangles_of(const Hierarchy& h, const CutFaces& cut) {
    std::vector<Triangle> triangles;
    triangles.reserve(cut.positions.size());
    for (const auto& corners : cut.positions) {
        Triangle t;
        for (size_t c = 0; c < 3; ++c) t[c] = h.origin_m + glm::dvec3(h.positions_m[corners[c]]);
        triangles.push_back(t);
    }
    return triangles;
}

std::vector<Triangle> triangles_of(const mesh::Mesh& mesh) {
    std::vector<Triangle> triangles;
    triangles.reserve(mesh.faces.size());
    for (size_t f = 0; f < mesh.faces.size(); ++f) {
        Triangle t;
        for (size_t c = 0; c < 3; ++c) t[c] = mesh.origin_m + glm::dvec3(mesh::corner_m(mesh, f, c));
        triangles.push_back(t);
    }
    return triangles;
}

using Key = std::array<int64_t, 9>;

// A triangle as whole steps of a grid, its corners turned so that the least comes first: equal for equal triangles.
Key key_of(const Triangle& t, const glm::dvec3& low_m, double step_m) {
    std::array<std::array<int64_t, 3>, 3> corners;
    for (size_t c = 0; c < 3; ++c)
        for (int axis = 0; axis < 3; ++axis) corners[c][size_t(axis)] = std::llround((t[c][axis] - low_m[axis]) / step_m);
    size_t first = size_t(std::min_element(corners.begin(), corners.end()) - corners.begin());
    Key key;
    for (size_t c = 0; c < 3; ++c) std::copy_n(corners[(first + c) % 3].begin(), 3, key.begin() + ptrdiff_t(3 * c));
    return key;
}

std::vector<Key> sorted_keys(const std::vector<Triangle>& triangles, const glm::dvec3& low_m, double step_m) {
    std::vector<Key> keys;
    keys.reserve(triangles.size());
    for (const Triangle& t : triangles) keys.push_back(key_of(t, low_m, step_m));
    std::sort(keys.begin(), keys.end());
    return keys;
}

uint64_t missing_count(const std::vector<Key>& wanted, const std::vector<Key>& there) {
    std::vector<Key> missing;
    std::set_difference(wanted.begin(), wanted.end(), there.begin(), there.end(), std::back_inserter(missing));
    return missing.size();
}

// The finest cut is the source, triangle by triangle, on the grid that positions are stored on.
void check_finest(const Hierarchy& h, const std::vector<Triangle>& source, Proof& proof) {
    CutFaces finest = faces_of(h, Applied(h.split_count(), 1));
    std::vector<Triangle> drawn = triangles_of(h, finest);
    std::vector<Key> wanted = sorted_keys(source, h.origin_m, h.grid.position_step_m);
    std::vector<Key> there = sorted_keys(drawn, h.origin_m, h.grid.position_step_m);
    proof.lost_triangle_count = missing_count(wanted, there);
    proof.foreign_triangle_count = missing_count(there, wanted);
    proof.finest_stated_m = double(h.finest_error_m);
    for (const Triangle& t : source)
        for (const glm::dvec3& corner : t) {
            glm::dvec3 steps = glm::round((corner - h.origin_m) / h.grid.position_step_m);
            proof.finest_moved_m = std::max(proof.finest_moved_m, glm::length(h.origin_m + steps * h.grid.position_step_m - corner));
        }
}

CutCheck check_cut(const Hierarchy& h, const TriangleTree& source, uint64_t seed) {
    std::mt19937_64 random(seed);
    double share = kLeastShare * std::pow(kMostShare / kLeastShare, double(random() >> 11) * 0x1p-53);
    uint64_t wanted = std::max<uint64_t>(1, uint64_t(share * double(h.face_positions.size())));
    Applied applied = random_cut(h, wanted, seed);
    CutFaces cut = faces_of(h, applied);
    CutCheck check;
    check.seed = seed;
    check.triangle_count = cut.face.size();
    check.stated_error_m = stated_error_m(h, applied);
    TriangleTree drawn(triangles_of(h, cut));
    Distance found = two_sided_distance(drawn, source, kGap, kGap * check.stated_error_m, kMostSteps);
    check.least_m = found.least_m, check.most_m = found.most_m;
    return check;
}

}  // namespace

uint64_t Proof::broken_cut_count() const {
    return uint64_t(std::count_if(cuts.begin(), cuts.end(), [](const CutCheck& cut) {
        return cut.least_m > cut.stated_error_m * (1 + 1e-9);
    }));
}

bool Proof::holds() const {
    return broken_law.empty() && lost_triangle_count == 0 && foreign_triangle_count == 0 &&
           finest_moved_m <= finest_stated_m * (1 + 1e-9) && broken_cut_count() == 0;
}

Proof prove(const Hierarchy& hierarchy, const mesh::Mesh& source, uint32_t cut_count, uint64_t seed,
            const std::function<void(double)>& progress) {
    Proof proof;
    proof.triangle_count = source.faces.size();
    proof.broken_law = broken_law(hierarchy);
    if (!proof.broken_law.empty()) return proof;
    std::vector<Triangle> triangles = triangles_of(source);
    check_finest(hierarchy, triangles, proof);
    progress(0.1);

    TriangleTree tree(triangles);
    proof.cuts.resize(cut_count);
    constexpr size_t kAtATime = 8;
    for (size_t begin = 0; begin < cut_count; begin += kAtATime) {
        size_t count = std::min(kAtATime, cut_count - begin);
        parallel_ranges(count, 1, [&](size_t i, size_t) {
            proof.cuts[begin + i] = check_cut(hierarchy, tree, seed + begin + i);
        });
        progress(0.1 + 0.9 * double(begin + count) / cut_count);
    }
    return proof;
}

}  // namespace overlook::caveclod
