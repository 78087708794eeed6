#include "runtime/lod_sprite/paper_strips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/tools/synthetic_dem.h"
#include "tools/bake/terrain.h"

namespace overlook::lod_sprite::paper {
namespace {

// `count` triangles, alternately with two vertices below and two above: a band without a turn.
terrain::Cut band(uint32_t count) {
    terrain::Cut cut;
    for (uint32_t i = 0; i < count; ++i) {
        if (i % 2 == 0)
            cut.indices.insert(cut.indices.end(), {i, i + 1, i + 2});
        else
            cut.indices.insert(cut.indices.end(), {i + 1, i, i + 2});
    }
    return cut;
}

// `count` triangles round vertex 0.
terrain::Cut fan(uint32_t count) {
    terrain::Cut cut;
    for (uint32_t i = 0; i < count; ++i) cut.indices.insert(cut.indices.end(), {0, i + 1, i + 2});
    return cut;
}

TEST(PaperStrips, SendABandWithOneVertexATriangle) {
    Strips strips;
    strips.build(band(10), {});
    EXPECT_EQ(strips.strip_count(), 1u);
    EXPECT_EQ(strips.vertex_count(), 12u);
}

TEST(PaperStrips, PayAVertexForEachTurn) {
    Strips strips;
    uint64_t wanted[] = {0, 3, 4, 5, 7, 9, 11};
    for (uint32_t count = 1; count <= 6; ++count) {
        strips.build(fan(count), {});
        EXPECT_EQ(strips.strip_count(), 1u);
        EXPECT_EQ(strips.vertex_count(), wanted[count]) << count;
    }
}

TEST(PaperStrips, AreNoLongerThanAsked) {
    Strips strips;
    strips.build(band(10), {4});
    EXPECT_EQ(std::vector<uint32_t>(strips.begins().begin(), strips.begins().end()), (std::vector<uint32_t>{0, 4, 8, 10}));
    strips.build(band(10), {1});
    EXPECT_EQ(strips.strip_count(), 10u);
    EXPECT_EQ(strips.vertex_count(), 30u);
}

TEST(PaperStrips, TakeTheSpriteFromMixedStripsOnly) {
    Strips strips;
    strips.build(band(10), {4});
    std::vector<uint8_t> flags = {1, 1, 1, 1, 1, 0, 1, 1, 0, 0};
    EXPECT_EQ(strips.take_from_mixed(flags), 3u);
    EXPECT_EQ(flags, (std::vector<uint8_t>{1, 1, 1, 1, 0, 0, 0, 0, 0, 0}));
    EXPECT_EQ(strips.take_from_mixed(flags), 0u);
}

size_t shared_vertices(const terrain::Cut& cut, uint32_t a, uint32_t b) {
    size_t shared = 0;
    for (size_t i = 0; i < 3; ++i)
        shared += size_t(std::count(&cut.indices[3 * a], &cut.indices[3 * a] + 3, cut.indices[3 * b + i]));
    return shared;
}

TEST(PaperStrips, HoldEveryTriangleOnceBesideItsNeighbour) {
    auto terrain = terrain::bake(overlook::test::make_hills(129, 100, 3), {}, [](double) {});
    ASSERT_TRUE(terrain.has_value());
    terrain::Refiner refiner(*terrain);
    terrain::Cut cut;
    for (double tolerance_m : {5.0, 40.0}) {
        refiner.cut_by_metres(tolerance_m, cut);
        Strips strips;
        strips.build(cut, {64});
        std::span<const uint32_t> order = strips.triangles(), begins = strips.begins();
        EXPECT_EQ(std::set<uint32_t>(order.begin(), order.end()).size(), cut.triangle_count());
        EXPECT_EQ(order.size(), cut.triangle_count());
        for (size_t strip = 0; strip < strips.strip_count(); ++strip) {
            EXPECT_LE(begins[strip + 1] - begins[strip], 64u);
            for (uint32_t i = begins[strip] + 1; i < begins[strip + 1]; ++i)
                ASSERT_EQ(shared_vertices(cut, order[i - 1], order[i]), 2u);
        }
        // Strips that do their work send much less than three vertices a triangle.
        EXPECT_LT(double(strips.vertex_count()), 2.0 * double(cut.triangle_count()));
        EXPECT_LT(strips.strip_count(), cut.triangle_count() / 8);
    }
}

TEST(PaperStrips, AreEmptyForAnEmptyCut) {
    Strips strips;
    strips.build({}, {});
    EXPECT_EQ(strips.strip_count(), 0u);
    EXPECT_EQ(strips.vertex_count(), 0u);
    EXPECT_EQ(strips.take_from_mixed({}), 0u);
}

}  // namespace
}  // namespace overlook::lod_sprite::paper
