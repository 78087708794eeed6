#include "runtime/terrain/refine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "formats/parallel.h"
#include "formats/terrain_diamond.h"
#include "runtime/view/pixel_error.h"
#include "tests/runtime/hills.h"

namespace overlook::terrain {
namespace {

// Triangles as a set: each from its least vertex on.
std::multiset<std::array<uint32_t, 3>> triangles_of(const Cut& cut) {
    std::multiset<std::array<uint32_t, 3>> triangles;
    for (size_t i = 0; i < cut.indices.size(); i += 3) {
        std::array<uint32_t, 3> t{cut.indices[i], cut.indices[i + 1], cut.indices[i + 2]};
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        triangles.insert(t);
    }
    return triangles;
}

TEST(SlicedCut, HoldsWhatTheWholeCutHolds) {
    Terrain terrain = baked(test::make_hills(129, 129, 3, 0.02));
    Refiner refiner(terrain);
    Cut whole, slice;
    for (uint64_t seed = 0; seed < 20; ++seed) {
        view::Camera camera = random_camera(terrain, seed);
        double error_px = random_tolerance_px(seed);
        refiner.cut_by_pixels(camera, error_px, whole);
        SlicedCut sliced(refiner, camera, error_px);
        std::multiset<std::array<uint32_t, 3>> triangles;
        uint64_t slices = 0;
        double share_before = 0;
        while (!sliced.is_done()) {
            sliced.next(100, slice);
            EXPECT_LE(slice.triangle_count(), 100u);
            EXPECT_TRUE(sliced.is_done() || slice.triangle_count() == 100);
            EXPECT_GE(sliced.share_done(), share_before);
            share_before = sliced.share_done();
            triangles.merge(triangles_of(slice));
            ++slices;
        }
        EXPECT_EQ(sliced.share_done(), 1);
        EXPECT_EQ(triangles, triangles_of(whole)) << seed;
        if (whole.triangle_count() > 3000) {
            EXPECT_GT(slices, 3u);
        }
    }
}

// Whatever of a frame another camera does not see keeps the finer error, crack-free; what it sees does not.
TEST(PixelCut, IsFinerOutsideWhatAnotherCameraSees) {
    Terrain terrain = baked(test::make_hills(129, 129, 3, 0.02));
    Refiner refiner(terrain);
    Cut coarse, fine, both;
    uint32_t between = 0;
    for (uint64_t seed = 0; seed < 40; ++seed) {
        view::Camera camera = random_camera(terrain, seed), other = camera;
        double error_px = random_tolerance_px(seed);
        view::PixelDetail detail{16 * error_px, 0, 0, error_px, camera};
        refiner.cut_by_pixels(camera, 16 * error_px, coarse);
        refiner.cut_by_pixels(camera, error_px, fine);

        detail.seen_by->heading_deg += 180;  // sees nothing of it
        detail.seen_by->pitch_deg = -detail.seen_by->pitch_deg;
        refiner.cut_by_pixels(camera, detail, both);
        EXPECT_EQ(triangles_of(both), triangles_of(fine)) << seed;

        other.heading_deg += 0.4 * camera.fov_y_deg;
        detail.seen_by = other;
        refiner.cut_by_pixels(camera, detail, both);
        EXPECT_EQ(count_t_junctions(both.indices, terrain.shape.width), 0u) << seed;
        EXPECT_GE(both.triangle_count(), coarse.triangle_count());
        between += both.triangle_count() > coarse.triangle_count() && both.triangle_count() < fine.triangle_count();
    }
    EXPECT_GT(between, 5u);
}

TEST(PixelCut, HasNoCrackForAnyCamera) {
    Terrain terrain = baked(test::make_hills(129, 129, 3, 0.02));
    Refiner refiner(terrain);
    Cut cut;
    size_t drawn = 0;
    for (uint64_t seed = 0; seed < 400; ++seed) {
        refiner.cut_by_pixels(random_camera(terrain, seed), random_tolerance_px(seed), cut);
        drawn += cut.triangle_count();
        ASSERT_EQ(count_t_junctions(cut.indices, terrain.shape.width), 0u) << "camera " << seed;
    }
    EXPECT_GT(drawn, 100000u);
}

TEST(PixelCut, CountsACrackWhereThereIsOne) {
    Terrain terrain = baked(test::make_hills(17, 17, 3));
    Cut cut;
    cut.indices = {0, 2, 34, 1, 18, 35};
    EXPECT_GT(count_t_junctions(cut.indices, terrain.shape.width), 0u);
}

struct Screen {
    double x, y, depth;
};

Screen project(const view::Camera& camera, const view::Axes& axes, const glm::dvec3& point) {
    glm::dvec3 p = point - camera.position_m;
    double depth = glm::dot(p, axes.forward), focal = view::focal_px(camera);
    return {focal * glm::dot(p, axes.right) / depth, focal * glm::dot(p, axes.up) / depth, depth};
}

bool is_in_frame(const view::Camera& camera, const Screen& s) {
    return s.depth >= camera.near_m && std::abs(s.x) <= camera.width_px / 2.0 && std::abs(s.y) <= camera.height_px / 2.0;
}

// A corner of a triangle as it is drawn.
struct Corner {
    int64_t x, y;
    double z;
};

Corner corner_of(const Terrain& terrain, const Cut& cut, size_t i) {
    uint32_t width = terrain.shape.width, sample = cut.indices[i];
    double rise_m = 0;
    if (sample >= terrain.heights.size()) {
        const Cut::Morph& morph = cut.morphs[sample - terrain.heights.size()];
        sample = morph.sample, rise_m = double(morph.rise_m);
    }
    return {sample % width, sample / width, terrain.height_m(sample % width, sample / width) + rise_m};
}

// Calls visit(column, row, z) for every sample that a triangle of the cut covers, z its drawn height there.
template <class Visit>
void visit_surface(const Terrain& terrain, const Cut& cut, const Visit& visit) {
    for (size_t i = 0; i < cut.indices.size(); i += 3) {
        Corner p[3] = {corner_of(terrain, cut, i), corner_of(terrain, cut, i + 1), corner_of(terrain, cut, i + 2)};
        double area = double((p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x));
        for (int64_t row = std::min({p[0].y, p[1].y, p[2].y}); row <= std::max({p[0].y, p[1].y, p[2].y}); ++row)
            for (int64_t column = std::min({p[0].x, p[1].x, p[2].x}); column <= std::max({p[0].x, p[1].x, p[2].x}); ++column) {
                auto side = [&](const Corner& a, const Corner& b) {
                    return double((b.x - a.x) * (row - a.y) - (b.y - a.y) * (column - a.x)) / area;
                };
                double a = side(p[1], p[2]), b = side(p[2], p[0]), c = side(p[0], p[1]);
                if (a >= 0 && b >= 0 && c >= 0) visit(uint32_t(column), uint32_t(row), a * p[0].z + b * p[1].z + c * p[2].z);
            }
    }
}

glm::dvec3 place_of(const Terrain& terrain, uint32_t column, uint32_t row, double z) {
    return {column * terrain.frame.metres_per_column, -(row * terrain.frame.metres_per_row), z};
}

// The greatest distance on the screen between a sample in the frame and the drawn point above or below it.
double greatest_displacement_px(const Terrain& terrain, const view::Camera& camera, const Cut& cut) {
    view::Axes axes = view::axes_of(camera);
    double greatest = 0;
    visit_surface(terrain, cut, [&](uint32_t column, uint32_t row, double z) {
        Screen truth = project(camera, axes, place_of(terrain, column, row, terrain.height_m(column, row)));
        Screen drawn = project(camera, axes, place_of(terrain, column, row, z));
        if (!is_in_frame(camera, truth) && !is_in_frame(camera, drawn)) return;
        bool is_before_the_eye = truth.depth > 0 && drawn.depth > 0;
        greatest = std::max(greatest, is_before_the_eye ? std::hypot(truth.x - drawn.x, truth.y - drawn.y) : double(INFINITY));
    });
    return greatest;
}

TEST(PixelCut, DisplacesNothingInTheFrameByMoreThanPredictedAndAsked) {
    Terrain terrain = baked(test::make_hills(129, 97, 11));
    Refiner refiner(terrain);
    Cut cut;
    double nearest_to_promise = 0;
    for (uint64_t seed = 0; seed < 400; ++seed) {
        view::Camera camera = random_camera(terrain, seed);
        double asked_px = random_tolerance_px(seed);
        refiner.cut_by_pixels(camera, asked_px, cut);
        double measured_px = greatest_displacement_px(terrain, camera, cut);
        ASSERT_LE(measured_px, cut.predicted_error_px) << "camera " << seed;
        ASSERT_LE(cut.predicted_error_px, asked_px) << "camera " << seed;
        nearest_to_promise = std::max(nearest_to_promise, measured_px / asked_px);
    }
    EXPECT_GT(nearest_to_promise, 0.3);  // or the bound would be honest by being useless
}

TEST(PixelCut, ShowsEverythingInTheFrame) {
    Terrain terrain = baked(test::make_hills(65, 65, 12));
    Refiner refiner(terrain);
    Cut cut;
    for (uint64_t seed = 0; seed < 100; ++seed) {
        view::Camera camera = random_camera(terrain, seed);
        view::Axes axes = view::axes_of(camera);
        refiner.cut_by_pixels(camera, 1, cut);
        std::vector<uint8_t> is_covered(65 * 65, 0);
        for (size_t i = 0; i < cut.indices.size(); i += 3) {
            int64_t x[3], y[3];
            for (size_t k = 0; k < 3; ++k) x[k] = cut.indices[i + k] % 65, y[k] = cut.indices[i + k] / 65;
            int64_t sign = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]) > 0 ? 1 : -1;
            for (int64_t row = 0; row < 65; ++row)
                for (int64_t column = 0; column < 65; ++column) {
                    auto side = [&](int p, int q) {
                        return sign * ((x[q] - x[p]) * (row - y[p]) - (y[q] - y[p]) * (column - x[p]));
                    };
                    if (side(0, 1) >= 0 && side(1, 2) >= 0 && side(2, 0) >= 0) is_covered[size_t(row * 65 + column)] = 1;
                }
        }
        for (uint32_t row = 0; row < 65; ++row)
            for (uint32_t column = 0; column < 65; ++column) {
                glm::dvec3 p{column * terrain.frame.metres_per_column, -(row * terrain.frame.metres_per_row),
                             terrain.height_m(column, row)};
                bool is_missing = is_in_frame(camera, project(camera, axes, p)) && !is_covered[row * 65 + column];
                ASSERT_FALSE(is_missing) << "camera " << seed << " at " << column << ", " << row;
            }
    }
}

