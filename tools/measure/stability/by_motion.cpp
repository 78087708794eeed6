// The case of things that move.
#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "tools/measure/numbers/trails.h"
#include "tools/measure/reference.h"
#include "tools/measure/stability/stage.h"

namespace overlook::measure {
namespace {

constexpr size_t kTrailFrames = 4;  // how long a trail is

// By id, of all instances of a picture; those of a chain's instances follow those of the chains before, from 1 on.
std::vector<uint8_t> moving_ids(const World& world) {
    std::vector<uint8_t> is_moving{0};
    for (const ChainWorld& one : world.chains)
        for (size_t i = 0; i < one.placements.size(); ++i)
            is_moving.push_back(i < one.instances.size() && one.instances[i].moves());
    return is_moving;
}

// Things stand where they did at the beginning when this goes.
class Outing {
  public:
    explicit Outing(World& world) : world_(world) {}
    ~Outing() { world_.go_to(0); }
    Outing(const Outing&) = delete;
    Outing& operator=(const Outing&) = delete;
    void to_frame(size_t frame) { world_.go_to(double(frame) * world_.step_s); }

  private:
    World& world_;
};

Result<std::vector<Frame>> truths_of(const Stage& stage, const std::vector<view::Camera>& cameras) {
    Result<ReferenceRenderer> reference =
        ReferenceRenderer::make(stage.world, stage.renderer, stage.width_px, stage.height_px, stage.cache_folder);
    if (!reference) return tl::unexpected(reference.error());
    std::vector<Frame> truths;
    Outing outing(stage.world);
    for (size_t frame = 0; frame < cameras.size(); ++frame) {
        outing.to_frame(frame);
        Result<Frame> truth = reference->frame(cameras[frame]);
        if (!truth) return tl::unexpected(truth.error());
        truths.push_back(std::move(*truth));
    }
    return truths;
}

ImageRgb8 picture_of(const Frame& frame) {
    return {frame.width, frame.height, frame.rgb};
}

// A method's trails over all frames.
struct Trails {
    uint64_t trail_px = 0, ghost_px = 0, worst_px = 0, changes = 0;
};

Result<Finding> follow(Stage& stage, const MethodSpec& spec, const std::vector<view::Camera>& cameras,
                       std::span<const Frame> truths, std::span<const uint8_t> is_moving) {
    Result<gl::Target> target = gl::Target::make(stage.width_px, stage.height_px, samples_of(spec));
    if (!target) return tl::unexpected(target.error());
    std::unique_ptr<Method> method = stage.make(spec, stage.world);
    Outing outing(stage.world);
    auto margin_px = uint32_t(std::ceil(std::max(stage.asked_px, 1.0)));
    std::deque<std::vector<uint32_t>> before;
    Trails found;
    Finding finding;
    for (uint32_t frame = 0; frame < cameras.size(); ++frame) {
        outing.to_frame(frame);
        method->decide(cameras[frame], frame);
        found.changes += method->draw(*target).event_count;
        ImageRgb8 picture = target->read();
        std::vector<std::vector<uint32_t>> ids(before.begin(), before.end());
        TrailErrors here = trail_errors(picture, truths[frame], ids, is_moving, margin_px);
        found.trail_px += here.trail_px, found.ghost_px += here.ghost_px;
        if (!finding.worst || here.ghost_px > found.worst_px) finding.worst = Shot{frame, picture, picture_of(truths[frame])};
        found.worst_px = std::max(found.worst_px, here.ghost_px);
        before.push_back(truths[frame].ids);
        if (before.size() > kTrailFrames) before.pop_front();
    }
    auto moving = std::count(is_moving.begin(), is_moving.end(), 1);
    finding.frames = uint32_t(cameras.size());
    bool is_shown = found.trail_px > 0 && found.changes > 0;
    finding.figures["ghost_share"] =
        is_shown ? double(found.ghost_px) / double(found.trail_px) : std::numeric_limits<double>::infinity();
    finding.sentence = fmt::format(
        "{} things move, {} changes of level begin. Of {} pixels that they left in the {} frames before, {} show what the truth "
        "has "
        "nowhere within {} pixels of them; {} in the worst frame.",
        moving, found.changes, found.trail_px, kTrailFrames, found.ghost_px, margin_px, found.worst_px);
    if (!is_shown) finding.sentence += " Nothing moves, or no level changes: nothing is shown of what would be left behind.";
    return finding;
}

}  // namespace

Result<std::vector<Finding>> run_crossing(Stage& stage, const Case&, const scene::Flight& flight,
                                          std::span<const MethodSpec> specs) {
    std::vector<view::Camera> cameras = cameras_of(stage, flight, Pick::in_row);
    std::vector<uint8_t> is_moving = moving_ids(stage.world);
    Result<std::vector<Frame>> truths = truths_of(stage, cameras);
    if (!truths) return tl::unexpected(truths.error());
    std::vector<Finding> findings;
    for (const MethodSpec& spec : specs) {
        Result<Finding> finding = follow(stage, spec, cameras, *truths, is_moving);
        if (!finding) return tl::unexpected(finding.error());
        findings.push_back(std::move(*finding));
    }
    return findings;
}

}  // namespace overlook::measure
