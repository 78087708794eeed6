// A scene ready to be flown over: deciding and drawing put together. Must go before the context that it was uploaded to.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "runtime/gl/target.h"
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
};

// What --triangles or --frame-ms leave, and what a frame takes of it; least_error_px is asked where they leave enough.
view::ErrorBudget budget_of(const Options& options, double least_error_px);
double cost_of(const Options& options, const FrameRecord& frame);

class Scene {
  public:
    // Reads a baked terrain, or (a name that ends in .json) a scene with one. Needs no OpenGL. Fails with Exit::bad_input as
    // scene::read_scene and terrain::read, and with
    //   "a.json: /layers/0/method: terrain has no variant paper"
    //   "a.json: /layers/0/settings/eror_px: terrain has no such setting; did you mean error_px?"
    //   "a.json: /layers/0/settings/error_px: a number from 0.001 to 10000 is wanted"
    // with Exit::impossible:
    //   "a.json: /layers/1: the player draws one terrain at a time; leave one layer"
    //   "a.json: /layers/0/method: the player cannot draw lod-sprite yet; it draws terrain"
    static Result<Scene> read(const std::string& path);
    // Puts it on the graphics card. Needs a current context; must be called once before draw().
    Result<void> upload();

    const terrain::Terrain& terrain() const { return *terrain_; }
    const terrain::Refiner& refiner() const { return *refiner_; }
    // What the file says, or the defaults of a baked file by itself. One layer; its error_px setting is error_px.
    const scene::Scene& described() const { return described_; }
    const scene::Transform& transform() const { return described_.layers.front().transform; }

    // camera: in the scene's frame. morph: as Refiner::cut_by_pixels.
    FrameRecord draw(const gl::Target& target, const view::Camera& camera, double error_px, double morph,
                     const terrain::DrawOptions& options);

  private:
    scene::Scene described_;
    std::unique_ptr<terrain::Terrain> terrain_;
    std::optional<terrain::Refiner> refiner_;
    std::optional<terrain::Drawing> drawing_;
    terrain::Cut cut_;
};

// Settles what the plan leaves to the scene: error and haze that the command line does not set, near plane and field of view, an
// overview of the terrain if there are no keys, how many frames a flight has and the step of one between --camera's.
void settle(Plan& plan, const Scene& scene);

// So near that nothing above the ground is cut off, whatever the size of the cells.
double near_m(const terrain::Terrain& terrain);

}  // namespace overlook::player
