// Rows of numbers into a hierarchy: caveclod_pack.cpp the other way round, trusting nothing.
#include <algorithm>

#include "formats/caveclod_layout.h"

namespace overlook::caveclod {
namespace {

constexpr Fault kFine{};
constexpr Fault kCutShort{10, "ends before its rows do"};

}  // namespace

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
    return kFine;
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
    return kFine;
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
    return kFine;
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
    return kFine;
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
    return kFine;
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
    return rows_are_done() ? kFine : Fault{10, "has numbers that nothing asks for"};
}

Fault Unpacker::take_moves(std::span<const StarCorner> star, uint32_t flags, uint32_t& begin) {
    moved_.clear();
    uint32_t length = 0;
    if ((flags & kOtherMoves) != 0) {
        if (!take(kRare, length)) return kCutShort;
        uint32_t last = 0;
        for (uint32_t k = 0; k < length; ++k) {
            uint32_t place = 0;
            if (!take(kRare, place)) return kCutShort;
            if (place >= star.size() || (k > 0 && place <= last))
                return {14, "has a split that moves a face which is not at its owner"};
            moved_.push_back(star[place]);
            last = place;
        }
        return kFine;
    }
    if (!take(kArcLength, length)) return kCutShort;
    begin = 0;
    if (length > 0 && length < star.size() && !take(kArcBegin, begin)) return kCutShort;
    if (!is_arc(star, begin, length)) return {14, "has a split that moves a face which is not at its owner"};
    for (uint32_t k = 0; k < length; ++k) moved_.push_back(star[in_arc(star, begin, k)]);
    return kFine;
}

Fault Unpacker::take_added(uint32_t flags, uint32_t owner, uint32_t created, const Added& expected, Added& added) {
    const Hierarchy& h = hierarchy_;
    added = expected;
    if ((flags & kOtherFaces) != 0) {
        if (!take(kRare, added.count)) return kCutShort;
        if (added.count > 2) return {15, "has a split that adds more than two faces"};
        for (uint32_t k = 0; k < added.count; ++k) {
            uint32_t is_last = 0;
            if (!take(kRare, is_last) || !take(kRare, added.faces[k].third)) return kCutShort;
            added.faces[k].third_is_last = is_last == 1;
            if (is_last > 1 || added.faces[k].third >= created || added.faces[k].third == owner)
                return {15, "has a split that adds a face at a position which is not there"};
        }
    }
    for (uint32_t k = 0; k < added.count; ++k) {
        AddedFace& face = added.faces[k];
        if ((flags & kOtherGroups) != 0 && !take(kRare, face.group)) return kCutShort;
        if (face.group >= h.group_surface.size()) return {15, "has a split that adds a face of a group which is not there"};
        if ((flags & kOtherWedges) == 0) continue;
        uint32_t at[3] = {owner, created, face.third};
        for (size_t c = 0; c < 3; ++c) {
            uint32_t wedge = 0;
            if (!take(kRare, wedge)) return kCutShort;
            if (wedge >= h.vertex_begin[at[c] + 1] - h.vertex_begin[at[c]])
                return {12, "has a corner at a vertex that its position has not"};
            face.wedges[c] = uint16_t(wedge);
        }
    }
    return kFine;
}

Fault Unpacker::take_needs(uint32_t flags, uint32_t owner, const Added& added) {
    Hierarchy& h = hierarchy_;
    uint32_t i = uint32_t(h.owner.size());
    corners_.clear();
    for (const StarCorner& at : moved_) corners_.push_back(at.corner);
    touched_needs(state_, h, owner, corners_, added, needs_);
    if ((flags & kMoreNeeds) != 0) {
        uint32_t count = 0;
        if (!take(kRare, count)) return kCutShort;
        for (uint32_t k = 0; k < count; ++k) {
            uint32_t back = 0;
            if (!take(kRare, back)) return kCutShort;
            if (back == 0 || back > i) return {16, "has a split that needs one which is not before it"};
            needs_.push_back(i - back);
        }
        std::sort(needs_.begin(), needs_.end());
        if (std::adjacent_find(needs_.begin(), needs_.end()) != needs_.end()) return {16, "has a split that needs another twice"};
    }
    h.needs.insert(h.needs.end(), needs_.begin(), needs_.end());
    h.need_begin.push_back(uint32_t(h.needs.size()));
    return kFine;
}

