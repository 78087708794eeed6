// G of meshes: the judge finds what is off, and caveclod keeps what it promises of a frame.
#include "tools/measure/honesty/mesh_honesty.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "runtime/caveclod/mesh_stream.h"
#include "runtime/caveclod/refine.h"
#include "runtime/view/nearest_in_triangle.h"
#include "tests/caveclod/mesh_files.h"
#include "tests/tools/caveclod/test_meshes.h"
#include "tools/bake/caveclod/bake.h"
#include "tools/measure/numbers/honesty_tally.h"

namespace overlook::measure {
namespace {

std::vector<glm::dvec3> random_places(size_t count, uint64_t seed, double size) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> within(-size, size);
    std::vector<glm::dvec3> places(count);
    for (glm::dvec3& place : places) place = {within(random), within(random), within(random)};
    return places;
}

TEST(NearestPoint, IsThatOfTryingAllTriangles) {
    std::vector<glm::dvec3> corners = random_places(3 * 300, 1, 10);
    for (size_t i = 0; i < corners.size(); i += 3) {  // small ones, some without an area
        corners[i + 1] = corners[i] + 0.1 * corners[i + 1];
        corners[i + 2] = i % 9 == 0 ? corners[i] : corners[i] + 0.1 * corners[i + 2];
    }
    NearestPoint nearest(corners);
    for (const glm::dvec3& place : random_places(2000, 2, 14)) {
        double least = 1e300;
        for (size_t i = 0; i < corners.size(); i += 3) {
            glm::dvec3 at = view::nearest_in_triangle(place, corners[i], corners[i + 1], corners[i + 2]);
            least = std::min(least, glm::distance(at, place));
        }
        ASSERT_DOUBLE_EQ(glm::distance(nearest(place), place), least);
    }
}

struct Baked {
    caveclod::Hierarchy hierarchy;
    std::unique_ptr<caveclod::Mesh> mesh;