TEST(PixelCut, IsTheSameWithAnyThreadCount) {
    Terrain terrain = baked(test::make_hills(200, 150, 5, 0.05));
    Refiner refiner(terrain);
    view::Camera camera = random_camera(terrain, 9);
    Cut one, more;
    set_thread_count(1);
    refiner.cut_by_pixels(camera, 0.7, one);
    for (unsigned threads : {2u, 7u}) {
        set_thread_count(threads);
        refiner.cut_by_pixels(camera, 0.7, more);
        EXPECT_EQ(one.indices, more.indices);
        EXPECT_EQ(one.predicted_error_px, more.predicted_error_px);
        EXPECT_EQ(one.tested_count, more.tested_count);
    }
    set_thread_count(0);
}

TEST(PixelCut, GrowsAsTheToleranceShrinks) {
    Terrain terrain = baked(test::make_hills(257, 257, 5));
    Refiner refiner(terrain);
    view::Camera camera = random_camera(terrain, 4);
    Cut cut;
    uint64_t before = 0;
    for (double error_px : {16.0, 8.0, 4.0, 2.0, 1.0, 0.5}) {
        refiner.cut_by_pixels(camera, error_px, cut);
        EXPECT_GE(cut.triangle_count(), before);
        before = cut.triangle_count();
    }
    EXPECT_GT(before, 1000u);
}

