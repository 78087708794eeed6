#include "tools/bake/caveclod/meetings.h"

#include <algorithm>
#include <numeric>

namespace overlook::caveclod {
namespace {

constexpr size_t kCliquesTried = 16;
constexpr uint32_t kMember = 0x80000000;  // of a clique: more than any number of members known

// The groups at a position, and others that share a position with all of them, while there are such. Returns how many.
uint32_t grow_clique(const Meetings& meetings, uint32_t position, std::span<const uint64_t> degrees) {
    std::vector<uint32_t> known(meetings.group_count, 0), touched;
    std::span<const uint32_t> first = meetings.groups_at(position);
    if (first.size() > kMostCompared) return uint32_t(first.size());
    Neighbours neighbours(meetings);
    auto add = [&](uint32_t group) {
        known[group] = kMember;
        neighbours.visit(group, [&](uint32_t other) {
            if (known[other]++ == 0) touched.push_back(other);
        });
    };
    for (uint32_t group : first) add(group);
    for (uint32_t size = uint32_t(first.size());; ++size) {
        uint32_t best = meetings.group_count;
        for (uint32_t group : touched)
            if (known[group] == size && (best == meetings.group_count || degrees[group] > degrees[best])) best = group;
        if (best == meetings.group_count) return size;
        add(best);
    }
}

}  // namespace

Meetings meetings_of(const GroupsAtPositions& at, uint32_t group_count) {
    Meetings meetings;
    meetings.group_count = group_count;
    for (size_t position = 0; position + 1 < at.begin.size(); ++position) {
        if (at.begin[position + 1] - at.begin[position] < 2) continue;
        meetings.groups.insert(meetings.groups.end(), at.groups.begin() + at.begin[position],
                               at.groups.begin() + at.begin[position + 1]);
        meetings.begin.push_back(uint32_t(meetings.groups.size()));
    }

    meetings.group_begin.assign(size_t(group_count) + 1, 0);
    for (uint32_t group : meetings.groups) ++meetings.group_begin[group + 1];
    std::partial_sum(meetings.group_begin.begin(), meetings.group_begin.end(), meetings.group_begin.begin());
    std::vector<uint32_t> cursor(meetings.group_begin.begin(), meetings.group_begin.end() - 1);
    meetings.at_position.resize(meetings.groups.size());
    for (uint32_t position = 0; position < meetings.position_count(); ++position)
        for (uint32_t group : meetings.groups_at(position)) meetings.at_position[cursor[group]++] = position;
    return meetings;
}

std::vector<uint64_t> degrees_of(const Meetings& meetings) {
    std::vector<uint64_t> degrees(meetings.group_count, 0);
    Neighbours neighbours(meetings);
    for (uint32_t group = 0; group < meetings.group_count; ++group) {
        neighbours.visit(group, [&](uint32_t) { ++degrees[group]; });
        for (uint32_t position : meetings.positions_of(group)) {
            size_t crowd = meetings.groups_at(position).size();
            if (crowd > kMostCompared) degrees[group] += crowd - 1;
        }
    }
    return degrees;
}

uint32_t clique_bound_of(const Meetings& meetings, std::span<const uint64_t> degrees) {
    std::vector<uint32_t> largest(meetings.position_count());
    std::iota(largest.begin(), largest.end(), 0u);
    size_t tried = std::min(largest.size(), kCliquesTried);
    std::partial_sort(largest.begin(), largest.begin() + tried, largest.end(), [&](uint32_t a, uint32_t b) {
        size_t in_a = meetings.groups_at(a).size(), in_b = meetings.groups_at(b).size();
        return in_a != in_b ? in_a > in_b : a < b;
    });
    uint32_t bound = meetings.group_count > 0 ? 1 : 0;
    for (size_t i = 0; i < tried; ++i) bound = std::max(bound, grow_clique(meetings, largest[i], degrees));
    return bound;
}

}  // namespace overlook::caveclod
