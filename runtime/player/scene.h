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
// the method keeps the triangles by itself.
view::ErrorBudget budget_of(const Options& options, Method method, double least_error_px);
double cost_of(const Options& options, const FrameRecord& frame);

class Scene {
  public:
    // Reads a baked terrain, mesh or chain of levels, or (a name that ends in .json) a scene with one. streaming: it is read in
    // parts; a terrain is then drawn by its triangles, a mesh by caveclod. Needs no OpenGL. Fails as scene::read_scene,
    // layer_method_of, read_terrain, read_mesh and the two that stream, with Exit::impossible:
    //   "a.json: /layers/1: the player draws one thing at a time; leave one layer"
    // and with Exit::bad_input:
    //   "a.json: /layers/0/method: caveclod draws meshes, and valley.ovl is a terrain"
    //   "a.json: /layers/0/settings: duck.ovl is a mesh, of which discrete takes error_px alone"
    //   "a.json: /layers/0/instances: duck.ovl is a mesh; chains of levels have instances"
    //   "a.ovl: a file of kind WLDI cannot be drawn; a baked terrain, mesh or chain of levels is wanted"
    static Result<Scene> read(const std::string& path, const std::optional<Streaming>& streaming = std::nullopt);
    // Puts it on the graphics card. Needs a current context; must be called once before draw(). second: how a context beside it
    // is made, for keys that are drawn by a thread.
    Result<void> upload(const gl::SecondContextMaker& second = gl::second_context) { return subject_->upload(second); }

    const Subject& subject() const { return *subject_; }
    // What the file says, or the defaults of a baked file by itself. One layer; its error_px setting is error_px.
    const scene::Scene& described() const { return described_; }
    const scene::Transform& transform() const { return described_.layers.front().transform; }

    // The method that the file asks for; if it does not say, terrain, caveclod or discrete.
    Method method() const { return layer_.method; }

    // camera: in the scene's frame. Fails as Subject::draw.
    Result<FrameRecord> draw(const gl::Target& target, const view::Camera& camera, const FrameStyle& style);

  private:
    scene::Scene described_;
    LayerMethod layer_;
    std::unique_ptr<Subject> subject_;
};

// Settles what the plan leaves to the scene: method, error and haze that the command line does not set, near plane and field of
// view, an overview of the terrain if there are no keys, how many frames a flight has and the step of one between --camera's.
void settle(Plan& plan, const Scene& scene);

}  // namespace overlook::player
