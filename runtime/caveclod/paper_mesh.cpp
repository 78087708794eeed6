// The static structures of CAVECLOD as printed.
#include <algorithm>

#include "formats/caveclod_state.h"
#include "runtime/caveclod/paper.h"

namespace overlook::caveclod::paper {
namespace {

// The face with the directed edge from -> to, other than `except`; kNone if there is none.
uint32_t face_with_edge(MeshState& state, uint32_t from, uint32_t to, uint32_t except) {
    for (const StarCorner& at : state.star(from))
        if (at.next == to && at.corner / kCorners != except) return at.corner / kCorners;
    return kNone;
}

}  // namespace

Equation1 equation1(uint64_t n, uint64_t p, uint64_t d, uint64_t s, uint64_t e, uint64_t active_nodes, uint64_t active_polygons,
                    uint64_t cameras) {
    return {44 * n, 12 * p, 32 * d, 2 * s * e, 12 * active_nodes, 36 * active_polygons, cameras * (4 * n + 4 * p + 16)};
}

void Mesh::enter(uint32_t face, uint32_t position, uint32_t wedge) {
    entries_.push_back(
        {position, hierarchy_.group_packed[hierarchy_.face_group[face]], hierarchy_.vertex_begin[position] + wedge});
}

// Of equal places the last stays.
void Mesh::sort_entries() {
    auto is_before = [](const Entry& a, const Entry& b) {
        return a.position != b.position ? a.position < b.position : a.packed < b.packed;
    };
    std::stable_sort(entries_.begin(), entries_.end(), is_before);
    size_t kept = 0;
    for (size_t k = 0; k < entries_.size(); ++k)
        if (k + 1 == entries_.size() || is_before(entries_[k], entries_[k + 1])) entries_[kept++] = entries_[k];
    entries_.resize(kept);
    entry_begin_.assign(hierarchy_.positions_m.size() + 1, 0);
    for (const Entry& entry : entries_) ++entry_begin_[entry.position + 1];
    for (size_t p = 0; p + 1 < entry_begin_.size(); ++p) entry_begin_[p + 1] += entry_begin_[p];
}

Mesh::Mesh(const Hierarchy& hierarchy) : hierarchy_(hierarchy) {
    const Hierarchy& h = hierarchy;
    for (uint16_t packed : h.group_packed) packed_count_ = std::max(packed_count_, packed + 1u);
    nodes_.resize(h.base_position_count + 2 * size_t(h.split_count()));
    creator_.assign(h.face_positions.size(), kNone);
    std::vector<uint32_t> node_of(h.positions_m.size());  // the one that stands there after the splits so far
    MeshState state;
    state.add_positions(h.positions_m.size());
    auto add_face = [&](uint32_t face, uint32_t by) {
        const uint16_t* wedge = h.birth_wedge.data() + 3 * size_t(face);
        state.add_face(h.face_positions[face], {wedge[0], wedge[1], wedge[2]}, by);
        for (size_t c = 0; c < 3; ++c) enter(face, h.face_positions[face][c], wedge[c]);
    };
    for (uint32_t p = 0; p < h.base_position_count; ++p) node_of[p] = p, nodes_[p].position = p;
    for (uint32_t face = 0; face < h.base_face_count; ++face) add_face(face, MeshState::kNone);
    for (uint32_t i = 0; i < h.split_count(); ++i) {
        uint32_t owner = h.owner[i], created = h.new_position(i), parent = node_of[owner];
        uint32_t stationary = h.base_position_count + 2 * i, floating = stationary + 1;
        Node& node = nodes_[parent];
        node.stationary = stationary, node.floating = floating, node.split = i;
        nodes_[stationary].parent = nodes_[floating].parent = parent;
        nodes_[stationary].position = owner, nodes_[floating].position = created;
        node_of[owner] = stationary, node_of[created] = floating;
        for (uint32_t k = h.moved_begin[i]; k < h.moved_begin[i + 1]; ++k) {
            state.move(h.moved[k], created, h.moved_wedge[k], i);
            enter(h.moved[k] / kCorners, created, h.moved_wedge[k]);
        }
        for (uint32_t face = h.added_begin[i]; face < h.added_begin[i + 1]; ++face) add_face(face, i), creator_[face] = parent;
        for (uint32_t face = h.added_begin[i]; face < h.added_begin[i + 1]; ++face) {
            bool is_left = h.face_positions[face][1] == created;
            uint32_t third = h.face_positions[face][is_left ? 2 : 1];
            node.polygons[is_left ? 0 : 1] = face;
            uint32_t* neighbours = node.neighbours.data() + (is_left ? 0 : 2);
            neighbours[0] = is_left ? face_with_edge(state, owner, third, face) : face_with_edge(state, third, owner, face);
            neighbours[1] = is_left ? face_with_edge(state, third, created, face) : face_with_edge(state, created, third, face);
        }
    }
    sort_entries();
}

uint32_t Mesh::vertex(uint16_t packed, uint32_t position) const {
    auto begin = entries_.begin() + entry_begin_[position], end = entries_.begin() + entry_begin_[position + 1];
    auto found = std::lower_bound(begin, end, packed, [](const Entry& entry, uint16_t wanted) { return entry.packed < wanted; });
    return found != end && found->packed == packed ? found->vertex : kNone;
}

}  // namespace overlook::caveclod::paper
