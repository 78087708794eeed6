// The cases of methods that show pictures again.
#include <algorithm>

#include "tools/measure/capture.h"
#include "tools/measure/numbers/frame_subset.h"
#include "tools/measure/numbers/temporal.h"
#include "tools/measure/reuse_truth.h"
#include "tools/measure/stability/stage.h"

namespace overlook::measure {
namespace {

constexpr uint32_t kMostJudged = 64;  // frames of the ridge, spread over the flight, all of which is flown

void mark(ImageRgb8& image, const std::vector<uint8_t>& where, const uint8_t (&colour)[3]) {
    for (size_t i = 0; i < where.size(); ++i) {
        if (where[i]) std::copy(std::begin(colour), std::end(colour), image.pixels.begin() + std::ptrdiff_t(3 * i));
    }
}

// What of the flight so far was worst.
struct Ridge {
    double ghost_share = 0, loss_share = 0, least_near = 1, most_near = 0, ghost_sum = 0, loss_sum = 0;
    uint32_t judged = 0;
    std::optional<Shot> worst;

    void add(uint32_t frame, const Reuse& reuse, ImageRgb8 picture) {
        const ReuseErrors& errors = reuse.errors;
        // By what the gates allow: a ghost is held to be as bad as seven losses.
        auto badness = [](double ghosts, double losses) { return 7 * ghosts + losses; };
        if (!worst || badness(errors.ghost_share, errors.loss_share) > worst_badness) {
            worst_badness = badness(errors.ghost_share, errors.loss_share);
            worst.emplace();
            worst->frame = frame;
            worst->test = std::move(picture);
            mark(worst->test, reuse.is_ghost, {255, 0, 255});
            mark(worst->test, reuse.is_loss, {255, 255, 0});
        }
        ghost_share = std::max(ghost_share, errors.ghost_share);
        loss_share = std::max(loss_share, errors.loss_share);
        least_near = std::min(least_near, reuse.near_share);
        most_near = std::max(most_near, reuse.near_share);
        ghost_sum += errors.ghost_share;
        loss_sum += errors.loss_share;
        ++judged;
    }
    double worst_badness = 0;
};

Result<Ridge> fly_ridge(Stage& stage, const MethodSpec& spec, const std::vector<view::Camera>& cameras, ReuseTruth& truth) {
    Result<gl::Target> target = gl::Target::make(stage.width_px, stage.height_px, samples_of(spec));
    Result<gl::Target> middle = gl::Target::make(stage.width_px, stage.height_px, 1);
    if (!target) return tl::unexpected(target.error());
    if (!middle) return tl::unexpected(middle.error());
    uint32_t most = stage.frames == 0 ? kMostJudged : stage.frames;
    std::vector<uint32_t> judged = spread_frames(uint32_t(cameras.size()), most);
    std::unique_ptr<Method> method = stage.make(spec, stage.world);
    Ridge ridge;
    for (uint32_t frame = 0; frame < cameras.size(); ++frame) {
        method->decide(cameras[frame], frame);
        method->draw(*target);
        if (!std::binary_search(judged.begin(), judged.end(), frame)) continue;
        ImageRgb8 picture = target->read();
        std::optional<Sources> sources = method->sources(*middle);
        if (!sources) continue;
        Result<Frame> full = truth.full_geometry(cameras[frame]);
        if (!full) return tl::unexpected(full.error());
        Result<Reuse> reuse = truth.reuse(*sources, *full);
        if (!reuse) return tl::unexpected(reuse.error());
        ridge.add(frame, *reuse, std::move(picture));
    }
    return ridge;
}

// How long a transition takes: of keys, of splits and collapses, or of levels.
uint32_t transition_frames_of(const MethodSpec& spec, double step_s) {
    for (const auto& [name, value] : spec.settings) {
        if (name == "fade-frames") return uint32_t(value);
        if (name == "glide-s" || name == "fade-s") return uint32_t(std::ceil(value / step_s - 1e-6));
    }
    return 0;
}

// Keys that took over; splits and collapses; levels that were exchanged.
uint64_t changes_of(const Counters& counters) {
    return counters.event_count + counters.operation_count;
}

// Where on the flight a key first takes over from another, or a mesh first changes.
Result<std::optional<uint32_t>> first_takeover(Stage& stage, const MethodSpec& spec, const std::vector<view::Camera>& cameras) {
    Result<gl::Target> target = gl::Target::make(stage.width_px, stage.height_px, samples_of(spec));
    if (!target) return tl::unexpected(target.error());
    std::unique_ptr<Method> method = stage.make(spec, stage.world);
    bool has_key = false;
    for (uint32_t frame = 0; frame < cameras.size(); ++frame) {
        method->decide(cameras[frame], frame);
        if (changes_of(method->draw(*target)) == 0) continue;
        if (has_key) return std::optional(frame);
        has_key = true;
    }
    return std::optional<uint32_t>();
}

// Frames of a method and of full geometry beside the reference's: what W needs.
class Watched {
  public:
    static Result<Watched> make(Stage& stage, const MethodSpec& spec) {
        Watched watched(stage, spec);
        Result<ReferenceRenderer> reference =
            ReferenceRenderer::make(stage.world, stage.renderer, stage.width_px, stage.height_px, stage.cache_folder);
        Result<gl::Target> target = gl::Target::make(stage.width_px, stage.height_px, samples_of(spec));
        Result<gl::Target> middle = gl::Target::make(stage.width_px, stage.height_px, 1);
        if (!reference) return tl::unexpected(reference.error());
        if (!target) return tl::unexpected(target.error());
        if (!middle) return tl::unexpected(middle.error());
        watched.reference_.emplace(std::move(*reference));
        watched.target_ = std::move(*target);
        watched.middle_ = std::move(*middle);
        return watched;
    }

