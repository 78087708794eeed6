#include "tools/bake/caveclod/collapse_cost.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "formats/parallel.h"
#include "tools/bake/caveclod/seam_error.h"

namespace overlook::caveclod {
namespace {

constexpr double kFeatureWeight = 1;    // of a plane upright on a feature edge, over the squared length of the edge
constexpr double kVolumeWeight = 0.5;   // of the mean signed offset
constexpr double kLengthWeight = 1e-9;  // of the distance that the position moves: breaks ties where all is flat
constexpr size_t kGrain = 4096;

glm::dvec3 unit(const glm::dvec3& v) {
    double length = glm::length(v);
    return length > 0 ? v / length : glm::dvec3(0);
}

void add_face(const WorkingMesh& mesh, uint32_t corner, Quadric& quadric) {
    glm::dvec3 a = mesh.at(mesh.position(corner)), b = mesh.at(mesh.position(next_corner(corner)));
    glm::dvec3 c = mesh.at(mesh.position(previous_corner(corner)));
    glm::dvec3 cross = glm::cross(b - a, c - a), normal = unit(cross);
    quadric.add_plane(normal, -glm::dot(normal, a), glm::length(cross) / 2);
    auto add_upright = [&](uint32_t facing, const glm::dvec3& end) {
        if (!mesh.is_feature[mesh.edge(facing)]) return;
        glm::dvec3 along = end - a, upright = unit(glm::cross(normal, along));
        quadric.add_plane(upright, -glm::dot(upright, a), glm::dot(along, along) * kFeatureWeight);
    };
    add_upright(previous_corner(corner), b);
    add_upright(next_corner(corner), c);
}

// The star of a position that may go, with the squared cost of each of its edges: comparing needs no roots.
struct Choices {
    Star star;
    uint32_t count = 0;
    std::array<double, kMostValence + 1> cost2;
};

bool estimate(const WorkingMesh& mesh, const Quadric& quadric, uint32_t position, Choices& choices) {
    Star& star = choices.star;
    if (mesh.kind[position] == PositionKind::rigid || !gather_star(mesh, position, star)) return false;
    glm::dvec3 from = mesh.at(position), area_vector(0), before = mesh.at(star.link[0]) - from;
    for (uint32_t i = 0; i < star.count; ++i) {
        glm::dvec3 after = mesh.at(star.link[i + 1]) - from;
        area_vector += glm::cross(before, after);
        before = after;
    }
    double vector2 = glm::dot(area_vector, area_vector),
           volume2 = vector2 > 0 ? kVolumeWeight * kVolumeWeight / (9 * vector2) : 0;
    double inverse_weight = quadric.weight > 0 ? 1 / quadric.weight : 0;
    choices.count = star.count + uint32_t(!star.is_closed);
    for (uint32_t i = 0; i < choices.count; ++i) {
        glm::dvec3 to = mesh.at(star.link[i]), step = to - from;
        double mean2 = std::max(quadric.at(to), 0.0) * inverse_weight, along = glm::dot(area_vector, step);
        choices.cost2[i] = mean2 + volume2 * along * along + kLengthWeight * kLengthWeight * glm::dot(step, step);
    }
    return true;
}

uint32_t cheapest(const Choices& choices) {
    return uint32_t(std::min_element(choices.cost2.begin(), choices.cost2.begin() + choices.count) - choices.cost2.begin());
}

}  // namespace

void Quadric::add_plane(const glm::dvec3& n, double d, double w) {
    xx += w * n.x * n.x, xy += w * n.x * n.y, xz += w * n.x * n.z, yy += w * n.y * n.y, yz += w * n.y * n.z, zz += w * n.z * n.z;
    x += w * d * n.x, y += w * d * n.y, z += w * d * n.z, one += w * d * d, weight += w;
}

void Quadric::add(const Quadric& o) {
    xx += o.xx, xy += o.xy, xz += o.xz, yy += o.yy, yz += o.yz, zz += o.zz;
    x += o.x, y += o.y, z += o.z, one += o.one, weight += o.weight;
}

double Quadric::at(const glm::dvec3& p) const {
    return p.x * (xx * p.x + 2 * (xy * p.y + xz * p.z + x)) + p.y * (yy * p.y + 2 * (yz * p.z + y)) + p.z * (zz * p.z + 2 * z) +
           one;
}

std::vector<Quadric> make_quadrics(const WorkingMesh& mesh) {
    std::vector<Quadric> quadrics(mesh.some_corner.size());
    parallel_ranges(quadrics.size(), kGrain, [&](size_t begin, size_t end) {
        Star star;
        for (size_t p = begin; p < end; ++p) {
            if (!mesh.is_alive(uint32_t(p)) || !gather_star(mesh, uint32_t(p), star)) continue;
            for (uint32_t i = 0; i < star.count; ++i) add_face(mesh, star.corner[i], quadrics[p]);
        }
    });
    return quadrics;
}

void RefusedFaces::add(const Fan& fan, uint32_t place) {
    faces_.push_back({fan.kept, fan.link[place], fan.link[place + 1], first_[fan.gone]});
    first_[fan.gone] = uint32_t(faces_.size() - 1);
}

bool RefusedFaces::has_one_of(const Fan& fan) const {
    for (uint32_t f = first_[fan.gone]; f != kNone; f = faces_[f].next) {
        if (faces_[f].kept != fan.kept) continue;
        for (uint32_t i = fan.first; i <= fan.last; ++i)
            if (fan.link[i] == faces_[f].second && fan.link[i + 1] == faces_[f].third) return true;
    }
    return false;
}

Candidate find_candidate(const WorkingMesh& mesh, std::span<const Quadric> quadrics, const RefusedFaces& refused,
                         uint32_t position, double above_m) {
    Choices choices;
    if (!estimate(mesh, quadrics[position], position, choices)) return {};
    Fan fan;
    TurnedVertices turned;
    Candidate best{std::numeric_limits<double>::infinity(), kNone, 0};
    for (uint32_t tries = 0; tries < choices.count; ++tries) {
        uint32_t at = cheapest(choices);
        double bare_m = std::sqrt(choices.cost2[at]);
        if (bare_m >= best.cost_m) break;
        bool is_allowed = bare_m > above_m && fan_of(choices.star, position, at, fan) && !refused.has_one_of(fan) &&
                          keeps_groups(mesh, fan, turned) && keeps_orientation(mesh, fan) && keeps_topology(mesh, fan);
        choices.cost2[at] = std::numeric_limits<double>::infinity();
        if (!is_allowed) continue;
        double cost_m = std::max(bare_m, seam_shift_m(mesh, fan, turned));
        if (cost_m < best.cost_m) best = {cost_m, choices.star.link[at], bare_m};
    }
    return best;
}

Candidate guess_candidate(const WorkingMesh& mesh, std::span<const Quadric> quadrics, uint32_t position) {
    Choices choices;
    if (!estimate(mesh, quadrics[position], position, choices)) return {};
    uint32_t at = cheapest(choices);
    return {std::sqrt(choices.cost2[at]), choices.star.link[at], std::sqrt(choices.cost2[at])};
}

}  // namespace overlook::caveclod
