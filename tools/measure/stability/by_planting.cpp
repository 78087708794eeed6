// What the cases S08 and S11 ask of planted ground.
#include <algorithm>
#include <cmath>

#include "runtime/terrain/refine.h"
#include "runtime/wang_ldi/field.h"
#include "tools/measure/planting_method.h"
#include "tools/measure/stability/stage.h"

namespace overlook::measure {
namespace {

constexpr uint32_t kMostFrames = 8;
constexpr int kPlaces = 6;  // along each side of a half

// Where a camera sees a place, pixels from the middle; nothing of what is not in the picture.
std::optional<glm::dvec2> seen_px(const view::Camera& camera, const view::Axes& axes, const glm::dvec3& at_m) {
    glm::dvec3 from = at_m - camera.position_m;
    double depth_m = glm::dot(axes.forward, from), focal_px = view::focal_px(camera);
    if (depth_m < camera.near_m) return std::nullopt;
    glm::dvec2 px(glm::dot(axes.right, from) * focal_px / depth_m, glm::dot(axes.up, from) * focal_px / depth_m);
    if (std::abs(px.x) > camera.width_px * 0.5 || std::abs(px.y) > camera.height_px * 0.5) return std::nullopt;
    return px;
}

struct Shear {
    uint64_t places = 0, tiles = 0, too_steep = 0;
    double worst_px = 0;
    std::optional<uint32_t> worst_frame;
};

// Of a half, places all over it.
void add_half(const wang_ldi::Placement& placement, const wang_ldi::Item& item, const wang_ldi::Half& half,
              const view::Camera& camera, uint32_t frame, Shear& all) {
    view::Axes axes = view::axes_of(camera);
    glm::dvec2 corner_m = placement.rect_of(item.i, item.j).low_m;
    double piece_m = placement.tile_m() / double(1u << item.pieces_log2);
    for (int y = 0; y <= kPlaces; ++y)
        for (int x = 0; x <= kPlaces; ++x) {
            double share_x = double(x) / kPlaces, share_y = double(y) / kPlaces;
            if (wang_ldi::half_of(half.diagonal, share_x, share_y) != half.half) continue;
            glm::dvec2 in_tile_m = piece_m * (glm::dvec2(half.column, half.row) + glm::dvec2(share_x, share_y));
            double ground_m = placement.ground().height_m(corner_m + in_tile_m);
            double drawn_m = half.plane.height_m + glm::dot(half.plane.slope, in_tile_m);
            auto wanted = seen_px(camera, axes, glm::dvec3(corner_m + in_tile_m, ground_m));
            auto drawn = seen_px(camera, axes, glm::dvec3(corner_m + in_tile_m, drawn_m));
            if (!wanted || !drawn) continue;
            ++all.places;
            double off_px = glm::length(*drawn - *wanted);
            if (all.worst_frame && off_px <= all.worst_px) continue;
            all.worst_px = off_px, all.worst_frame = frame;
        }
}

Result<void> add_frame(wang_ldi::FrameDrawer& frames, const wang_ldi::Placement& placement, const view::Camera& camera,
                       uint32_t frame, Shear& all) {
    if (Result<void> decided = frames.decide(camera, 0, terrain::kDefaultMorph); !decided) return decided;
    const wang_ldi::FieldList& list = frames.list();
    all.too_steep = std::max(all.too_steep, list.counts.tiles_by_verdict[size_t(wang_ldi::Verdict::too_steep)]);
    for (const wang_ldi::Item& item : list.items) {
        auto is_image = [&](const wang_ldi::Shown& shown) {
            return frames.field().ladder().rungs[shown.rung].stage == wang_ldi::Stage::ldi;
        };
        std::span<const wang_ldi::Shown> shown = list.shown_of(item);
        if (std::none_of(shown.begin(), shown.end(), is_image)) continue;  // geometry stands on the ground itself
        all.tiles += item.half_count > 0;
        for (const wang_ldi::Half& half : list.halves_of(item)) add_half(placement, item, half, camera, frame, all);
    }
    return {};
}

}  // namespace

Result<Finding> planted_shear(Stage& stage, const MethodSpec& spec, const scene::Flight& flight) {
    Stage few = stage;
    few.frames = stage.frames == 0 ? kMostFrames : std::min(stage.frames, kMostFrames);
    std::vector<view::Camera> cameras = cameras_of(few, flight, Pick::spread);
    const wang_ldi::PlantedField& planted = stage.world.planted->planted();
    auto frames = wang_ldi::FrameDrawer::make(planted, stage.world.planted->land(), planting_options(spec), streaming_of(spec));
    if (!frames) return tl::unexpected(frames.error());
    Shear all;
    for (uint32_t frame = 0; frame < cameras.size(); ++frame) {
        Result<void> added = add_frame(**frames, planted.placement(), cameras[frame], frame, all);
        if (!added) return tl::unexpected(added.error());
    }
    if (!all.worst_frame) return impossible("{}: no tile of this flight is drawn by images", label_of(spec));
    Finding finding;
    finding.figures["shear_error_px"] = all.worst_px;
    finding.frames = uint32_t(cameras.size());
    finding.sentence = fmt::format(
        "Of {} places of {} sheared tiles in the picture none is drawn farther than {:.3f} px from where its ground is; up to {} "
        "tiles in sight are steeper than is planted.",
        all.places, all.tiles, all.worst_px, all.too_steep);
    Result<Shot> shot = shot_of(stage, spec, cameras[*all.worst_frame], *all.worst_frame);
    if (!shot) return tl::unexpected(shot.error());
    finding.worst = std::move(*shot);
    return finding;
}

namespace {

// How high an eye is above the ground, by what is drawn of the finest terrain looking straight down.
class GroundBelow {
  public:
    static Result<GroundBelow> make(const World& world) {
        Result<gl::Target> target = gl::Target::make(kSide_px, kSide_px, 1);
        if (!target) return tl::unexpected(target.error());
        return GroundBelow(world, std::move(*target));
    }
    double above_m(const view::Camera& camera) const {
        view::Camera down = camera;
        down.position_m -= wang_ldi::origin_of(land_, camera);
        down.width_px = down.height_px = kSide_px, down.pitch_deg = -90, down.fov_y_deg = 1, down.near_m = kNear_m;
        land_.drawing->draw(target_, cut_, down, {});
        return kNear_m / double(target_.read_depth()[kSide_px * kSide_px / 2]);
    }