    // Draws the next frame; with is_judged it is held against the reference, and against the frame before if that was as well.
    Result<uint64_t> next(const view::Camera& camera, uint32_t frame, bool is_judged) {
        method_->decide(camera, frame);
        uint64_t events = changes_of(method_->draw(*target_));
        picture = target_->read();
        if (!is_judged) return events;
        Frame now = seen(*method_, camera);
        floor_->decide(camera, frame);
        floor_->draw(*target_);
        Frame floor_now = seen(*floor_, camera);
        Result<Frame> truth = reference_->frame(camera);
        if (!truth) return tl::unexpected(truth.error());
        if (truth_) {
            Motion motion = motion_between(*truth_, *truth);
            errors_.push_back(temporal_error(motion, rgb_of(before_), rgb_of(now), rgb_of(*truth_), rgb_of(*truth)));
            floor_errors_.push_back(
                temporal_error(motion, rgb_of(floor_before_), rgb_of(floor_now), rgb_of(*truth_), rgb_of(*truth)));
            errors_.back().frame = floor_errors_.back().frame = frame;
            if (errors_.back().mean > worst_w_) {
                worst_w_ = errors_.back().mean;
                worst = Shot{frame, picture, {truth->width, truth->height, truth->rgb}};
            }
        }
        before_ = std::move(now);
        floor_before_ = std::move(floor_now);
        truth_ = std::move(*truth);
        return events;
    }

    PopIndex pop() const { return pop_index(errors_, floor_errors_); }

    ImageRgb8 picture;
    std::optional<Shot> worst;

  private:
    Watched(Stage& stage, const MethodSpec& spec)
        : method_(stage.make(spec, stage.world)), floor_(make_method(floor_spec(samples_of(spec)), stage.world)) {}

    Frame seen(Method& method, const view::Camera& camera) {
        ImageRgb8 shown = target_->read();
        method.draw(*middle_);
        Frame frame = captured(*middle_, *middle_, camera);
        frame.rgb = std::move(shown.pixels);
        return frame;
    }

