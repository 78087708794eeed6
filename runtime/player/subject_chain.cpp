// Instances of chains of levels in the player, drawn by any of discrete's variants.

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "formats/discrete.h"
#include "runtime/discrete/draw_frames.h"
#include "runtime/gl/timer.h"
#include "runtime/player/subject.h"
#include "runtime/view/error_budget.h"

namespace overlook::player {
namespace {

constexpr double kOverviewFov_deg = 42, kOverviewHeading_deg = -30, kOverviewPitch_deg = -20, kOverviewMargin = 1.1;
constexpr double kLeastSpeedShare = 0.05;  // of one thing's size in a second

// A chain and where it stands.
struct Stood {
    std::unique_ptr<const discrete::Chain> chain;  // stays where it is, since its drawing knows it
    std::vector<scene::Instance> instances;
    scene::Transform whole;
    bool moves = false;
    std::vector<discrete::Placement> placements;  // at the time of the frame
    std::optional<discrete::Drawing> drawing;
};

class ChainSubject : public Subject {
  public:
    ChainSubject(std::vector<Stood> chains, const discrete::FrameOptions& options)
        : chains_(std::move(chains)), options_(options) {
        for_each([&](const glm::dvec3& middle_m, double radius_m) {
            lowest_m_ = glm::min(lowest_m_, middle_m - radius_m), highest_m_ = glm::max(highest_m_, middle_m + radius_m);
            least_radius_m_ = std::min(least_radius_m_, std::max(radius_m, 1e-6));
        });
    }

    Result<void> upload(const gl::SecondContextMaker&) override {
        for (Stood& each : chains_) {
            Result<discrete::Drawing> drawing = discrete::Drawing::make(*each.chain);
            if (!drawing) return tl::unexpected(drawing.error());
            each.drawing.emplace(std::move(*drawing));
        }
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
    double near_m() const override {
        double near_m = std::numeric_limits<double>::infinity();
        for (const Stood& each : chains_)
            near_m = std::min(near_m, discrete::near_plane_m(each.chain->radius_m, each.placements));
        return near_m;
    }
    Thing thing() const override { return Thing::chain; }

    std::optional<double> height_m(double, double) const override { return std::nullopt; }
    // Of a thing that is all round the place, such as ground, a sphere cannot say how near it is: it counts if there is no other.
    double distance_m(const glm::dvec3& place_m) const override {
        double nearest_m = std::numeric_limits<double>::infinity();
        for_each([&](const glm::dvec3& middle_m, double radius_m) {
            double away_m = glm::distance(place_m, middle_m) - radius_m;
            if (away_m > 0) nearest_m = std::min(nearest_m, away_m);
        });
        return std::isinf(nearest_m) ? 0 : nearest_m;
    }
    double step_m() const override { return least_radius_m_ / 16; }
    double least_speed_m_s() const override { return kLeastSpeedShare * least_radius_m_; }

    Result<FrameRecord> draw(const gl::Target& target, const view::Camera& camera, const FrameStyle& style) override {
        bool is_first = frames_ == nullptr;
        if (Result<void> ready = make_ready(style); !ready) return tl::unexpected(ready.error());
        if (is_first)
            if (Result<void> prepared = frames_->prepare(camera, target); !prepared) return tl::unexpected(prepared.error());
        FrameRecord record;
        time_.set_most_ms(style.most_ms);
        frames_->set_budget(style.most_triangles > 0 ? double(style.most_triangles) : time_.work());
        if (has_drawn_) clip_s_ += style.dt_s;
        has_drawn_ = true;
        gl::Timer deciding;
        go_on();
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
        record.asked_error_px = style.error_px * counts->coarser_times;
        record.predicted_error_px = counts->error_px;
        record.chain = *counts;
        time_.frame_done(record.refine_ms + record.draw_ms, double(counts->triangle_count), double(counts->settled_triangle_count),
                         counts->coarser_times > 1);
        return record;
    }

  private:
    // what(middle_m, radius_m) of the sphere round each thing.
    template <class What>
    void for_each(const What& what) const {
        for (const Stood& each : chains_)
            for (const discrete::Placement& placement : each.placements)
                what(placement.at(each.chain->middle_m), each.chain->radius_m * placement.scale);
    }

    // To where what moves is at the clip's time.
    void go_on() {
        for (size_t i = 0; i < chains_.size(); ++i) {
            Stood& each = chains_[i];
            if (!each.moves) continue;
            each.placements = discrete::placements_of(each.instances, each.whole, clip_s_);
            frames_->place(each.placements, i);
        }
    }

    // With the method and the error of this frame.
    Result<void> make_ready(const FrameStyle& style) {
        discrete::Variant variant = discrete_variant_of(style.method);
        discrete::FrameOptions wanted = options_;
        if (wanted.variant != variant) wanted = discrete::defaults_of(variant);
        wanted = with_error(wanted, style.error_px);
        bool is_same = frames_ != nullptr && frames_->director().options().variant == variant;
        if (is_same && frames_->director().options().select.error_px == wanted.select.error_px) return {};
        if (frames_ != nullptr) return frames_->change(wanted);
        std::vector<discrete::Stand> stands;
        for (const Stood& each : chains_) stands.push_back({&*each.drawing, each.placements});
        Result<std::unique_ptr<discrete::FrameDrawer>> frames = discrete::FrameDrawer::make(stands, wanted);
        if (!frames) return tl::unexpected(frames.error());
        frames_ = std::move(*frames);
        return {};
    }

    std::vector<Stood> chains_;
    discrete::FrameOptions options_;
    glm::dvec3 lowest_m_{std::numeric_limits<double>::infinity()}, highest_m_{-std::numeric_limits<double>::infinity()};
    double least_radius_m_ = std::numeric_limits<double>::infinity();
    std::unique_ptr<discrete::FrameDrawer> frames_;
    view::WorkAllowance time_;  // of triangles, where a frame's time is to be kept
    double clip_s_ = 0;         // of the frame; 0 of the first
    bool has_drawn_ = false;
};

}  // namespace

Result<std::unique_ptr<Subject>> read_chains(std::span<const ChainLayer> layers, const discrete::FrameOptions& options) {
    std::vector<Stood> chains;
    for (const ChainLayer& layer : layers) {
        Result<discrete::Chain> chain = discrete::read(layer.file);
        if (!chain) return tl::unexpected(chain.error());
        bool moves = std::any_of(layer.instances.begin(), layer.instances.end(), [](const auto& one) { return one.moves(); });
        chains.push_back({std::make_unique<const discrete::Chain>(std::move(*chain)),
                          layer.instances,
                          layer.whole,
                          moves,
                          discrete::placements_of(layer.instances, layer.whole),
                          {}});
    }
    return std::make_unique<ChainSubject>(std::move(chains), options);
}

}  // namespace overlook::player
