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
    World world;       // the chain that scene.json names: Overlook's own, but of SIMPLE
    // The same instances of levels made by hand, and of levels with a visibility that was optimised; where they are there.
    std::optional<World> by_hand, optimised;
    scene::Flight flight;

    // The paper's levels: made by hand where there are any.
    World& printed() { return by_hand ? *by_hand : world; }
};

// "TREES".
std::string title_of(const std::string& name);

// Reads FOLDER/scene.json, flight.json and, of the asset NAME.ovl that stands about, NAME-by-hand.ovl and NAME-optimised.ovl
// where they are there. Fails as scene::read_scene, scene::read_flight and discrete::read; and with Exit::impossible:
//   "trees/scene.json: nothing in it has instances; reproduce fsi flies over what make-sample trees, windmills or simple made"
Result<Subject> read_subject(const std::string& folder);

// Puts everything of it on the graphics card. Fails as measure::upload.
Result<void> upload(Subject& subject);

// Frames of the flight from its middle on, one step apart: `count` of them, the flight's end where it is shorter.
std::vector<view::Camera> cameras_of(const Subject& subject, uint32_t count, uint32_t width_px, uint32_t height_px);

}  // namespace overlook::measure::paper::fsi
