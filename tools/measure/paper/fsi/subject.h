// A scene of section 4 with what belongs to it: what make-sample made of it, baked.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/scene.h"
#include "runtime/view/camera.h"
#include "tools/measure/world.h"

namespace overlook::measure::paper::fsi {

struct Subject {
    std::string name;  // of its folder: "trees"
    World world;       // of scene.json: levels cut by Overlook, but of SIMPLE
    // The same of levels made by hand, and of levels with a visibility that was optimised; where they are there.
    std::optional<World> by_hand, optimised;
    scene::Flight flight;
};

// What stands about: the first chain that has several levels. The world must hold one.
const ChainWorld& things_of(const World& world);

// "TREES".
std::string title_of(const std::string& name);

// Reads FOLDER/scene.json, flight.json and, where they are there, scene-by-hand.json and scene-optimised.json. Fails as
// read_world and scene::read_flight; and with Exit::impossible:
//   "trees/scene.json: holds no chain of several levels; reproduce fsi flies over what make-sample trees, windmills or simple
//   made"
Result<Subject> read_subject(const std::string& folder);

// Puts everything of it on the graphics card. Fails as measure::upload.
Result<void> upload(Subject& subject);

// Frames of the flight from its middle on, one step apart: `count` of them, the flight's end where it is shorter.
std::vector<view::Camera> cameras_of(const Subject& subject, uint32_t count, uint32_t width_px, uint32_t height_px);

}  // namespace overlook::measure::paper::fsi