TEST(MorphedCut, KeepsItsPromiseOnAnyRaster) {
    Cut cut;
    size_t morphing = 0;
    for (auto [width, height] : {std::pair{129u, 129u}, {150u, 97u}, {77u, 201u}}) {
        Terrain terrain = baked(test::make_hills(width, height, 21, 0.01));
        Refiner refiner(terrain);
        for (uint64_t seed = 0; seed < 120; ++seed) {
            view::Camera camera = random_camera(terrain, seed);
            double asked_px = random_tolerance_px(seed), morph = seed % 2 == 0 ? 0.5 : 2;
            refiner.cut_by_pixels(camera, asked_px, cut, morph);
            morphing += cut.morphs.size();
            ASSERT_LE(greatest_displacement_px(terrain, camera, cut), asked_px * (1 + 1e-6))
                << width << " x " << height << ", camera " << seed;
            ASSERT_LE(cut.predicted_error_px, asked_px);
        }
    }
    EXPECT_GT(morphing, 100000u);
}

TEST(MorphedCut, GivesEveryVertexOneHeight) {
    Terrain terrain = baked(test::make_hills(150, 97, 22, 0.02));
    Refiner refiner(terrain);
    Cut cut;
    for (uint64_t seed = 0; seed < 60; ++seed) {
        refiner.cut_by_pixels(random_camera(terrain, seed), random_tolerance_px(seed), cut, 0.5);
        std::map<std::pair<int64_t, int64_t>, double> heights;
        for (size_t i = 0; i < cut.indices.size(); ++i) {
            Corner corner = corner_of(terrain, cut, i);
            auto [at, is_new] = heights.try_emplace({corner.x, corner.y}, corner.z);
            ASSERT_EQ(at->second, corner.z) << "camera " << seed;
        }
    }
}

