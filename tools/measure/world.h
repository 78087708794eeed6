// What is flown over, loaded once for all methods of a run.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "formats/scene.h"
#include "runtime/terrain/draw.h"
#include "runtime/terrain/refine.h"

namespace overlook::measure {

// Must go before the context that it was uploaded to.
struct World {
    std::string name;          // of the scene's file, without its folder
    std::string content_hash;  // of the scene and of everything it names
    std::unique_ptr<terrain::Terrain> terrain;
    std::optional<terrain::Refiner> refiner;
    std::optional<terrain::Drawing> drawing;
    terrain::DrawOptions look;    // the same for every method and the reference
    uint64_t resident_bytes = 0;  // on the card without what changes from frame to frame
    scene::Transform transform;   // from the terrain's own frame into the scene's
    view::Camera base;            // what a flight does not say: near plane, field of view
};

// Reads a scene (.json) or a baked terrain by itself (.ovl). Needs no OpenGL. Fails with Exit::bad_input, as scene::read_scene
// and terrain::read; and with Exit::impossible:
//   "a.scene.json: has 2 layers; measure draws scenes of one terrain"
//   "a.scene.json: /layers/0/method: caveclod cannot be measured yet; measure draws scenes of one terrain"
Result<World> read_world(const std::string& path);

// Puts it on the graphics card, once; needs a current context. Fails with Exit::impossible.
Result<void> upload(World& world);

}  // namespace overlook::measure
