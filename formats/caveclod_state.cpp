#include "formats/caveclod_state.h"

#include <algorithm>
#include <numeric>

namespace overlook::caveclod {

void MeshState::link(uint32_t corner, uint32_t position) {
    next_[corner] = first_[position];
    previous_[corner] = kNone;
    if (first_[position] != kNone) previous_[first_[position]] = corner;
    first_[position] = corner;
}

void MeshState::unlink(uint32_t corner, uint32_t position) {
    if (previous_[corner] == kNone)
        first_[position] = next_[corner];
    else
        next_[previous_[corner]] = next_[corner];
    if (next_[corner] != kNone) previous_[next_[corner]] = previous_[corner];
}

void MeshState::add_face(const std::array<uint32_t, 3>& positions, const std::array<uint16_t, 3>& wedges, uint32_t touched_by) {
    uint32_t face = uint32_t(positions_.size());
    positions_.push_back(positions);
    wedges_.push_back(wedges);
    touched_by_.push_back(touched_by);
    next_.resize(next_.size() + kCorners, kNone);
    previous_.resize(next_.size(), kNone);
    for (uint32_t c = 0; c < 3; ++c) link(face * kCorners + c, positions[c]);
}

void MeshState::move(uint32_t corner, uint32_t to, uint16_t wedge, uint32_t touched_by) {
    uint32_t face = corner / kCorners, c = corner % kCorners;
    unlink(corner, positions_[face][c]);
    positions_[face][c] = to;
    wedges_[face][c] = wedge;
    touched_by_[face] = touched_by;
    link(corner, to);
}

void MeshState::gather(uint32_t position) {
    found_.clear();
    for (uint32_t corner = first_[position]; corner != kNone; corner = next_[corner]) {
        uint32_t face = corner / kCorners, c = corner % kCorners;
        found_.push_back({corner, positions_[face][(c + 1) % 3], positions_[face][(c + 2) % 3], 0, false, false});
    }
    std::sort(found_.begin(), found_.end(), [](const StarCorner& a, const StarCorner& b) { return a.corner < b.corner; });
    by_next_.resize(found_.size());
    std::iota(by_next_.begin(), by_next_.end(), 0u);
    by_previous_ = by_next_;
    std::sort(by_next_.begin(), by_next_.end(),
              [&](uint32_t a, uint32_t b) { return found_[a].next != found_[b].next ? found_[a].next < found_[b].next : a < b; });
    std::sort(by_previous_.begin(), by_previous_.end(),
              [&](uint32_t a, uint32_t b) { return found_[a].previous < found_[b].previous; });
}

// One fan from `from` on, as far as it goes.
void MeshState::walk(size_t from, uint32_t fan) {
    size_t at = from;
    while (true) {
        is_taken_[at] = 1;
        star_.push_back(found_[at]);
        star_.back().fan = fan;
        uint32_t wanted = found_[at].previous;
        auto next = std::lower_bound(by_next_.begin(), by_next_.end(), wanted,
                                     [&](uint32_t i, uint32_t position) { return found_[i].next < position; });
        if (next == by_next_.end() || found_[*next].next != wanted) {
            star_.back().ends_open = true;
            return;
        }
        uint32_t& taken = cursor_[size_t(next - by_next_.begin())];
        next += taken;
        for (; next != by_next_.end() && found_[*next].next == wanted && is_taken_[*next] != 0; ++next) ++taken;
        if (next == by_next_.end() || found_[*next].next != wanted) return;
        at = *next;
    }
}

std::span<const StarCorner> MeshState::star(uint32_t position) {
    gather(position);
    star_.clear();
    is_taken_.assign(found_.size(), 0);
    cursor_.assign(found_.size(), 0);
    uint32_t fan = 0;
    for (size_t i = 0; i < found_.size(); ++i) {
        auto before = std::lower_bound(by_previous_.begin(), by_previous_.end(), found_[i].next,
                                       [&](uint32_t j, uint32_t at) { return found_[j].previous < at; });
        if (before != by_previous_.end() && found_[*before].previous == found_[i].next) continue;
        if (is_taken_[i] != 0) continue;
        size_t first = star_.size();
        walk(i, fan++);
        star_[first].begins_open = true;
    }
    for (size_t i = 0; i < found_.size(); ++i)
        if (is_taken_[i] == 0) walk(i, fan++);
    return star_;
}

}  // namespace overlook::caveclod