  private:
    static constexpr uint32_t kSide_px = 9;
    static constexpr double kNear_m = 0.01, kEverything_m = -1;  // below every error, 0 as well
    GroundBelow(const World& world, gl::Target target) : land_(world.planted->land()), target_(std::move(target)) {
        land_.refiner->cut_by_metres(kEverything_m, cut_);
    }
    wang_ldi::Land land_;
    terrain::Cut cut_;
    gl::Target target_;
};

}  // namespace

Result<void> say_fallbacks(Stage& stage, std::span<const MethodSpec> specs, const std::vector<view::Camera>& cameras,
                           std::vector<Finding>& findings) {
    constexpr double kUnsure_m = 0.02;  // of what is read off a depth buffer
    const wang_ldi::Cell& cell = stage.world.planted->planted().images().set().cell;
    Result<GroundBelow> ground = GroundBelow::make(stage.world);
    if (!ground) return tl::unexpected(ground.error());
    Result<gl::Target> target = gl::Target::make(stage.width_px, stage.height_px, 1);
    if (!target) return tl::unexpected(target.error());
    std::vector<double> above_m;
    for (const view::Camera& camera : cameras) above_m.push_back(ground->above_m(camera));
    for (size_t i = 0; i < specs.size(); ++i) {
        std::unique_ptr<Method> method = stage.make(specs[i], stage.world);
        uint32_t outside = 0, unsaid = 0;
        for (uint32_t frame = 0; frame < cameras.size(); ++frame) {
            method->decide(cameras[frame], frame);
            bool is_said = method->draw(*target).is_eye_outside;
            bool is_outside = above_m[frame] < cell.eye_low_m - kUnsure_m || above_m[frame] > cell.eye_high_m + kUnsure_m;
            outside += is_outside, unsaid += is_outside && !is_said;
        }
        findings[i].figures["fallbacks_unsaid"] = unsaid;
        findings[i].sentence = fmt::format(
            "Images were sampled for eyes {:g} to {:g} m above the ground; {} of {} frames are outside of that, {} of them "
            "without saying so.",
            cell.eye_low_m, cell.eye_high_m, outside, cameras.size(), unsaid);
    }
    return {};
}

}  // namespace overlook::measure
