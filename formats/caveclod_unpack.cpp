// Rows of numbers into a hierarchy: caveclod_pack.cpp the other way round, trusting nothing. Splits: caveclod_unpack_splits.cpp.
#include "formats/caveclod_layout.h"

namespace overlook::caveclod {

bool Unpacker::take(Row row, uint32_t& value) {
    const std::vector<uint32_t>& from = (*rows_)[row];
    if (taken_[row] == from.size()) return false;
    value = from[taken_[row]++];
    return true;
}

bool Unpacker::take_signed(Row row, int32_t& value) {
    uint32_t coded = 0;
    if (!take(row, coded)) return false;
    value = unzigzag(coded);
    return true;
}

bool Unpacker::rows_are_done() const {
    for (size_t row = 0; row < kRowCount; ++row)
        if (taken_[row] != (*rows_)[row].size()) return false;
    return true;
}

Fault Unpacker::take_position(const GridPosition& expected) {
    GridPosition position;
    for (size_t axis = 0; axis < 3; ++axis) {
        int32_t away = 0;
        if (!take_signed(kPosition, away)) return kCutShort;
        int64_t at = int64_t(expected.at[axis]) + away;
        if (at < 0 || at > most_steps(hierarchy_.grid.position_bits)) return {11, "has a position beyond the grid"};
        position.at[axis] = int32_t(at);
    }
    positions_.push_back(position);
    hierarchy_.positions_m.push_back(position_of_steps(hierarchy_.grid, position));
    return kNoFault;
}

Fault Unpacker::take_vertex(uint32_t position, const Steps& expected) {
    const Hierarchy& h = hierarchy_;
    Steps steps;
    bool is_within = true, is_there = true;
    auto one = [&](Row row, auto& now, const auto& before, int32_t least, int32_t most) {
        for (size_t k = 0; k < now.size(); ++k) {
            int32_t away = 0;
            is_there = is_there && take_signed(row, away);
            int64_t at = int64_t(before[k]) + away;
            is_within = is_within && at >= least && at <= most;
            now[k] = is_within ? int32_t(at) : 0;
        }
    };
    int32_t half = h.attributes.normals ? most_steps(h.grid.normal_bits) / 2 : 0;
    if (h.attributes.normals) one(kNormal, steps.normal, expected.normal, -half, half);
    if (h.attributes.uvs) one(kUv, steps.uv, expected.uv, 0, most_steps(h.grid.uv_bits));
    if (h.attributes.colours) one(kColour, steps.colour, expected.colour, 0, 255);
    if (!is_there) return kCutShort;
    if (!is_within) return {12, "has an attribute beyond its grid"};
    vertices_.push_back(steps);
    hierarchy_.vertices.push_back(vertex_of_steps(h.grid, h.attributes, position, steps));
    return kNoFault;
}

// The vertices of the next position, and through new_wedges_ which of them each moved corner takes.
Fault Unpacker::take_row(std::span<const StarCorner> moved) {
    uint32_t more = 0, position = uint32_t(hierarchy_.vertex_begin.size() - 1), first = hierarchy_.vertex_begin.back();
    if (!take(kWedgeCount, more)) return kCutShort;
    if (more >= kMostWedges) return {12, "has a position with more than 65,535 vertices"};
    new_wedges_.assign(moved.size(), 0);
    if (more > 0) {
        for (uint16_t& wedge : new_wedges_) {
            uint32_t value = 0;
            if (!take(kWedge, value)) return kCutShort;
            if (value > more) return {12, "has a corner at a vertex that its position has not"};
            wedge = uint16_t(value);
        }
    }
    hierarchy_.vertex_begin.push_back(first + more + 1);
    for (uint32_t wedge = 0; wedge <= more; ++wedge) {
        Steps expected = expected_vertex(state_, hierarchy_, vertices_, moved, new_wedges_, uint16_t(wedge));
        if (Fault fault = take_vertex(position, expected)) return fault;
    }
    return kNoFault;
}

Fault Unpacker::take_groups(uint32_t count) {
    uint32_t last = 0;
    for (uint32_t group = 0; group < count; ++group) {
        int32_t away = 0;
        uint32_t packed = 0;
        if (!take_signed(kBase, away) || !take(kBase, packed)) return kCutShort;
        uint32_t surface = last + uint32_t(away);
        if (surface >= hierarchy_.surfaces.size() || packed > 65535)
            return {13, "has a group of no surface, or a packed one above 65,535"};
        hierarchy_.group_surface.push_back(surface);
        hierarchy_.group_packed.push_back(uint16_t(packed));
        last = surface;
    }
    return kNoFault;
}

Fault Unpacker::take_faces() {
    Hierarchy& h = hierarchy_;
    std::array<uint32_t, 3> before{};
    uint32_t group = 0;
    for (uint32_t face = 0; face < h.base_face_count; ++face) {
        std::array<uint32_t, 3> at{};
        for (size_t c = 0; c < 3; ++c) {
            int32_t away = 0;
            if (!take_signed(kBase, away)) return kCutShort;
            at[c] = (c == 0 ? before[0] : at[c - 1]) + uint32_t(away);
            if (at[c] >= h.base_position_count) return {13, "has a face at a position that is not there"};
        }
        int32_t away = 0;
        if (!take_signed(kBase, away)) return kCutShort;
        group += uint32_t(away);
        if (group >= h.group_surface.size()) return {13, "has a face of a group that is not there"};
        if (at[0] == at[1] || at[1] == at[2] || at[2] == at[0]) return {13, "has a face with two corners at one position"};
        std::array<uint16_t, 3> wedges{};
        for (size_t c = 0; c < 3; ++c) {
            uint32_t value = 0, count = h.vertex_begin[at[c] + 1] - h.vertex_begin[at[c]];
            if (count > 1 && !take(kWedge, value)) return kCutShort;
            if (value >= count) return {12, "has a corner at a vertex that its position has not"};
            wedges[c] = uint16_t(value);
        }
        state_.add_face(at, wedges, MeshState::kNone);
        h.face_positions.push_back(at);
        h.face_group.push_back(group);
        h.birth_wedge.insert(h.birth_wedge.end(), wedges.begin(), wedges.end());
        before = at;
    }
    return kNoFault;
}

Fault Unpacker::base(const Rows& rows, uint32_t group_count) {
    Hierarchy& h = hierarchy_;
    rows_ = &rows, taken_ = {};
    if (Fault fault = take_groups(group_count)) return fault;
    state_.add_positions(h.base_position_count);
    h.vertex_begin.assign(1, 0), h.need_begin.assign(1, 0), h.moved_begin.assign(1, 0);
    for (uint32_t p = 0; p < h.base_position_count; ++p) {
        if (Fault fault = take_position(positions_.empty() ? GridPosition{} : positions_.back())) return fault;
        if (Fault fault = take_row({})) return fault;
    }
    if (Fault fault = take_faces()) return fault;
    h.added_begin.assign(1, h.base_face_count);
    return rows_are_done() ? kNoFault : Fault{10, "has numbers that nothing asks for"};
}

uint64_t Unpacker::bytes() const {
    return state_.bytes() + positions_.size() * sizeof(GridPosition) + vertices_.size() * sizeof(Steps) +
           error_codes_.size() * sizeof(uint32_t);
}

}  // namespace overlook::caveclod
