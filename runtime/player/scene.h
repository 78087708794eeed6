// A scene ready to be flown over: deciding and drawing put together. Must go before the context that it was uploaded to.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "runtime/gl/target.h"
#include "runtime/player/frame.h"
#include "runtime/player/method.h"
#include "runtime/player/options.h"
#include "runtime/player/subject.h"
#include "runtime/view/error_budget.h"

namespace overlook::player {

// When the last key took over, and why.
struct KeyWatch {
    lod_sprite::Cause cause = lod_sprite::Cause::none;  // none: there was no key yet
    uint32_t frames_ago = 0;
};
// A frame was drawn. One that LOD-sprite did not draw ends the watch.
void watch(KeyWatch& keys, const FrameRecord& frame);

// What --triangles or --frame-ms leave, and what a frame takes of it; least_error_px is asked where they leave enough. None where
// the method keeps them by itself.
view::ErrorBudget budget_of(const Options& options, Method method, Thing thing, double least_error_px);
double cost_of(const Options& options, const FrameRecord& frame);

class Scene {
  public:
    // Reads a baked terrain, mesh, chain of levels or planting (on a plain), or (a name that ends in .json) a scene with one,
    // with several chains, or with a planting on a terrain. streaming: it is read in parts; a terrain is then drawn by its
    // triangles, a mesh by caveclod, of a planting the images. A planting's always are: without it, within 1 GiB. waits: then
    // every picture waits for them. Needs no OpenGL. Fails as scene::read_scene, layer_method_of, read_terrain, read_mesh,
    // read_chains, the two that stream and read_planting, with Exit::impossible:
    //   "a.json: /layers/1: hills.ovl is a terrain; of scenes of several layers the player draws chains of levels alone"
    //   "a.json: /layers/1: asks for another method or settings than /layers/0; chains in one picture are drawn alike"
    //   "tree.ovl: a chain of levels is read whole; --stream-memory is of terrains, meshes and plantings"
    //   "a.json: /layers/2: meadow.ovl is a planting; the player draws one, on one terrain or a plain"
    // and with Exit::bad_input:
    //   "a.json: /layers/0/method: caveclod draws meshes, and valley.ovl is a terrain"
    //   "a.json: /layers/0/settings: duck.ovl is a mesh, of which discrete takes error_px alone"
    //   "a.json: /layers/0/instances: duck.ovl is a mesh; chains of levels have instances"
    //   "a.json: /layers/0/method: lod-sprite; the ground of a planting is drawn by terrain"
    //   "a.json: /layers/1/transform: a planting stands where its ground is; move the terrain"
    //   "a.ovl: a file of kind ABCD cannot be drawn; a baked terrain, mesh, chain of levels or planting is wanted"
    static Result<Scene> read(const std::string& path, const std::optional<Streaming>& streaming = std::nullopt,
                              bool waits = true);
    // Puts it on the graphics card. Needs a current context; must be called once before draw(). second: how a context beside it
    // is made, for keys that are drawn by a thread.
    Result<void> upload(const gl::SecondContextMaker& second = gl::second_context) { return subject_->upload(second); }

    const Subject& subject() const { return *subject_; }
    // What the file says, or the defaults of a baked file by itself; the first layer's error_px setting is error_px.
    const scene::Scene& described() const { return described_; }
    // From the subject's frame into the scene's; none of chains, which stand where their placements say.
    const scene::Transform& transform() const { return transform_; }

    // The method that the file asks for; if it does not say, terrain, caveclod or discrete.
    Method method() const { return layer_.method; }

    // camera: in the scene's frame. Fails as Subject::draw.
    Result<FrameRecord> draw(const gl::Target& target, const view::Camera& camera, const FrameStyle& style);

  private:
    // Of a layer that plants, and its ground.
    Result<void> read_planted(const std::string& path, std::span<const std::string> assets, size_t place,
                              const Streaming& streaming);

    scene::Scene described_;
    scene::Transform transform_;
    LayerMethod layer_;
    std::unique_ptr<Subject> subject_;
};

// Settles what the plan leaves to the scene: method, error and haze that the command line does not set, near plane and field of
// view, an overview of the terrain if there are no keys, how many frames a flight has and the step of one between --camera's.
void settle(Plan& plan, const Scene& scene);

}  // namespace overlook::player
