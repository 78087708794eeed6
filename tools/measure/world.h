// What is flown over, loaded once for all methods of a run.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/caveclod.h"
#include "formats/scene.h"
#include "runtime/caveclod/draw.h"
#include "runtime/caveclod/mesh.h"
#include "runtime/discrete/draw.h"
#include "runtime/discrete/select.h"
#include "runtime/terrain/draw.h"
#include "runtime/terrain/refine.h"
#include "runtime/wang_ldi/draw_land.h"
#include "tools/measure/honesty/mesh_honesty.h"

namespace overlook::measure {

struct MeshWorld {
    std::unique_ptr<caveclod::Hierarchy> hierarchy;
    std::unique_ptr<caveclod::Mesh> mesh;
    std::optional<caveclod::Drawing> drawing;
    caveclod::DrawOptions look;

    // What its promises are judged by; made when it is first asked for.
    const MeshHonesty& honesty();

  private:
    std::unique_ptr<MeshHonesty> honesty_;
};

// A chain of levels and where it stands in the scene.
struct ChainWorld {
    std::unique_ptr<discrete::Chain> chain;
    std::optional<discrete::Drawing> drawing;
    std::vector<scene::Instance> instances;       // none: once, as `whole` says
    scene::Transform whole;                       // moves all of them
    std::vector<discrete::Placement> placements;  // at least one: at World::time_s
    discrete::ChainFacts facts;

    bool moves() const;
};

// Holds a terrain, a mesh, chains of levels or planted ground. Must go before the context that it was uploaded to.
struct World {
    std::string name;          // of the scene's file, without its folder
    std::string content_hash;  // of the scene and of everything it names
    std::string asset_path;    // the baked file, for what is streamed of it
    std::unique_ptr<terrain::Terrain> terrain;
    std::optional<terrain::Refiner> refiner;
    std::optional<terrain::Drawing> drawing;
    terrain::DrawOptions look;                       // the same for every method and the reference
    std::optional<MeshWorld> mesh;                   // then there is no terrain
    std::vector<ChainWorld> chains;                  // if there are any there is neither
    std::unique_ptr<wang_ldi::PlantedLand> planted;  // then there is none of them; its models were read
    uint64_t resident_bytes = 0;                     // on the card without what changes from frame to frame
    scene::Transform transform;  // from the thing's own frame into the scene's; of chains, whose placements hold it, none
    view::Camera base;           // what a flight does not say: near plane, field of view
    double step_s = 1.0 / 60;    // of the logical clock, from frame to frame
    double time_s = 0;           // of that clock, of the frame that is drawn: set by go_to()

    bool is_mesh() const { return mesh.has_value(); }
    bool is_chain() const { return !chains.empty(); }
    bool is_planted() const { return planted != nullptr; }
    std::string_view thing() const {
        return is_planted() ? "planting" : is_chain() ? "chain of levels" : is_mesh() ? "mesh" : "terrain";
    }
    // The clock, and with it all that moves by itself.
    void go_to(double time_s);
    // A camera of the scene in the thing's own frame, its near plane where it cuts nothing off.
    view::Camera local(const view::Camera& camera) const;
};

// A chain that stands where instances say, or once if there are none; and all of it moved by `whole`.
ChainWorld chain_world(discrete::Chain chain, std::span<const scene::Instance> instances, const scene::Transform& whole = {});

// Reads a scene (.json) of one terrain, one mesh, any number of chains or one planting on a terrain or a plain, or a baked file
// of one of the first three by itself (.ovl). Needs no OpenGL. Fails with Exit::bad_input, as scene::read_scene, terrain::read,
// caveclod::read, discrete::read, wang_ldi::PlantedLand::read and read_models, and
//   "a.scene.json: /layers/0/instances: duck.ovl is no chain of levels"
// and with Exit::impossible:
//   "a.scene.json: /layers/1: duck.ovl is a second planting, or no terrain; measure draws one planting on one terrain"
//   "a.scene.json: /layers/1: duck.ovl is no chain of levels, and there are 2 layers; measure draws scenes of one terrain, one
//   mesh or chains of levels"
//   "a.ovl: a file of kind WLDI cannot be measured; measure draws scenes of one terrain, one mesh or chains of levels"
Result<World> read_world(const std::string& path);

// Puts it on the graphics card, once; needs a current context. Fails with Exit::impossible.
// shading_rounds: of chains, as discrete::Drawing::make.
Result<void> upload(World& world, uint32_t shading_rounds = 0);

}  // namespace overlook::measure
