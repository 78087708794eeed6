// What is flown over: a terrain, a mesh, instances of chains of levels, or planted ground.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "formats/container.h"
#include "runtime/gl/context.h"
#include "runtime/gl/target.h"
#include "runtime/player/controls.h"
#include "runtime/player/frame.h"
#include "runtime/stream/stream.h"

namespace overlook::player {

// Deciding and drawing put together. Places and cameras are in its own frame. Must go before the context it was uploaded to.
class Subject : public Ground {
  public:
    // Puts it on the graphics card. Needs a current context; must be called once before draw(). second: how a context beside it
    // is made, for keys that are drawn by a thread.
    virtual Result<void> upload(const gl::SecondContextMaker& second) = 0;

    // A view over the whole of it.
    virtual view::Camera overview(uint32_t width_px, uint32_t height_px) const = 0;
    virtual double near_m() const = 0;
    virtual Thing thing() const = 0;
    virtual bool has_one_method() const { return false; }

    // A method that was not drawn with in the frame before begins anew. Fails as lod_sprite::FrameDrawer.
    virtual Result<FrameRecord> draw(const gl::Target& target, const view::Camera& camera, const FrameStyle& style) = 0;
};

// layer: its settings. Fail as terrain::read and caveclod::read, and with Exit::impossible as caveclod::Mesh::make.
Result<std::unique_ptr<Subject>> read_terrain(const container::Reader& file, const LayerMethod& layer);
Result<std::unique_ptr<Subject>> read_mesh(const container::Reader& file, const LayerMethod& layer);

// A chain of levels in its file, and where it stands and goes in the scene: as a layer's instances and transform say.
struct ChainLayer {
    container::Reader file;
    std::vector<scene::Instance> instances;
    scene::Transform whole;
};
// All in one picture. options: how they change their levels. Fails as discrete::read.
Result<std::unique_ptr<Subject>> read_chains(std::span<const ChainLayer> layers, const discrete::FrameOptions& options);

// How something is read in parts.
struct Streaming {
    stream::Settings settings;
    // Every picture waits for what memory has room for, and a block that cannot be read ends the drawing with its error; needs
    // latency_frames.
    bool waits = false;
};
// A terrain in parts, drawn by its triangles, and a mesh in parts, by caveclod. Fail as terrain::Tiles::open and
// caveclod::MeshStream::open.
Result<std::unique_ptr<Subject>> read_streamed_terrain(container::Reader file, const Streaming& streaming);
Result<std::unique_ptr<Subject>> read_streamed_mesh(container::Reader file, const LayerMethod& layer, const Streaming& streaming);

// What is planted where, and what it stands on.
struct PlantingLayer {
    container::Reader file;
    std::optional<container::Reader> ground;  // a terrain; none: a plain
    scene::Planting planting;
    std::string scene_path;  // of the scene that says so
};
// Its images are streamed. Fails as terrain::read and wang_ldi::PlantedLand::read.
Result<std::unique_ptr<Subject>> read_planting(PlantingLayer planting, const LayerMethod& layer, const Streaming& streaming);

}  // namespace overlook::player
