// The variants to compare with: as printed, and one refinement for all cameras in turn.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "runtime/caveclod/paper.h"
#include "runtime/caveclod/refine.h"
#include "tests/caveclod/flights.h"
#include "tests/caveclod/synthetic_hierarchy.h"

namespace overlook::caveclod {
namespace {

using flights::camera_at;
using flights::flown;
using flights::hills;
using flights::kFrame_s;
using flights::plain;

TEST(PaperRefinement, KeepsItsListsConsistentThroughAFlight) {
    paper::Mesh mesh(hills());
    for (auto criterion : {paper::Criterion::pixel_error, paper::Criterion::projected_extent}) {
        paper::CameraRefinement refinement(mesh);
        paper::Options options{criterion, plain(), paper::kPrintedTolerance};
        uint64_t splits = 0, collapses = 0;
        for (int frame = 0; frame < 120; ++frame) {
            FrameReport report = refinement.refine(flown(0.05 * frame), options);
            splits += report.split_count, collapses += report.collapse_count;
            ASSERT_TRUE(refinement.is_consistent()) << frame;
            ASSERT_EQ(report.triangle_count, refinement.active_polygon_count());
        }
        EXPECT_GT(splits, 200u);
        EXPECT_GT(collapses, 50u);
    }
}

TEST(PaperRefinement, DrawsAClosedSurfaceWithVerticesOfItsGroups) {
    Hierarchy h = synthetic::bake(synthetic::sphere(24));
    paper::Mesh mesh(h);
    paper::CameraRefinement refinement(mesh);
    for (int frame = 0; frame < 40; ++frame)
        refinement.refine(camera_at(0, -30, 0, 0, 0), {paper::Criterion::pixel_error, plain()});
    std::vector<std::vector<uint32_t>> indices;
    uint64_t wrong = 0;
    refinement.collect(indices, wrong);
    EXPECT_EQ(wrong, 0u);
    ASSERT_EQ(indices.size(), 1u);
    EXPECT_EQ(indices[0].size(), 3 * refinement.active_polygon_count());
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    for (size_t k = 0; k < indices[0].size(); k += 3)
        for (size_t c = 0; c < 3; ++c)
            ++edges[{h.vertices[indices[0][k + c]].position, h.vertices[indices[0][k + (c + 1) % 3]].position}];
    for (const auto& [edge, count] : edges) {
        ASSERT_EQ(count, 1);
        ASSERT_EQ(edges.count({edge.second, edge.first}), 1u);
    }
}

TEST(PaperRefinement, ForcesWhatASplitNeedsAndGoesBackToTheCoarsest) {
    paper::Mesh mesh(hills());
    paper::CameraRefinement refinement(mesh);
    uint64_t coarsest = refinement.active_polygon_count();
    FrameReport all;
    for (int frame = 0; frame < 60; ++frame) {
        FrameReport report = refinement.refine(camera_at(5, 5, 6, 45, -20), {paper::Criterion::pixel_error, plain()});
        all.split_count += report.split_count, all.forced_count += report.forced_count;
    }
    EXPECT_GT(all.forced_count, 0u);
    EXPECT_GT(all.split_count, all.forced_count);
    uint64_t fine = refinement.active_polygon_count();
    for (int frame = 0; frame < 60; ++frame)
        refinement.refine(camera_at(32, -200, 10, 180, 0), {paper::Criterion::pixel_error, plain()});
    EXPECT_LT(refinement.active_polygon_count(), fine / 4);
    EXPECT_GE(refinement.active_polygon_count(), coarsest);
}

TEST(PaperMemory, IsWhatEquation1Says) {
    paper::Mesh mesh(hills());
    EXPECT_EQ(mesh.nodes().size(), hills().base_position_count + 2 * size_t(hills().split_count()));
    // Of the paper's Three Lakes: what it prints for each camera is 4n + 4p + 16 of 80,762 nodes and 80,000 polygons.
    paper::Equation1 lakes = paper::equation1(80762, 80000, 0, 5, 40401, 0, 0, 1);
    EXPECT_EQ(lakes.cameras, 643064u);
    EXPECT_EQ(lakes.nodes, 44u * 80762);
    EXPECT_EQ(lakes.index_array, 2u * 5 * 40401);
    EXPECT_EQ(lakes.all(), lakes.static_bytes() + lakes.cameras);
    // Where no group meets itself across a seam the array has one entry for each vertex.
    EXPECT_EQ(mesh.populated_count(), hills().vertices.size());
}

// What the paper compares: every frame the one refinement goes to and fro, its own ones move a little.
TEST(SharedRefinement, DrawsTheSameAtEqualErrorWithManyTimesTheOperations) {
    auto mesh = Mesh::make(hills());
    ASSERT_TRUE(mesh);
    constexpr size_t kCameras = 4;
    Refinement shared(*mesh);
    std::vector<Refinement> own;
    std::vector<Refinement*> pointers;
    for (size_t c = 0; c < kCameras; ++c) own.emplace_back(*mesh);
    for (Refinement& refinement : own) pointers.push_back(&refinement);
    uint64_t shared_operations = 0, own_operations = 0;
    std::vector<FrameReport> reports(kCameras);
    std::vector<uint64_t> drawn(kCameras);
    for (int frame = 0; frame < 60; ++frame) {
        std::vector<view::Camera> cameras;
        for (size_t c = 0; c < kCameras; ++c) {
            cameras.push_back(flown(0.004 * frame + 0.25 * double(c)));
            cameras.back().heading_deg += 90 * double(c);
        }
        refine_in_turn(
            shared, cameras, plain(), [&](size_t c) { drawn[c] = shared.faces().face_count(); }, reports);
        for (size_t c = 0; c < kCameras; ++c) {
            EXPECT_LE(reports[c].error_px, plain().error_px);
            EXPECT_EQ(reports[c].triangle_count, drawn[c]);
            if (frame > 0) shared_operations += reports[c].split_count + reports[c].collapse_count;
        }
        refine_all(pointers, cameras, plain(), kFrame_s, reports);
        for (size_t c = 0; c < kCameras; ++c) {
            EXPECT_LE(reports[c].error_px, plain().error_px);
            if (frame > 0) own_operations += reports[c].split_count + reports[c].collapse_count;
        }
    }
    std::printf("shared %llu operations, own %llu\n", static_cast<unsigned long long>(shared_operations),
                static_cast<unsigned long long>(own_operations));
    EXPECT_GT(shared_operations, 10 * own_operations);
}

}  // namespace
}  // namespace overlook::caveclod
