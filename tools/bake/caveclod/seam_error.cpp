#include "tools/bake/caveclod/seam_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tools/bake/caveclod/distances.h"

namespace overlook::caveclod {
namespace {

// One face of the fan as it is after the collapse.
struct TurnedFace {
    std::array<glm::dvec3, 3> at;
    std::array<uint32_t, 3> vertex;
    std::array<const RenderVertex*, 3> looks;
    uint32_t group = 0;
    glm::dvec2 texture_px{kTextureSize_px};
    bool is_mixed = false;
};

bool is_carried(uint32_t vertex) {
    return (vertex & kCarried) != 0;
}

glm::dvec2 texture_px_of(const SeamBudget& budget, uint32_t surface) {
    return surface < budget.texture_px.size() ? budget.texture_px[surface] : glm::dvec2(kTextureSize_px);
}

TurnedFace turned_face(const WorkingMesh& mesh, const Fan& fan, const TurnedVertices& turned, uint32_t i,
                       const SeamBudget& budget) {
    TurnedFace face;
    uint32_t corner = fan.corner[i];
    face.at = {mesh.at(fan.kept), mesh.at(fan.link[i]), mesh.at(fan.link[i + 1])};
    face.vertex = {turned[i], mesh.vertex(next_corner(corner)), mesh.vertex(previous_corner(corner))};
    for (size_t c = 0; c < 3; ++c) face.looks[c] = &mesh.look(face.vertex[c]);
    face.group = mesh.face_group[corner / kCorners];
    face.texture_px = texture_px_of(budget, mesh.groups->group_surface[face.group]);
    face.is_mixed = std::any_of(face.vertex.begin(), face.vertex.end(), is_carried);
    return face;
}

// Against the nearest in look of the group's own render vertices at the position; nothing where it has none.
SeamError error_at(const WorkingMesh& mesh, const TurnedFace& face, uint32_t position) {
    const Groups& groups = *mesh.groups;
    uint32_t source = mesh.source_position[position];
    SeamError least;
    double least_share = std::numeric_limits<double>::max();
    RenderVertex drawn = interpolated(mesh.at(position), face.at, face.looks);
    for (uint32_t v = groups.vertex_begin[source]; v < groups.vertex_begin[source + 1]; ++v) {
        if (groups.vertex_group[v] != face.group) continue;
        SeamError error = between(drawn, groups.vertices[v], face.texture_px);
        double share = error.uv_texels + error.normal_deg;
        if (share < least_share) least_share = share, least = error;
    }
    return least;
}

SeamError error_at_origins(const WorkingMesh& mesh, const TurnedFace& face) {
    SeamError error;
    for (uint32_t vertex : face.vertex) {
        if (!is_carried(vertex)) continue;
        glm::dvec3 from = mesh.at(mesh.vertex_place[vertex & ~kCarried]);
        error.include(between(interpolated(from, face.at, face.looks), mesh.look(vertex), face.texture_px));
    }
    return error;
}

}  // namespace

void SeamError::include(const SeamError& other) {
    uv_texels = std::max(uv_texels, other.uv_texels);
    normal_deg = std::max(normal_deg, other.normal_deg);
}

bool SeamError::is_within(const SeamBudget& budget) const {
    return uv_texels <= budget.uv_texels && normal_deg <= budget.normal_deg;
}

SeamError between(const RenderVertex& a, const RenderVertex& b, const glm::dvec2& texture_px) {
    glm::dvec3 na(a.normal), nb(b.normal);
    double turn_rad = std::atan2(glm::length(glm::cross(na, nb)), glm::dot(na, nb));
    return {glm::length((glm::dvec2(a.uv) - glm::dvec2(b.uv)) * texture_px), turn_rad * 180 / std::numbers::pi};
}

RenderVertex interpolated(const glm::dvec3& p, const std::array<glm::dvec3, 3>& at,
                          const std::array<const RenderVertex*, 3>& looks) {
    glm::dvec3 w = weights_at(p, at[0], at[1], at[2]), normal(0);
    glm::dvec2 uv(0);
    for (glm::length_t c = 0; c < 3; ++c) {
        normal += glm::dvec3(looks[size_t(c)]->normal) * w[c];
        uv += glm::dvec2(looks[size_t(c)]->uv) * w[c];
    }
    RenderVertex drawn;
    drawn.normal = glm::vec3(normal), drawn.uv = glm::vec2(uv);
    return drawn;
}

double seam_shift_m(const WorkingMesh& mesh, const Fan& fan, const TurnedVertices& turned) {
    double shift_m = 0;
    if (!mesh.seams_move) return shift_m;
    for (uint32_t i = fan.first; i <= fan.last; ++i) {
        if (!is_carried(turned[i])) continue;
        glm::dvec3 from = mesh.at(mesh.vertex_place[turned[i] & ~kCarried]);
        shift_m = std::max(shift_m, glm::distance(from, mesh.at(fan.kept)));
    }
    return shift_m;
}

SeamError seam_error(const WorkingMesh& mesh, const Fan& fan, const TurnedVertices& turned, std::span<const uint32_t> placed,
                     std::span<const uint32_t> places, const SeamBudget& budget) {
    std::array<TurnedFace, kMostValence> faces;
    SeamError error;
    bool has_mixed = false;
    for (uint32_t i = fan.first; i <= fan.last; ++i) {
        faces[i] = turned_face(mesh, fan, turned, i, budget);
        if (!faces[i].is_mixed) continue;
        has_mixed = true;
        error.include(error_at_origins(mesh, faces[i]));
    }
    for (size_t k = 0; has_mixed && k < placed.size(); ++k)
        if (faces[places[k]].is_mixed) error.include(error_at(mesh, faces[places[k]], placed[k]));
    return error;
}

}  // namespace overlook::caveclod