    std::unique_ptr<Method> method_, floor_;
    std::optional<ReferenceRenderer> reference_;
    std::optional<gl::Target> target_, middle_;
    Frame before_, floor_before_;
    std::optional<Frame> truth_;
    std::vector<TemporalError> errors_, floor_errors_;
    double worst_w_ = -1;
};

// Flies to half a transition after `takeover`, stays, and flies back: which frames of the flight that takes.
struct Turn {
    std::vector<uint32_t> frames;
    uint32_t stop = 0, leaves = 0;  // of `frames`, the first and the last that stand still
};
Turn turn_of(uint32_t takeover, uint32_t fade, uint32_t whole) {
    constexpr uint32_t kLonger = 8, kBack = 8;  // frames to stay after the transition's end, and to fly back
    Turn turn;
    uint32_t stop = std::min(takeover + fade / 2, whole - 1);
    for (uint32_t frame = 0; frame <= stop; ++frame) turn.frames.push_back(frame);
    turn.stop = stop;
    turn.frames.insert(turn.frames.end(), fade - fade / 2 + kLonger, stop);
    turn.leaves = uint32_t(turn.frames.size() - 1);
    for (uint32_t back = 1; back <= std::min(kBack, stop); ++back) turn.frames.push_back(stop - back);
    return turn;
}

Result<Finding> turn_back(Stage& stage, const MethodSpec& spec, const scene::Flight& flight,
                          const std::vector<view::Camera>& cameras) {
    constexpr uint32_t kBefore = 2;  // frames judged before the takeover
    Result<std::optional<uint32_t>> takeover = first_takeover(stage, spec, cameras);
    if (!takeover) return tl::unexpected(takeover.error());
    if (!*takeover) {
        Finding nothing;
        nothing.frames = uint32_t(cameras.size());
        nothing.sentence = "Nothing changes on this flight after its first frame, so that nothing is shown of how.";
        return nothing;
    }
    uint32_t fade = transition_frames_of(spec, flight.step_s), event = **takeover;
    Turn turn = turn_of(event, fade, uint32_t(cameras.size()));
    Result<Watched> watched = Watched::make(stage, spec);
    if (!watched) return tl::unexpected(watched.error());
    // A mesh goes on changing as long as the camera moves, and so do chains.
    bool has_keys = is_image(spec) && !stage.world.is_mesh();
    uint32_t last_change = event, last_key = !has_keys ? std::max(event, turn.stop) : event, new_keys = 0, over = 0;
    ImageRgb8 before;
    for (uint32_t step = 0; step < turn.frames.size(); ++step) {
        Result<uint64_t> events = watched->next(cameras[turn.frames[step]], step, step + kBefore >= event);
        if (!events) return tl::unexpected(events.error());
        bool stands = step > turn.stop && step <= turn.leaves;
        // A key that takes over later has a transition of its own.
        if (step > event && *events > 0) last_key = step, ++new_keys;
        if (stands && watched->picture.pixels != before.pixels) {
            last_change = step;
            over = std::max(over, step - std::min(step, last_key + fade));
        }
        before = watched->picture;
    }
    PopIndex pop = watched->pop();
    Finding finding;
    finding.figures["pop_index"] = pop.index;
    finding.figures["transition_over_time_s"] = over * flight.step_s;
    finding.frames = uint32_t(turn.frames.size());
    finding.worst = std::move(watched->worst);
    finding.sentence = fmt::format(
        "{} in frame {}, over {} frames; the camera stops in frame {} and turns back in frame {}. The picture of "
        "the "
        "still camera changes last in frame {}. Such frames after it: {}. The greatest unrest above full geometry's is "
        "{:.4f} luma, in frame {}, tile {}, {}.",
        stage.world.is_chain() ? "A level changes"
        : has_keys             ? "A key takes over"
                               : "The mesh changes",
        event, fade, turn.stop, turn.leaves + 1, last_change, new_keys, pop.excess, pop.frame, pop.tile_column, pop.tile_row);
    return finding;
}

}  // namespace

Result<std::vector<Finding>> run_ridge(Stage& stage, const Case&, const scene::Flight& flight,
                                       std::span<const MethodSpec> specs) {
    std::vector<view::Camera> cameras = cameras_of(stage, flight, Pick::all);
    Result<ReferenceRenderer> reference =
        ReferenceRenderer::make(stage.world, stage.renderer, stage.width_px, stage.height_px, stage.cache_folder);
    if (!reference) return tl::unexpected(reference.error());
    ReuseTruth truth(stage.world);
    std::vector<Finding> findings;
    for (const MethodSpec& spec : specs) {
        Result<Ridge> ridge = fly_ridge(stage, spec, cameras, truth);
        if (!ridge) return tl::unexpected(ridge.error());
        if (ridge->judged == 0) return impossible("{}: no frame of this flight shows a picture again", label_of(spec));
        Result<Frame> best = reference->frame(cameras[ridge->worst->frame]);
        if (!best) return tl::unexpected(best.error());
        ridge->worst->reference = {best->width, best->height, std::move(best->rgb)};
        Finding finding;
        finding.figures["ghost_share"] = ridge->ghost_share;
        finding.figures["loss_share"] = ridge->loss_share;
        finding.frames = ridge->judged;
        finding.worst = std::move(ridge->worst);
        finding.sentence = fmt::format(
            "In the worst frames {:.3f} % of the surface's pixels are ghosts (magenta) and {:.3f} % are lost (yellow); in the "
            "mean "
            "{:.3f} and {:.3f} %. {:.1f} to {:.1f} % are near geometry, drawn as such on purpose: neither. Frames that use no "
            "key are "
            "left out.",
            100 * ridge->ghost_share, 100 * ridge->loss_share, 100 * ridge->ghost_sum / ridge->judged,
            100 * ridge->loss_sum / ridge->judged, 100 * ridge->least_near, 100 * ridge->most_near);
        findings.push_back(std::move(finding));
    }
    return findings;
}

Result<std::vector<Finding>> run_turning_back(Stage& stage, const Case&, const scene::Flight& flight,
                                              std::span<const MethodSpec> specs) {
    std::vector<view::Camera> cameras = cameras_of(stage, flight, Pick::all);
    std::vector<Finding> findings;
    for (const MethodSpec& spec : specs) {
        Result<Finding> finding = turn_back(stage, spec, flight, cameras);
        if (!finding) return tl::unexpected(finding.error());
        findings.push_back(std::move(*finding));
    }
    return findings;
}

}  // namespace overlook::measure
