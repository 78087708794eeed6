#include "tools/baked/prove_caveclod.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <vector>

namespace overlook::caveclod {
namespace {

// A triangle by its corners' steps on the grid that positions are stored on, turned so that the least comes first (of triangles
// with two corners in one place, too): equal for equal triangles.
using Key = std::array<int64_t, 9>;
using Steps = std::array<int64_t, 3>;

Key key_of(const std::array<Steps, 3>& corners) {
    auto turned = [&](size_t first) {
        Key key;
        for (size_t c = 0; c < 3; ++c) std::copy_n(corners[(first + c) % 3].begin(), 3, key.begin() + ptrdiff_t(3 * c));
        return key;
    };
    return std::min({turned(0), turned(1), turned(2)});
}

Steps steps_of(const glm::dvec3& relative_m, double step_m) {
    return {std::llround(relative_m.x / step_m), std::llround(relative_m.y / step_m), std::llround(relative_m.z / step_m)};
}

std::vector<Key> keys_of_source(const Hierarchy& h, const mesh::Mesh& source) {
    glm::dvec3 shift_m = source.origin_m - h.origin_m;
    std::vector<Key> keys;
    keys.reserve(source.faces.size());
    for (size_t f = 0; f < source.faces.size(); ++f) {
        std::array<Steps, 3> corners;
        for (size_t c = 0; c < 3; ++c)
            corners[c] = steps_of(glm::dvec3(mesh::corner_m(source, f, c)) + shift_m, h.grid.position_step_m);
        keys.push_back(key_of(corners));
    }
    std::sort(keys.begin(), keys.end());
    return keys;
}

std::vector<Key> keys_of_finest(const Hierarchy& h) {
    CutFaces finest = faces_of(h, Applied(h.split_count(), 1));
    std::vector<Key> keys;
    keys.reserve(finest.face.size());
    for (const auto& positions : finest.positions) {
        std::array<Steps, 3> corners;
        for (size_t c = 0; c < 3; ++c) corners[c] = steps_of(glm::dvec3(h.positions_m[positions[c]]), h.grid.position_step_m);
        keys.push_back(key_of(corners));
    }
    std::sort(keys.begin(), keys.end());
    return keys;
}

uint64_t missing_count(const std::vector<Key>& wanted, const std::vector<Key>& there) {
    std::vector<Key> missing;
    std::set_difference(wanted.begin(), wanted.end(), there.begin(), there.end(), std::back_inserter(missing));
    return missing.size();
}

double farthest_moved_m(const Hierarchy& h, const mesh::Mesh& source) {
    glm::dvec3 shift_m = source.origin_m - h.origin_m;
    double farthest_m = 0;
    for (const glm::vec3& position_m : source.positions_m) {
        glm::dvec3 relative_m = glm::dvec3(position_m) + shift_m;
        Steps steps = steps_of(relative_m, h.grid.position_step_m);
        glm::dvec3 stored_m = glm::dvec3(double(steps[0]), double(steps[1]), double(steps[2])) * h.grid.position_step_m;
        farthest_m = std::max(farthest_m, glm::length(stored_m - relative_m));
    }
    return farthest_m;
}

}  // namespace

bool Proof::holds() const {
    return broken_law.empty() && lost_triangle_count == 0 && foreign_triangle_count == 0 &&
           finest_moved_m <= finest_stated_m * (1 + 1e-6) && cuts.broken_count == 0 && cuts.turned_count == 0 &&
           seams.wrong_count == 0;
}

Proof prove(const Hierarchy& hierarchy, const mesh::Mesh& source, const SeamBudget& seams, const ProofOptions& options,
            const std::function<void(double)>& progress) {
    Proof proof;
    proof.triangle_count = source.faces.size();
    proof.broken_law = broken_law(hierarchy);
    if (!proof.broken_law.empty()) return proof;
    std::vector<Key> wanted = keys_of_source(hierarchy, source), there = keys_of_finest(hierarchy);
    proof.lost_triangle_count = missing_count(wanted, there);
    proof.foreign_triangle_count = missing_count(there, wanted);
    proof.finest_stated_m = double(hierarchy.finest_error_m);
    proof.finest_moved_m = farthest_moved_m(hierarchy, source);
    progress(0.1);
    proof.cuts = prove_cuts(hierarchy, options, [&](double share) { progress(0.1 + 0.8 * share); });
    proof.seams = prove_seams(hierarchy, seams, options, [&](double share) { progress(0.9 + 0.1 * share); });
    progress(1);
    return proof;
}

}  // namespace overlook::caveclod
