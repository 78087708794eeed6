// A mesh as what LOD-sprite sits on: what its cuts keep, by every split of it.
#include "runtime/lod_sprite/on_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>

#include "runtime/lod_sprite/director.h"
#include "runtime/view/pixel_error.h"
#include "tests/caveclod/flights.h"
#include "tests/caveclod/synthetic_hierarchy.h"

namespace overlook::lod_sprite {
namespace {

namespace synthetic = caveclod::synthetic;
using Triangles = std::multiset<std::array<uint32_t, 3>>;

struct Thing {
    caveclod::Hierarchy hierarchy = synthetic::bake(synthetic::hills(48, 48, 3));  // of three surfaces
    caveclod::Mesh mesh = *caveclod::Mesh::make(hierarchy);
};
const Thing& thing() {
    static const Thing kThing;
    return kThing;
}

view::Camera pose(double x_m, double heading_deg = 0) {
    return caveclod::flights::camera_at(24 + x_m, -20, 14, heading_deg, -22, 320, 240);
}

Triangles triangles_of(const MeshGeometry::BySurface& by_surface) {
    Triangles triangles;
    for (const std::vector<uint32_t>& indices : by_surface)
        for (size_t i = 0; i < indices.size(); i += 3) triangles.insert({indices[i], indices[i + 1], indices[i + 2]});
    return triangles;
}

Triangles coarse_of(MeshGeometry& geometry, const view::Camera& camera, const view::PixelDetail& detail) {
    CutCount count = geometry.cut_coarse(camera, detail);
    EXPECT_EQ(geometry.put_near_first(camera, 0), 0u);
    Triangles far = triangles_of(geometry.far());
    EXPECT_EQ(far.size(), count.triangle_count);
    return far;
}

// The faces of a refinement, all or those of a slice, surface by surface.
Triangles faces_of(const caveclod::FaceSlots& faces, uint64_t first = 0, uint64_t count = ~uint64_t(0)) {
    Triangles triangles;
    uint64_t at = 0;
    for (uint32_t surface = 0; surface < faces.surface_count(); ++surface)
        for (uint32_t page = 0; page < faces.pages(surface).size(); ++page)
            for (uint32_t slot = 0; slot < faces.page_count(surface, page); ++slot, ++at) {
                const uint32_t* corners = &faces.pages(surface)[page]->indices[3 * size_t(slot)];
                if (at >= first && at - first < count) triangles.insert({corners[0], corners[1], corners[2]});
            }
    return triangles;
}

TEST(MeshGeometry, DependsOnTheCameraAlone) {
    MeshGeometry flown(thing().mesh);
    for (int step = 0; step < 12; ++step) {
        view::Camera camera = pose(1.5 * step - 8, 4.0 * step - 20);
        view::PixelDetail detail{12, 0, 0, 1, {}, {}, step % 2 == 1};
        if (step % 3 == 0) detail.near_depth_m = 24;
        if (step % 3 == 1) detail.seen_by = pose(0);
        MeshGeometry fresh(thing().mesh);
        EXPECT_TRUE(coarse_of(flown, camera, detail) == coarse_of(fresh, camera, detail)) << step;

        fresh.begin_key(camera, 0.7);
        fresh.next_slice(std::numeric_limits<uint64_t>::max());
        flown.begin_key(camera, 0.7);
        while (!flown.next_slice(300).is_last) continue;
        EXPECT_TRUE(faces_of(flown.key().faces()) == faces_of(fresh.key().faces())) << step;
    }
}

// What could be split next and is not keeps the error of the part that it is in: so does the whole cut, since a split's error and
// sphere bound those of all that needs it. On a flight, where each cut goes on from the one before.
TEST(MeshGeometry, KeepsEachPartsError) {
    const caveclod::Mesh& mesh = thing().mesh;
    caveclod::Refinement refinement(mesh);
    MeshGeometry geometry(mesh);
    std::vector<uint32_t> needs;
    uint64_t finer = 0, coarser = 0;
    for (int step = 0; step < 12; ++step) {
        view::Camera camera = pose(1.5 * step - 8, 3.0 * step - 15);
        std::vector<uint8_t> marked(16, 0);
        marked[size_t(step)] = 1;
        view::PixelDetail detail{16, 0, step % 2 == 0 ? 22.0 : 0.0, 1, {}, view::PictureMask(4, 4, marked), false};
        if (step % 3 == 2) detail.seen_by = pose(0);
        caveclod::Settings settings;
        settings.error_px = detail.error_px, settings.collapse_share = 1, settings.guard_deg = 0, settings.glide_s = 0,
        settings.most_operations = 0;
        view::FinerParts parts(camera, detail);
        refinement.refine(camera, settings, 0, &parts);
        ASSERT_EQ(coarse_of(geometry, camera, detail), faces_of(refinement.faces()));

        view::SphereErrorBound bound(camera);
        for (uint32_t split = 0; split < mesh.split_count(); ++split) {
            mesh.decode_needs(split, needs);
            bool is_next = std::all_of(needs.begin(), needs.end(), [&](uint32_t need) { return refinement.is_applied(need); });
            if (refinement.is_applied(split) || !is_next) continue;
            glm::dvec3 from_eye_m = mesh.middle_m(split) - camera.position_m;
            view::SphereErrorBound::Place place = bound.place_of(from_eye_m);
            double radius_m = mesh.radius_m(split);
            bool is_outside = false;  // of the frame, wholly
            for (const glm::dvec3& side : view::sides_of(camera))
                is_outside = is_outside || glm::dot(side, from_eye_m) < -glm::length(side) * radius_m * (1 + 1e-9);
            if (is_outside) continue;
            bool is_fine = parts.touch(place, radius_m);
            ++(is_fine ? finer : coarser);
            EXPECT_LE(bound(place, radius_m, mesh.error_m(split)), is_fine ? detail.near_error_px : detail.error_px) << split;
        }
    }
    EXPECT_GT(finer, 20u);
    EXPECT_GT(coarser, 500u);
}

TEST(MeshGeometry, IsFinerOnlyWhereItIsAsked) {
    view::Camera camera = pose(0);
    MeshGeometry geometry(thing().mesh);
    size_t coarse = coarse_of(geometry, camera, {16, 0, 0, 1}).size(), fine = coarse_of(geometry, camera, {1, 0, 0, 1}).size();
    size_t near = coarse_of(geometry, camera, {16, 0, 24, 1}).size();
    size_t outlines = coarse_of(geometry, camera, {16, 0, 0, 1, {}, {}, true}).size();
    EXPECT_GT(near, coarse);
    EXPECT_LT(near, fine);
    EXPECT_GT(outlines, coarse);
    EXPECT_LT(outlines, fine);
}

TEST(MeshGeometry, PutsNearTrianglesFirst) {
    view::Camera camera = pose(0);
    MeshGeometry geometry(thing().mesh);
    CutCount count = geometry.cut_coarse(camera, {2, 0, 30, 1});
    uint64_t near_count = geometry.put_near_first(camera, 30);
    Triangles near = triangles_of(geometry.near()), far = triangles_of(geometry.far());
    EXPECT_EQ(near.size(), near_count);
    EXPECT_EQ(near.size() + far.size(), count.triangle_count);
    EXPECT_GT(near.size(), 50u);
    EXPECT_GT(far.size(), 50u);
    auto farthest_m = [&](const std::array<uint32_t, 3>& corners) {
        double farthest = 0;
        for (uint32_t vertex : corners) {
            glm::dvec3 away_m = thing().mesh.origin_m() + thing().mesh.vertex_m(vertex) - camera.position_m;
            farthest = std::max(farthest, glm::dot(away_m, view::axes_of(camera).forward));
        }
        return farthest;
    };
    for (const auto& triangle : near) EXPECT_LT(farthest_m(triangle), 30);
    for (const auto& triangle : far) EXPECT_GE(farthest_m(triangle), 30);
}

// Whatever key was made before, and whether in one slice or in many.
TEST(MeshGeometry, DrawsEachTriangleOfAKeyOnce) {
    MeshGeometry geometry(thing().mesh);
    for (int step = 0; step < 6; ++step) {
        geometry.begin_key(pose(3.0 * step - 4), 0.7);
        uint64_t wanted = step % 2 == 0 ? 100 : std::numeric_limits<uint64_t>::max(), slices = 0;
        Triangles drawn;
        for (bool is_last = false; !is_last; ++slices) {
            ASSERT_LT(slices, 1000u);
            Geometry::Slice slice = geometry.next_slice(wanted);
            EXPECT_LE(slice.count.triangle_count, wanted);
            EXPECT_EQ(slice.count.triangle_count, geometry.slice_count());
            drawn.merge(faces_of(geometry.key().faces(), geometry.slice_begin(), geometry.slice_count()));
            is_last = slice.is_last;
        }
        EXPECT_EQ(slices > 1, step % 2 == 0);
        EXPECT_GT(drawn.size(), 500u);
        EXPECT_EQ(drawn, faces_of(geometry.key().faces())) << step;
    }
}

// Of a camera that dives at it: keys are for places far ahead, where the frame's own near plane would cut the mesh away.
TEST(MeshGeometry, IsNeverCutByAKeysNearPlane) {
    MeshGeometry geometry(thing().mesh);
    Settings settings;
    Director director(geometry, settings);
    auto distance_m = [&](const view::Camera& camera) {
        return glm::distance(camera.position_m, glm::clamp(camera.position_m, thing().mesh.lowest_m(), thing().mesh.highest_m()));
    };
    uint32_t keys = 0, far_ahead = 0;
    for (int frame = 0; frame < 60; ++frame) {
        view::Camera camera = caveclod::flights::camera_at(24, -200 + 3.0 * frame, 3, 0, 0, 320, 240);
        camera.near_m = 1e-4;
        while (std::optional<KeyWork> work = director.key_work(camera)) {
            if (work->begin != nullptr) {
                ++keys;
                const view::Camera& key = *work->begin;
                EXPECT_LE(key.near_m * view::corner_secant(key), distance_m(key) + camera.near_m) << frame;
                EXPECT_GE(key.near_m, camera.near_m);
                far_ahead += distance_m(key) < 0.4 * distance_m(camera);
            }
            if (work->is_last) director.key_done({2, 2, std::vector<float>(4, float(distance_m(camera) + 20))});
        }
        director.novel();
        EXPECT_LE(director.camera().near_m * view::corner_secant(director.camera()), distance_m(camera) + camera.near_m);
    }
    EXPECT_GE(keys, 3u);
    EXPECT_GE(far_ahead, 1u);
}

TEST(MeshGeometry, SaysHowFarAnyCutMayBeOff) {
    MeshGeometry geometry(thing().mesh);
    double greatest_m = 0;
    for (uint32_t split = 0; split < thing().mesh.split_count(); ++split)
        greatest_m = std::max(greatest_m, double(thing().mesh.error_m(split)));
    EXPECT_GT(greatest_m, 0);
    EXPECT_EQ(geometry.most_slack_m(), greatest_m);
}

}  // namespace
}  // namespace overlook::lod_sprite
