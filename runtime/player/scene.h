// A scene ready to be flown over: deciding and drawing put together. Must go before the context that it was uploaded to.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "runtime/gl/target.h"
#include "runtime/player/method.h"
#include "runtime/player/options.h"
#include "runtime/terrain/draw.h"
#include "runtime/terrain/refine.h"
#include "runtime/view/error_budget.h"

namespace overlook::player {

// What one frame was and what it cost.
struct FrameRecord {
    uint64_t triangle_count = 0;
    uint64_t void_rim_triangle_count = 0;
    uint64_t tested_count = 0;
    uint64_t uploaded_bytes = 0;
    double refine_ms = 0;
    double draw_ms = 0;         // submitting and waiting until it is drawn
    double asked_error_px = 0;  // above --error-px where a budget forces it
    double predicted_error_px = 0;
    // Of a frame by LOD-sprite, whose predicted error is the p99 over the pixels.
    std::optional<lod_sprite::FrameCounts> sprite;
};

// How a frame is to be drawn.
struct FrameStyle {
    Method method = Method::terrain;
    double error_px = 1;
    double morph = 0;            // of terrain, as Refiner::cut_by_pixels
    bool shows_sources = false;  // of lod-sprite: what is sprite and what is not
    terrain::DrawOptions look;   // of the shaded picture all but the wireframe, which terrain alone has
};

// When the last key took over, and why.
struct KeyWatch {
    lod_sprite::Cause cause = lod_sprite::Cause::none;  // none: there was no key yet
    uint32_t frames_ago = 0;
};
// A frame was drawn. One that LOD-sprite did not draw ends the watch.
void watch(KeyWatch& keys, const FrameRecord& frame);

// What --triangles or --frame-ms leave, and what a frame takes of it; least_error_px is asked where they leave enough.
view::ErrorBudget budget_of(const Options& options, double least_error_px);
double cost_of(const Options& options, const FrameRecord& frame);

class Scene {
  public:
    // Reads a baked terrain, or (a name that ends in .json) a scene with one. Needs no OpenGL. Fails as
    // scene::read_scene, terrain::read and layer_method_of, and with Exit::impossible:
    //   "a.json: /layers/1: the player draws one terrain at a time; leave one layer"
    static Result<Scene> read(const std::string& path);
    // Puts it on the graphics card. Needs a current context; must be called once before draw(). second: how a context beside it
    // is made, for keys that are drawn by a thread.
    Result<void> upload(const gl::SecondContextMaker& second = gl::second_context);

    const terrain::Terrain& terrain() const { return *terrain_; }
    const terrain::Refiner& refiner() const { return *refiner_; }
    // What the file says, or the defaults of a baked file by itself. One layer; its error_px setting is error_px.
    const scene::Scene& described() const { return described_; }
    const scene::Transform& transform() const { return described_.layers.front().transform; }

    // The method that the file asks for; terrain if it does not say.
    Method method() const { return layer_.method; }

    // camera: in the scene's frame. A method that was not drawn with in the frame before, or has another error, begins without
    // keys. Fails as lod_sprite::FrameDrawer.
    Result<FrameRecord> draw(const gl::Target& target, const view::Camera& camera, const FrameStyle& style);

  private:
    void draw_terrain(const gl::Target& target, const view::Camera& local, const FrameStyle& style, FrameRecord& record);
    Result<void> ready_sprite(const FrameStyle& style);

    scene::Scene described_;
    std::unique_ptr<terrain::Terrain> terrain_;
    std::optional<terrain::Refiner> refiner_;
    std::optional<terrain::Drawing> drawing_;
    gl::SecondContextMaker second_context_;
    terrain::Cut cut_;
    LayerMethod layer_;
    std::unique_ptr<lod_sprite::FrameDrawer> sprite_;        // once it was drawn with
    std::unique_ptr<lod_sprite::paper::FrameDrawer> paper_;  // while it is drawn with
    Method last_method_ = Method::terrain;                   // of the frame before
    double last_error_px_ = 0;
};

// Settles what the plan leaves to the scene: method, error and haze that the command line does not set, near plane and field of
// view, an overview of the terrain if there are no keys, how many frames a flight has and the step of one between --camera's.
void settle(Plan& plan, const Scene& scene);

// So near that nothing above the ground is cut off, whatever the size of the cells.
double near_m(const terrain::Terrain& terrain);

}  // namespace overlook::player
