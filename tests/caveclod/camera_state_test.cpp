// What one camera keeps: tables of handles, faces in their slots, what glides.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "runtime/caveclod/face_slots.h"
#include "runtime/caveclod/glide_list.h"

namespace overlook::caveclod {
namespace {

using Corners = std::array<uint32_t, 3>;

// Faces as they should be, and in their slots.
class TwoWays {
  public:
    explicit TwoWays(uint32_t surfaces) : surfaces_(surfaces), slots_(surfaces, 27) {}

    void add(uint32_t face) {
        Corners corners = {face, face + 1, face + 2};
        if (!wanted_.emplace(face, corners).second) return;
        slots_.add(face % surfaces_, face, corners);
    }
    void remove(uint32_t face) {
        if (wanted_.erase(face) != 0) slots_.remove(face);
    }
    void move(uint32_t face, uint32_t corner, uint32_t index) {
        if (!wanted_.contains(face)) return;
        wanted_[face][corner] = index;
        slots_.set(face * 4 + corner, index);
    }
    void expect_same() const {
        ASSERT_EQ(slots_.face_count(), wanted_.size());
        size_t seen = 0;
        for (uint32_t surface = 0; surface < surfaces_; ++surface)
            for (uint32_t p = 0; p < slots_.pages(surface).size(); ++p)
                for (uint32_t i = 0; i < slots_.page_count(surface, p); ++i, ++seen) {
                    const FacePage& page = *slots_.pages(surface)[p];
                    ASSERT_EQ(page.faces[i] % surfaces_, surface);
                    const Corners& corners = wanted_.at(page.faces[i]);
                    ASSERT_TRUE(std::equal(corners.begin(), corners.end(), page.indices.begin() + 3 * i));
                }
        ASSERT_EQ(seen, wanted_.size());
        for (const auto& [face, corners] : wanted_)
            for (uint32_t c = 0; c < 3; ++c) ASSERT_EQ(slots_.index_at(face * 4 + c), corners[c]);
    }
    const FaceSlots& slots() const { return slots_; }

  private:
    uint32_t surfaces_;
    FaceSlots slots_;
    std::map<uint32_t, Corners> wanted_;
};

TEST(FaceSlots, HoldWhatWasPutInThroughGrowingAndShrinking) {
    std::mt19937 random(3);
    TwoWays faces(5);
    for (uint32_t most : {40u, 4000u, 300u, 9000u, 0u}) {
        // Numbers run in stretches, as a mesh's do.
        for (int step = 0; step < 30000; ++step) {
            uint32_t face = uint32_t(random() % 60000) / 2 * 2;
            bool grows = faces.slots().face_count() < most;
            if (grows) {
                faces.add(face), faces.add(face + 1);
            } else if (random() % 4 == 0) {
                faces.remove(face), faces.remove(face + 1);
            }
            faces.move(uint32_t(random() % 60000), uint32_t(random() % 3), uint32_t(random()));
        }
        faces.expect_same();
        EXPECT_FALSE(faces.slots().has(70000));
    }
}

// However many there were before: 16 bytes and 4.6 to 5.4 of its handle, and pages that are not full.
TEST(FaceSlots, TakeTwentyTwoBytesAFaceAndHalfAPageASurface) {
    constexpr uint32_t kSurfaces = 9;
    FaceSlots slots(kSurfaces, 27);
    uint32_t added = 0, removed = 0;
    auto expect_small = [&] {
        double faces = added - removed, rest = double(slots.bytes()) - kSurfaces * (sizeof(FacePage) + 64);
        EXPECT_LE(rest / faces, 22) << faces;
    };
    for (uint32_t most : {3000u, 20000u, 60000u}) {
        for (; added - removed < most; ++added) {
            slots.add(added * kSurfaces / 100000 % kSurfaces, added, {1, 2, 3});
            if (added % 97 == 0 && added - removed > 1000) expect_small();
        }
        for (; added - removed > most / 2; ++removed) {
            slots.remove(removed);
            if (removed % 97 == 0) expect_small();
        }
    }
}

TEST(GlideList, KeepsEachSplitsVerticesWhereTheyAre) {
    std::mt19937 random(7);
    GlideList list;
    std::map<uint32_t, std::vector<uint32_t>> slots_of;
    std::vector<uint32_t> slots;
    for (int step = 0; step < 20000; ++step) {
        uint32_t split = uint32_t(random() % 3000);
        if (slots_of.contains(split)) {
            list.remove(split);
            slots_of.erase(split);
        } else {
            std::vector<GlideVertex> vertices(1 + random() % 4);
            for (GlideVertex& vertex : vertices) vertex.to_bits = split;
            Glide glide;
            glide.split = split;
            list.add(glide, vertices, slots);
            ASSERT_EQ(slots.size(), vertices.size());
            slots_of[split] = slots;
        }
        ASSERT_EQ(list.all().size(), slots_of.size());
    }
    size_t used = 0;
    for (const auto& [split, its] : slots_of) {
        EXPECT_EQ(list.of(split).split, split);
        for (uint32_t slot : its) EXPECT_EQ(list.vertices()[slot].to_bits, split);
        used += its.size();
    }
    EXPECT_GT(used, 1000u);
    EXPECT_LT(list.vertices().size(), 3000 * 4u);
}

TEST(GlideList, ArrivesInOrderOfSplitsAtBothEnds) {
    GlideList list;
    std::vector<uint32_t> slots;
    for (uint32_t split : {9u, 4u, 7u, 2u}) {
        Glide glide;
        glide.split = split, glide.share = 0.5f, glide.is_collapsing = split % 2 == 0;
        GlideVertex vertex;
        vertex.to_bits = split;
        list.add(glide, std::span(&vertex, 1), slots);
    }
    std::vector<Glide> arrived;
    list.advance(0.25f, arrived);
    EXPECT_TRUE(arrived.empty());
    for (const GlideVertex& vertex : list.vertices()) EXPECT_EQ(vertex.share, vertex.to() % 2 == 0 ? 0.25f : 0.75f);
    list.turn_back(4);
    list.advance(0.25f, arrived);
    std::vector<uint32_t> order;
    for (const Glide& glide : arrived) order.push_back(glide.split);
    EXPECT_EQ(order, (std::vector<uint32_t>{2, 7, 9}));
    EXPECT_EQ(list.of(4).share, 0.5f);
}

}  // namespace
}  // namespace overlook::caveclod