Fault Unpacker::take_error() {
    uint32_t limit = greatest_error_, less = 0;
    for (uint32_t need : needs_) limit = std::min(limit, error_codes_[need]);
    if (!take(kError, less)) return kCutShort;
    if (less > limit) return {17, "has a split with an error below none"};
    error_codes_.push_back(limit - less);
    block_error_ = std::max(block_error_, limit - less);
    hierarchy_.error_m.push_back(error_of_code(limit - less));
    return kFine;
}

void Unpacker::apply(uint32_t owner, uint32_t created, const Added& added) {
    Hierarchy& h = hierarchy_;
    uint32_t i = uint32_t(h.owner.size());
    h.owner.push_back(owner);
    state_.add_positions(1);
    std::vector<uint32_t>& order = needs_;  // no longer wanted
    order.resize(moved_.size());
    for (uint32_t k = 0; k < order.size(); ++k) order[k] = k;
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return moved_[a].corner < moved_[b].corner; });
    for (uint32_t k : order) {
        h.moved.push_back(moved_[k].corner);
        h.moved_wedge.push_back(new_wedges_[k]);
        h.moved_back_wedge.push_back(state_.wedge(moved_[k].corner));
        state_.move(moved_[k].corner, created, new_wedges_[k], i);
    }
    h.moved_begin.push_back(uint32_t(h.moved.size()));
    for (uint32_t k = 0; k < added.count; ++k) {
        const AddedFace& face = added.faces[k];
        std::array<uint32_t, 3> at{owner, face.third, created};
        std::array<uint16_t, 3> wedges{face.wedges[0], face.wedges[2], face.wedges[1]};
        if (face.third_is_last) std::swap(at[1], at[2]), std::swap(wedges[1], wedges[2]);
        state_.add_face(at, wedges, i);
        h.face_positions.push_back(at);
        h.face_group.push_back(face.group);
        h.birth_wedge.insert(h.birth_wedge.end(), wedges.begin(), wedges.end());
    }
    h.added_begin.push_back(uint32_t(h.face_positions.size()));
}

Fault Unpacker::take_split() {
    Hierarchy& h = hierarchy_;
    uint32_t created = h.new_position(h.split_count()), flags = 0, begin = 0;
    int32_t away = 0;
    if (!take_signed(kOwner, away) || !take(kFlags, flags)) return kCutShort;
    uint32_t owner = last_owner_ + uint32_t(away);
    if (owner >= created) return {14, "has a split of a position that is not there"};
    if (flags >= kFlagsEnd) return {14, "has a split with unknown flags"};
    last_owner_ = owner;
    std::span<const StarCorner> star = state_.star(owner);
    if (star.size() > kMostStar) return {14, "has a split whose owner has more than 1,024 faces round it"};
    Added expected, added;
    if (Fault fault = take_moves(star, flags, begin)) return fault;
    if (Fault fault = take_position(expected_position(positions_, owner, moved_))) return fault;
    if (Fault fault = take_row(moved_)) return fault;
    if ((flags & kOtherMoves) == 0) expected = expected_faces(state_, h, star, begin, uint32_t(moved_.size()), new_wedges_);
    if (Fault fault = take_added(flags, owner, created, expected, added)) return fault;
    if (Fault fault = take_needs(flags, owner, added)) return fault;
    if (Fault fault = take_error()) return fault;
    apply(owner, created, added);
    return kFine;
}

Fault Unpacker::splits(const Rows& rows, uint32_t count, uint32_t& greatest_error) {
    rows_ = &rows, taken_ = {}, block_error_ = 0;
    for (uint32_t k = 0; k < count; ++k)
        if (Fault fault = take_split()) return fault;
    greatest_error = block_error_;
    return rows_are_done() ? kFine : Fault{10, "has numbers that nothing asks for"};
}

uint64_t Unpacker::bytes() const {
    return state_.bytes() + positions_.size() * sizeof(GridPosition) + vertices_.size() * sizeof(Steps) +
           error_codes_.size() * sizeof(uint32_t);
}

}  // namespace overlook::caveclod
