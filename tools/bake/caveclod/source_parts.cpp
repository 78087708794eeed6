#include "tools/bake/caveclod/source_parts.h"

#include <algorithm>
#include <cmath>

#include "formats/parallel.h"
#include "tools/bake/caveclod/disjoint_sets.h"

namespace overlook::caveclod {

SourceParts::SourceParts(std::span<const glm::vec3> positions_m, std::span<const std::array<uint32_t, 3>> faces) {
    DisjointSets sets(positions_m.size());
    for (const auto& face : faces) sets.unite(face[0], face[1]), sets.unite(face[0], face[2]);
    std::vector<uint32_t> number(positions_m.size(), kNoGuess);
    std::vector<std::vector<Triangle>> triangles;
    for (const auto& face : faces) {
        uint32_t& part = number[sets.find(face[0])];
        if (part == kNoGuess) part = uint32_t(triangles.size()), triangles.emplace_back();
        part_.push_back(part);
        place_.push_back(uint32_t(triangles[part].size()));
        triangles[part].push_back(
            {glm::dvec3(positions_m[face[0]]), glm::dvec3(positions_m[face[1]]), glm::dvec3(positions_m[face[2]])});
    }
    trees_.assign(triangles.size(), TriangleTree({}));
    parallel_ranges(trees_.size(), 1, [&](size_t part, size_t) { trees_[part] = TriangleTree(triangles[part]); });
}

size_t SourceParts::first_turned(std::span<const Triangle> faces, double away_m, double slack_m,
                                 std::span<const uint32_t> guesses) const {
    std::vector<uint32_t> places;
    for (uint32_t guess : guesses) places.push_back(place_[guess]);
    return caveclod::first_turned(trees_[part_[guesses[0]]], faces, away_m, slack_m, places);
}

// No point of a face is farther from the source than its middle, and from there to the farthest corner.
bool SourceParts::is_turned(const Triangle& face, double slack_m, uint32_t guess) const {
    const TriangleTree& part = trees_[part_[guess]];
    glm::dvec3 middle = (face[0] + face[1] + face[2]) / 3.0;
    const Triangle& near = part.triangle(place_[guess]);
    double most_m = std::sqrt(distance2_to_triangle(middle, probe_of(near[0], near[1], near[2])));
    double away_m = part.nearest(middle, most_m).distance_m, half_m = 0;
    for (const glm::dvec3& corner : face) half_m = std::max(half_m, glm::distance(middle, corner));
    return first_turned(std::span(&face, 1), away_m + half_m, slack_m, std::span(&guess, 1)) == 0;
}

}  // namespace overlook::caveclod
