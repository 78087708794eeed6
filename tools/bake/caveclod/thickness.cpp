#include "tools/bake/caveclod/thickness.h"

#include <cmath>
#include <limits>

#include "formats/parallel.h"

namespace overlook::caveclod {
namespace {

constexpr size_t kGrain = 1024;
constexpr double kLeastCosine = 0.5;  // between the ray and the normal of the wall that it leaves through

// Of length 1, or 0.
glm::dvec3 outward_at(const WorkingMesh& mesh, const Star& star, uint32_t position) {
    glm::dvec3 here = mesh.at(position), sum(0);
    for (uint32_t i = 0; i < star.count; ++i) sum += glm::cross(mesh.at(star.link[i]) - here, mesh.at(star.link[i + 1]) - here);
    double length = glm::length(sum);
    return length > 0 ? sum / length : glm::dvec3(0);
}

}  // namespace

std::vector<float> thickness_of_positions(const WorkingMesh& mesh, const SourceParts& source, double slack_m, double most_m) {
    std::vector<float> thickness_m(mesh.some_corner.size(), std::numeric_limits<float>::infinity());
    parallel_ranges(thickness_m.size(), kGrain, [&](size_t begin, size_t end) {
        Star star;
        for (size_t p = begin; p < end; ++p) {
            if (!mesh.is_alive(uint32_t(p)) || !gather_star(mesh, uint32_t(p), star)) continue;
            glm::dvec3 inward = -outward_at(mesh, star, uint32_t(p));
            if (inward == glm::dvec3(0)) continue;
            const TriangleTree& part = source.part_of(star.corner[0] / kCorners);
            TriangleTree::Nearest wall = part.ahead({mesh.at(uint32_t(p)), inward, slack_m, most_m});
            if (wall.triangle == kNone) continue;
            const Triangle& t = part.triangle(wall.triangle);
            glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
            if (glm::dot(normal, inward) >= kLeastCosine * glm::length(normal)) thickness_m[p] = float(wall.distance_m);
        }
    });
    return thickness_m;
}

}  // namespace overlook::caveclod
