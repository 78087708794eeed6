// A terrain of section 4 with what belongs to it: what make-sample made of it, baked, and what is known of it from the paper.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "formats/scene.h"
#include "runtime/caveclod/paper.h"
#include "tools/measure/paper/caveclod/screen.h"
#include "tools/measure/world.h"

namespace overlook::measure::paper::cameras {

struct Subject {
    std::string name;  // of its folder
    World world;       // a mesh
    std::unique_ptr<caveclod::paper::Mesh> printed;  // the same hierarchy in the paper's structures
    std::array<scene::Flight, kMostCameras> flights;
    // The mesh at its finest in the colours of `baked export --colour group, class, id`, baked again; where they are there.
    std::optional<World> groups, classes, ids;

    const caveclod::Mesh& mesh() const { return *world.mesh->mesh; }
    uint32_t frame_count() const { return scene::frame_count(flights[0]); }
    double step_s() const { return flights[0].step_s; }
};

// Reads FOLDER/scene.json, flight-a.json to flight-d.json and, where they are there, groups.ovl, classes.ovl and ids.ovl. Fails
// as read_world and scene::read_flight; and with Exit::impossible:
//   "lakes/scene.json: holds a terrain; reproduce caveclod flies meshes"
//   "lakes/flight-b.json: has steps of 0.1 s, flight-a.json of 0.03125 s; all cameras fly at one step"
Result<Subject> read_subject(const std::string& folder);

// Puts everything of it on the graphics card. Fails as measure::upload.
Result<void> upload(Subject& subject);

// Camera A (0) to D (3) where its flight is at that time, its picture of that size, in the mesh's own frame.
view::Camera camera_at(const Subject& subject, uint32_t camera, double time_s, const view::Part& place);
// All of `count` cameras in their places on the screen.
std::vector<view::Camera> cameras_at(const Subject& subject, uint32_t count, double time_s, uint32_t width_px,
                                     uint32_t height_px);

}  // namespace overlook::measure::paper::cameras
