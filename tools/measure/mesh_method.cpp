#include "tools/measure/mesh_method.h"

#include <optional>
#include <vector>

#include "runtime/caveclod/draw_frames.h"
#include "runtime/caveclod/static_levels.h"

namespace overlook::measure {
namespace {

class Caveclod : public Method {
  public:
    Caveclod(World& world, const MethodSpec& spec)
        : world_(world), frames_(*world.mesh->hierarchy, *world.mesh->mesh, *world.mesh->drawing, refining_of(spec)) {}

    void decide(const view::Camera& camera, uint32_t frame) override {
        camera_ = camera;
        frames_.decide(camera, double(frame - last_frame_) * world_.step_s);
        last_frame_ = frame;
    }

    Counters draw(const gl::Target& target) override {
        Counters counters = counters_of(frames_.draw(target, world_.mesh->look), world_.resident_bytes);
        counters.predicted_error_px = predicted_error_px();
        return counters;
    }

    bool set_triangles(double triangles) override {
        if (frames_.options().variant == caveclod::Variant::paper) return false;
        caveclod::Settings settings = frames_.options().settings;
        settings.most_triangles = uint64_t(triangles);
        frames_.change(settings);
        return true;
    }

    std::optional<Promises> promises() override {
        return world_.mesh->honesty().promises_of(frames_.drawn_corners_m(), camera_, predicted_error_px());
    }

  private:
    // The paper's legality lets triangles be drawn that nobody has measured: its threshold is what it claims.
    double predicted_error_px() const {
        bool is_paper = frames_.options().variant == caveclod::Variant::paper;
        return is_paper ? frames_.options().settings.error_px : frames_.counts().error_px;
    }

    World& world_;
    caveclod::FrameDrawer frames_;
    view::Camera camera_;
    uint32_t last_frame_ = 0;
};

class Discrete : public Method {
  public:
    Discrete(World& world, double error_px) : world_(world), error_px_(error_px), levels_(*world.mesh->mesh) {
        for (size_t i = 0; i < levels_.size(); ++i) {
            buffers_.push_back(std::make_unique<caveclod::CameraBuffers>(*world.mesh->mesh));
            buffers_.back()->take(levels_[i].by_surface);
            resident_bytes_ += buffers_.back()->uploaded_bytes();
        }
    }

    void decide(const view::Camera& camera, uint32_t) override {
        camera_ = camera;
        size_t now = levels_.chosen(camera, error_px_);
        event_count_ = level_ && *level_ != now ? 1 : 0;
        level_ = now;
    }

    Counters draw(const gl::Target& target) override {
        const caveclod::CameraBuffers& buffers = *buffers_[*level_];
        world_.mesh->drawing->draw(target, buffers, camera_, world_.mesh->look);
        Counters counters;
        counters.triangle_count = buffers.triangle_count();
        counters.vertex_reference_count = 3 * counters.triangle_count;
        counters.draw_call_count = buffers.draw_call_count() + 1;
        counters.tested_count = levels_.size();
        counters.resident_bytes = world_.resident_bytes + resident_bytes_;
        counters.event_count = event_count_;
        counters.predicted_error_px = predicted_error_px();
        return counters;
    }

    std::optional<Promises> promises() override {
        std::vector<glm::dvec3> corners_m;
        const caveclod::Mesh& mesh = *world_.mesh->mesh;
        for (const std::vector<uint32_t>& indices : levels_[*level_].by_surface) {
            for (uint32_t vertex : indices) corners_m.push_back(mesh.origin_m() + mesh.vertex_m(vertex));
        }
        return world_.mesh->honesty().promises_of(corners_m, camera_, predicted_error_px());
    }

  private:
    // Against the file's finest, as the other methods.
    double predicted_error_px() const { return *level_ > 0 ? levels_.error_px(*level_, camera_) : 0; }

    World& world_;
    double error_px_;
    caveclod::StaticLevels levels_;
    std::vector<std::unique_ptr<caveclod::CameraBuffers>> buffers_;
    uint64_t resident_bytes_ = 0, event_count_ = 0;
    view::Camera camera_;
    std::optional<size_t> level_;  // of the frame decided last
};

}  // namespace

caveclod::FrameOptions refining_of(const MethodSpec& spec) {
    caveclod::FrameOptions options;
    if (spec.variant == "paper") options.variant = caveclod::Variant::paper;
    if (spec.variant == "shared") options.variant = caveclod::Variant::shared;
    for (const SettingKind& kind : caveclod::setting_kinds(options.variant))
        caveclod::set(options, kind.name, setting(spec, std::string(kind.name)));
    return options;
}

Counters counters_of(const caveclod::FrameCounts& counts, uint64_t resident_bytes) {
    Counters counters;
    counters.triangle_count = counts.triangle_count;
    counters.vertex_reference_count = 3 * counts.triangle_count;
    counters.draw_call_count = counts.draw_call_count;
    counters.uploaded_bytes = counts.uploaded_bytes;
    counters.tested_count = counts.evaluated_count;
    counters.resident_bytes = resident_bytes + 12 * counts.refined_triangle_count;
    counters.operation_count = counts.split_count + counts.collapse_count;
    counters.camera_bytes = counts.camera_bytes;
    counters.wrong_corner_count = counts.wrong_corner_count;
    counters.predicted_error_px = counts.error_px;
    return counters;
}

std::unique_ptr<Method> make_caveclod_method(World& world, const MethodSpec& spec) {
    return std::make_unique<Caveclod>(world, spec);
}

std::unique_ptr<Method> make_discrete_method(World& world, double error_px) {
    return std::make_unique<Discrete>(world, error_px);
}

}  // namespace overlook::measure
