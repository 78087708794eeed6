// How few ids groups need, on graphs whose chromatic number is known.
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "tools/bake/caveclod/packing.h"

namespace overlook::caveclod {
namespace {

using Row = std::vector<uint32_t>;

GroupsAtPositions rows_of(const std::vector<Row>& rows) {
    GroupsAtPositions at{{0}, {}};
    for (const Row& row : rows) {
        at.groups.insert(at.groups.end(), row.begin(), row.end());
        at.begin.push_back(uint32_t(at.groups.size()));
    }
    return at;
}

Packing packed(const std::vector<Row>& rows, uint32_t group_count) {
    Result<Packing> packing = pack_groups(rows_of(rows), group_count);
    EXPECT_TRUE(packing.has_value());
    for (const Row& row : rows) {
        std::set<uint32_t> ids;
        for (uint32_t group : row) ids.insert(packing->packed[group]);
        EXPECT_EQ(ids.size(), row.size());
        for (uint32_t id : ids) EXPECT_LT(id, packing->count);
    }
    return *packing;
}

TEST(Packing, GroupsThatNeverMeetShareOneId) {
    Packing packing = packed({{0}, {1}, {2}, {}}, 3);
    EXPECT_EQ(packing.count, 1u);
    EXPECT_EQ(packing.clique_bound, 1u);
}

TEST(Packing, NoGroupsNeedNone) {
    EXPECT_EQ(packed({}, 0).count, 0u);
}

TEST(Packing, AllAtOnePositionNeedOneEach) {
    Row all;
    for (uint32_t group = 0; group < 300; ++group) all.push_back(group);
    Packing packing = packed({all}, 300);
    EXPECT_EQ(packing.count, 300u);
    EXPECT_EQ(packing.clique_bound, 300u);
}

TEST(Packing, EvenRingsNeedTwoAndOddOnesThree) {
    for (uint32_t n = 4; n < 12; ++n) {
        std::vector<Row> ring;
        for (uint32_t i = 0; i < n; ++i) ring.push_back({i, (i + 1) % n});
        Packing packing = packed(ring, n);
        EXPECT_EQ(packing.count, n % 2 == 0 ? 2u : 3u);
        EXPECT_EQ(packing.clique_bound, 2u);
    }
}

TEST(Packing, FindsCliquesThatNoSinglePositionShows) {
    std::vector<Row> pairs;
    for (uint32_t a = 0; a < 6; ++a)
        for (uint32_t b = a + 1; b < 6; ++b) pairs.push_back({a, b});
    Packing packing = packed(pairs, 6);
    EXPECT_EQ(packing.count, 6u);
    EXPECT_EQ(packing.clique_bound, 6u);
}

// Greedy colouring in the order of the numbers takes n / 2 ids for a crown (a_i meets all b_j but b_i); degrees are all equal, so
// that only the later rounds bring it to two.
TEST(Packing, RecoloursWhatGreedyOrderSpoils) {
    const uint32_t n = 10;
    std::vector<Row> crown;
    for (uint32_t i = 0; i < n; ++i)
        for (uint32_t j = 0; j < n; ++j)
            if (i != j) crown.push_back({2 * i, 2 * j + 1});
    EXPECT_EQ(packed(crown, 2 * n).count, 2u);
}

TEST(Packing, SquaresOfAGridNeedFour) {
    const uint32_t side = 40;
    std::vector<Row> corners;
    for (uint32_t y = 0; y + 1 < side; ++y)
        for (uint32_t x = 0; x + 1 < side; ++x) {
            uint32_t a = y * side + x;
            corners.push_back({a, a + 1, a + side, a + side + 1});
        }
    Packing packing = packed(corners, side * side);
    EXPECT_EQ(packing.count, 4u);
    EXPECT_EQ(packing.clique_bound, 4u);
}

// [vertex] adjacency bits; the least number of colours by trying all.
uint32_t chromatic_number(const std::vector<uint32_t>& adjacent, uint32_t most) {
    std::vector<uint32_t> colour(adjacent.size(), 0);
    for (uint32_t count = 1; count <= most; ++count) {
        auto place = [&](auto&& self, uint32_t vertex, uint32_t used) -> bool {
            if (vertex == adjacent.size()) return true;
            for (uint32_t c = 0; c < std::min(count, used + 1); ++c) {
                bool fits = true;
                for (uint32_t other = 0; other < vertex; ++other)
                    if ((adjacent[vertex] >> other & 1) && colour[other] == c) fits = false;
                if (!fits) continue;
                colour[vertex] = c;
                if (self(self, vertex + 1, std::max(used, c + 1))) return true;
            }
            return false;
        };
        if (place(place, 0, 0)) return count;
    }
    return most;
}

TEST(Packing, LiesBetweenTheBoundAndOneMoreThanNeededOnSmallGraphs) {
    std::mt19937 random(5);
    for (int round = 0; round < 300; ++round) {
        uint32_t n = 4 + uint32_t(random() % 9);
        std::vector<uint32_t> adjacent(n, 0);
        std::vector<Row> rows;
        for (uint32_t a = 0; a < n; ++a)
            for (uint32_t b = 0; b < a; ++b)
                if (random() % 3 == 0) {
                    adjacent[a] |= 1u << b;
                    adjacent[b] |= 1u << a;
                    rows.push_back({b, a});
                }
        uint32_t needed = chromatic_number(adjacent, n);
        Packing packing = packed(rows, n);
        EXPECT_LE(packing.clique_bound, needed);
        EXPECT_GE(packing.count, needed);
        EXPECT_LE(packing.count, needed + 1);
    }
}

}  // namespace
}  // namespace overlook::caveclod
