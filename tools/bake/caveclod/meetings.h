// The graph of surface groups that share a position, as rows of both.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tools/bake/caveclod/packing.h"

namespace overlook::caveclod {

constexpr uint32_t kMostCompared = 256;  // groups at a position that are compared pairwise

// Positions of at least two groups, from both sides.
struct Meetings {
    std::vector<uint32_t> begin{0}, groups;          // rows of positions
    std::vector<uint32_t> group_begin, at_position;  // rows of groups
    uint32_t group_count = 0;

    std::span<const uint32_t> groups_at(uint32_t position) const {
        return std::span(groups).subspan(begin[position], begin[position + 1] - begin[position]);
    }
    std::span<const uint32_t> positions_of(uint32_t group) const {
        return std::span(at_position).subspan(group_begin[group], group_begin[group + 1] - group_begin[group]);
    }
    uint32_t position_count() const { return uint32_t(begin.size() - 1); }
};

Meetings meetings_of(const GroupsAtPositions& at, uint32_t group_count);

// Visits each neighbour of a group once (and a group but once), as far as positions of at most kMostCompared groups show them.
class Neighbours {
  public:
    explicit Neighbours(const Meetings& meetings) : meetings_(meetings), seen_by_(meetings.group_count, 0xffffffff) {}

    template <class Visit>
    void visit(uint32_t group, const Visit& visit) {
        seen_by_[group] = group;
        for (uint32_t position : meetings_.positions_of(group)) {
            if (meetings_.groups_at(position).size() > kMostCompared) continue;
            for (uint32_t other : meetings_.groups_at(position)) {
                if (seen_by_[other] == group) continue;
                seen_by_[other] = group;
                visit(other);
            }
        }
    }

  private:
    const Meetings& meetings_;
    std::vector<uint32_t> seen_by_;
};

// [G] how many neighbours each group has; one at a position of more than kMostCompared groups counts there anew.
std::vector<uint64_t> degrees_of(const Meetings& meetings);

// So many groups at least share a position pairwise: the most at any one position, and what others around share a position with
// all of them (added one by one, from the fullest positions).
uint32_t clique_bound_of(const Meetings& meetings, std::span<const uint64_t> degrees);

}  // namespace overlook::caveclod
