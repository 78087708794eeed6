// Planted ground in the player: the terrain by its triangles, what is planted by layered depth images.

#include <cmath>

#include "runtime/gl/timer.h"
#include "runtime/player/subject.h"
#include "runtime/wang_ldi/draw_land.h"

namespace overlook::player {
namespace {

class PlantingSubject : public Subject {
  public:
    PlantingSubject(std::unique_ptr<wang_ldi::PlantedLand> land, const LayerMethod& layer,
                    const wang_ldi::ImageStreaming& streaming)
        : land_(std::move(land)), options_(layer.planting), streaming_(streaming) {}

    Result<void> upload(const gl::SecondContextMaker&) override { return land_->upload(); }

    view::Camera overview(uint32_t width_px, uint32_t height_px) const override { return land_->overview(width_px, height_px); }
    double near_m() const override { return wang_ldi::kPlantedNear_m; }
    Thing thing() const override { return Thing::planting; }

    // So that an eye as low as it may be is as high as images were sampled for.
    std::optional<double> height_m(double x_m, double y_m) const override {
        double height_m = land_->planted().ground().height_m({x_m, y_m});
        if (std::isnan(height_m)) return std::nullopt;
        return height_m + land_->eye_height_m() - kLeastHeight_m;
    }
    double distance_m(const glm::dvec3& place_m) const override {
        double height_m = land_->planted().ground().height_m(glm::dvec2(place_m));
        return std::isnan(height_m) ? 0 : std::abs(place_m.z - height_m);
    }
    double step_m() const override { return land_->planted().placement().tile_m() / 2; }
    double least_speed_m_s() const override { return 2; }

    Result<FrameRecord> draw(const gl::Target& target, const view::Camera& camera, const FrameStyle& style) override {
        if (Result<void> ready = make_ready(style, target.samples()); !ready) return tl::unexpected(ready.error());
        frames_->set_budget(double(style.most_triangles));
        gl::Timer deciding;
        if (Result<void> decided = frames_->decide(camera, style.dt_s, style.morph); !decided)
            return tl::unexpected(decided.error());
        FrameRecord record;
        record.refine_ms = deciding.elapsed_ms();
        gl::Timer drawing;
        frames_->draw(target, style.look);
        record.draw_ms = drawing.finished_ms();
        take_counts(record);
        return record;
    }

  private:
    void take_counts(FrameRecord& record) const {
        const wang_ldi::FrameCounts& counts = frames_->counts();
        record.planting = counts;
        record.asked_error_px = counts.asked_error_px;
        record.triangle_count = counts.triangle_count + counts.plants.triangle_count;
        record.void_rim_triangle_count = counts.void_rim_triangle_count;
        record.tested_count = counts.terrain_tested_count + counts.field.tiles_tested + counts.field.blocks_tested;
        record.uploaded_bytes = counts.uploaded_bytes;
        record.predicted_error_px = counts.predicted_error_px;
        StreamRecord& stream = record.stream.emplace();
        stream.counts = counts.stream, stream.budget_bytes = frames_->budget_bytes(), stream.faults = frames_->faults();
    }

    // With the method and the error of this frame.
    Result<void> make_ready(const FrameStyle& style, uint32_t samples) {
        wang_ldi::FrameOptions wanted = options_;
        wanted.variant = planting_variant_of(style.method);
        wanted.error_px = style.error_px, wanted.samples = samples;
        wanted.shows_rings = wanted.shows_rings != style.shows_sources;
        wanted.is_pipelined = wanted.is_pipelined || style.is_pipelined;
        if (frames_ != nullptr) {
            return frames_->options() != wanted ? frames_->change(wanted) : Result<void>();
        }
        auto made = wang_ldi::FrameDrawer::make(land_->planted(), land_->land(), wanted, streaming_);
        if (!made) return tl::unexpected(made.error());
        frames_ = std::move(*made);
        return {};
    }

    std::unique_ptr<wang_ldi::PlantedLand> land_;
    wang_ldi::FrameOptions options_;
    wang_ldi::ImageStreaming streaming_;
    std::unique_ptr<wang_ldi::FrameDrawer> frames_;
};

}  // namespace

Result<std::unique_ptr<Subject>> read_planting(PlantingLayer planting, const LayerMethod& layer, const Streaming& streaming) {
    std::optional<terrain::Terrain> on;
    if (planting.ground) {
        Result<terrain::Terrain> terrain = terrain::read(*planting.ground);
        if (!terrain) return tl::unexpected(terrain.error());
        on = std::move(*terrain);
    }
    auto land = wang_ldi::PlantedLand::read(std::move(planting.file), std::move(on), planting.planting, planting.scene_path);
    if (!land) return tl::unexpected(land.error());
    if (layer.planting.has_geometry && (layer.planting.geometry_m > 0 || (*land)->has_models())) {
        if (Result<void> models = (*land)->read_models(); !models) return tl::unexpected(models.error());
    }
    return std::make_unique<PlantingSubject>(std::move(*land), layer,
                                             wang_ldi::ImageStreaming{streaming.settings, streaming.waits});
}

}  // namespace overlook::player
