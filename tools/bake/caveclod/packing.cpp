#include "tools/bake/caveclod/packing.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <span>

namespace overlook::caveclod {
namespace {

constexpr uint32_t kMostPacked = 65535;
constexpr uint32_t kMostCompared = 256;  // groups at a position that are compared pairwise
constexpr int kRounds = 16;
constexpr size_t kCliquesTried = 16;
constexpr uint32_t kMember = 0x80000000;  // of a clique: more than any number of members known

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

// Which ids are taken at each position: a list, or a set of bits where many meet.
class Taken {
  public:
    explicit Taken(const Meetings& meetings) : meetings_(meetings) {}

    // Colours the groups in an order, each with the least id free. Returns how many ids that took.
    uint32_t colour(std::span<const uint32_t> order, std::vector<uint32_t>& colours) {
        filled_.assign(meetings_.position_count(), 0);
        listed_.resize(meetings_.groups.size());
        bits_.assign(meetings_.position_count(), {});
        uint32_t count = 0;
        for (uint32_t group : order) {
            colours[group] = least_free(group);
            take(group, colours[group]);
            count = std::max(count, colours[group] + 1);
        }
        return count;
    }

  private:
    bool is_crowded(uint32_t position) const { return meetings_.groups_at(position).size() > kMostCompared; }
    uint32_t least_free(uint32_t group) {
        forbidden_.clear();
        for (uint32_t position : meetings_.positions_of(group)) {
            const std::vector<uint64_t>& words = bits_[position];
            if (forbidden_.size() < words.size()) forbidden_.resize(words.size(), 0);
            for (size_t i = 0; i < words.size(); ++i) forbidden_[i] |= words[i];
            if (is_crowded(position)) continue;
            for (uint32_t i = 0; i < filled_[position]; ++i) set(forbidden_, listed_[meetings_.begin[position] + i]);
        }
        size_t word = 0;
        while (word < forbidden_.size() && forbidden_[word] == ~uint64_t(0)) ++word;
        uint64_t taken = word < forbidden_.size() ? forbidden_[word] : 0;
        return uint32_t(word * 64) + uint32_t(std::countr_one(taken));
    }
    void take(uint32_t group, uint32_t colour) {
        for (uint32_t position : meetings_.positions_of(group))
            if (is_crowded(position))
                set(bits_[position], colour);
            else
                listed_[meetings_.begin[position] + filled_[position]++] = colour;
    }
    static void set(std::vector<uint64_t>& words, uint32_t bit) {
        if (words.size() <= bit / 64) words.resize(bit / 64 + 1, 0);
        words[bit / 64] |= uint64_t(1) << (bit % 64);
    }

    const Meetings& meetings_;
    std::vector<uint32_t> filled_, listed_;
    std::vector<std::vector<uint64_t>> bits_;
    std::vector<uint64_t> forbidden_;
};

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

// The classes of a colouring one after another, the last first.
std::vector<uint32_t> classes_in_turn(std::span<const uint32_t> order, std::span<const uint32_t> colours) {
    std::vector<uint32_t> next(order.begin(), order.end());
    std::stable_sort(next.begin(), next.end(), [&](uint32_t a, uint32_t b) { return colours[a] > colours[b]; });
    return next;
}

}  // namespace

Result<Packing> pack_groups(const GroupsAtPositions& at, uint32_t group_count) {
    Meetings meetings = meetings_of(at, group_count);
    std::vector<uint64_t> degrees = degrees_of(meetings);
    std::vector<uint32_t> order(group_count), colours(group_count, 0), best;
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return degrees[a] > degrees[b]; });

    Packing packing;
    packing.clique_bound = clique_bound_of(meetings, degrees);
    Taken taken(meetings);
    packing.count = taken.colour(order, colours);
    best = colours;
    for (int round = 0; round < kRounds && packing.count > packing.clique_bound; ++round) {
        order = classes_in_turn(order, colours);
        uint32_t count = taken.colour(order, colours);
        if (count >= packing.count) continue;
        packing.count = count;
        best = colours;
    }
    if (packing.count > kMostPacked)
        return impossible(
            "the surface groups need more than {} identifiers; weld normals (--weld-normals) or leave texture coordinates out "
            "(--ignore-uv)",
            kMostPacked);
    packing.packed.assign(best.begin(), best.end());
    return packing;
}

}  // namespace overlook::caveclod
