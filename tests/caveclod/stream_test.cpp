// Meshes of which a part is in memory: each frame a legal cut within its budgets, and the whole once all is there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "runtime/caveclod/mesh_stream.h"
#include "runtime/caveclod/screen_test.h"
#include "tests/caveclod/drawn_faces.h"
#include "tests/caveclod/flights.h"
#include "tests/caveclod/mesh_files.h"
#include "tests/caveclod/streams.h"

namespace overlook::caveclod {
namespace {

using flights::camera_at;
using flights::flown;
using flights::kFrame_s;
using flights::plain;
using streams::Baked;
using streams::Cameras;
using streams::hills;
using streams::kMuch;
using streams::opened;
using streams::play;
using streams::reader_of;
using streams::settle;
using streams::sphere;
using synthetic::applied;
using synthetic::buffers;
using synthetic::drawn;
using synthetic::expected;
using synthetic::is_closed;

void expect_same(const Mesh& a, const Mesh& b) {
    ASSERT_EQ(a.split_count(), b.split_count());
    ASSERT_TRUE(std::equal(a.vertices().begin(), a.vertices().end(), b.vertices().begin(), b.vertices().end(),
                           [](const PackedVertex& x, const PackedVertex& y) { return std::memcmp(&x, &y, sizeof x) == 0; }));
    ASSERT_TRUE(std::equal(a.roots().begin(), a.roots().end(), b.roots().begin(), b.roots().end()));
    SplitRecord one, other;
    for (uint32_t i = 0; i < a.split_count(); ++i) {
        const Bounds &x = a.bounds(i), &y = b.bounds(i);
        ASSERT_TRUE(x.middle == y.middle && x.error == y.error && x.radius == y.radius && x.cone == y.cone) << i;
        ASSERT_EQ(a.glides(i), b.glides(i)) << i;
        a.decode(i, one), b.decode(i, other);
        ASSERT_TRUE(one.needs == other.needs && one.dependents == other.dependents) << i;
    }
}

// Loading costs the sum of all that is there after each run.
TEST(MeshStream, LoadsWhatIsLargeInTimeOfItsSize) {
    EXPECT_EQ(runs_of_blocks(std::vector<uint32_t>{0}), (std::vector<uint32_t>{1}));
    EXPECT_EQ(runs_of_blocks(std::vector<uint32_t>{0, 1024, 2048}), (std::vector<uint32_t>{1, 2, 3}));
    std::vector<uint32_t> splits(2000, 1 << 14);
    splits[0] = 0;
    uint64_t all = 0, before = 0, work = 0;
    std::vector<uint32_t> ends = runs_of_blocks(splits);
    for (size_t run = 0; run < ends.size(); ++run) {
        uint64_t own = 0;
        for (uint32_t block = run > 0 ? ends[run - 1] : 0; block < ends[run]; ++block) own += splits[block];
        if (run > 1 && run + 1 < ends.size()) {
            EXPECT_TRUE(8 * own >= before && 8 * (own - splits[1]) <= before) << run;
        }
        all += own, before += own, work += before;
    }
    EXPECT_EQ(ends[0], 1u);
    EXPECT_EQ(ends.back(), 2000u);
    EXPECT_EQ(all, 1999u << 14);
    EXPECT_LT(work, 10 * all);
}

TEST(MeshStream, IsTheMeshOfTheBlocksThatAreThere) {
    auto stream = opened(hills(), kMuch);
    Cameras cameras(*stream, 0, 1);
    uint32_t known = 0;
    while (known < stream->block_count(0)) {
        if (stream->resident_block_count(0) != known) {
            known = stream->resident_block_count(0);
            Result<Hierarchy> read = synthetic::read_bytes(hills().file, known - 1);
            ASSERT_TRUE(read);
            expect_same(stream->mesh(0), *Mesh::make(*read));
        }
        play(*stream, cameras, flown(0), plain());
    }
    EXPECT_EQ(known, 5u);
    EXPECT_EQ(stream->mesh(0).missing_error_m(), 0);
}

// A refinement that has grown with the mesh has come to the cut of one that had all of it, and a new one draws the same bytes.
TEST(MeshStream, DrawsTheSameAsTheWholeOnceAllIsThere) {
    for (const Baked* baked : {&sphere(), &hills()}) {
        Mesh whole = *Mesh::make(baked->hierarchy);
        for (double glide_s : {0.0, 0.25}) {
            Settings settings = plain();
            settings.error_px = 0.5, settings.glide_s = glide_s;
            view::Camera camera = baked == &sphere() ? camera_at(0, -22, 3, 0, -8) : flown(0.4);
            auto stream = opened(*baked, kMuch);
            Cameras cameras(*stream, 0, 1);
            settle(*stream, cameras, camera, settings);
            Refinement anew(stream->mesh(0)), of_whole(whole);
            for (int frame = 0; frame < 120; ++frame) {
                play(*stream, cameras, camera, settings);
                anew.refine(camera, settings, kFrame_s), of_whole.refine(camera, settings, kFrame_s);
            }
            EXPECT_EQ(applied(baked->hierarchy, cameras[0]), applied(baked->hierarchy, of_whole));
            for (int frame = 0; frame < 20; ++frame) {
                camera = baked == &sphere() ? camera_at(0, -22 + frame, 3, 0, -8) : flown(0.4 + 0.03 * frame);
                FrameReport a = anew.refine(camera, settings, kFrame_s), b = of_whole.refine(camera, settings, kFrame_s);
                EXPECT_EQ(a.error_px, b.error_px);
                ASSERT_EQ(buffers(anew), buffers(of_whole)) << frame;
            }
        }
    }
}

TEST(MeshStream, DrawsALegalCutInEveryFrameWithinItsBudgets) {
    for (uint64_t budget_bytes : {uint64_t(2) << 20, uint64_t(4) << 20, kMuch}) {
        for (uint32_t latency : {1u, 4u}) {
            stream::Settings limits{budget_bytes, 128 << 10, 1, latency};
            auto stream = opened({&hills()}, limits);
            Cameras cameras(*stream, 0, 1);
            Settings settings = plain();
            settings.error_px = 1, settings.most_operations = 500;
            uint32_t most_blocks = 0;
            for (int frame = 0; frame < 60; ++frame) {
                play(*stream, cameras, flown(0.05 * frame), settings);
                ASSERT_TRUE(is_closed(hills().hierarchy, applied(hills().hierarchy, cameras[0])));
                ASSERT_EQ(drawn(cameras[0]), expected(hills().hierarchy, cameras[0]));
                const stream::Counts& counts = stream->counts();
                EXPECT_LE(counts.resident_bytes + counts.on_the_way_bytes, budget_bytes);
                EXPECT_LE(counts.uploaded_bytes, limits.upload_budget_bytes);
                EXPECT_GE(counts.resident_bytes, stream->mesh(0).bytes().all());
                EXPECT_LE(stream->resident_block_count(0), most_blocks + 1);  // a block at a time
                most_blocks = std::max(most_blocks, stream->resident_block_count(0));
            }
            EXPECT_EQ(most_blocks == 5, budget_bytes == kMuch) << budget_bytes;
            EXPECT_GT(most_blocks, 1u);
        }
    }
}

// What a frame lacks because blocks are missing, it tells: as much as a refinement of the whole would still split.
TEST(MeshStream, TellsTheErrorOfWhatIsMissing) {
    auto stream = opened(hills(), 2 << 20);
    Cameras cameras(*stream, 0, 1);
    Mesh whole = *Mesh::make(hills().hierarchy);
    Settings settings = plain();
    settings.error_px = 0.5;
    for (int frame = 0; frame < 30; ++frame) {
        view::Camera camera = flown(0.1 * frame);
        settle(*stream, cameras, camera, settings);
        const Refinement& refinement = cameras[0];
        EXPECT_GT(cameras.report().missing_px, settings.error_px);
        EXPECT_GE(cameras.report().error_px, cameras.report().missing_px);
        // By each missing split alone, at the places that it turns: faces that are drawn.
        ScreenTest test(whole, camera, settings);
        for (uint32_t i = stream->mesh(0).split_count(); i < whole.split_count(); ++i) {
            SplitRecord record;
            whole.decode(i, record);
            for (const SplitRecord::Move& move : record.moves) {
                uint32_t face = move.corner / kCorners;
                if (!refinement.faces().has(face)) continue;
                glm::dvec3 at = refinement.place_m(refinement.faces().index_at(move.corner));
                ASSERT_LE(test.seen_px(at, 0, whole.error_m(i)), cameras.report().error_px) << i;
            }
        }
    }
}

TEST(MeshStream, StaysCoarserWhereALateBlockIsDamaged) {
    for (uint32_t damaged : {2u, 4u}) {
        Baked broken = hills();
        {
            container::Reader reader = reader_of(broken.file);
            const container::Section& section = *reader.find(container::tag("MBLK"));
            Result<BlockFile> blocks = BlockFile::open(reader);
            ASSERT_TRUE(blocks);
            broken.file[section.offset + blocks->stored_begin(damaged) + 100] ^= 1;
        }
        auto stream = opened(broken, kMuch);
        Cameras cameras(*stream, 0, 1);
        std::vector<std::string> faults;
        for (int frame = 0; frame < 30; ++frame) {
            for (const Error& fault : stream->begin_frame()) faults.push_back(fault.message);
            view::Camera camera = flown(0.05 * frame);
            cameras.refine(std::span(&camera, 1), plain());
            stream->end_frame();
            ASSERT_EQ(drawn(cameras[0]), expected(hills().hierarchy, cameras[0]));
        }
        EXPECT_EQ(faults, std::vector<std::string>{fmt::format(
                              "mesh.ovl: M9: block {}: its bytes do not match their checksum; was the file damaged?", damaged)});
        EXPECT_EQ(stream->resident_block_count(0), damaged);
        EXPECT_GT(cameras.report().missing_px, 0);
    }
}

// Vertices go on on their way when a block comes, each by what a frame's time is worth.
TEST(MeshStream, LetsGlidesGoOnWhenABlockComes) {
    auto stream = opened(sphere(), kMuch, 12);
    Cameras cameras(*stream, 0, 1);
    Settings settings = plain();
    settings.error_px = 2, settings.glide_s = 1;
    auto shares = [&] {
        std::vector<float> all;
        for (const GlideVertex& vertex : cameras[0].glide_vertices()) all.push_back(vertex.share);
        return all;
    };
    uint32_t came_while_gliding = 0;
    for (int frame = 0; frame < 100; ++frame) {
        uint32_t blocks = stream->resident_block_count(0), gliding = cameras.report().gliding_count;
        std::vector<float> before = shares();
        play(*stream, cameras, camera_at(0, -70 + 0.4 * frame, 0, 0, 0), settings);
        if (stream->resident_block_count(0) == blocks || gliding == 0) continue;
        ++came_while_gliding;
        std::vector<float> after = shares();
        size_t on = 0;
        for (size_t i = 0; i < before.size(); ++i)
            on += before[i] > 0 && std::abs(after[i] - before[i]) > 1e-4f && std::abs(after[i] - before[i]) < 0.02f;
        EXPECT_GT(on, 0u) << frame;
        EXPECT_GT(cameras.report().gliding_count, 0u);
    }
    EXPECT_GT(came_while_gliding, 0u);
}

TEST(MeshStream, RefusesInOneLineWhatIsTooLittle) {
    auto refused = [](const stream::Settings& settings) {
        std::vector<container::Reader> readers;
        readers.push_back(reader_of(hills().file));
        auto stream = MeshStream::open(std::move(readers), settings);
        EXPECT_FALSE(stream);
        return stream ? Error{} : stream.error();
    };
    EXPECT_EQ(refused({1000, 1 << 20, 1, 1}).exit, Exit::impossible);
    EXPECT_NE(refused({1000, 1 << 20, 1, 1}).message.find("residency budget of 1,000 is too small"), std::string::npos);
    EXPECT_NE(refused({kMuch, 1000, 1, 1}).message.find("upload budget of 1,000 is too small"), std::string::npos);
}

}  // namespace
}  // namespace overlook::caveclod
