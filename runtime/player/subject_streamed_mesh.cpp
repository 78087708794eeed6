// A mesh of which a part is in memory, in the player.

#include <cassert>

#include "runtime/caveclod/mesh_stream.h"
#include "runtime/gl/timer.h"
#include "runtime/player/mesh_room.h"

namespace overlook::player {
namespace {

class StreamedMeshSubject : public MeshRoom {
  public:
    StreamedMeshSubject(std::unique_ptr<caveclod::MeshStream> stream, const LayerMethod& layer, const Streaming& streaming)
        : stream_(std::move(stream)), layer_(layer), streaming_(streaming) {}

    Result<void> upload(const gl::SecondContextMaker&) override {
        // Where pictures wait, all that memory has room for comes before the first: none of them lacks anything that another has.
        do {
            std::span<const Error> faults = stream_->begin_frame();
            if (streaming_.waits && !faults.empty()) return tl::unexpected(faults.front());
            stream_->end_frame();
        } while (streaming_.waits && !stream_->is_settled());
        Result<caveclod::Drawing> drawing = caveclod::Drawing::make(mesh());
        if (!drawing) return tl::unexpected(drawing.error());
        drawing_.emplace(std::move(*drawing));
        return {};
    }

    bool has_one_method() const override { return true; }

    Result<FrameRecord> draw(const gl::Target& target, const view::Camera& camera, const FrameStyle& style) override {
        assert(drawing_.has_value() && style.method == Method::caveclod);
        FrameRecord record;
        record.asked_error_px = style.error_px;
        StreamRecord& stream = record.stream.emplace();
        gl::Timer refining;
        std::span<const Error> faults = stream_->begin_frame();
        stream.faults.assign(faults.begin(), faults.end());
        Result<uint64_t> taken = drawing_->take_vertices(mesh());
        if (!taken) return tl::unexpected(taken.error());
        caveclod::FrameOptions options = with_error(layer_.mesh, style.error_px);
        if (style.most_triangles > 0) options.settings.most_triangles = style.most_triangles;
        if (!frames_)
            frames_ = std::make_unique<caveclod::FrameDrawer>(caveclod::Hierarchy(), mesh(), *drawing_, options);
        else
            frames_->change(options.settings);
        frames_->decide(camera, style.dt_s);
        frames_->take_note(*stream_, 0);
        stream_->end_frame();
        record.refine_ms = refining.elapsed_ms();

        gl::Timer drawing;
        caveclod::FrameCounts counts = frames_->draw(target, look_of(style, layer_));
        record.draw_ms = drawing.finished_ms();
        record.uploaded_bytes = *taken;
        take_counts(counts, record);
        stream.counts = stream_->counts();
        stream.budget_bytes = streaming_.settings.residency_budget_bytes;
        stream.block_count = stream_->block_count(0), stream.resident_block_count = stream_->resident_block_count(0);
        return record;
    }

  private:
    const caveclod::Mesh& mesh() const override { return stream_->mesh(0); }

    std::unique_ptr<caveclod::MeshStream> stream_;
    LayerMethod layer_;
    Streaming streaming_;
    std::optional<caveclod::Drawing> drawing_;
    std::unique_ptr<caveclod::FrameDrawer> frames_;
};

}  // namespace

Result<std::unique_ptr<Subject>> read_streamed_mesh(container::Reader file, const LayerMethod& layer,
                                                    const Streaming& streaming) {
    std::vector<container::Reader> files;
    files.push_back(std::move(file));
    Result<std::unique_ptr<caveclod::MeshStream>> stream = caveclod::MeshStream::open(std::move(files), streaming.settings);
    if (!stream) return tl::unexpected(stream.error());
    return std::make_unique<StreamedMeshSubject>(std::move(*stream), layer, streaming);
}

}  // namespace overlook::player
