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

// The render vertices of every position: the source's own, then those whose attributes corners have carried there.
class VertexRows {
  public:
    VertexRows(const Groups& groups, const WorkingMesh& coarsest, const CollapseLog& log) : groups_(groups), mesh_(coarsest) {
        for (size_t c = 0; c < log.gone.size(); ++c)
            for (uint32_t t = log.turn_begin[c]; t < log.turn_begin[c + 1]; ++t)
                if (!goes(log.turns[t]) && (log.turns[t].to_vertex & kCarried) != 0)
                    carried_.push_back({log.kept[c], log.turns[t].to_vertex});
        std::sort(carried_.begin(), carried_.end());
        carried_.erase(std::unique(carried_.begin(), carried_.end()), carried_.end());
        offset_.resize(carried_.size());
        for (size_t begin = 0, end = 0; begin < carried_.size(); begin = end) {
            while (end < carried_.size() && carried_[end].position == carried_[begin].position) ++end;
            lay_row(begin, end);
        }
    }

    // The first position with more render vertices than a row may hold, or kNone.
    uint32_t overfull() const { return overfull_; }

    void append(uint32_t position, std::vector<RenderVertex>& vertices) const {
        uint32_t source = mesh_.source_position[position];
        vertices.insert(vertices.end(), groups_.vertices.begin() + groups_.vertex_begin[source],
                        groups_.vertices.begin() + groups_.vertex_begin[source + 1]);
        uint32_t count = own_count(position);
        for (size_t i = first_at(position); i < carried_.size() && carried_[i].position == position; ++i) {
            if (offset_[i] != count) continue;
            vertices.push_back(mesh_.look(carried_[i].vertex));
            ++count;
        }
    }

    uint16_t offset_of(uint32_t position, uint32_t vertex) const {
        if ((vertex & kCarried) == 0) return uint16_t(vertex - groups_.vertex_begin[groups_.vertices[vertex].position]);
        auto found = std::lower_bound(carried_.begin(), carried_.end(), Carried{position, vertex});
        return uint16_t(offset_[size_t(found - carried_.begin())]);
    }

  private:
    struct Carried {
        uint32_t position = 0, vertex = 0;
        auto operator<=>(const Carried&) const = default;
    };

    uint32_t own_count(uint32_t position) const {
        uint32_t source = mesh_.source_position[position];
        return groups_.vertex_begin[source + 1] - groups_.vertex_begin[source];
    }
    size_t first_at(uint32_t position) const {
        return size_t(std::lower_bound(carried_.begin(), carried_.end(), Carried{position, 0}) - carried_.begin());
    }

    // Looks that are equal share one render vertex: the first that has it, the position's own before those carried there.
    void lay_row(size_t begin, size_t end) {
        uint32_t position = carried_[begin].position;
        std::vector<RenderVertex> row;
        append_own(position, row);
        for (size_t i = begin; i < end; ++i) {
            RenderVertex look = mesh_.look(carried_[i].vertex);
            look.position = 0;
            auto same = std::find(row.begin(), row.end(), look);
            offset_[i] = uint32_t(same - row.begin());
            if (same == row.end()) row.push_back(look);
        }
        if (row.size() > kMostWedges && overfull_ == kNone) overfull_ = position;
    }
    void append_own(uint32_t position, std::vector<RenderVertex>& row) const {
        uint32_t source = mesh_.source_position[position];
        for (uint32_t v = groups_.vertex_begin[source]; v < groups_.vertex_begin[source + 1]; ++v) {
            row.push_back(groups_.vertices[v]);
            row.back().position = 0;
        }
    }

    const Groups& groups_;
    const WorkingMesh& mesh_;
    std::vector<Carried> carried_;  // ascending
    std::vector<uint32_t> offset_;  // of each in its position's row
    uint32_t overfull_ = kNone;
};

void fill_vertices(const VertexRows& rows, const Numbering& numbering, Hierarchy& h) {
    h.vertex_begin.push_back(0);
    for (uint32_t p = 0; p < numbering.old_position.size(); ++p) {
        rows.append(numbering.old_position[p], h.vertices);
        for (size_t v = h.vertex_begin.back(); v < h.vertices.size(); ++v) h.vertices[v].position = p;
        h.vertex_begin.push_back(uint32_t(h.vertices.size()));
    }
}

void fill_faces(const VertexRows& rows, const WorkingMesh& coarsest, const Numbering& numbering, Hierarchy& h) {
    for (uint32_t old : numbering.old_face) {
        std::array<uint32_t, 3> positions;
        for (uint32_t c = 0; c < 3; ++c) {
            uint32_t position = coarsest.position(old * kCorners + c);
            positions[c] = numbering.position[position];
            h.birth_wedge.push_back(rows.offset_of(position, coarsest.vertex(old * kCorners + c)));
        }
        h.face_positions.push_back(positions);
        h.face_group.push_back(coarsest.face_group[old]);
    }
}

void fill_splits(const VertexRows& rows, const CollapseLog& log, const Numbering& numbering, Hierarchy& h) {
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
            h.moved_wedge.push_back(rows.offset_of(log.gone[c], turn.from_vertex));
            h.moved_back_wedge.push_back(rows.offset_of(log.kept[c], turn.to_vertex));
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
    h.attributes = attributes_of(mesh);
}

}  // namespace

Result<Hierarchy> make_rows(const mesh::Mesh& mesh, const Groups& groups, const WorkingMesh& coarsest, const CollapseLog& log) {
    VertexRows rows(groups, coarsest, log);
    if (rows.overfull() != kNone)
        return bad_input("position {} would have more than {} render vertices; bake with --seams strict",
                         coarsest.source_position[rows.overfull()], kMostWedges);
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
            fill_splits(rows, log, numbering, h);
            fill_needs(numbering.face.size(), h);
        }
        if (part == 1) fill_faces(rows, coarsest, numbering, h);
        if (part == 2) fill_vertices(rows, numbering, h);
    });
    h.group_surface = groups.group_surface;
    h.group_packed = groups.group_packed;
    fill_surfaces(mesh, h);
    return h;
}

Attributes attributes_of(const mesh::Mesh& mesh) {
    return {true, !mesh.uvs.empty(), !mesh.colours.empty()};
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
