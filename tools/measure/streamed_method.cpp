#include "tools/measure/streamed_method.h"

#include <utility>
#include <vector>

#include "formats/container.h"
#include "runtime/caveclod/mesh_stream.h"
#include "runtime/terrain/refine_tiles.h"
#include "tools/measure/honesty/terrain_honesty.h"
#include "tools/measure/mesh_method.h"
#include "tools/measure/still.h"
#include "tools/measure/terrain_method.h"

namespace overlook::measure {
namespace {

stream::Settings streaming_of(const MethodSpec& spec) {
    stream::Settings settings;
    settings.residency_budget_bytes = uint64_t(setting(spec, "memory-mib") * double(1 << 20));
    settings.latency_frames = uint32_t(setting(spec, "latency"));
    return settings;
}

Result<std::unique_ptr<caveclod::MeshStream>> open_mesh(const MethodSpec& spec, const World& world) {
    std::vector<container::Reader> files;
    Result<container::Reader> file = container::Reader::open(world.asset_path);
    if (!file) return tl::unexpected(file.error());
    files.push_back(std::move(*file));
    return caveclod::MeshStream::open(std::move(files), streaming_of(spec));
}

Result<std::unique_ptr<terrain::Tiles>> open_terrain(const MethodSpec& spec, const World& world) {
    Result<container::Reader> file = container::Reader::open(world.asset_path);
    if (!file) return tl::unexpected(file.error());
    return terrain::Tiles::open(std::move(*file), streaming_of(spec));
}

class StreamedMesh : public Method {
  public:
    StreamedMesh(World& world, const MethodSpec& spec)
        : world_(world),
          stream_(still(open_mesh(spec, world))),
          drawing_(still(caveclod::Drawing::make(stream_->mesh(0)))),
          frames_(whole_, stream_->mesh(0), drawing_, refining_of(spec)) {}

    void decide(const view::Camera& camera, uint32_t frame) override {
        camera_ = camera;
        std::span<const Error> faults = stream_->begin_frame();
        still(faults);
        taken_bytes_ = still(drawing_.take_vertices(stream_->mesh(0)));
        frames_.decide(camera, double(frame - last_frame_) * world_.step_s);
        frames_.take_note(*stream_, 0);
        stream_->end_frame();
        last_frame_ = frame;
    }

    Counters draw(const gl::Target& target) override {
        const caveclod::Mesh& mesh = stream_->mesh(0);
        uint64_t resident_bytes = mesh.vertices().size_bytes() + mesh.colours().size_bytes();
        Counters counters = counters_of(frames_.draw(target, world_.mesh->look), resident_bytes);
        counters.uploaded_bytes += std::exchange(taken_bytes_, 0);
        counters.streamed_bytes = stream_->counts().resident_bytes;
        return counters;
    }

    bool set_triangles(double triangles) override {
        caveclod::Settings settings = frames_.options().settings;
        settings.most_triangles = uint64_t(triangles);
        frames_.change(settings);
        return true;
    }

    std::optional<Promises> promises() override {
        return world_.mesh->honesty().promises_of(frames_.drawn_corners_m(), camera_, frames_.counts().error_px);
    }

  private:
    World& world_;
    const caveclod::Hierarchy whole_;  // none: of the paper's variant alone
    std::unique_ptr<caveclod::MeshStream> stream_;
    caveclod::Drawing drawing_;
    caveclod::FrameDrawer frames_;
    uint64_t taken_bytes_ = 0;  // vertices of blocks, since the last draw()
    view::Camera camera_;
    uint32_t last_frame_ = 0;
};

class StreamedTerrain : public Method {
  public:
    StreamedTerrain(World& world, const MethodSpec& spec)
        : world_(world),
          tiles_(still(open_terrain(spec, world))),
          refiner_(*tiles_),
          drawing_(still(terrain::Drawing::make(*tiles_))),
          error_px_(setting(spec, "error-px")),
          morph_(setting(spec, "morph")) {}

    void decide(const view::Camera& camera, uint32_t) override {
        camera_ = camera;
        const stream::Stream::Changes& changes = tiles_->begin_frame();
        still(changes.faults);
        for (uint32_t tile : changes.arrived) drawing_.take_tile(*tiles_, tile);
        refiner_.cut_by_pixels(camera, error_px_, cut_, morph_);
        tiles_->end_frame();
    }

    Counters draw(const gl::Target& target) override {
        uint64_t resident_bytes = uint64_t(4) * tiles_->slot_count() * terrain::kTileSamples;
        Counters counters = draw_cut(drawing_, resident_bytes, target, cut_, camera_, world_.look);
        counters.streamed_bytes = tiles_->counts().resident_bytes;
        return counters;
    }

    // The same cut again, with what it is worth, of the terrain as a whole.
    std::optional<Promises> promises() override {
        terrain::Cut cut;
        cut.wants_codes = true;
        refiner_.cut_by_pixels(camera_, error_px_, cut, morph_);
        find_samples();
        uint32_t morphs_begin = tiles_->slot_count() * terrain::kTileSamples;
        for (terrain::Cut::Morph& morph : cut.morphs) morph.sample = samples_[morph.sample];
        for (uint32_t& index : cut.indices) {
            index = index < morphs_begin ? samples_[index] : index - morphs_begin + uint32_t(world_.terrain->heights.size());
        }
        return promises_of(*world_.terrain, cut, camera_, error_px_);
    }

  private:
    // Of each place in a slot, which sample stands there.
    void find_samples() {
        const terrain::Shape& shape = tiles_->head().shape;
        samples_.assign(size_t(tiles_->slot_count()) * terrain::kTileSamples, 0);
        for (uint32_t tile = 0; tile < tiles_->grid().count(); ++tile) {
            const terrain::Tiles::View& view = tiles_->view(tile);
            if (view.heights == nullptr) continue;
            auto from = tiles_->grid().origin(tile);
            uint32_t level = tiles_->grid().block(tile).level;
            for (uint32_t i = 0; i < terrain::kTileSamples; ++i) {
                uint64_t x = from.x + (uint64_t(i % terrain::kTileSide) << level),
                         y = from.y + (uint64_t(i / terrain::kTileSide) << level);
                if (x >= shape.width || y >= shape.height) continue;
                samples_[size_t(view.slot) * terrain::kTileSamples + i] = uint32_t(y * shape.width + x);
            }
        }
    }

    World& world_;
    std::unique_ptr<terrain::Tiles> tiles_;
    terrain::TileRefiner refiner_;
    terrain::Drawing drawing_;
    double error_px_, morph_;
    std::vector<uint32_t> samples_;  // scratch of promises()
    view::Camera camera_;
    terrain::Cut cut_;
};

}  // namespace

bool is_streamed(const MethodSpec& spec) {
    return spec.variant == "streamed";
}

Result<void> check_streams(const MethodSpec& spec, const World& world) {
    if (world.is_mesh()) return open_mesh(spec, world).map([](const auto&) {});
    return open_terrain(spec, world).map([](const auto&) {});
}

std::unique_ptr<Method> make_streamed_method(World& world, const MethodSpec& spec) {
    if (world.is_mesh()) return std::make_unique<StreamedMesh>(world, spec);
    return std::make_unique<StreamedTerrain>(world, spec);
}

}  // namespace overlook::measure
