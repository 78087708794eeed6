// Instances of a chain of levels in the player, drawn by any of discrete's variants.

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "formats/discrete.h"
#include "runtime/discrete/draw_frames.h"
#include "runtime/gl/timer.h"
#include "runtime/player/subject.h"

namespace overlook::player {
namespace {

constexpr double kOverviewFov_deg = 42, kOverviewHeading_deg = -30, kOverviewPitch_deg = -20, kOverviewMargin = 1.1;
constexpr double kNearShare = 1e-5;        // of one thing's size; depths are reversed floats, so this costs no precision
constexpr double kLeastSpeedShare = 0.05;  // of one thing's size in a second

class ChainSubject : public Subject {
  public:
    ChainSubject(discrete::Chain chain, const LayerMethod& layer) : chain_(std::move(chain)), options_(layer.chain) {
        for (const scene::Transform& instance : layer.instances) placements_.push_back(discrete::placement_of(instance));
        if (placements_.empty()) placements_.emplace_back();
        for (const discrete::Placement& placement : placements_) {
            glm::dvec3 middle_m = placement.at(chain_.middle_m);
            double radius_m = chain_.radius_m * placement.scale;
            lowest_m_ = glm::min(lowest_m_, middle_m - radius_m), highest_m_ = glm::max(highest_m_, middle_m + radius_m);
            least_radius_m_ = std::min(least_radius_m_, std::max(radius_m, 1e-6));
        }
    }

    Result<void> upload(const gl::SecondContextMaker&) override {
        Result<discrete::Drawing> drawing = discrete::Drawing::make(chain_);
        if (!drawing) return tl::unexpected(drawing.error());
        drawing_.emplace(std::move(*drawing));
        return {};
    }

    // As near as the sphere round all of it allows.
    view::Camera overview(uint32_t width_px, uint32_t height_px) const override {
        view::Camera camera;
        camera.width_px = width_px, camera.height_px = height_px;
        camera.fov_y_deg = kOverviewFov_deg, camera.heading_deg = kOverviewHeading_deg, camera.pitch_deg = kOverviewPitch_deg;
        double tangent_y = std::tan(camera.fov_y_deg * std::numbers::pi / 360);
        double tangent = std::min(tangent_y, tangent_y * width_px / height_px);
        double radius_m = glm::distance(lowest_m_, highest_m_) / 2;
        double away_m = kOverviewMargin * radius_m * std::sqrt(1 + 1 / (tangent * tangent));
        camera.position_m = (lowest_m_ + highest_m_) / 2.0 - view::axes_of(camera).forward * away_m;
        return camera;
    }
    double near_m() const override { return std::min(0.5, kNearShare * least_radius_m_); }
    Thing thing() const override { return Thing::chain; }

    std::optional<double> height_m(double, double) const override { return std::nullopt; }
    double distance_m(const glm::dvec3& place_m) const override {
        double nearest_m = std::numeric_limits<double>::infinity();
        for (const discrete::Placement& placement : placements_) {
            double away_m = glm::distance(place_m, placement.at(chain_.middle_m)) - chain_.radius_m * placement.scale;
            nearest_m = std::min(nearest_m, std::max(away_m, 0.0));
        }
        return nearest_m;
    }
    double step_m() const override { return least_radius_m_ / 16; }
    double least_speed_m_s() const override { return kLeastSpeedShare * least_radius_m_; }

    Result<FrameRecord> draw(const gl::Target& target, const view::Camera& camera, const FrameStyle& style) override {
        assert(drawing_.has_value());
        if (Result<void> ready = make_ready(style); !ready) return tl::unexpected(ready.error());
        FrameRecord record;
        record.asked_error_px = style.error_px;
        clip_s_ += style.dt_s;
        gl::Timer deciding;
        frames_->decide(camera, style.dt_s, clip_s_);
        record.refine_ms = deciding.elapsed_ms();
        gl::Timer drawing;
        discrete::DrawOptions look;
        look.is_wireframe = style.look.look == terrain::Look::wireframe;
        Result<discrete::FrameCounts> counts = frames_->draw(target, look);
        if (!counts) return tl::unexpected(counts.error());
        record.draw_ms = drawing.finished_ms();
        record.triangle_count = counts->triangle_count;
        record.tested_count = counts->tested_count;
        record.uploaded_bytes = counts->uploaded_bytes;
        record.predicted_error_px = counts->error_px;
        record.chain = *counts;
        return record;
    }

  private:
    // With the method and the error of this frame.
    Result<void> make_ready(const FrameStyle& style) {
        discrete::Variant variant = discrete_variant_of(style.method);
        discrete::FrameOptions wanted = options_;
        if (wanted.variant != variant) wanted = discrete::defaults_of(variant);
        wanted = with_error(wanted, style.error_px);
        bool is_same = frames_ != nullptr && frames_->director().options().variant == variant;
        if (is_same && frames_->director().options().select.error_px == wanted.select.error_px) return {};
        if (frames_ != nullptr) return frames_->change(wanted);
        Result<std::unique_ptr<discrete::FrameDrawer>> frames = discrete::FrameDrawer::make(*drawing_, placements_, wanted);
        if (!frames) return tl::unexpected(frames.error());
        frames_ = std::move(*frames);
        return {};
    }

    const discrete::Chain chain_;
    discrete::FrameOptions options_;
    std::vector<discrete::Placement> placements_;
    glm::dvec3 lowest_m_{std::numeric_limits<double>::infinity()}, highest_m_{-std::numeric_limits<double>::infinity()};
    double least_radius_m_ = std::numeric_limits<double>::infinity();
    std::optional<discrete::Drawing> drawing_;
    std::unique_ptr<discrete::FrameDrawer> frames_;
    double clip_s_ = 0;
};

}  // namespace

Result<std::unique_ptr<Subject>> read_chain(const container::Reader& file, const LayerMethod& layer) {
    Result<discrete::Chain> chain = discrete::read(file);
    if (!chain) return tl::unexpected(chain.error());
    return std::make_unique<ChainSubject>(std::move(*chain), layer);
}

}  // namespace overlook::player
