#include "tools/measure/paper/caveclod/team.h"

namespace overlook::measure::paper::cameras {
namespace {

using caveclod::FrameReport;
using caveclod::Refinement;
using caveclod::Settings;
namespace printed = caveclod::paper;

constexpr uint32_t kMostTraversals = 256;  // until nothing is left to do

CameraMemory memory_of_refinement(const Refinement& refinement) {
    Refinement::Bytes bytes = refinement.bytes();
    return {bytes.fixed, bytes.active + bytes.glides, bytes.glides, 0, refinement.faces().face_count()};
}

class OwnTeam : public Team {
  public:
    OwnTeam(const Subject& subject, const Settings& settings, size_t cameras) : Team(cameras), settings_(settings) {
        for (size_t i = 0; i < cameras; ++i) {
            refinements_.push_back(std::make_unique<Refinement>(subject.mesh()));
            pointers_.push_back(refinements_.back().get());
        }
    }
    void settle(std::span<const view::Camera> cameras) override {
        Settings at_once = settings_;
        at_once.most_operations = 0, at_once.glide_s = 0;
        caveclod::refine_all(pointers_, cameras, at_once, 0, reports_);
    }
    void refine(std::span<const view::Camera> cameras, double dt_s, const OnReady& ready) override {
        caveclod::refine_all(pointers_, cameras, settings_, dt_s, reports_);
        for (size_t i = 0; ready && i < pointers_.size(); ++i) ready({i, pointers_[i], nullptr});
    }
    CameraMemory memory_of(size_t camera) const override { return memory_of_refinement(*refinements_[camera]); }

  private:
    Settings settings_;
    std::vector<std::unique_ptr<Refinement>> refinements_;
    std::vector<Refinement*> pointers_;
};

class SharedTeam : public Team {
  public:
    SharedTeam(const Subject& subject, const Settings& settings, size_t cameras)
        : Team(cameras), settings_(settings), refinement_(subject.mesh()) {}
    void settle(std::span<const view::Camera> cameras) override { refine(cameras, 0, {}); }
    void refine(std::span<const view::Camera> cameras, double, const OnReady& ready) override {
        caveclod::refine_in_turn(
            refinement_, cameras, settings_,
            [&](size_t i) {
                if (ready) ready({i, &refinement_, nullptr});
            },
            reports_);
    }
    CameraMemory memory_of(size_t camera) const override {
        return camera == 0 ? memory_of_refinement(refinement_) : CameraMemory{};
    }
    bool has_memory() const override { return reports_.size() == 1; }

  private:
    Settings settings_;
    Refinement refinement_;
};

// Traverses until nothing changes, since a traversal goes one step deeper. All that it did is one report.
FrameReport traverse(printed::CameraRefinement& refinement, const view::Camera& camera, const printed::Options& options) {
    FrameReport all = refinement.refine(camera, options);
    for (uint32_t more = 1; !all.is_settled && more < kMostTraversals; ++more) {
        FrameReport next = refinement.refine(camera, options);
        all.split_count += next.split_count, all.collapse_count += next.collapse_count;
        all.forced_count += next.forced_count, all.evaluated_count += next.evaluated_count;
        all.triangle_count = next.triangle_count, all.is_settled = next.is_settled;
    }
    return all;
}

// As printed: lists of each camera's own.
class PrintedTeam : public Team {
  public:
    PrintedTeam(const Subject& subject, const printed::Options& options, size_t cameras) : Team(cameras), options_(options) {
        for (size_t i = 0; i < cameras; ++i)
            refinements_.push_back(std::make_unique<printed::CameraRefinement>(*subject.printed));
        fixed_bytes_ = printed::equation1(subject.printed->nodes().size(), subject.mesh().face_count(), 0, 0, 0, 0, 0, 1).cameras;
    }
    void settle(std::span<const view::Camera> cameras) override {
        for (size_t i = 0; i < cameras.size(); ++i) reports_[i] = traverse(*refinements_[i], cameras[i], options_);
    }
    void refine(std::span<const view::Camera> cameras, double, const OnReady& ready) override {
        for (size_t i = 0; i < cameras.size(); ++i) {
            reports_[i] = refinements_[i]->refine(cameras[i], options_);
            if (!ready) continue;
            uint64_t wrong_corners = 0;
            refinements_[i]->collect(by_surface_, wrong_corners);
            ready({i, nullptr, &by_surface_});
        }
    }
    CameraMemory memory_of(size_t camera) const override {
        const printed::CameraRefinement& own = *refinements_[camera];
        printed::Equation1 terms = printed::equation1(0, 0, 0, 0, 0, own.active_node_count(), own.active_polygon_count(), 1);
        return {fixed_bytes_, terms.active_nodes + terms.active_polygons, 0, own.active_node_count(), own.active_polygon_count()};
    }

  private:
    printed::Options options_;
    std::vector<std::unique_ptr<printed::CameraRefinement>> refinements_;
    std::vector<std::vector<uint32_t>> by_surface_;
    uint64_t fixed_bytes_ = 0;
};

}  // namespace

std::string name_of(Way way) {
    switch (way) {
        case Way::own:
            return "caveclod";
        case Way::printed:
            return "caveclod:paper";
        case Way::shared:
            return "caveclod:shared";
        case Way::printed_7:
            return "caveclod:paper at 7 %";
    }
    return "";
}

std::unique_ptr<Team> make_team(const Subject& subject, Way way, const Settings& settings, size_t cameras) {
    printed::Options options;
    options.settings = settings;
    if (way == Way::printed_7) options.criterion = printed::Criterion::projected_extent;
    switch (way) {
        case Way::own:
            return std::make_unique<OwnTeam>(subject, settings, cameras);
        case Way::shared:
            return std::make_unique<SharedTeam>(subject, settings, cameras);
        case Way::printed:
        case Way::printed_7:
            return std::make_unique<PrintedTeam>(subject, options, cameras);
    }
    return nullptr;
}

}  // namespace overlook::measure::paper::cameras
