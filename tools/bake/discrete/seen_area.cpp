#include "tools/bake/discrete/seen_area.h"

#include <algorithm>
#include <cmath>

#include "formats/caveclod_octahedral.h"
#include "formats/parallel.h"
#include "tools/bake/discrete/card.h"

namespace overlook::discrete {
namespace {

std::array<glm::dvec3, kSeenFrom> directions() {
    std::array<glm::dvec3, kSeenFrom> all;
    size_t next = 0;
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z) {
                int first = x != 0 ? x : y != 0 ? y : z;
                if (first > 0) all[next++] = glm::normalize(glm::dvec3(x, y, z));
            }
    return all;
}

}  // namespace

std::array<double, kSeenFrom> seen_areas_m2(const Shape& shape, const Looks& looks, const glm::dvec3& middle_m, double radius_m) {
    constexpr uint32_t kSide = 192;
    std::array<double, kSeenFrom> areas_m2{};
    std::vector<caveclod::Triangle> triangles = shape.triangles();
    if (triangles.empty()) return areas_m2;
    RayScene rays(triangles);
    AcceptHit accept = [&](uint32_t face, float second, float third) {
        return looks.is_drawn(shape, face, {1.0 - double(second) - double(third), second, third});
    };
    double step_m = 2 * radius_m / kSide;
    std::array<glm::dvec3, kSeenFrom> from = directions();
    std::vector<uint32_t> hits(kSeenFrom * kSide, 0);
    parallel_ranges(hits.size(), 8, [&](size_t begin, size_t end) {
        for (size_t row = begin; row < end; ++row) {
            CardPlane plane = plane_of(middle_m, from[row / kSide]);
            for (uint32_t x = 0; x < kSide; ++x) {
                // Rows out of step, so that nothing upright falls between all rays.
                double right_m = (x + (double(row * 5 % 8) + 0.5) / 8 - kSide / 2.0) * step_m,
                       up_m = (double(row % kSide) + 0.5 - kSide / 2.0) * step_m;
                glm::dvec3 at = middle_m + right_m * plane.right + up_m * plane.up + 2 * radius_m * plane.normal;
                hits[row] += rays.first(at, -plane.normal, 4 * radius_m, accept).triangle != RayHit::kNone;
            }
        }
    });
    for (size_t row = 0; row < hits.size(); ++row) areas_m2[row / kSide] += hits[row] * step_m * step_m;
    return areas_m2;
}

SeenChange seen_change(const std::array<double, kSeenFrom>& finest_m2, const std::array<double, kSeenFrom>& level_m2,
                       double finest_area_m2) {
    SeenChange change;
    if (finest_area_m2 <= 0) return change;
    for (size_t i = 0; i < kSeenFrom; ++i) {
        double less_m2 = finest_m2[i] - level_m2[i];
        change.lost += std::max(less_m2, 0.0), change.added += std::max(-less_m2, 0.0);
    }
    double share = 2 / (double(kSeenFrom) * finest_area_m2);
    return {change.lost * share, change.added * share};
}

Shape shape_of_level(const Chain& chain, const Level& level) {
    Shape shape;
    for (const Vertex& v : level.vertices) {
        glm::dvec2 octahedral(v.normal[0] / 32767.0, v.normal[1] / 32767.0);
        glm::dvec2 uv = chain.uv_low + chain.uv_step * glm::dvec2(v.uv[0], v.uv[1]);
        shape.vertices.push_back(
            {position_m(chain, v), v.part, glm::vec3(caveclod::vector_of_octahedral(octahedral)), glm::vec2(uv), v.colour});
    }
    for (const Draw& draw : level.draws)
        for (uint32_t i = draw.first_index; i < draw.first_index + draw.index_count; i += 3) {
            shape.faces.push_back({level.indices[i], level.indices[i + 1], level.indices[i + 2]});
            shape.face_surface.push_back(draw.surface);
        }
    return shape;
}

std::array<double, kSeenFrom> seen_areas_m2(const Chain& chain, const Level& level, const Looks& looks) {
    return seen_areas_m2(shape_of_level(chain, level), looks, chain.middle_m, chain.radius_m);
}

}  // namespace overlook::discrete
