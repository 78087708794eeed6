#include "tools/bake/caveclod/packing.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <queue>
#include <span>
#include <tuple>

#include "tools/bake/caveclod/meetings.h"

namespace overlook::caveclod {
namespace {

constexpr uint32_t kMostPacked = 65535;
constexpr int kRounds = 16;

// Which ids are taken at each position: a list, or a set of bits where many meet.
class Taken {
  public:
    explicit Taken(const Meetings& meetings)
        : meetings_(meetings),
          filled_(meetings.position_count(), 0),
          listed_(meetings.groups.size()),
          bits_(meetings.position_count()) {}

    // Takes the least id that is free at all of the group's positions, there, and returns it.
    uint32_t take_least(uint32_t group) {
        uint32_t id = least_free(group);
        for (uint32_t position : meetings_.positions_of(group))
            if (is_crowded(position))
                set(bits_[position], id);
            else
                listed_[meetings_.begin[position] + filled_[position]++] = id;
        return id;
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
    static void set(std::vector<uint64_t>& words, uint32_t bit) {
        if (words.size() <= bit / 64) words.resize(bit / 64 + 1, 0);
        words[bit / 64] |= uint64_t(1) << (bit % 64);
    }

    const Meetings& meetings_;
    std::vector<uint32_t> filled_, listed_;
    std::vector<std::vector<uint64_t>> bits_;
    std::vector<uint64_t> forbidden_;
};

struct Colouring {
    std::vector<uint32_t> ids;  // [G]
    uint32_t count = 0;
};

Colouring colour_in_order(const Meetings& meetings, std::span<const uint32_t> order) {
    Colouring made{std::vector<uint32_t>(meetings.group_count, 0)};
    Taken taken(meetings);
    for (uint32_t group : order) {
        made.ids[group] = taken.take_least(group);
        made.count = std::max(made.count, made.ids[group] + 1);
    }
    return made;
}

// Next always the group round which most different ids are taken already.
Colouring colour_by_saturation(const Meetings& meetings, std::span<const uint64_t> degrees) {
    using Waiting = std::tuple<size_t, uint64_t, uint32_t>;  // ids round it, neighbours, ~group
    std::priority_queue<Waiting> waiting;
    for (uint32_t group = 0; group < meetings.group_count; ++group) waiting.push({0, degrees[group], ~group});

    Colouring made{std::vector<uint32_t>(meetings.group_count, 0)};
    std::vector<uint8_t> is_done(meetings.group_count, 0);
    std::vector<std::vector<uint32_t>> ids_round(meetings.group_count);
    Taken taken(meetings);
    Neighbours neighbours(meetings);
    for (; !waiting.empty(); waiting.pop()) {
        uint32_t group = ~std::get<2>(waiting.top());
        if (is_done[group]) continue;
        is_done[group] = 1;
        uint32_t id = made.ids[group] = taken.take_least(group);
        made.count = std::max(made.count, id + 1);
        neighbours.visit(group, [&](uint32_t other) {
            std::vector<uint32_t>& ids = ids_round[other];
            if (is_done[other] || std::find(ids.begin(), ids.end(), id) != ids.end()) return;
            ids.push_back(id);
            waiting.push({ids.size(), degrees[other], ~other});
        });
    }
    return made;
}

// The classes of a colouring one after another, the last first.
std::vector<uint32_t> classes_in_turn(const Colouring& colouring) {
    std::vector<uint32_t> order(colouring.ids.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return colouring.ids[a] > colouring.ids[b]; });
    return order;
}

Colouring colour(const Meetings& meetings, std::span<const uint64_t> degrees, uint32_t bound) {
    std::vector<uint32_t> order(meetings.group_count);
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return degrees[a] > degrees[b]; });
    Colouring best = colour_in_order(meetings, order);
    if (best.count <= bound) return best;

    Colouring other = colour_by_saturation(meetings, degrees);
    if (other.count < best.count) best = std::move(other);
    for (int round = 0; round < kRounds && best.count > bound; ++round) best = colour_in_order(meetings, classes_in_turn(best));
    return best;
}

}  // namespace

Result<Packing> pack_groups(const GroupsAtPositions& at, uint32_t group_count) {
    Meetings meetings = meetings_of(at, group_count);
    std::vector<uint64_t> degrees = degrees_of(meetings);
    uint32_t bound = clique_bound_of(meetings, degrees);
    Colouring best = colour(meetings, degrees, bound);
    if (best.count > kMostPacked)
        return impossible(
            "the surface groups need more than {} identifiers; weld normals (--weld-normals) or leave texture coordinates out "
            "(--ignore-uv)",
            kMostPacked);
    return Packing{std::vector<uint16_t>(best.ids.begin(), best.ids.end()), best.count, bound};
}

}  // namespace overlook::caveclod
