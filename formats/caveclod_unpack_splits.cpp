// The rows of a block's splits, one split after the other; the base's are in caveclod_unpack.cpp.
#include <algorithm>

#include "formats/caveclod_layout.h"

namespace overlook::caveclod {

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
        return kNoFault;
    }
    if (!take(kArcLength, length)) return kCutShort;
    begin = 0;
    if (length > 0 && length < star.size() && !take(kArcBegin, begin)) return kCutShort;
    if (!is_arc(star, begin, length)) return {14, "has a split that moves a face which is not at its owner"};
    for (uint32_t k = 0; k < length; ++k) moved_.push_back(star[in_arc(star, begin, k)]);
    return kNoFault;
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
    return kNoFault;
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
    return kNoFault;
}

Fault Unpacker::take_error() {
    uint32_t limit = greatest_error_, less = 0;
    for (uint32_t need : needs_) limit = std::min(limit, error_codes_[need]);
    if (!take(kError, less)) return kCutShort;
    if (less > limit) return {17, "has a split with an error below none"};
    error_codes_.push_back(limit - less);
    block_error_ = std::max(block_error_, limit - less);
    hierarchy_.error_m.push_back(error_of_code(limit - less));
    return kNoFault;
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
    return kNoFault;
}

Fault Unpacker::splits(const Rows& rows, uint32_t count, uint32_t& greatest_error) {
    rows_ = &rows, taken_ = {}, block_error_ = 0;
    for (uint32_t k = 0; k < count; ++k)
        if (Fault fault = take_split()) return fault;
    greatest_error = block_error_;
    return rows_are_done() ? kNoFault : Fault{10, "has numbers that nothing asks for"};
}

}  // namespace overlook::caveclod