    explicit Baked(const mesh::Mesh& source) {
        caveclod::BakeReport report;
        auto made = caveclod::bake(source, {}, report, [](double) {});
        EXPECT_TRUE(made) << made.error().message;
        hierarchy = std::move(*made);
        auto packed = caveclod::Mesh::make(hierarchy);
        EXPECT_TRUE(packed);
        mesh = std::make_unique<caveclod::Mesh>(std::move(*packed));
    }
};

// The drawn corners of a refinement without glides.
std::vector<glm::dvec3> corners_of(const caveclod::Refinement& refinement) {
    std::vector<glm::dvec3> corners;
    const caveclod::FaceSlots& faces = refinement.faces();
    for (uint32_t surface = 0; surface < faces.surface_count(); ++surface) {
        for (uint32_t page = 0; page < faces.pages(surface).size(); ++page) {
            for (uint32_t i = 0; i < 3 * faces.page_count(surface, page); ++i) {
                const caveclod::Mesh& mesh = refinement.mesh();
                corners.push_back(mesh.origin_m() + mesh.vertex_m(faces.pages(surface)[page]->indices[i]));
            }
        }
    }
    return corners;
}

view::Camera random_camera(const caveclod::Mesh& mesh, uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> share(0, 1);
    glm::dvec3 middle = (mesh.lowest_m() + mesh.highest_m()) / 2.0;
    double size = glm::distance(mesh.lowest_m(), mesh.highest_m());
    view::Camera camera;
    camera.heading_deg = 360 * share(random), camera.pitch_deg = 60 - 120 * share(random),
    camera.fov_y_deg = 25 + 80 * share(random);
    camera.position_m = middle - view::axes_of(camera).forward * (size * (0.2 + 2 * share(random)));
    camera.width_px = seed % 2 == 0 ? 1280 : 480, camera.height_px = seed % 3 == 0 ? 1200 : 480;
    camera.near_m = 1e-4 * size;
    return camera;
}

struct Judged {
    Honesty all;
    size_t frames = 0;
};
// promise: what is said of a frame, of what was promised.
Judged judge(const Baked& baked, double promise) {
    MeshHonesty judge(baked.hierarchy);
    HonestyTally tally;
    Judged judged;
    for (uint64_t seed = 0; seed < 60; ++seed) {
        caveclod::Refinement refinement(*baked.mesh);
        caveclod::Settings settings;
        settings.error_px = seed % 4 == 0 ? 8 : 1.5, settings.most_operations = 0, settings.glide_s = 0;
        view::Camera camera = random_camera(*baked.mesh, seed);
        double error_px = refinement.refine(camera, settings, 0).error_px;
        EXPECT_LE(error_px, settings.error_px);
        Promises promises = judge.promises_of(corners_of(refinement), camera, promise * error_px);
        if (!promises.predicted_px.empty()) ++judged.frames;
        tally.add(promises.predicted_px, promises.measured_px);
    }
    judged.all = tally.all();
    return judged;
}

TEST(HonestyOfCaveclod, NothingInAFrameIsFartherOffThanPromised) {
    Baked torus(caveclod::test::torus(96, 48, 10, 4));
    Judged judged = judge(torus, 1);
    EXPECT_GT(judged.frames, 40u);
    EXPECT_EQ(judged.all.above_prediction, 0u) << judged.all.ratio_max;
    EXPECT_LE(judged.all.ratio_max, 1);
    EXPECT_GE(judged.all.ratio_median, kIdleRatio);
    std::printf("measured over promised: %.3f at most, %.3f in the median of %zu frames\n", judged.all.ratio_max,
                judged.all.ratio_median, judged.frames);
}

// While a mesh comes block by block, and with as much as a little memory holds.
TEST(HonestyOfCaveclod, NothingIsFartherOffThanPromisedWhileBlocksAreMissing) {
    Baked torus(caveclod::test::torus(120, 60, 10, 4));
    MeshHonesty judge(torus.hierarchy);
    std::string file = caveclod::synthetic::file_of(torus.hierarchy);
    size_t judged = 0, lacking = 0;
    for (uint64_t seed = 0; seed < 24; ++seed) {
        std::vector<container::Reader> readers;
        readers.push_back(*container::Reader::open_bytes(std::as_bytes(std::span(file)), "torus.ovl"));
        uint64_t budget_bytes = seed % 3 == 0 ? 2 << 20 : 1 << 30;
        auto stream = caveclod::MeshStream::open(std::move(readers), {budget_bytes, 1 << 20, 1, 2});
        ASSERT_TRUE(stream) << stream.error().message;
        caveclod::Refinement refinement((*stream)->mesh(0));
        caveclod::Settings settings;
        settings.error_px = seed % 4 == 0 ? 4 : 0.7, settings.most_operations = 0, settings.glide_s = 0;
        view::Camera camera = random_camera(*torus.mesh, seed);
        for (int frame = 0; frame < 9; ++frame) {
            ASSERT_TRUE((*stream)->begin_frame().empty());
            caveclod::FrameReport report = refinement.refine(camera, settings, 0);
            (*stream)->take_note(0, refinement, camera, settings, report.missing_px);
            (*stream)->end_frame();
            lacking += report.missing_px > settings.error_px;
            Promises promises = judge.promises_of(corners_of(refinement), camera, report.error_px);
            for (size_t i = 0; i < promises.predicted_px.size(); ++i, ++judged)
                EXPECT_LE(promises.measured_px[i], promises.predicted_px[i]) << seed << " " << frame;
        }
    }
    EXPECT_GT(judged, 100u);
    EXPECT_GT(lacking, 40u);
}

TEST(HonestyOfCaveclod, APromiseOfLessIsFoundOut) {
    Baked torus(caveclod::test::torus(96, 48, 10, 4));
    EXPECT_GT(judge(torus, 0.3).all.above_prediction, 0u);
}

}  // namespace
}  // namespace overlook::measure
