// One camera's refinement: legal, resting, within its budgets, and the same as when decided anew.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "runtime/caveclod/refine.h"
#include "runtime/caveclod/screen_test.h"
#include "tests/caveclod/drawn_faces.h"
#include "tests/caveclod/flights.h"
#include "tests/caveclod/synthetic_hierarchy.h"

namespace overlook::caveclod {
namespace {

using synthetic::applied;
using synthetic::drawn;
using synthetic::expected;
using synthetic::is_closed;
using synthetic::Triangle;

using flights::camera_at;
using flights::flown;
using flights::hills;
using flights::kFrame_s;
using flights::mesh_of;
using flights::plain;

TEST(Refinement, DrawsAtEveryFrameTheFacesOfALegalCut) {
    Mesh mesh = mesh_of(hills());
    for (uint32_t most_operations : {0u, 50u}) {
        Refinement refinement(mesh);
        Settings settings = plain();
        settings.most_operations = most_operations;
        uint64_t splits = 0, collapses = 0;
        for (int frame = 0; frame < 60; ++frame) {
            FrameReport report = refinement.refine(flown(frame * 0.1), settings, kFrame_s);
            splits += report.split_count, collapses += report.collapse_count;
            ASSERT_TRUE(is_closed(hills(), applied(hills(), refinement)));
            ASSERT_EQ(drawn(refinement), expected(hills(), refinement));
            ASSERT_EQ(report.triangle_count, drawn(refinement).size());
        }
        EXPECT_GT(splits, 500u);
        EXPECT_GT(collapses, 100u);
    }
}

TEST(Refinement, IsTheStatelessAnswerOnceItIsSettled) {
    const Hierarchy& h = hills();
    Mesh mesh = mesh_of(h);
    for (double t : {0.3, 2.0, 4.5}) {
        Settings settings = plain();
        settings.most_operations = 40;
        Refinement refinement(mesh);
        view::Camera camera = flown(t);
        int frames = 0;
        while (!refinement.refine(camera, settings, kFrame_s).is_settled) ASSERT_LT(++frames, 1000);
        EXPECT_GT(frames, 3);

        ScreenTest test(mesh, camera, settings);
        std::vector<bool> wanted(h.split_count());
        for (uint32_t i = 0; i < h.split_count(); ++i) {
            wanted[i] = test(i).wants_split;
            for (uint32_t k = h.need_begin[i]; k < h.need_begin[i + 1]; ++k) wanted[i] = wanted[i] && wanted[h.needs[k]];
        }
        EXPECT_EQ(applied(h, refinement), wanted);
    }
}

TEST(Refinement, KeepsTheErrorAskedOfEverythingInView) {
    const Hierarchy& h = hills();
    Mesh mesh = mesh_of(h);
    Refinement refinement(mesh);
    for (bool glides : {false, true}) {
        Settings settings = plain();
        if (glides) settings.glide_s = 0.25;
        for (int frame = 0; frame < 40; ++frame) {
            view::Camera camera = flown(frame * 0.03);
            FrameReport report = refinement.refine(camera, settings, kFrame_s);
            EXPECT_LE(report.error_px, settings.error_px);
            for (uint32_t i = 0; i < h.split_count(); ++i) {
                bool is_open = !refinement.is_applied(i);
                for (uint32_t k = h.need_begin[i]; is_open && k < h.need_begin[i + 1]; ++k)
                    is_open = refinement.is_applied(h.needs[k]);
                if (!is_open) continue;
                ScreenTest::Answer answer = ScreenTest(mesh, camera, settings)(i);
                ASSERT_FALSE(answer.must_split);
                ASSERT_LE(answer.seen_error_px, report.error_px);
            }
        }
    }
}

// What is applied is asked once, and what could be applied.
TEST(Refinement, AsksNothingTwiceWhereTheCutDependsOnTheCameraAlone) {
    const Hierarchy& h = hills();
    Mesh mesh = mesh_of(h);
    Settings settings = plain();
    settings.collapse_share = 1;
    Refinement refinement(mesh);
    for (double t : {0.3, 2.0, 4.5}) {
        refinement.refine(flown(t), settings, 0);
        FrameReport report = refinement.refine(flown(t), settings, 0);
        EXPECT_EQ(report.split_count + report.collapse_count, 0u);
        size_t asked = 0;
        for (uint32_t i = 0; i < h.split_count(); ++i) {
            bool stands = true;
            for (uint32_t k = h.need_begin[i]; k < h.need_begin[i + 1]; ++k) stands = stands && refinement.is_applied(h.needs[k]);
            asked += stands;
        }
        EXPECT_EQ(report.evaluated_count, asked);
        Refinement fresh(mesh);
        fresh.refine(flown(t), settings, 0);
        EXPECT_EQ(drawn(refinement), drawn(fresh));
    }
}

TEST(Refinement, RestsWhileTheCameraStands) {
    Mesh mesh = mesh_of(hills());
    for (double glide_s : {0.0, 0.25}) {
        Settings settings = plain();
        settings.glide_s = glide_s;
        Refinement refinement(mesh);
        for (int frame = 0; frame < 30; ++frame) refinement.refine(flown(1), settings, kFrame_s);
        for (int frame = 0; frame < 30; ++frame) {
            FrameReport report = refinement.refine(flown(1), settings, kFrame_s);
            EXPECT_EQ(report.split_count + report.collapse_count + report.gliding_count, 0u);
        }
    }
}

TEST(Refinement, RestsUnderAJitterOfOneInAHundred) {
    Mesh mesh = mesh_of(hills());
    Settings settings = plain();
    Refinement refinement(mesh);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> jitter(-0.01, 0.01);
    std::vector<view::Camera> cameras;
    for (int i = 0; i < 60; ++i) {
        cameras.push_back(flown(1));
        glm::dvec3 middle(32, 32, 0);
        cameras.back().position_m = middle + (cameras.back().position_m - middle) * (1 + jitter(random));
        cameras.back().heading_deg += 100 * jitter(random);
    }
    uint32_t first_second = 0;
    for (int frame = 0; frame < 240; ++frame) {
        FrameReport report = refinement.refine(cameras[size_t(frame) % cameras.size()], settings, kFrame_s);
        if (frame < 60)
            first_second += report.split_count;
        else
            EXPECT_EQ(report.split_count + report.collapse_count, 0u) << frame;
    }
    EXPECT_GT(first_second, 300u);
}

TEST(Refinement, RestoresTheCoarsestFacesWhenItLooksAway) {
    Mesh mesh = mesh_of(hills());
    Refinement refinement(mesh);
    std::vector<Triangle> coarsest = drawn(refinement);
    refinement.refine(flown(1), plain(), kFrame_s);
    EXPECT_GT(drawn(refinement).size(), 3 * coarsest.size());
    refinement.refine(camera_at(32, -200, 10, 180, 0), plain(), kFrame_s);
    EXPECT_EQ(drawn(refinement), coarsest);
}

TEST(Refinement, KeepsItsBudgets) {
    Mesh mesh = mesh_of(hills());
    Settings settings = plain();
    settings.most_operations = 64;
    Refinement refinement(mesh);
    for (int frame = 0; frame < 30; ++frame) {
        FrameReport report = refinement.refine(flown(frame * 0.1), settings, kFrame_s);
        EXPECT_LE(report.split_count + report.collapse_count, 64u);
    }
    settings.most_operations = 400;
    settings.error_px = 0.5;
    settings.most_triangles = 3000;
    for (int frame = 0; frame < 60; ++frame) {
        FrameReport report = refinement.refine(flown(3), settings, kFrame_s);
        if (frame < 30) continue;
        EXPECT_LE(report.triangle_count, 3000u);
        EXPECT_GE(report.triangle_count, 2850u);
        EXPECT_EQ(report.split_count + report.collapse_count, 0u);
        EXPECT_GT(report.error_px, 0.5);
    }
    settings.most_triangles = 1500;
    for (int frame = 0; frame < 20; ++frame) refinement.refine(flown(3), settings, kFrame_s);
    FrameReport report = refinement.refine(flown(3), settings, kFrame_s);
    EXPECT_LE(report.triangle_count, 1500u);
    EXPECT_GE(report.triangle_count, 1425u);
}

// By the greatest error: with a budget no split made has less than one that is left.
TEST(Refinement, SplitsTheGreatestErrorsFirst) {
    const Hierarchy& h = hills();
    Mesh mesh = mesh_of(h);
    Settings settings = plain();
    settings.error_px = 0.5, settings.most_operations = 300;
    Refinement refinement(mesh);
    view::Camera camera = flown(1);
    FrameReport report = refinement.refine(camera, settings, kFrame_s);
    EXPECT_EQ(report.split_count, 300u);
    ScreenTest test(mesh, camera, settings);
    double least_made = std::numeric_limits<double>::infinity(), greatest_left = 0;
    for (uint32_t i = 0; i < h.split_count(); ++i) {
        bool needs_all = true;
        for (uint32_t k = h.need_begin[i]; k < h.need_begin[i + 1]; ++k)
            needs_all = needs_all && refinement.is_applied(h.needs[k]);
        if (refinement.is_applied(i)) least_made = std::min(least_made, test(i).error_px);
        if (!refinement.is_applied(i) && needs_all && test(i).wants_split)
            greatest_left = std::max(greatest_left, test(i).error_px);
    }
    EXPECT_GE(least_made, greatest_left);
    EXPECT_EQ(report.error_px, greatest_left);
}

TEST(Refinement, DrawsEveryCornerWithAVertexOfItsFacesOwnGroup) {
    const Hierarchy& h = hills();
    Mesh mesh = mesh_of(h);
    Refinement refinement(mesh);
    refinement.refine(flown(2), plain(), kFrame_s);
    size_t seam_corners = 0;
    for (const Triangle& t : drawn(refinement)) {
        for (uint32_t v : t.vertices) {
            const RenderVertex& vertex = h.vertices[v];
            float of_group = vertex.uv.x - 0.05f * (h.positions_m[vertex.position].x + float(h.origin_m.x));
            EXPECT_NEAR(of_group, float(h.face_group[t.face]), 0.01);
            seam_corners += h.vertex_begin[vertex.position + 1] - h.vertex_begin[vertex.position] > 1;
        }
    }
    EXPECT_GT(seam_corners, 20u);
}

TEST(Refinement, LeavesUnsplitWhatLooksAwayOnlyIfBackFacesAreCulled) {
    Hierarchy h = synthetic::bake(synthetic::sphere(32));
    Mesh mesh = mesh_of(h);
    view::Camera camera = camera_at(0, -40, 0, 0, 0);
    Settings settings = plain();
    settings.error_px = 0.4;
    auto behind = [&](const Settings& asked) {
        Refinement refinement(mesh);
        refinement.refine(camera, asked, kFrame_s);
        size_t count = 0;
        for (const Triangle& t : drawn(refinement))
            count += h.positions_m[h.vertices[t.vertices[0]].position].y + h.origin_m.y > 6;
        return count;
    };
    size_t kept = behind(settings);
    settings.culls_back_faces = true;
    EXPECT_LT(behind(settings) * 2, kept);
}

TEST(Refinement, RefinesOutlinesFurtherIfAsked) {
    Hierarchy h = synthetic::bake(synthetic::sphere(32));
    Mesh mesh = mesh_of(h);
    view::Camera camera = camera_at(0, -40, 0, 0, 0);
    Settings settings = plain();
    auto near_outline = [&](double silhouette_px, bool outline) {
        settings.error_px = 3, settings.silhouette_error_px = silhouette_px;
        Refinement refinement(mesh);
        refinement.refine(camera, settings, kFrame_s);
        size_t count = 0;
        for (const Triangle& t : drawn(refinement)) {
            double y = h.positions_m[h.vertices[t.vertices[0]].position].y + h.origin_m.y;
            count += outline ? std::abs(y + 2.5) < 2.5 : y < -9;
        }
        return count;
    };
    double outline_growth = double(near_outline(0.5, true)) / double(near_outline(3, true));
    double front_growth = double(near_outline(0.5, false)) / double(near_outline(3, false));
    EXPECT_GT(outline_growth, 1.2 * front_growth);
}

TEST(RefinementMemory, IsWithinWhatIsPromised) {
    Hierarchy h = synthetic::bake(synthetic::hills(120, 120, 2));
    Mesh mesh = mesh_of(h);
    double bytes_per_triangle = double(mesh.bytes().all()) / mesh.face_count();
    EXPECT_LE(bytes_per_triangle, 40);
    RecordProperty("static_bytes_per_triangle", std::to_string(bytes_per_triangle));
    Settings settings = plain();
    settings.error_px = 0.5;
    Refinement refinement(mesh);
    for (int frame = 0; frame < 100; ++frame) refinement.refine(flown(0.02 * frame), settings, kFrame_s);
    Refinement::Bytes bytes = refinement.bytes();
    double active = double(bytes.active) / double(refinement.faces().face_count());
    EXPECT_LE(double(bytes.fixed), 0.01 * double(mesh.bytes().all()));
    EXPECT_LE(active, 24);
    std::printf(
        "static %.1f bytes a triangle (bounds %.1f, records %.1f, vertices %.1f, base %.1f); fixed %.2f %%, active %.1f bytes a "
        "face\n",
        bytes_per_triangle, double(mesh.bytes().bounds) / mesh.face_count(), double(mesh.bytes().records) / mesh.face_count(),
        double(mesh.bytes().vertices) / mesh.face_count(), double(mesh.bytes().base) / mesh.face_count(),
        100.0 * double(bytes.fixed) / double(mesh.bytes().all()), active);
}

}  // namespace
}  // namespace overlook::caveclod
