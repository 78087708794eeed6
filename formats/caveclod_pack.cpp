// A hierarchy into rows of numbers that are small where splits are as their surroundings let expect (after R. Pajarola,
// J. Rossignac, Compressed Progressive Meshes, 2000; here the bake's own order is kept, and errors and wedges go along).
#include <algorithm>

#include "formats/caveclod_layout.h"

namespace overlook::caveclod {
namespace {

uint32_t difference(uint32_t value, uint32_t from) {
    return zigzag(int32_t(value) - int32_t(from));
}

}  // namespace

Packer::Packer(const Hierarchy& hierarchy) : hierarchy_(hierarchy) {
    for (float error_m : hierarchy.error_m) greatest_error_ = std::max(greatest_error_, code_of_error(error_m));
}

void Packer::add_vertex(const Steps& steps, const Steps& expected, Rows& rows) {
    auto add = [&](Row row, auto& now, auto& before) {
        for (size_t k = 0; k < now.size(); ++k) rows[row].push_back(zigzag(now[k] - before[k]));
    };
    if (hierarchy_.attributes.normals) add(kNormal, steps.normal, expected.normal);
    if (hierarchy_.attributes.uvs) add(kUv, steps.uv, expected.uv);
    if (hierarchy_.attributes.colours) add(kColour, steps.colour, expected.colour);
    vertices_.push_back(steps);
}

void Packer::add_vertices(uint32_t position, Rows& rows, std::span<const StarCorner> moved,
                          std::span<const uint16_t> new_wedges) {
    uint32_t begin = hierarchy_.vertex_begin[position], end = hierarchy_.vertex_begin[position + 1];
    rows[kWedgeCount].push_back(end - begin - 1);
    if (end - begin > 1)
        for (uint16_t wedge : new_wedges) rows[kWedge].push_back(wedge);
    for (uint32_t v = begin; v < end; ++v) {
        Steps expected = expected_vertex(state_, hierarchy_, vertices_, moved, new_wedges, uint16_t(v - begin));
        add_vertex(steps_of_vertex(hierarchy_.grid, hierarchy_.vertices[v]), expected, rows);
    }
}

const char* Packer::base(Rows& rows) {
    const Hierarchy& h = hierarchy_;
    for (const glm::vec3& position_m : h.positions_m) {
        positions_.push_back(steps_of_position(h.grid, position_m));
        if (position_of_steps(h.grid, positions_.back()) != position_m) return "positions that are not quantised";
        for (int32_t step : positions_.back().at)
            if (step < 0 || step > most_steps(h.grid.position_bits)) return "positions that are not quantised";
    }
    for (const RenderVertex& vertex : h.vertices)
        if (vertex_of_steps(h.grid, h.attributes, vertex.position, steps_of_vertex(h.grid, vertex)) != vertex)
            return "attributes that are not quantised";
    uint32_t last = 0;
    for (size_t group = 0; group < h.group_surface.size(); ++group) {
        rows[kBase].push_back(difference(h.group_surface[group], last));
        rows[kBase].push_back(h.group_packed[group]);
        last = h.group_surface[group];
    }
    state_.add_positions(h.base_position_count);
    GridPosition before;
    for (uint32_t p = 0; p < h.base_position_count; ++p) {
        for (size_t axis = 0; axis < 3; ++axis) rows[kPosition].push_back(zigzag(positions_[p].at[axis] - before.at[axis]));
        before = positions_[p];
        add_vertices(p, rows, {}, {});
    }
    std::array<uint32_t, 3> face_before{};
    uint32_t group_before = 0;
    for (uint32_t face = 0; face < h.base_face_count; ++face) {
        const auto& at = h.face_positions[face];
        uint32_t from[3] = {face_before[0], at[0], at[1]};
        for (size_t c = 0; c < 3; ++c) rows[kBase].push_back(difference(at[c], from[c]));
        rows[kBase].push_back(difference(h.face_group[face], group_before));
        face_before = at, group_before = h.face_group[face];
        std::array<uint16_t, 3> wedges{};
        for (size_t c = 0; c < 3; ++c) {
            wedges[c] = h.birth_wedge[3 * size_t(face) + c];
            if (h.vertex_begin[at[c] + 1] - h.vertex_begin[at[c]] > 1) rows[kWedge].push_back(wedges[c]);
        }
        state_.add_face(at, wedges, MeshState::kNone);
    }
    return nullptr;
}

// moved_places_ in the order of the star, from an arc's beginning where it is one.
void Packer::find_moves(std::span<const StarCorner> star, uint32_t i) {
    const Hierarchy& h = hierarchy_;
    auto row = std::span(h.moved).subspan(h.moved_begin[i], h.moved_begin[i + 1] - h.moved_begin[i]);
    moved_places_.clear(), is_moved_.assign(star.size(), 0);
    for (uint32_t place = 0; place < star.size(); ++place) {
        is_moved_[place] = std::binary_search(row.begin(), row.end(), star[place].corner);
        if (is_moved_[place] != 0) moved_places_.push_back(place);
    }
    is_arc_ = true;
    if (moved_places_.empty()) return;
    uint32_t begin = moved_places_.front(), length = uint32_t(moved_places_.size());
    // A closed fan may be moved round its end.
    if (moved_places_.front() > 0 ? star[moved_places_.front() - 1].fan != star[begin].fan : true)
        for (uint32_t k = 1; k < length; ++k)
            if (moved_places_[k] != moved_places_[k - 1] + 1) begin = moved_places_[k];
    is_arc_ = is_arc(star, begin, length);
    for (uint32_t k = 0; is_arc_ && k < length; ++k) is_arc_ = is_moved_[in_arc(star, begin, k)] != 0;
    if (!is_arc_) return;
    for (uint32_t k = 0; k < length; ++k) moved_places_[k] = in_arc(star, begin, k);
}

uint32_t Packer::other_flags(const Added& expected, uint32_t i) const {
    const Hierarchy& h = hierarchy_;
    uint32_t begin = h.added_begin[i], count = h.added_begin[i + 1] - begin, created = h.new_position(i);
    constexpr uint32_t kAll = kOtherFaces | kOtherGroups | kOtherWedges;
    if (count != expected.count) return kAll;
    uint32_t flags = 0;
    for (uint32_t k = 0; k < count; ++k) {
        const AddedFace& face = expected.faces[k];
        const auto& at = h.face_positions[begin + k];
        const uint16_t* wedge = h.birth_wedge.data() + 3 * size_t(begin + k);
        bool is_last = at[1] == created;
        if (is_last != face.third_is_last || (is_last ? at[2] : at[1]) != face.third) return kAll;
        if (h.face_group[begin + k] != face.group) flags |= kOtherGroups;
        if (wedge[0] != face.wedges[0] || wedge[is_last ? 1 : 2] != face.wedges[1] || wedge[is_last ? 2 : 1] != face.wedges[2])
            flags |= kOtherWedges;
    }
    return flags;
}

void Packer::add_others(uint32_t i, uint32_t flags, std::span<const StarCorner> star, Rows& rows) {
    const Hierarchy& h = hierarchy_;
    uint32_t begin = h.added_begin[i], end = h.added_begin[i + 1], created = h.new_position(i);
    std::vector<uint32_t>& rare = rows[kRare];
    if ((flags & kOtherMoves) != 0) {
        rare.push_back(uint32_t(moved_places_.size()));
        rare.insert(rare.end(), moved_places_.begin(), moved_places_.end());
    } else {
        rows[kArcLength].push_back(uint32_t(moved_places_.size()));
        if (!moved_places_.empty() && moved_places_.size() < star.size()) rows[kArcBegin].push_back(moved_places_.front());
    }
    if ((flags & kOtherFaces) != 0) {
        rare.push_back(end - begin);
        for (uint32_t face = begin; face < end; ++face) {
            bool is_last = h.face_positions[face][1] == created;
            rare.push_back(uint32_t(is_last));
            rare.push_back(h.face_positions[face][is_last ? 2 : 1]);
        }
    }
    for (uint32_t face = begin; face < end; ++face) {
        if ((flags & kOtherGroups) != 0) rare.push_back(h.face_group[face]);
        bool is_last = h.face_positions[face][1] == created;
        const uint16_t* wedge = h.birth_wedge.data() + 3 * size_t(face);
        if ((flags & kOtherWedges) != 0) rare.insert(rare.end(), {wedge[0], wedge[is_last ? 1 : 2], wedge[is_last ? 2 : 1]});
    }
    if ((flags & kMoreNeeds) == 0) return;
    rare.push_back(uint32_t(more_needs_.size()));
    for (uint32_t need : more_needs_) rare.push_back(i - need);
}

const char* Packer::add_error(uint32_t i, std::span<const uint32_t> needs, Rows& rows) {
    uint32_t limit = greatest_error_, code = code_of_error(hierarchy_.error_m[i]);
    for (uint32_t need : needs) limit = std::min(limit, code_of_error(hierarchy_.error_m[need]));
    if (code > limit) return "an error above that of a split which it needs";
    rows[kError].push_back(limit - code);
    return nullptr;
}

void Packer::apply(uint32_t i) {
    const Hierarchy& h = hierarchy_;
    state_.add_positions(1);
    for (uint32_t k = h.moved_begin[i]; k < h.moved_begin[i + 1]; ++k)
        state_.move(h.moved[k], h.new_position(i), h.moved_wedge[k], i);
    for (uint32_t face = h.added_begin[i]; face < h.added_begin[i + 1]; ++face) {
        const uint16_t* wedge = h.birth_wedge.data() + 3 * size_t(face);
        state_.add_face(h.face_positions[face], {wedge[0], wedge[1], wedge[2]}, i);
    }
}

const char* Packer::split(uint32_t i, Rows& rows) {
    const Hierarchy& h = hierarchy_;
    uint32_t owner = h.owner[i];
    std::span<const StarCorner> star = state_.star(owner);
    if (star.size() > kMostStar) return "a split whose owner has too many faces round it";
    find_moves(star, i);
    if (moved_places_.size() != h.moved_begin[i + 1] - h.moved_begin[i])
        return "a split that moves a face which is not at its owner";
    moved_.clear(), new_wedges_.clear();
    auto row = std::span(h.moved).subspan(h.moved_begin[i], moved_places_.size());
    for (uint32_t place : moved_places_) {
        size_t k = h.moved_begin[i] + size_t(std::lower_bound(row.begin(), row.end(), star[place].corner) - row.begin());
        if (h.moved_back_wedge[k] != state_.wedge(star[place].corner)) return "a wedge that is not the one a corner had before";
        moved_.push_back(star[place]);
        new_wedges_.push_back(h.moved_wedge[k]);
    }
    Added expected;
    if (is_arc_ && !moved_places_.empty())
        expected = expected_faces(state_, h, star, moved_places_.front(), uint32_t(moved_places_.size()), new_wedges_);
    uint32_t flags = other_flags(expected, i) | (is_arc_ ? 0 : kOtherMoves);

    Added added;
    for (uint32_t face = h.added_begin[i]; face < h.added_begin[i + 1]; ++face)
        added.faces[added.count++].third = h.face_positions[face][h.face_positions[face][1] == h.new_position(i) ? 2 : 1];
    touched_needs(state_, h, owner, row, added, needs_);
    auto all = std::span(h.needs).subspan(h.need_begin[i], h.need_begin[i + 1] - h.need_begin[i]);
    more_needs_.clear();
    std::set_difference(all.begin(), all.end(), needs_.begin(), needs_.end(), std::back_inserter(more_needs_));
    if (all.size() != needs_.size() + more_needs_.size()) return "needs that are not complete";
    if (!more_needs_.empty()) flags |= kMoreNeeds;

    rows[kOwner].push_back(difference(owner, last_owner_));
    last_owner_ = owner;
    rows[kFlags].push_back(flags);
    add_others(i, flags, star, rows);
    if (const char* fault = add_error(i, all, rows)) return fault;
    GridPosition near = expected_position(positions_, owner, moved_);
    for (size_t axis = 0; axis < 3; ++axis)
        rows[kPosition].push_back(zigzag(positions_[h.new_position(i)].at[axis] - near.at[axis]));
    add_vertices(h.new_position(i), rows, moved_, new_wedges_);
    apply(i);
    return nullptr;
}

}  // namespace overlook::caveclod
