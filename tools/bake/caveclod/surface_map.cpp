#include "tools/bake/caveclod/surface_map.h"

#include <limits>
#include <utility>

namespace overlook::caveclod {
namespace {

// The places in the fan of the edges between `gone` and link[place] that exist: an open star has one more than faces.
uint32_t spoke_count(const Fan& fan) {
    return fan.count + uint32_t(!fan.is_closed);
}

uint32_t spoke_edge(const WorkingMesh& mesh, const Fan& fan, uint32_t place) {
    return place < fan.count ? mesh.edge(previous_corner(fan.corner[place])) : mesh.edge(next_corner(fan.corner[place - 1]));
}

// The corner that faces link edge `place` once the collapse is made.
uint32_t corner_at_link_edge(const Fan& fan, uint32_t place) {
    if (place < fan.first) return previous_corner(fan.corner[fan.first]);
    return place > fan.last ? next_corner(fan.corner[fan.last]) : fan.corner[place];
}

// The corner that faces the one border edge that an open fan makes.
uint32_t corner_at_new_border(const Fan& fan) {
    return fan.first == 1 ? next_corner(fan.corner[fan.last]) : previous_corner(fan.corner[fan.first]);
}

uint32_t new_label(const SurfaceMap& map, const Fan& fan, uint32_t position, uint32_t place) {
    uint32_t slot = map.points[position].label == kNone ? (fan.is_closed ? 3u : kNone) : map.points[position].label & 3u;
    if (slot == 3) return (fan.corner[map.placement[position].place] | 3u);
    bool is_on_link = slot != kNone && slot == (fan.corner[place] & 3u);
    return is_on_link ? corner_at_link_edge(fan, place) : corner_at_new_border(fan);
}

void put_in_face(SurfaceMap& map, uint32_t position, uint32_t label) {
    map.points[position].label = label;
    map.points[position].next_in_face = std::exchange(map.first_in_face[label / kCorners], position);
}

void relabel(SurfaceMap& map, const Fan& fan, std::vector<uint32_t>& inside) {
    inside.clear();
    for (uint32_t i = 0; i < fan.count; ++i) {
        uint32_t v = std::exchange(map.first_in_face[fan.corner[i] / kCorners], kNone);
        for (; v != kNone; v = map.points[v].next_in_face) inside.push_back(v), map.points[v].label = new_label(map, fan, v, i);
    }
    for (uint32_t v : inside) put_in_face(map, v, map.points[v].label);
    put_in_face(map, fan.gone, new_label(map, fan, fan.gone, 0));
}

void splice(SurfaceMap& map, const WorkingMesh& mesh, const Fan& fan, const Splice& s, MapChanges& changes) {
    uint32_t* link = s.before == kNone ? &map.first_on_source[s.source_edge] : &map.crossings[s.before].next_on_source;
    for (uint32_t c = *link; c != s.after; c = map.crossings[c].next_on_source) changes.spare.push_back(c);
    for (uint32_t i = s.begin; i < s.end; ++i) {
        uint32_t made = changes.spare.back(), edge = spoke_edge(mesh, fan, changes.added[i].place);
        changes.spare.pop_back();
        map.crossings[made] = {edge, s.source_edge, kNone, map.first_on_cut[edge], changes.added[i].at};
        map.first_on_cut[edge] = made;
        *link = made;
        link = &map.crossings[made].next_on_source;
    }
    *link = s.after;
}

void fill_stars(SurfaceMap& map) {
    for (auto [a, b] : map.ends) ++map.star_begin[a + 1], ++map.star_begin[b + 1];
    for (size_t p = 1; p < map.star_begin.size(); ++p) map.star_begin[p] += map.star_begin[p - 1];
    std::vector<uint32_t> filled(map.star_begin.begin(), map.star_begin.end() - 1);
    map.star.resize(2 * map.ends.size());
    for (uint32_t e = 0; e < map.ends.size(); ++e) {
        auto [a, b] = map.ends[e];
        map.star[filled[a]++] = {e, b};
        map.star[filled[b]++] = {e, a};
    }
}

}  // namespace

SurfaceMap make_surface_map(const WorkingMesh& mesh) {
    SurfaceMap map;
    size_t position_count = mesh.some_corner.size(), edge_count = mesh.edge_corners.size(), face_count = mesh.face_count();
    map.points.resize(position_count);
    for (size_t p = 0; p < position_count; ++p) map.points[p].at_m = mesh.positions_m[p];
    for (auto [corner, other] : mesh.edge_corners)
        map.ends.push_back({mesh.position(next_corner(corner)), mesh.position(previous_corner(corner))});
    map.may_lose_m.assign(position_count, std::numeric_limits<float>::infinity());
    map.star_begin.assign(position_count + 1, 0);
    fill_stars(map);
    for (uint32_t f = 0; f < face_count; ++f) {
        const auto& p = mesh.faces[f].position;
        glm::vec3 area(glm::cross(mesh.at(p[1]) - mesh.at(p[0]), mesh.at(p[2]) - mesh.at(p[0])) / 3.0);
        for (size_t c = 0; c < 3; ++c) map.points[p[c]].area_vector_m2 += area;
    }
    map.first_on_source.assign(edge_count, kNone);
    map.first_on_cut.assign(edge_count, kNone);
    map.placement.assign(position_count, {});
    map.first_in_face.assign(face_count, kNone);
    map.fan_of_face.assign(face_count, kNone);
    map.place_in_fan.assign(face_count, 0);
    return map;
}

void apply_to_map(SurfaceMap& map, const WorkingMesh& mesh, const Fan& fan, const Measured& measured, MapChanges& changes) {
    for (uint32_t place = 0; place < spoke_count(fan); ++place) map.first_on_cut[spoke_edge(mesh, fan, place)] = kNone;
    for (uint32_t i = measured.splice_begin; i < measured.splice_end; ++i) splice(map, mesh, fan, changes.splices[i], changes);
    relabel(map, fan, changes.inside);
}

}  // namespace overlook::caveclod
