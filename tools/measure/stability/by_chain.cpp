// The case of levels that do not match, or match too well.
#include <algorithm>
#include <limits>

#include "tools/measure/stability/stage.h"

namespace overlook::measure {
namespace {

constexpr double kNearer = 8;  // times the error asked, at which levels change: near enough that they are seen to mismatch
constexpr uint32_t kHeld = 8;  // frames in which a still camera is looked at, time standing still or all changes being over

uint64_t changed(const ImageRgb8& a, const ImageRgb8& b) {
    uint64_t count = 0;
    for (size_t i = 0; i < a.pixels.size(); i += 3)
        count += std::equal(a.pixels.begin() + ptrdiff_t(i), a.pixels.begin() + ptrdiff_t(i + 3), b.pixels.begin() + ptrdiff_t(i))
                     ? 0
                     : 1;
    return count;
}

// A method flown by hand.
class Flown {
  public:
    static Result<Flown> make(Stage& stage, const MethodSpec& spec) {
        Result<gl::Target> target = gl::Target::make(stage.width_px, stage.height_px, samples_of(spec));
        if (!target) return tl::unexpected(target.error());
        return Flown(stage, spec, std::move(*target));
    }

    Counters next(const view::Camera& camera) {
        method_->decide(camera, frame_++);
        return method_->draw(target_);
    }
    ImageRgb8 picture() { return target_.read(); }

    // The greatest share of the pixels that differ from one frame to the next, of a camera that stands still; the first is there
    // already.
    double flicker(const view::Camera& camera, std::optional<Shot>& worst) {
        ImageRgb8 before = picture();
        uint64_t most = 0;
        for (uint32_t held = 0; held < kHeld; ++held) {
            next(camera);
            ImageRgb8 now = picture();
            uint64_t here = changed(before, now);
            if (here > most || !worst) worst = Shot{frame_ - 1, now, before};
            most = std::max(most, here);
            before = std::move(now);
        }
        return double(most) / double(uint64_t(before.width) * before.height);
    }

  private:
    Flown(Stage& stage, const MethodSpec& spec, gl::Target target)
        : target_(std::move(target)), method_(stage.make(spec, stage.world)) {}

    gl::Target target_;
    std::unique_ptr<Method> method_;
    uint32_t frame_ = 0;
};

// Time that stands still till this goes.
class Held {
  public:
    explicit Held(World& world) : world_(world), step_s_(world.step_s) { world_.step_s = 0; }
    ~Held() { world_.step_s = step_s_; }
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;

  private:
    World& world_;
    double step_s_;
};

struct Flicker {
    double in_transition = 0, at_rest = 0;
    std::optional<uint32_t> begins;  // the frame in which a level changes first
    uint32_t most_under_way = 0;
    std::optional<Shot> worst;
};

// Flies till a change of level is under way, two frames of it, stops the clock, and lets it go on.
Result<Flicker> flicker_of(Stage& stage, const MethodSpec& spec, const std::vector<view::Camera>& cameras) {
    constexpr uint32_t kInto = 2, kLongest = 600;  // frames
    Result<Flown> flown = Flown::make(stage, spec);
    if (!flown) return tl::unexpected(flown.error());
    Flicker found;
    size_t at = 0;
    for (uint32_t since = 0; at + 1 < cameras.size() && since < kInto; ++at) {
        Counters counters = flown->next(cameras[at]);
        if (since > 0 || counters.event_count > 0) ++since;
        if (since == 1) found.begins = uint32_t(at);
    }
    const view::Camera& still = cameras[at];
    {
        Held held(stage.world);
        // What is carried over from the frames before the stop is over after two.
        found.most_under_way = uint32_t(flown->next(still).transition_count);
        for (int settled = 0; settled < 2; ++settled) flown->next(still);
        found.in_transition = flown->flicker(still, found.worst);
    }
    uint32_t waited = 0;
    while (flown->next(still).transition_count > 0 && waited < kLongest) ++waited;
    for (int settled = 0; settled < 2; ++settled) flown->next(still);
    std::optional<Shot> at_rest;
    found.at_rest = flown->flicker(still, at_rest);
    if (found.at_rest > found.in_transition) found.worst = std::move(at_rest);
    return found;
}

}  // namespace

Result<std::vector<Finding>> run_mismatched(Stage& stage, const Case& each, const scene::Flight& flight,
                                            std::span<const MethodSpec> asked) {
    std::vector<MethodSpec> specs(asked.begin(), asked.end());
    for (MethodSpec& spec : specs)
        for (auto& [name, value] : spec.settings) value *= name == "error-px" ? kNearer : 1;
    Result<std::vector<Finding>> findings = run_dolly(stage, each, flight, specs);
    if (!findings) return findings;
    std::vector<view::Camera> cameras = cameras_of(stage, flight, Pick::in_row);
    for (size_t i = 0; i < specs.size(); ++i) {
        Result<Flicker> flicker = flicker_of(stage, specs[i], cameras);
        if (!flicker) return tl::unexpected(flicker.error());
        Finding& finding = (*findings)[i];
        if (!flicker->begins) {
            finding.figures["still_flicker"] = finding.figures["pop_index"] = std::numeric_limits<double>::infinity();
            finding.sentence += " No level changes on this flight, so that nothing is shown of how.";
            continue;
        }
        finding.figures["still_flicker"] = std::max(flicker->in_transition, flicker->at_rest);
        finding.sentence += fmt::format(
            " Levels change at {} times the error asked, so that their silhouettes are seen to differ. A level changes first in "
            "frame {}; with the clock stopped and {} changes under way {:.4f} % of a still camera's "
            "pixels differ from frame to frame, once all are over {:.4f} %.",
            kNearer, *flicker->begins, flicker->most_under_way, 100 * flicker->in_transition, 100 * flicker->at_rest);
        if (finding.figures["still_flicker"] > 0) finding.worst = std::move(flicker->worst);
    }
    return findings;
}

}  // namespace overlook::measure
