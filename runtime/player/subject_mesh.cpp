// A mesh in the player: refined by any of CAVECLOD's variants, by levels for the whole of it, or by LOD-sprite on it.

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "formats/caveclod.h"
#include "runtime/caveclod/draw_frames.h"
#include "runtime/caveclod/static_levels.h"
#include "runtime/caveclod/near_plane.h"
#include "runtime/gl/timer.h"
#include "runtime/lod_sprite/draw_on_mesh.h"
#include "runtime/player/draw_sprite.h"
#include "runtime/player/subject.h"

namespace overlook::player {
namespace {

constexpr double kOverviewFov_deg = 42, kOverviewHeading_deg = -30, kOverviewPitch_deg = -20, kOverviewMargin = 1.1;
constexpr double kNearShare = 1e-6;        // of the mesh's size; depths are reversed floats, so this costs no precision
constexpr double kLeastSpeedShare = 0.05;  // of the mesh's size in a second

class MeshSubject : public Subject {
  public:
    MeshSubject(caveclod::Hierarchy hierarchy, caveclod::Mesh mesh, const LayerMethod& layer)
        : hierarchy_(std::move(hierarchy)), mesh_(std::move(mesh)), layer_(layer) {
        middle_m_ = (mesh_.lowest_m() + mesh_.highest_m()) / 2.0;
        radius_m_ = std::max(glm::distance(mesh_.lowest_m(), mesh_.highest_m()) / 2, 1e-6);
    }

    Result<void> upload(const gl::SecondContextMaker& second) override {
        second_context_ = second;
        Result<caveclod::Drawing> drawing = caveclod::Drawing::make(mesh_);
        if (!drawing) return tl::unexpected(drawing.error());
        drawing_.emplace(std::move(*drawing));
        return {};
    }

    view::Camera overview(uint32_t width_px, uint32_t height_px) const override {
        view::Camera camera;
        camera.width_px = width_px, camera.height_px = height_px;
        camera.fov_y_deg = kOverviewFov_deg, camera.heading_deg = kOverviewHeading_deg, camera.pitch_deg = kOverviewPitch_deg;
        // As near as all corners of the box allow.
        view::Axes axes = view::axes_of(camera);
        double tangent_y = std::tan(camera.fov_y_deg * std::numbers::pi / 360), tangent_x = tangent_y * width_px / height_px;
        double away_m = 0;
        for (int corner = 0; corner < 8; ++corner) {
            glm::dvec3 at_m((corner & 1) != 0 ? mesh_.highest_m().x : mesh_.lowest_m().x,
                            (corner & 2) != 0 ? mesh_.highest_m().y : mesh_.lowest_m().y,
                            (corner & 4) != 0 ? mesh_.highest_m().z : mesh_.lowest_m().z);
            at_m -= middle_m_;
            double side_m =
                std::max(std::abs(glm::dot(at_m, axes.right)) / tangent_x, std::abs(glm::dot(at_m, axes.up)) / tangent_y);
            away_m = std::max(away_m, kOverviewMargin * side_m - glm::dot(at_m, axes.forward));
        }
        camera.position_m = middle_m_ - axes.forward * (away_m + kNearShare * radius_m_);
        return camera;
    }
    Thing thing() const override { return Thing::mesh; }
    double near_m() const override { return std::min(0.5, kNearShare * radius_m_); }

    // Meshes are flown through and round; nothing of them is ground.
    std::optional<double> height_m(double, double) const override { return std::nullopt; }
    double distance_m(const glm::dvec3& place_m) const override {
        return glm::distance(place_m, glm::clamp(place_m, mesh_.lowest_m(), mesh_.highest_m()));
    }
    double step_m() const override { return radius_m_ / 16; }
    double least_speed_m_s() const override { return kLeastSpeedShare * radius_m_; }

    Result<FrameRecord> draw(const gl::Target& target, const view::Camera& camera, const FrameStyle& style) override {
        assert(drawing_.has_value());
        FrameRecord record;
        record.asked_error_px = style.error_px;
        bool goes_on = style.method == last_method_ && style.error_px == last_error_px_;
        if (!goes_on && style.method == Method::lod_sprite && sprite_) sprite_->change(with_error(layer_.sprite, style.error_px));
        last_method_ = style.method;
        last_error_px_ = style.error_px;
        if (style.method == Method::lod_sprite) {
            if (Result<void> ready = ready_sprite(style); !ready) return tl::unexpected(ready.error());
            view::Camera far_plane = caveclod::with_far_near_plane(mesh_, camera);
            if (Result<void> drawn = draw_sprite(*sprite_, target, far_plane, record); !drawn) return tl::unexpected(drawn.error());
            return record;
        }
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
        caveclod::FrameCounts counts = frames_->draw(target, look_of(style));
        record.draw_ms = drawing.finished_ms();
        record.triangle_count = counts.triangle_count;
        record.tested_count = counts.evaluated_count;
        record.uploaded_bytes = counts.uploaded_bytes;
        record.predicted_error_px = counts.error_px;
        record.mesh = counts;
        return record;
    }

  private:
    caveclod::DrawOptions look_of(const FrameStyle& style) const {
        caveclod::DrawOptions look;
        look.is_wireframe = style.look.look == terrain::Look::wireframe;
        look.culls_back_faces = layer_.mesh.settings.culls_back_faces;
        return look;
    }

    // Whoever draws sprites on it, with this error.
    Result<void> ready_sprite(const FrameStyle& style) {
        if (!sprite_) {
            auto thing = std::make_unique<lod_sprite::DrawnMesh>(mesh_, *drawing_, caveclod::DrawOptions());
            auto made = lod_sprite::FrameDrawer::make(std::move(thing), with_error(layer_.sprite, style.error_px), second_context_);
            if (!made) return tl::unexpected(made.error());
            sprite_ = std::move(*made);
        }
        sprite_->show_sources(style.shows_sources || layer_.sprite.draw.shows_sources);
        return {};
    }

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
        drawing_->draw(target, *level_buffers_[level], camera, look_of(style));
        record.draw_ms = drawing.finished_ms();
        record.triangle_count = level_buffers_[level]->triangle_count();
        record.tested_count = levels_->size();
        record.predicted_error_px = levels_->error_px(level, camera);
    }

    const caveclod::Hierarchy hierarchy_;  // for the paper's variant
    const caveclod::Mesh mesh_;
    LayerMethod layer_;
    glm::dvec3 middle_m_{0};
    double radius_m_ = 1;
    std::optional<caveclod::Drawing> drawing_;
    std::unique_ptr<caveclod::FrameDrawer> frames_;  // of the method of the frame before
    std::optional<caveclod::StaticLevels> levels_;   // once they were drawn with
    std::vector<std::unique_ptr<caveclod::CameraBuffers>> level_buffers_;
    gl::SecondContextMaker second_context_;
    std::unique_ptr<lod_sprite::FrameDrawer> sprite_;  // once it was drawn with
    Method last_method_ = Method::caveclod;            // of the frame before
    double last_error_px_ = 0;
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
