#include "tools/bake/caveclod/collapse_rules.h"

#include <algorithm>
#include <cmath>

namespace overlook::caveclod {
namespace {

constexpr double kLeastTurnCosine = 0.25;
// A face's height over its longest side must be at least this share of it, or its normal is noise in float32.
constexpr double kLeastHeightShare = 1e-5;

bool is_in_link(const Fan& fan, uint32_t position) {
    return std::find(fan.link.begin(), fan.link.begin() + fan.count + 1, position) != fan.link.begin() + fan.count + 1;
}

bool first_goes(const Fan& fan) {
    return fan.first == 1;
}
bool last_goes(const Fan& fan) {
    return fan.last + 2 == fan.count;
}

// The third corners of the faces that go.
bool is_far_corner(const Fan& fan, uint32_t position) {
    return (first_goes(fan) && fan.link[1] == position) || (last_goes(fan) && fan.link[fan.count - 1] == position);
}

// Closed curves of three feature edges that the collapse would fold to one edge, walked there and back. Where seams move only
// those of the border count.
bool folds_feature_curve(const WorkingMesh& mesh, const Fan& fan) {
    auto bounds = [&](uint32_t corner) {
        uint32_t edge = mesh.edge(corner);
        return mesh.seams_move ? mesh.edge_corners[edge][1] == kNone : mesh.is_feature[edge] != 0;
    };
    auto folds = [&](uint32_t going, uint32_t spoke_side) { return bounds(spoke_side) && bounds(fan.corner[going]); };
    uint32_t last = fan.count - 1;
    return (first_goes(fan) && folds(0, next_corner(fan.corner[0]))) ||
           (last_goes(fan) && folds(last, previous_corner(fan.corner[last])));
}

}  // namespace

bool keeps_topology(const WorkingMesh& mesh, const Fan& fan) {
    Star kept;
    if (!gather_star(mesh, fan.kept, kept)) return false;
    uint32_t going = uint32_t(first_goes(fan)) + uint32_t(last_goes(fan));
    if (kept.count + fan.count > kMostValence + 2 * going) return false;
    // A border collapsed through the inside would pinch the surface.
    if (!fan.is_closed && kept.is_closed) return false;
    for (uint32_t i = 0; i < kept.count + uint32_t(!kept.is_closed); ++i) {
        uint32_t position = kept.link[i];
        if (position != fan.gone && is_in_link(fan, position) && !is_far_corner(fan, position)) return false;
    }
    // The one face left of a star of three must not be there already.
    if (fan.is_closed && fan.count == 3)
        for (uint32_t i = 0; i < kept.count; ++i)
            if (is_far_corner(fan, kept.link[i]) && is_far_corner(fan, kept.link[i + 1])) return false;
    return !folds_feature_curve(mesh, fan);
}

bool keeps_groups(const WorkingMesh& mesh, const Fan& fan, TurnedVertices& turned) {
    if (mesh.kind[fan.gone] == PositionKind::rigid) return false;
    uint32_t last = fan.count - 1;
    uint32_t edge = first_goes(fan) ? mesh.edge(previous_corner(fan.corner[0])) : mesh.edge(next_corner(fan.corner[last]));
    // Across this edge, and over no other, lies the position that stays.
    if (mesh.kind[fan.gone] == PositionKind::sharp && !mesh.is_feature[edge]) return false;
    struct Pair {
        uint32_t from, to, group;
    };
    std::array<Pair, 2> pairs;
    uint32_t count = 0;
    auto add = [&](uint32_t corner, uint32_t at_kept) {
        pairs[count++] = {mesh.vertex(corner), mesh.vertex(at_kept), mesh.face_group[corner / kCorners]};
    };
    if (first_goes(fan)) add(fan.corner[0], next_corner(fan.corner[0]));
    if (last_goes(fan)) add(fan.corner[last], previous_corner(fan.corner[last]));
    if (count == 2 && pairs[0].from == pairs[1].from && pairs[0].group == pairs[1].group && pairs[0].to != pairs[1].to) {
        if (!mesh.seams_move) return false;
        count = 0;
    }
    for (uint32_t i = fan.first; i <= fan.last; ++i) {
        uint32_t corner = fan.corner[i], group = mesh.face_group[corner / kCorners], vertex = mesh.vertex(corner);
        auto pair = std::find_if(pairs.begin(), pairs.begin() + count,
                                 [&](const Pair& p) { return p.from == vertex && p.group == group; });
        bool is_there = pair != pairs.begin() + count;
        if (!is_there && !mesh.seams_move) return false;
        turned[i] = is_there ? pair->to : vertex | kCarried;
    }
    return true;
}

Hindrance hindrance_of(const WorkingMesh& mesh, uint32_t position) {
    if (mesh.kind[position] == PositionKind::rigid) return Hindrance::fixed;
    Star star;
    if (!gather_star(mesh, position, star)) return Hindrance::topology;
    Hindrance farthest = Hindrance::seams;
    for (uint32_t at = 0; at < star.count + uint32_t(!star.is_closed); ++at) {
        Fan fan;
        TurnedVertices turned;
        if (!fan_of(star, position, at, fan) || !keeps_groups(mesh, fan, turned)) continue;
        Hindrance here = !keeps_topology(mesh, fan)      ? Hindrance::topology
                         : !keeps_orientation(mesh, fan) ? Hindrance::orientation
                                                         : Hindrance::turned;
        farthest = std::max(farthest, here);
    }
    return farthest;
}

bool keeps_orientation(const WorkingMesh& mesh, const Fan& fan) {
    glm::dvec3 kept = mesh.at(fan.kept), gone = mesh.at(fan.gone);
    for (uint32_t i = fan.first; i <= fan.last; ++i) {
        glm::dvec3 a = mesh.at(fan.link[i]), b = mesh.at(fan.link[i + 1]);
        glm::dvec3 turned = glm::cross(a - kept, b - kept), before = glm::cross(a - gone, b - gone);
        double longest2 = std::max({glm::dot(a - kept, a - kept), glm::dot(b - kept, b - kept), glm::dot(b - a, b - a)});
        double turned2 = glm::dot(turned, turned), before2 = glm::dot(before, before), both = glm::dot(turned, before);
        if (before2 == 0) continue;
        if (turned2 <= kLeastHeightShare * kLeastHeightShare * longest2 * longest2) return false;
        if (both <= 0 || both * both < kLeastTurnCosine * kLeastTurnCosine * turned2 * before2) return false;
    }
    return true;
}

}  // namespace overlook::caveclod
