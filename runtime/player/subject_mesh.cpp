// A mesh in the player: refined by any of CAVECLOD's variants, by levels for the whole of it, or by LOD-sprite on it.

#include <cassert>

#include "formats/caveclod.h"
#include "runtime/caveclod/static_levels.h"
#include "runtime/gl/timer.h"
#include "runtime/lod_sprite/draw_on_mesh.h"
#include "runtime/player/draw_sprite.h"
#include "runtime/player/mesh_room.h"

namespace overlook::player {
namespace {

class MeshSubject : public MeshRoom {
  public:
    MeshSubject(caveclod::Hierarchy hierarchy, caveclod::Mesh mesh, const LayerMethod& layer)
        : hierarchy_(std::move(hierarchy)), mesh_(std::move(mesh)), layer_(layer) {}

    Result<void> upload(const gl::SecondContextMaker& second) override {
        second_context_ = second;
        Result<caveclod::Drawing> drawing = caveclod::Drawing::make(mesh_);
        if (!drawing) return tl::unexpected(drawing.error());
        drawing_.emplace(std::move(*drawing));
        return {};
    }

    Result<FrameRecord> draw(const gl::Target& target, const view::Camera& camera, const FrameStyle& style) override {
        assert(drawing_.has_value());
        FrameRecord record;
        record.asked_error_px = style.error_px;
        if (style.method == Method::lod_sprite) {
            auto make_thing = [&] { return std::make_unique<lod_sprite::DrawnMesh>(mesh_, *drawing_, caveclod::DrawOptions()); };
            Result<void> drawn = sprite_.draw(target, camera, style, make_thing, second_context_, record);
            if (!drawn) return tl::unexpected(drawn.error());
            return record;
        }
        sprite_.pause();
        if (style.method == Method::discrete) {
            draw_level(target, camera, style, record);
            return record;
        }
        caveclod::FrameOptions options = with_error(layer_.mesh, style.error_px);
        options.variant = variant_of(style.method);
        if (style.most_triangles > 0) options.settings.most_triangles = style.most_triangles;
        if (!frames_ || frames_->options().variant != options.variant)
            frames_ = std::make_unique<caveclod::FrameDrawer>(hierarchy_, mesh_, *drawing_, options);
        else
            frames_->change(options.settings);
        gl::Timer refining;
        frames_->decide(camera, style.dt_s);
        record.refine_ms = refining.elapsed_ms();
        gl::Timer drawing;
        caveclod::FrameCounts counts = frames_->draw(target, look_of(style, layer_));
        record.draw_ms = drawing.finished_ms();
        take_counts(counts, record);
        return record;
    }

  private:
    const caveclod::Mesh& mesh() const override { return mesh_; }

    void draw_level(const gl::Target& target, const view::Camera& camera, const FrameStyle& style, FrameRecord& record) {
        gl::Timer choosing;
        if (!levels_) {
            levels_.emplace(mesh_);
            for (size_t i = 0; i < levels_->size(); ++i) {
                level_buffers_.push_back(std::make_unique<caveclod::CameraBuffers>(mesh_));
                level_buffers_.back()->take((*levels_)[i].by_surface);
                record.uploaded_bytes += level_buffers_.back()->uploaded_bytes();
            }
        }
        size_t level = levels_->chosen(camera, style.error_px);
        record.refine_ms = choosing.elapsed_ms();
        gl::Timer drawing;
        drawing_->draw(target, *level_buffers_[level], camera, look_of(style, layer_));
        record.draw_ms = drawing.finished_ms();
        record.triangle_count = level_buffers_[level]->triangle_count();
        record.tested_count = levels_->size();
        record.predicted_error_px = levels_->error_px(level, camera);
    }

    const caveclod::Hierarchy hierarchy_;  // for the paper's variant
    const caveclod::Mesh mesh_;
    LayerMethod layer_;
    std::optional<caveclod::Drawing> drawing_;
    std::unique_ptr<caveclod::FrameDrawer> frames_;  // of the method of the frame before
    std::optional<caveclod::StaticLevels> levels_;   // once they were drawn with
    std::vector<std::unique_ptr<caveclod::CameraBuffers>> level_buffers_;
    gl::SecondContextMaker second_context_;
    SpriteDrawing sprite_{layer_.sprite};
};

}  // namespace

Result<std::unique_ptr<Subject>> read_mesh(const container::Reader& file, const LayerMethod& layer) {
    Result<caveclod::Hierarchy> hierarchy = caveclod::read(file);
    if (!hierarchy) return tl::unexpected(hierarchy.error());
    Result<caveclod::Mesh> mesh = caveclod::Mesh::make(*hierarchy);
    if (!mesh) return tl::unexpected(mesh.error());
    return std::make_unique<MeshSubject>(std::move(*hierarchy), std::move(*mesh), layer);
}

}  // namespace overlook::player
