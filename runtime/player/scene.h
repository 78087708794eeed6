// A terrain ready to be flown over: deciding and drawing put together. Must go before the context that it was uploaded to.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "runtime/gl/target.h"
#include "runtime/player/options.h"
#include "runtime/terrain/draw.h"
#include "runtime/terrain/refine.h"

namespace overlook::player {

// What one frame was and what it cost.
struct FrameRecord {
    uint64_t triangle_count = 0;
    uint64_t void_rim_triangle_count = 0;
    uint64_t tested_count = 0;
    uint64_t uploaded_bytes = 0;
    double refine_ms = 0;
    double draw_ms = 0;  // submitting and waiting until it is drawn
    double predicted_error_px = 0;
};

class Scene {
  public:
    // Reads the file. Fails with Exit::bad_input. Needs no OpenGL.
    static Result<Scene> read(const std::string& path);
    // Puts it on the graphics card. Needs a current context; must be called once before draw().
    Result<void> upload();

    const terrain::Terrain& terrain() const { return *terrain_; }
    const terrain::Refiner& refiner() const { return *refiner_; }

    FrameRecord draw(const gl::Target& target, const view::Camera& camera, double error_px, double morph,
                     const terrain::DrawOptions& options);

  private:
    std::unique_ptr<terrain::Terrain> terrain_;
    std::optional<terrain::Refiner> refiner_;
    std::optional<terrain::Drawing> drawing_;
    terrain::Cut cut_;
};

// The camera of each frame that was asked for: the keys, or an overview of the terrain.
std::vector<view::Camera> keys_of(const Plan& plan, const Scene& scene);

// So near that nothing above the ground is cut off, whatever the size of the cells.
double near_m(const terrain::Terrain& terrain);

}  // namespace overlook::player
