#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "runtime/view/flight.h"
#include "tests/formats/scratch_folder.h"
#include "tools/bake/mesh_input.h"
#include "tools/make_sample/sample_objects.h"

namespace overlook::sample {
namespace {

const std::string kSamples = OVERLOOK_SOURCE_DIR "/samples/";

// Of edges between two faces each is there once in either direction.
size_t open_edges(const mesh::Mesh& mesh, uint32_t surface) {
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    for (size_t face = 0; face < mesh.faces.size(); ++face)
        for (size_t i = 0; i < 3 && mesh.face_surface[face] == surface; ++i)
            ++edges[{mesh.faces[face][i], mesh.faces[face][(i + 1) % 3]}];
    size_t open = 0;
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        open += edges.count({edge.second, edge.first}) == 0;
    }
    return open;
}

// Six times what a closed mesh holds: positive where its faces are seen counterclockwise from outside.
double volume_m3(const mesh::Mesh& mesh, uint32_t surface) {
    double sum = 0;
    for (size_t face = 0; face < mesh.faces.size(); ++face) {
        if (mesh.face_surface[face] != surface) continue;
        const auto& [a, b, c] = mesh.faces[face];
        glm::dvec3 p(mesh.positions_m[a]), q(mesh.positions_m[b]), r(mesh.positions_m[c]);
        sum += glm::dot(p, glm::cross(q, r)) / 6;
    }
    return sum;
}

TEST(SampleObjects, AreClosedAndSeenFromOutside) {
    mesh::Mesh vase = vase_mesh(), masts = masts_mesh();
    EXPECT_EQ(vase.faces.size(), 98'816u);
    EXPECT_EQ(open_edges(vase, 0), 0u);
    EXPECT_GT(volume_m3(vase, 0), 1);
    EXPECT_EQ(masts.surfaces[0].name, "ground");
    EXPECT_EQ(open_edges(masts, 0), 4 * 64u);
    EXPECT_EQ(open_edges(masts, 1), 0u);
    // Twelve round bars of 0.3 m and 15.5 m, and a little for the railing.
    EXPECT_NEAR(volume_m3(masts, 1), 12 * 15.5 * 3.0 * 0.15 * 0.15, 1.5);
}

TEST(SampleObjects, AreFlownRoundAndPastByTheirCases) {
    EXPECT_EQ(scene::json_from_flight(vase_flight()), text_of_file(kSamples + "flights/s09.json"));
    EXPECT_EQ(scene::json_from_flight(masts_flight()), text_of_file(kSamples + "flights/s10.json"));
    scene::Flight flight = vase_flight();
    for (uint32_t frame = 0; frame < scene::frame_count(flight); ++frame) {
        view::Camera camera = view::camera_at(flight, scene::frame_time_s(flight, frame), {});
        EXPECT_NEAR(glm::length(camera.position_m), std::hypot(4.5, 1.0), 0.01) << frame;
        EXPECT_GT(glm::dot(view::axes_of(camera).forward, -glm::normalize(camera.position_m)), 0.9999) << frame;
    }
}

TEST(SampleObjects, AreWrittenTheSameEveryTimeAndReadAgain) {
    ScratchFolder folder;
    for (std::string name : {"vase", "masts"}) {
        Result<std::vector<std::string>> first = make_object(name, folder / "a"), second = make_object(name, folder / "b");
        ASSERT_TRUE(first && second);
        ASSERT_EQ(first->size(), 4u);
        for (size_t i = 0; i < 4; ++i) EXPECT_EQ(text_of_file((*first)[i]), text_of_file((*second)[i]));
        EXPECT_EQ(scene::read_scene((*first)[2])->layers[0].asset, name + ".ovl");
        EXPECT_TRUE(scene::read_flight((*first)[3]));
        EXPECT_NE(text_of_file((*first)[1]).find(name == "vase" ? "newmtl clay" : "newmtl mast"), std::string::npos);
    }
    EXPECT_EQ(make_object("vase", "/proc/nowhere").error().exit, Exit::cannot_write);
}

}  // namespace
}  // namespace overlook::sample