// The greatest step on the screen that any point of the surface makes from one frame of a slow flight to the next, the camera's
// own movement taken out.
double greatest_step_px(const Terrain& terrain, double morph, double step_m = 0.5) {
    Refiner refiner(terrain);
    Cut cut;
    std::vector<double> before, now;
    double greatest = 0;
    for (int frame = 0; frame < 200; ++frame) {
        view::Camera camera;
        camera.position_m = {1900, -3000 + step_m * frame, 1700};
        camera.pitch_deg = -20;
        refiner.cut_by_pixels(camera, 2, cut, morph);
        now.assign(terrain.heights.size(), NAN);
        visit_surface(terrain, cut,
                      [&](uint32_t column, uint32_t row, double z) { now[row * terrain.shape.width + column] = z; });
        view::Axes axes = view::axes_of(camera);
        for (size_t i = 0; i < before.size(); ++i) {
            if (std::isnan(before[i]) || std::isnan(now[i])) continue;
            uint32_t column = uint32_t(i % terrain.shape.width), row = uint32_t(i / terrain.shape.width);
            Screen a = project(camera, axes, place_of(terrain, column, row, before[i])),
                   b = project(camera, axes, place_of(terrain, column, row, now[i]));
            if (is_in_frame(camera, b)) greatest = std::max(greatest, std::hypot(a.x - b.x, a.y - b.y));
        }
        before = now;
    }
    return greatest;
}

TEST(MorphedCut, GlidesWhereAnUnmorphedOnePops) {
    Terrain terrain = baked(test::make_hills(129, 129, 23));
    double popping_px = greatest_step_px(terrain, 0), gliding_px = greatest_step_px(terrain, 0.5);
    EXPECT_GT(popping_px, 0.3);
    EXPECT_LT(gliding_px, 0.05);
}

// Ten times finer steps over the same start: a surface that is continuous in the camera moves about ten times less at once.
TEST(MorphedCut, MovesInProportionToTheCamera) {
    Terrain terrain = baked(test::make_hills(129, 129, 23));
    double coarse_px = greatest_step_px(terrain, 0.5, 0.5), fine_px = greatest_step_px(terrain, 0.5, 0.05);
    EXPECT_GT(fine_px, 0);
    EXPECT_LT(fine_px, 0.2 * coarse_px);
    EXPECT_GT(greatest_step_px(terrain, 0, 0.05), 0.3);  // a pop is one however slowly it is flown by
}

