#include "tools/bake/caveclod/working_mesh.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "tools/bake/caveclod/spatial_order.h"
#include "tools/bake/caveclod/topology.h"

namespace overlook::caveclod {
namespace {

// Stars of collapses beside one another share link positions, never the face that one of them has to let go of.
void leave_face(WorkingMesh& mesh, uint32_t position, uint32_t face, uint32_t corner_instead) {
    std::atomic_ref<uint32_t> some(mesh.some_corner[position]);
    if (some.load(std::memory_order_relaxed) / kCorners == face) some.store(corner_instead, std::memory_order_relaxed);
}

void join(WorkingMesh& mesh, uint32_t corner, uint32_t outer, uint32_t edge) {
    mesh.opposite(corner) = outer;
    mesh.edge(corner) = edge;
    if (outer != kNone) mesh.opposite(outer) = corner;
    mesh.edge_corners[edge] = {corner, outer};
}

// Face `going` of the fan goes, and its neighbour in the fan takes its place at the link. The edge between `kept` and the far
// corner stays; the one between `gone` and the far corner is no more.
void drop_face(WorkingMesh& mesh, const Fan& fan, uint32_t going, uint32_t neighbour) {
    bool is_first = going < neighbour;
    uint32_t corner = fan.corner[going], inner = fan.corner[neighbour];
    uint32_t side = is_first ? previous_corner(inner) : next_corner(inner);  // faces the edge that the two have in common
    uint32_t lost = mesh.edge(side), stays = mesh.edge(corner);
    mesh.is_feature[stays] = uint8_t(mesh.is_feature[stays] | mesh.is_feature[lost]);
    uint32_t far = is_first ? next_corner(inner) : previous_corner(inner);
    leave_face(mesh, mesh.position(far), corner / kCorners, far);
    leave_face(mesh, fan.kept, corner / kCorners, inner);
    join(mesh, side, mesh.opposite(corner), stays);
}

// The first face of an open star: the one from whose border edge the others follow counter-clockwise.
uint32_t first_of_open(const WorkingMesh& mesh, uint32_t corner) {
    for (uint32_t across = mesh.opposite(previous_corner(corner)); across != kNone;
         across = mesh.opposite(previous_corner(corner)))
        corner = previous_corner(across);
    return corner;
}

std::vector<mesh::Corners> renumber(const mesh::Mesh& mesh, WorkingMesh& made) {
    made.source_position = order_along_curve(mesh.positions_m);
    std::vector<uint32_t> rank(made.source_position.size());
    for (uint32_t p = 0; p < rank.size(); ++p) rank[made.source_position[p]] = p;
    made.source_face = order_by_least_corner(mesh.faces, rank);
    for (uint32_t source : made.source_position) made.positions_m.push_back(mesh.positions_m[source]);
    std::vector<mesh::Corners> faces;
    faces.reserve(mesh.faces.size());
    for (uint32_t source : made.source_face) {
        const mesh::Corners& f = mesh.faces[source];
        faces.push_back({rank[f[0]], rank[f[1]], rank[f[2]]});
    }
    return faces;
}

void fill_corners(std::span<const mesh::Corners> faces, const Groups& groups, WorkingMesh& made) {
    made.some_corner.assign(made.positions_m.size(), kNone);
    for (uint32_t source : made.source_position) {
        PositionKind moving = groups.is_fixed[source] != 0 ? PositionKind::rigid : PositionKind::free;
        made.kind.push_back(made.seams_move ? moving : groups.kind[source]);
    }
    for (uint32_t f = 0; f < faces.size(); ++f) {
        made.face_group.push_back(groups.face_group[made.source_face[f]]);
        for (uint32_t c = 0; c < 3; ++c) {
            made.position(f * kCorners + c) = faces[f][c];
            made.vertex(f * kCorners + c) = groups.face_vertices[made.source_face[f]][c];
            made.some_corner[faces[f][c]] = f * kCorners + c;
        }
    }
}

void fill_vertex_places(const Groups& groups, WorkingMesh& made) {
    made.vertex_place.resize(groups.vertices.size());
    for (uint32_t p = 0; p < made.source_position.size(); ++p)
        for (uint32_t v = groups.vertex_begin[made.source_position[p]]; v < groups.vertex_begin[made.source_position[p] + 1]; ++v)
            made.vertex_place[v] = p;
}

void fill_features(const Groups& groups, WorkingMesh& made) {
    made.is_feature.assign(made.edge_corners.size(), 0);
    for (size_t e = 0; e < made.edge_corners.size(); ++e) {
        uint32_t corner = made.edge_corners[e][0];
        uint32_t a = made.source_position[made.position(next_corner(corner))];
        uint32_t b = made.source_position[made.position(previous_corner(corner))];
        auto begin = groups.feature_ends.begin() + groups.feature_begin[a],
             end = groups.feature_ends.begin() + groups.feature_begin[a + 1];
        made.is_feature[e] = made.edge_corners[e][1] == kNone || std::find(begin, end, b) != end;
    }
}

}  // namespace

bool gather_star(const WorkingMesh& mesh, uint32_t position, Star& star) {
    uint32_t begin = mesh.some_corner[position], corner = begin;
    star.is_closed = true, star.count = 0;
    while (true) {
        if (star.count == kMostValence) return false;
        star.corner[star.count] = corner;
        star.link[star.count++] = mesh.position(next_corner(corner));
        uint32_t across = mesh.opposite(next_corner(corner));
        if (across == kNone && star.is_closed) {
            star.is_closed = false, star.count = 0;
            begin = corner = first_of_open(mesh, begin);
            continue;
        }
        star.link[star.count] = mesh.position(previous_corner(corner));
        if (across == kNone) return true;
        corner = next_corner(across);
        if (corner == begin) return true;
    }
}

bool fan_of(const Star& star, uint32_t gone, uint32_t at, Fan& fan) {
    uint32_t count = star.count;
    if (!star.is_closed && at != 0 && at != count) return false;
    if (count < (star.is_closed ? 3u : 2u)) return false;
    uint32_t turn = star.is_closed ? at : 0;
    fan.count = count, fan.is_closed = star.is_closed;
    for (uint32_t i = 0; i < count; ++i) {
        uint32_t from = i + turn < count ? i + turn : i + turn - count;
        fan.corner[i] = star.corner[from];
        fan.link[i] = star.link[from];
    }
    fan.link[count] = star.is_closed ? fan.link[0] : star.link[count];
    fan.gone = gone, fan.kept = star.link[at];
    fan.first = star.is_closed || at == 0 ? 1 : 0;
    fan.last = star.is_closed || at == count ? count - 2 : count - 1;
    return true;
}

Result<WorkingMesh> make_working_mesh(const mesh::Mesh& mesh, const Groups& groups, bool seams_move) {
    WorkingMesh made;
    made.groups = &groups, made.seams_move = seams_move;
    std::vector<mesh::Corners> faces = renumber(mesh, made);
    auto topology = find_topology(mesh.positions_m.size(), faces);
    if (!topology) return bad_input("face {} {}", made.source_face[topology.error().face], topology.error().why);
    made.faces.resize(faces.size());
    for (uint32_t f = 0; f < faces.size(); ++f) {
        std::copy_n(topology->edge.begin() + f * kCorners, kCorners, made.faces[f].edge.begin());
        std::copy_n(topology->opposite.begin() + f * kCorners, kCorners, made.faces[f].opposite.begin());
    }
    made.edge_corners = std::move(topology->edge_corners);
    fill_corners(faces, groups, made);
    for (uint32_t p = 0; p < made.some_corner.size(); ++p)
        if (made.some_corner[p] == kNone) return bad_input("position {} is no corner of any face", made.source_position[p]);
    fill_features(groups, made);
    if (seams_move) fill_vertex_places(groups, made);
    return made;
}

void apply_collapse(WorkingMesh& mesh, const Fan& fan, std::span<const uint32_t> vertex_at_kept) {
    if (fan.first == 1) drop_face(mesh, fan, 0, 1);
    if (fan.last + 2 == fan.count) drop_face(mesh, fan, fan.count - 1, fan.last);
    for (uint32_t i = fan.first; i <= fan.last; ++i) {
        mesh.position(fan.corner[i]) = fan.kept;
        mesh.vertex(fan.corner[i]) = vertex_at_kept[i];
    }
    mesh.some_corner[fan.gone] = kNone;
}

}  // namespace overlook::caveclod
