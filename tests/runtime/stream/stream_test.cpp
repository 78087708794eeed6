// The laws of runtime/stream: budgets, who stands in for whom, no waiting, the same frames for the same flight.
#include "runtime/stream/stream.h"

#include <gtest/gtest.h>

#include <atomic>
#include <latch>
#include <random>
#include <set>

namespace overlook::stream {
namespace {

constexpr uint64_t kBlockBytes = 1000;

// A quadtree of `levels` levels: block 0 is its root, and the children of block b are 4 b + 1 .. 4 b + 4.
Source quadtree(uint32_t levels) {
    Source source;
    uint32_t count = 0;
    for (uint32_t level = 0, wide = 1; level < levels; ++level, wide *= 4) count += wide;
    for (uint32_t block = 0; block < count; ++block) {
        source.decoded_bytes.push_back(kBlockBytes + block % 7);
        if (block > 0) source.needs.push_back((block - 1) / 4);
        source.need_begin.push_back(uint32_t(source.needs.size()));
    }
    source.decode = [sizes = source.decoded_bytes](uint32_t block, std::span<const std::span<const std::byte>> needed) {
        // Of what a block needs its own bytes follow: a decoder that saw anything else gives others.
        uint8_t first = needed.empty() ? uint8_t(1) : uint8_t(uint8_t(needed[0][0]) + block);
        return Result<Bytes>(Bytes(sizes[block], std::byte(first == 0 ? 255 : first)));
    };
    return source;
}

std::unique_ptr<Stream> opened(Source source, const Settings& settings) {
    auto stream = Stream::open("tree.ovl", std::move(source), settings);
    EXPECT_TRUE(stream.has_value());
    uint32_t root = 0;
    EXPECT_TRUE((*stream)->keep({&root, 1}).has_value());
    return std::move(*stream);
}

// Uses the chain down to a leaf as far as it is there, and asks for its next block. Returns how deep the frame got.
uint32_t visit(Stream& stream, const Source& source, uint32_t leaf, float priority = 1) {
    std::vector<uint32_t> chain{leaf};
    while (chain.back() != 0) chain.push_back(source.needs_of(chain.back())[0]);
    uint32_t depth = 0;
    for (; depth < chain.size() && stream.is_resident(chain[chain.size() - 1 - depth]); ++depth)
        stream.use(chain[chain.size() - 1 - depth]);
    if (depth < chain.size()) stream.ask(leaf, priority);
    return depth;
}

uint64_t resident_bytes(const Stream& stream, uint32_t count) {
    uint64_t bytes = 0;
    for (uint32_t block = 0; block < count; ++block) bytes += stream.bytes(block).size();
    return bytes;
}

Settings deterministic(uint64_t residency_bytes, uint64_t upload_bytes, uint32_t latency = 1) {
    return {residency_bytes, upload_bytes, 1, latency};
}

// Walks at random, for many frames and until the budget was felt often, and checks every law of residency after each.
void expect_laws_hold(const Settings& settings) {
    Source source = quadtree(6);
    std::unique_ptr<Stream> stream = opened(source, settings);
    std::mt19937 random(7);
    uint32_t first_leaf = (source.block_count() - 1) / 4;
    uint64_t sum_arrived = 0, sum_dropped = 0, leaf = first_leaf;
    for (uint32_t frame = 0; frame < 600 || sum_dropped <= 50; ++frame) {
        const Stream::Changes& changes = stream->begin_frame();
        sum_arrived += changes.arrived.size(), sum_dropped += changes.dropped.size();
        uint64_t taken = 0;
        for (uint32_t block : changes.arrived) taken += stream->bytes(block).size();
        EXPECT_EQ(taken, stream->counts().uploaded_bytes);
        EXPECT_LE(taken, settings.upload_budget_bytes);
        std::set<uint32_t> used;
        if (frame % 5 == 0) leaf = first_leaf + random() % (source.block_count() - first_leaf);
        for (uint32_t k = 0; k < 4; ++k) {
            uint32_t at = uint32_t(std::min<uint64_t>(leaf + 4 * k, source.block_count() - 1));
            visit(*stream, source, at, float(4 - k));
            for (uint32_t block = at; stream->is_resident(block) && block != 0; block = source.needs_of(block)[0])
                used.insert(block);
        }
        stream->end_frame();
        for (uint32_t block : used) EXPECT_TRUE(stream->is_resident(block)) << "what the frame used was dropped";
        EXPECT_EQ(resident_bytes(*stream, source.block_count()), stream->counts().resident_bytes);
        EXPECT_LE(stream->counts().resident_bytes + stream->counts().on_the_way_bytes, settings.residency_budget_bytes);
        for (uint32_t block = 1; block < source.block_count(); ++block) {
            if (!stream->is_resident(block)) continue;
            EXPECT_TRUE(stream->is_resident(source.needs_of(block)[0])) << block << " is there without what it needs";
        }
    }
    EXPECT_EQ(sum_arrived, stream->counts().arrived_count);
}

TEST(Stream, KeepsItsBudgetsAndItsOrderUnderAnyWalk) {
    expect_laws_hold(deterministic(40 * kBlockBytes, 3 * kBlockBytes));
    expect_laws_hold(deterministic(25 * kBlockBytes, 2 * kBlockBytes, 3));
    expect_laws_hold({40 * kBlockBytes, 3 * kBlockBytes, 2, std::nullopt});
}

TEST(Stream, GivesTheSameFramesForTheSameWalkWithAnyWorkers) {
    auto walk = [](unsigned workers, uint32_t latency) {
        Source source = quadtree(5);
        Settings settings = deterministic(30 * kBlockBytes, 3 * kBlockBytes, latency);
        settings.worker_count = workers;
        std::unique_ptr<Stream> stream = opened(source, settings);
        std::vector<uint32_t> events;
        for (uint32_t frame = 0; frame < 300; ++frame) {
            const Stream::Changes& changes = stream->begin_frame();
            events.insert(events.end(), changes.arrived.begin(), changes.arrived.end());
            for (uint32_t block : changes.dropped) events.push_back(1'000'000 + block);
            events.push_back(2'000'000);
            for (uint32_t k = 0; k < 3; ++k) visit(*stream, source, 85 + (frame / 4 * 37 + 11 * k) % 256, float(k));
            stream->end_frame();
        }
        return events;
    };
    std::vector<uint32_t> once = walk(1, 1);
    EXPECT_EQ(once, walk(1, 1));
    EXPECT_EQ(once, walk(2, 1));
    EXPECT_NE(once, walk(1, 2));
    EXPECT_EQ(walk(1, 2), walk(2, 2));
}

TEST(Stream, BringsABlockAfterWhatItNeedsAndNotBeforeItsFrame) {
    Source source = quadtree(4);
    std::unique_ptr<Stream> stream = opened(source, deterministic(100 * kBlockBytes, 10 * kBlockBytes, 2));
    std::vector<uint32_t> depths;
    for (uint32_t frame = 0; frame < 8; ++frame) {
        stream->begin_frame();
        depths.push_back(visit(*stream, source, 60));
        stream->end_frame();
    }
    EXPECT_EQ(depths, (std::vector<uint32_t>{1, 1, 2, 2, 3, 3, 4, 4}));
    EXPECT_TRUE(stream->is_settled());
    EXPECT_EQ(uint8_t(stream->bytes(60)[0]), uint8_t(1 + 3 + 14 + 60)) << "decoded on other bytes than those it needs";
}

TEST(Stream, NeverWaitsForABlockThatIsNotDecodedYet) {
    Source source = quadtree(3);
    std::latch may_decode(1);
    std::atomic<uint32_t> begun{0};
    source.decode = [&, plain = source.decode](uint32_t block, std::span<const std::span<const std::byte>> needed) {
        if (block != 0) ++begun, may_decode.wait();
        return plain(block, needed);
    };
    std::unique_ptr<Stream> stream = opened(source, {20 * kBlockBytes, 4 * kBlockBytes, 1, std::nullopt});
    // If any of these waited, the test would never end: nothing is decoded before the latch opens.
    for (uint32_t frame = 0; frame < 100; ++frame) {
        stream->begin_frame();
        EXPECT_EQ(visit(*stream, source, 5), 1u) << "the root stands in";
        stream->end_frame();
    }
    EXPECT_FALSE(stream->is_settled());
    may_decode.count_down();
    uint32_t depth = 0;
    while (depth < 3) {
        stream->begin_frame();
        depth = visit(*stream, source, 5);
        stream->end_frame();
    }
    EXPECT_EQ(begun, 2u) << "asked for in a hundred frames, sent for once";
}

TEST(Stream, TellsOfABlockThatCannotBeDecodedOnceAndGoesOn) {
    Source source = quadtree(3);
    std::atomic<uint32_t> tries{0};
    source.decode = [&, plain = source.decode](uint32_t block,
                                               std::span<const std::span<const std::byte>> needed) -> Result<Bytes> {
        if (block != 2) return plain(block, needed);
        ++tries;
        return bad_input("tree.ovl: block {}: its bytes do not match their checksum; was the file damaged?", block);
    };
    std::unique_ptr<Stream> stream = opened(source, deterministic(30 * kBlockBytes, 4 * kBlockBytes));
    std::vector<Error> faults;
    for (uint32_t frame = 0; frame < 20; ++frame) {
        const Stream::Changes& changes = stream->begin_frame();
        faults.insert(faults.end(), changes.faults.begin(), changes.faults.end());
        visit(*stream, source, 9);  // below block 2
        uint32_t depth = visit(*stream, source, 5);
        EXPECT_EQ(depth, std::min(3u, frame + 1)) << "its neighbours come";
        stream->end_frame();
    }
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_EQ(faults[0].exit, Exit::bad_input);
    EXPECT_EQ(faults[0].message, "tree.ovl: block 2: its bytes do not match their checksum; was the file damaged?");
    EXPECT_EQ(tries, 1u);
    EXPECT_TRUE(stream->is_settled());
    EXPECT_EQ(stream->counts().on_the_way_bytes, 0u) << "its room is free again";
}

TEST(Stream, DropsTheLeastRecentlyUsedAndOnlyForWhatFits) {
    Source source = quadtree(3);
    // Room for the root and four blocks of some 1,000 bytes.
    std::unique_ptr<Stream> stream = opened(source, deterministic(5 * kBlockBytes + 100, 5 * kBlockBytes));
    auto frames = [&](uint32_t count, std::vector<uint32_t> blocks) {
        for (uint32_t frame = 0; frame < count; ++frame) {
            stream->begin_frame();
            for (uint32_t block : blocks) visit(*stream, source, block);
            stream->end_frame();
        }
    };
    frames(3, {1}), frames(3, {2}), frames(3, {3}), frames(3, {4});
    EXPECT_EQ(stream->counts().dropped_count, 0u);
    frames(4, {5});  // needs 1, which was used first: 2 goes instead
    EXPECT_TRUE(stream->is_resident(5) && stream->is_resident(1) && stream->is_resident(3) && stream->is_resident(4));
    EXPECT_FALSE(stream->is_resident(2));

    uint64_t dropped = stream->counts().dropped_count;
    frames(3, {5, 3, 4, 2});  // all of the room is in use: what has none drops nothing
    EXPECT_EQ(stream->counts().dropped_count, dropped);
    EXPECT_EQ(stream->counts().refused_count, 1u);
    EXPECT_TRUE(stream->is_settled());
}

TEST(Stream, RefusesBudgetsThatABlockAloneBreaks) {
    auto message = [](const Settings& settings) {
        auto stream = Stream::open("tree.ovl", quadtree(2), settings);
        EXPECT_FALSE(stream.has_value());
        EXPECT_EQ(stream.error().exit, Exit::impossible);
        return stream.error().message;
    };
    EXPECT_EQ(message({1 << 20, 1001, 1, std::nullopt}),
              "tree.ovl: block 2 takes 1,002 bytes; an upload budget of 1,001 is too small for it");
    EXPECT_EQ(message({999, 1 << 20, 1, std::nullopt}),
              "tree.ovl: block 0 takes 1,000 bytes; a residency budget of 999 is too small for it");

    auto stream = Stream::open("tree.ovl", quadtree(2), {3000, 2000, 1, std::nullopt});
    ASSERT_TRUE(stream.has_value());
    uint32_t blocks[] = {0, 1, 2};
    Result<void> kept = (*stream)->keep(blocks);
    ASSERT_FALSE(kept.has_value());
    EXPECT_EQ(kept.error().message, "tree.ovl: its coarsest blocks take 3,003 bytes; 3,000 for what is streamed are too few");
}

TEST(Stream, EndsWhileBlocksAreOnTheirWay) {
    for (uint32_t run = 0; run < 20; ++run) {
        Source source = quadtree(4);
        std::unique_ptr<Stream> stream = opened(source, {80 * kBlockBytes, 20 * kBlockBytes, 2, std::nullopt});
        for (uint32_t frame = 0; frame < run; ++frame) {
            stream->begin_frame();
            for (uint32_t leaf = 21; leaf < 85; leaf += 3) visit(*stream, source, leaf);
            stream->end_frame();
        }
        EXPECT_LE(stream->counts().arrived_count, stream->counts().sent_for_count);
    }
}

// A chain of blocks that the source keeps, each of which takes less than was planned, and of which a tenth is uploaded.
Source kept_chain(uint32_t count) {
    Source source;
    source.keeps_blocks = true;
    for (uint32_t block = 0; block < count; ++block) {
        source.decoded_bytes.push_back(kBlockBytes), source.upload_bytes.push_back(kBlockBytes / 10);
        if (block > 0) source.needs.push_back(block - 1);
        source.need_begin.push_back(uint32_t(source.needs.size()));
    }
    source.decode = [](uint32_t, std::span<const std::span<const std::byte>>) { return Result<Bytes>(Bytes()); };
    return source;
}

TEST(StreamOfKeptBlocks, CountsWhatTheSourceSaysAndUploadsApart) {
    auto stream = opened(kept_chain(20), deterministic(5 * kBlockBytes, kBlockBytes / 10));
    stream->set_held_bytes(0, 400);
    uint32_t there = 1;
    for (uint32_t frame = 0; frame < 40; ++frame) {
        for (uint32_t block : stream->begin_frame().arrived) {
            EXPECT_EQ(block, there++);
            EXPECT_TRUE(stream->is_resident(block) && stream->bytes(block).empty());
            stream->set_held_bytes(block, 400);
        }
        EXPECT_LE(stream->counts().uploaded_bytes, kBlockBytes / 10);
        stream->use(there - 1);
        stream->ask(there, 1);
        stream->end_frame();
        EXPECT_EQ(stream->counts().resident_bytes, 400u * there);
        EXPECT_LE(stream->counts().resident_bytes + stream->counts().on_the_way_bytes, 5 * kBlockBytes);
    }
    EXPECT_EQ(there, 11u);  // ten of 400 bytes leave room for one that might take 1,000
    EXPECT_EQ(stream->counts().refused_count, 1u);
}

TEST(StreamOfKeptBlocks, RefusesUploadsBeyondTheBudget) {
    auto stream = Stream::open("chain.ovl", kept_chain(3), deterministic(5 * kBlockBytes, kBlockBytes / 10 - 1));
    ASSERT_FALSE(stream);
    EXPECT_EQ(stream.error().message, "chain.ovl: block 0 takes 100 bytes; an upload budget of 99 is too small for it");
}

}  // namespace
}  // namespace overlook::stream