// A finer near part, for cameras of every kind.
TEST(NearFinerCut, HasNoCrack) {
    Terrain terrain = baked(test::make_hills(129, 129, 3, 0.02));
    Refiner refiner(terrain);
    Cut cut, coarse;
    size_t finer = 0;
    for (uint64_t seed = 0; seed < 300; ++seed) {
        view::Camera camera = random_camera(terrain, seed);
        double near_depth_m = 100 + 3000 * test::random_share(79, seed);
        refiner.cut_by_pixels(camera, 12, coarse);
        refiner.cut_by_pixels(camera, {12, 0, near_depth_m, 1}, cut);
        finer += cut.triangle_count() > coarse.triangle_count() + 20;
        ASSERT_EQ(count_t_junctions(cut.indices, terrain.shape.width), 0u) << "camera " << seed;
    }
    EXPECT_GT(finer, 50u);
}

TEST(NearFinerCut, KeepsTheNearErrorNearAndTheOtherEverywhere) {
    Terrain terrain = baked(test::make_hills(129, 97, 11));
    Refiner refiner(terrain);
    Cut cut;
    double nearest_to_promise_px[2] = {0, 0};  // far, near
    for (uint64_t seed = 0; seed < 200; ++seed) {
        view::Camera camera = random_camera(terrain, seed);
        view::Axes axes = view::axes_of(camera);
        double near_depth_m = 100 + 3000 * test::random_share(79, seed), morph = seed % 2 == 0 ? 0 : 0.5;
        refiner.cut_by_pixels(camera, {12, morph, near_depth_m, 1}, cut);
        visit_surface(terrain, cut, [&](uint32_t column, uint32_t row, double z) {
            Screen truth = project(camera, axes, place_of(terrain, column, row, terrain.height_m(column, row)));
            Screen drawn = project(camera, axes, place_of(terrain, column, row, z));
            if (!is_in_frame(camera, truth) || !is_in_frame(camera, drawn)) return;
            bool is_near = std::min(truth.depth, drawn.depth) < near_depth_m;
            double off_px = std::hypot(truth.x - drawn.x, truth.y - drawn.y), asked_px = is_near ? 1 : 12;
            ASSERT_LE(off_px, asked_px * (1 + 1e-6)) << "camera " << seed;
            nearest_to_promise_px[is_near] = std::max(nearest_to_promise_px[is_near], off_px);
        });
    }
    EXPECT_GT(nearest_to_promise_px[0], 3);
    EXPECT_GT(nearest_to_promise_px[1], 0.3);
}

TEST(MetreCut, OfAPlaneIsTwoTrianglesARoot) {
    dem::Raster plane = test::make_dem(129, 65, [](uint32_t x, uint32_t y) { return float(4 * x + 2 * y); });
    Terrain terrain = baked(plane);
    Cut cut;
    Refiner(terrain).cut_by_metres(0.001, cut);
    EXPECT_EQ(cut.triangle_count(), 4u);
    EXPECT_EQ(cut.void_rim_triangle_count, 0u);
}

TEST(MetreCut, AtZeroReproducesEverySample) {
    dem::Raster noise = test::make_dem(65, 65, [](uint32_t x, uint32_t y) { return float(test::noise(1, x, y) % 5000); });
    Terrain terrain = baked(noise);
    Cut cut;
    Refiner(terrain).cut_by_metres(0, cut);
    EXPECT_EQ(cut.triangle_count(), 2u * 64 * 64);
}

TEST(MetreCut, TurnsItsTrianglesUpwards) {
    Terrain terrain = baked(test::make_hills(40, 50, 5, 0.05));
    Cut cut;
    Refiner(terrain).cut_by_metres(10, cut);
    for (size_t i = 0; i < cut.indices.size(); i += 3) {
        double x[3], y[3];
        for (size_t k = 0; k < 3; ++k) x[k] = cut.indices[i + k] % 40, y[k] = -double(cut.indices[i + k] / 40);
        EXPECT_GT((x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]), 0);
    }
}

TEST(MetreCut, OfAllVoidsIsEmpty) {
    dem::Raster dem = test::make_hills(65, 65, 1);
    for (size_t i = 1; i < dem.samples.size(); ++i) dem.samples[i] = NAN;
    Terrain terrain = baked(dem);
    Cut cut;
    Refiner(terrain).cut_by_metres(10, cut);
    EXPECT_EQ(cut.triangle_count(), 0u);
}

}  // namespace
}  // namespace overlook::terrain
