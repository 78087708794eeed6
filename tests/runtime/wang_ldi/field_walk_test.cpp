// Walking through a field: nothing pops, nothing is kept, and the list depends on nothing but where the eye is.
#include <gtest/gtest.h>

#include <map>
#include <tuple>

#include "runtime/wang_ldi/field.h"
#include "tests/allocations.h"
#include "tests/runtime/wang_ldi/field_ground.h"
#include "tests/runtime/wang_ldi/field_parts.h"

namespace overlook::wang_ldi {
namespace {

// Of whole numbers only, which rounding elsewhere in the last place leaves as they are.
uint64_t digest(const FieldList& list) {
    uint64_t hash = 0;
    auto add = [&](uint64_t value) { hash = mixed(hash + 0x9e3779b97f4a7c15u) ^ mixed(value); };
    for (const Item& item : list.items) {
        add(uint64_t(item.i)), add(uint64_t(item.j)), add(item.tiles_log2), add(item.tile), add(item.texels_px);
        for (const Shown& shown : list.shown_of(item))
            add(shown.rung), add(shown.direction), add(shown.by_rung.from), add(shown.by_rung.to), add(shown.by_direction.from),
                add(shown.by_direction.to);
        for (const Half& half : list.halves_of(item))
            add(half.column), add(half.row), add(half.half), add(uint64_t(half.diagonal));
    }
    return hash;
}

// By how much of a tile each means shows it: [stage, level, direction], of kWhole^2.
using Shares = std::map<std::tuple<Stage, uint32_t, uint32_t>, uint32_t>;
std::map<std::pair<int64_t, int64_t>, Shares> shares_of_tiles(const Field& field, const FieldList& list) {
    std::map<std::pair<int64_t, int64_t>, Shares> tiles;
    for (const Item& item : list.items) {
        if (item.half_count == 0) continue;
        for (const Shown& shown : list.shown_of(item)) {
            const Rung& rung = field.ladder().rungs[shown.rung];
            tiles[{item.i, item.j}][{rung.stage, rung.level, shown.direction}] =
                shown.by_rung.share() * shown.by_direction.share();
        }
    }
    return tiles;
}

// Walking on by a centimetre changes what shows a tile by a few hundredths of it at most; twice as many where geometry is whole
// until images are.
TEST(FieldWalk, NoTilePopsOnAWalk) {
    TestField test{Ground::plain()};
    Field field = test.field(test.to_horizon(4));
    FieldList list;
    std::map<std::pair<int64_t, int64_t>, Shares> before;
    int64_t greatest = 0, greatest_beside_geometry = 0;
    uint32_t compared = 0;
    std::map<Stage, int> changes;
    for (int step = 0; step < 1500; ++step) {
        field.list(head_camera({0.01 * step, 0.3 * std::sin(0.002 * step), 1.7}, 60), list);
        auto now = shares_of_tiles(field, list);
        for (const auto& [tile, shares] : now) {
            auto was = before.find(tile);
            if (was == before.end()) continue;
            ++compared;
            Shares all = was->second;
            all.insert(shares.begin(), shares.end());
            for (const auto& [means, unused] : all) {
                int64_t here = shares.contains(means) ? shares.at(means) : 0;
                int64_t there = was->second.contains(means) ? was->second.at(means) : 0;
                bool is_beside_geometry = std::get<0>(all.begin()->first) == Stage::geometry;
                int64_t& most = is_beside_geometry ? greatest_beside_geometry : greatest;
                most = std::max(most, std::abs(here - there));
                changes[std::get<0>(means)] += here != there;
            }
        }
        before = std::move(now);
    }
    EXPECT_LE(greatest, kWhole * kWhole * 4 / 100);
    EXPECT_LE(greatest_beside_geometry, kWhole * kWhole * 8 / 100);
    EXPECT_GT(compared, 100000u);
    EXPECT_GT(changes[Stage::geometry], 500);  // in half its band
    for (Stage stage : {Stage::ldi, Stage::texture}) EXPECT_GT(changes[stage], 1000) << int(stage);
}

TEST(FieldWalk, AWalkOf100KilometresKeepsNothing) {
    TestField test{Ground::plain()};
    Field field = test.field(test.to_horizon(3));
    FieldList list;
    auto camera_at = [](int step) {
        return head_camera({-50000.0 + 100 * step, 31 * std::sin(step * 0.1), 1.7}, 90 + 3 * std::sin(step * 0.7), -8);
    };
    uint64_t before = 0;
    size_t most_items = 0;
    list.items.reserve(20000), list.shown.reserve(80000), list.halves.reserve(80000);
    for (int step = 0; step <= 1000; ++step) {
        if (step == 1) before = test::allocation_count();
        field.list(camera_at(step), list);
        most_items = std::max(most_items, list.items.size());
    }
    EXPECT_EQ(test::allocation_count(), before);
    EXPECT_LT(most_items, 20000u);
    TestField fresh{Ground::plain()};
    EXPECT_EQ(digest(list_of(fresh.field(fresh.to_horizon(3)), camera_at(1000))), digest(list));
    // The same tiles stand where they stood, from wherever they are seen.
    FieldList back = list_of(field, head_camera({50002.5, 31 * std::sin(100.0), 1.7}, 270, -8));
    for (const Item& item : back.items)
        if (item.tiles_log2 == 0) {
            ASSERT_EQ(item.tile, test.tiling->at(item.i, item.j));
        }
}

TEST(FieldWalk, IsTheSameListOnAnyMachine) {
    PlacementOptions planting;
    planting.highest_m = 155;
    TestField test(Ground(hills()), planting, 2);
    Field field = test.field(test.to_horizon(3));
    FieldList list = list_of(field, head_camera({600, -500, test.ground.height_m({600, -500}) + 1.7}, 77));
    EXPECT_GT(list.items.size(), 300u);
    EXPECT_EQ(digest(list), 6749596835679538243u);
    FieldList by_threads;
    FieldScratch scratch;
    for (int times = 0; times < 2; ++times) {
        field.list(head_camera({600, -500, test.ground.height_m({600, -500}) + 1.7}, 77), by_threads, scratch);
        EXPECT_EQ(digest(by_threads), digest(list));
        EXPECT_TRUE(by_threads.counts == list.counts);
    }
}

}  // namespace
}  // namespace overlook::wang_ldi
