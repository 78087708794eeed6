#include "tools/bake/caveclod/hierarchy_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "formats/parallel.h"

namespace overlook::caveclod {
namespace {

struct Numbering {
    std::vector<uint32_t> position, face;  // new number of each of the source's
    std::vector<uint32_t> old_position, old_face;
};

bool goes(const Turn& turn) {
    return turn.to_vertex == kNone;
}

// Coarse to fine: what is left at the end first, then what each split, from the last collapse to the first, brings back.
Numbering number(const WorkingMesh& coarsest, const CollapseLog& log) {
    Numbering made;
    std::vector<uint8_t> went(coarsest.face_count(), 0);
    for (const Turn& turn : log.turns)
        if (goes(turn)) went[turn.corner / kCorners] = 1;
    for (uint32_t p = 0; p < coarsest.some_corner.size(); ++p)
        if (coarsest.is_alive(p)) made.old_position.push_back(p);
    for (uint32_t f = 0; f < went.size(); ++f)
        if (went[f] == 0) made.old_face.push_back(f);
    for (size_t c = log.gone.size(); c-- > 0;) {
        made.old_position.push_back(log.gone[c]);
        for (uint32_t t = log.turn_begin[c]; t < log.turn_begin[c + 1]; ++t)
            if (goes(log.turns[t])) made.old_face.push_back(log.turns[t].corner / kCorners);
    }
    made.position.resize(made.old_position.size());
    made.face.resize(made.old_face.size());
    for (uint32_t p = 0; p < made.position.size(); ++p) made.position[made.old_position[p]] = p;
    for (uint32_t f = 0; f < made.face.size(); ++f) made.face[made.old_face[f]] = f;
    return made;
}

void fill_vertices(const Groups& groups, const WorkingMesh& coarsest, const Numbering& numbering, Hierarchy& h) {
    h.vertices.reserve(groups.vertices.size());
    h.vertex_begin.push_back(0);
    for (uint32_t p = 0; p < numbering.old_position.size(); ++p) {
        uint32_t old = coarsest.source_position[numbering.old_position[p]];
        for (uint32_t v = groups.vertex_begin[old]; v < groups.vertex_begin[old + 1]; ++v) {
            h.vertices.push_back(groups.vertices[v]);
            h.vertices.back().position = p;
        }
        h.vertex_begin.push_back(uint32_t(h.vertices.size()));
    }
}

uint16_t offset_of(const Groups& groups, uint32_t vertex) {
    return uint16_t(vertex - groups.vertex_begin[groups.vertices[vertex].position]);
}

void fill_faces(const Groups& groups, const WorkingMesh& coarsest, const Numbering& numbering, Hierarchy& h) {
    for (uint32_t old : numbering.old_face) {
        std::array<uint32_t, 3> positions;
        for (uint32_t c = 0; c < 3; ++c) {
            positions[c] = numbering.position[coarsest.position(old * kCorners + c)];
            h.birth_wedge.push_back(offset_of(groups, coarsest.vertex(old * kCorners + c)));
        }
        h.face_positions.push_back(positions);
        h.face_group.push_back(coarsest.face_group[old]);
    }
}

void fill_splits(const Groups& groups, const CollapseLog& log, const Numbering& numbering, Hierarchy& h) {
    uint32_t face_count = h.base_face_count;
    h.added_begin.push_back(face_count);
    h.moved_begin.push_back(0);
    std::vector<Turn> row;
    for (size_t c = log.gone.size(); c-- > 0;) {
        row.clear();
        for (uint32_t t = log.turn_begin[c]; t < log.turn_begin[c + 1]; ++t) {
            Turn turn = log.turns[t];
            if (goes(turn))
                ++face_count;
            else
                row.push_back({numbering.face[turn.corner / kCorners] * kCorners + turn.corner % kCorners, turn.from_vertex,
                               turn.to_vertex});
        }
        std::sort(row.begin(), row.end(), [](const Turn& a, const Turn& b) { return a.corner < b.corner; });
        for (const Turn& turn : row) {
            h.moved.push_back(turn.corner);
            h.moved_wedge.push_back(offset_of(groups, turn.from_vertex));
            h.moved_back_wedge.push_back(offset_of(groups, turn.to_vertex));
        }
        h.owner.push_back(numbering.position[log.kept[c]]);
        h.error_m.push_back(log.error_m[c]);
        h.added_begin.push_back(face_count);
        h.moved_begin.push_back(uint32_t(h.moved.size()));
    }
}

// Drops from a row what another of it needs, directly or over one more.
void reduce(const Hierarchy& h, std::vector<uint32_t>& row) {
    auto needs_of = [&](uint32_t split) {
        return std::span(h.needs).subspan(h.need_begin[split], h.need_begin[split + 1] - h.need_begin[split]);
    };
    auto is_implied = [&](uint32_t wanted) {
        for (uint32_t other : row) {
            if (other <= wanted) continue;
            for (uint32_t one : needs_of(other)) {
                if (one == wanted) return true;
                if (one < wanted) continue;
                for (uint32_t two : needs_of(one))
                    if (two == wanted) return true;
            }
        }
        return false;
    };
    row.erase(std::remove_if(row.begin(), row.end(), is_implied), row.end());
}

// Going from coarse to fine, each split needs the last one that touched any of the faces it turns; positions follow, because the
// faces that it turns have all of them as corners, and whoever created one of these touched the face or one whose splits lead to
// it.
void fill_needs(size_t face_count, Hierarchy& h) {
    std::vector<uint32_t> touched_by(face_count, kNone), row;
    h.need_begin.push_back(0);
    for (uint32_t i = 0; i < h.split_count(); ++i) {
        row.clear();
        for (uint32_t m = h.moved_begin[i]; m < h.moved_begin[i + 1]; ++m) {
            uint32_t& last = touched_by[h.moved[m] / kCorners];
            if (last != kNone) row.push_back(last);
            last = i;
        }
        for (uint32_t f = h.added_begin[i]; f < h.added_begin[i + 1]; ++f) touched_by[f] = i;
        std::sort(row.begin(), row.end());
        row.erase(std::unique(row.begin(), row.end()), row.end());
        reduce(h, row);
        h.needs.insert(h.needs.end(), row.begin(), row.end());
        h.need_begin.push_back(uint32_t(h.needs.size()));
    }
    for (uint32_t i = h.split_count(); i-- > 0;)
        for (uint32_t n = h.need_begin[i]; n < h.need_begin[i + 1]; ++n)
            h.error_m[h.needs[n]] = std::max(h.error_m[h.needs[n]], h.error_m[i]);
}

float float_at_least(double value) {
    float rounded = float(value);
    return double(rounded) < value ? std::nextafter(rounded, std::numeric_limits<float>::infinity()) : rounded;
}

uint8_t byte_of(float share) {
    return uint8_t(std::lround(std::clamp(share, 0.0f, 1.0f) * 255));
}

void fill_surfaces(const mesh::Mesh& mesh, Hierarchy& h) {
    for (const mesh::Surface& from : mesh.surfaces) {
        Surface to;
        to.name = from.name;
        for (int c = 0; c < 4; ++c) to.colour[size_t(c)] = byte_of(from.base_colour[c]);
        to.texture = from.texture;
        for (uint8_t byte : from.texture_bytes) to.texture_bytes.push_back(std::byte(byte));
        to.is_alpha_masked = from.is_alpha_masked;
        to.alpha_cutoff = from.alpha_cutoff;
        to.is_two_sided = from.is_two_sided;
        h.surfaces.push_back(std::move(to));
    }
    h.attributes = {true, !mesh.uvs.empty(), !mesh.colours.empty()};
}

}  // namespace

Hierarchy make_rows(const mesh::Mesh& mesh, const Groups& groups, const WorkingMesh& coarsest, const CollapseLog& log) {
    Numbering numbering = number(coarsest, log);
    Hierarchy h;
    h.origin_m = mesh.origin_m;
    h.base_position_count = uint32_t(numbering.position.size() - log.gone.size());
    uint32_t added = uint32_t(std::count_if(log.turns.begin(), log.turns.end(), goes));
    h.base_face_count = uint32_t(numbering.face.size()) - added;
    for (uint32_t old : numbering.old_position) h.positions_m.push_back(coarsest.positions_m[old]);
    // Each fills fields of its own.
    parallel_ranges(3, 1, [&](size_t part, size_t) {
        if (part == 0) {
            fill_splits(groups, log, numbering, h);
            fill_needs(numbering.face.size(), h);
        }
        if (part == 1) fill_faces(groups, coarsest, numbering, h);
        if (part == 2) fill_vertices(groups, coarsest, numbering, h);
    });
    h.group_surface = groups.group_surface;
    h.group_packed = groups.group_packed;
    fill_surfaces(mesh, h);
    return h;
}

uint32_t depth_of(const Hierarchy& h) {
    std::vector<uint32_t> depth(h.split_count(), 1);
    for (uint32_t i = 0; i < h.split_count(); ++i)
        for (uint32_t n = h.need_begin[i]; n < h.need_begin[i + 1]; ++n) depth[i] = std::max(depth[i], depth[h.needs[n]] + 1);
    return depth.empty() ? 0 : *std::max_element(depth.begin(), depth.end());
}

void add_displacement(Hierarchy& hierarchy, double displacement_m) {
    for (float& error_m : hierarchy.error_m) error_m = float_at_least(double(error_m) + displacement_m);
    hierarchy.finest_error_m = float_at_least(double(hierarchy.finest_error_m) + displacement_m);
}

}  // namespace overlook::caveclod
