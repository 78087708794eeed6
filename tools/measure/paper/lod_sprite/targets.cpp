#include "tools/measure/paper/lod_sprite/targets.h"

#include <algorithm>
#include <functional>
#include <iterator>

#include "tools/measure/figures.h"
#include "tools/measure/methods.h"
#include "tools/measure/page_text.h"

namespace overlook::measure::paper::sprite {
namespace {

using Value = std::optional<double>;

double mean_over(const RunResult& run, const std::function<double(const FrameRecord&)>& of) {
    double sum = 0;
    for (const FrameRecord& frame : run.frames) sum += of(frame);
    return sum / double(run.frames.size());
}

Value ratio(Value above, Value below) {
    if (!above || !below || *below == 0) return std::nullopt;
    return *above / *below;
}

// The high cut's triangles over those of the pictures themselves, on frames that are no keyframe as a whole.
Value novel_triangle_ratio(const RunResult& high, const RunResult& run) {
    double high_sum = 0, sum = 0;
    for (size_t i = 0; i < run.frames.size(); ++i) {
        const Counters& counters = run.frames[i].counters;
        if (counters.event_count > 0 && counters.key_triangle_count == 0) continue;
        high_sum += double(high.frames[i].counters.triangle_count);
        sum += double(counters.triangle_count - counters.key_triangle_count);
    }
    return ratio(high_sum, sum);
}

// Of figure 12's first and last point: the share of keyframes with most frames over that with fewest.
Value fall_of_keyframes(const Flown& flown, const std::string& family) {
    const Swept *fewest = nullptr, *most = nullptr;
    for (const Swept& one : flown.frame_counts) {
        if (one.family != family) continue;
        if (fewest == nullptr || one.frames < fewest->frames) fewest = &one;
        if (most == nullptr || one.frames > most->frames) most = &one;
    }
    if (fewest == nullptr || fewest == most) return std::nullopt;
    return ratio(most->keyframe_share(), fewest->keyframe_share());
}

// Of the run with keys held at the same settings.
const HeldRun* held_of(const Flown& flown, const MethodSpec& sprite) {
    MethodSpec held = at_threshold(sprite, kHeldThreshold_px);
    auto found = std::find_if(flown.held.begin(), flown.held.end(), [&](const HeldRun& one) { return one.spec == held; });
    return found == flown.held.end() ? nullptr : &*found;
}

// At which the first key takes over; 0 where none does.
uint32_t first_key_frame(const RunResult& run) {
    auto first = std::find_if(run.frames.begin(), run.frames.end(),
                              [](const FrameRecord& frame) { return frame.counters.event_count > 0; });
    return first == run.frames.end() ? 0 : first->frame;
}

// The numbers of its last frames alone.
RunResult from_frame(const RunResult& run, uint32_t first) {
    RunResult part;
    part.frames.assign(run.frames.begin() + first, run.frames.end());
    return part;
}

// What the run says of each target, and what of it is the reason where a target is missed.
class Teller {
  public:
    explicit Teller(const Flown& flown) : flown_(flown), high_(high_of(flown)), low_(low_of(flown)) {
        const ImageRgb8* picture = flown.views.empty() ? nullptr : &flown.views[0].high.image;
        picture_px_ = picture ? double(picture->width) * picture->height : 0;
    }

    Value speed_up(const RunResult& run) const { return mean_ms(high_) / mean_ms(run); }
    Value cost_ratio(const RunResult& run) const { return cost(high_) / cost(run); }
    Value p99_over_p50(const RunResult& run) const {
        Percentiles times_ms = percentiles_of(run, "frame_ms");
        return ratio(times_ms.p99, times_ms.p50);
    }
    Value slowest(const RunResult& run) const {
        return ratio(percentiles_of(run, "frame_ms").max, percentiles_of(high_, "frame_ms").p50);
    }
    Value novel_triangles(const RunResult& run) const { return novel_triangle_ratio(high_, run); }
    Value triangles(const RunResult& run) const { return ratio(mean_of(high_, "triangles"), mean_of(run, "triangles")); }
    // Of the frames from `first` on.
    Value over_floor(const RunResult& run, std::string_view name, uint32_t first) const {
        return ratio(mean_of(from_frame(run, first), name), mean_of(from_frame(flown_.beside.runs[run.floor], first), name));
    }
    Value e_p99(const RunResult& run, uint32_t first) const {
        auto e_of = [&](const RunResult& one) { return percentiles_of(from_frame(one, first), "e_p99_flip").p99; };
        return ratio(e_of(run), e_of(flown_.beside.runs[run.floor]));
    }
    Value ghosts(const RunResult& run) const {
        const HeldRun* held = held_of(flown_, run.spec);
        return held ? Value(held->tally.up_to(HeldGoals::kEdge_px).ghost_share()) : std::nullopt;
    }
    Value losses(const RunResult& run) const {
        const HeldRun* held = held_of(flown_, run.spec);
        return held ? Value(held->tally.up_to(HeldGoals::kEdge_px).loss_share()) : std::nullopt;
    }
    Value keyframes(const RunResult& run) const { return swept_from(run, nullptr, kThreshold_px).keyframe_share(); }
    Value fall(const RunResult& run) const { return fall_of_keyframes(flown_, family_of(run.spec)); }

    std::string why_slow(const RunResult& run) const {
        return fmt::format(
            "the low cut by itself gains {:.1f}: pixels cost, not triangles. A frame takes {:.1f} ms, {:.1f} times the low "
            "cut's: "
            "looking pixels up in keys, near geometry, and of keys {} triangles a frame",
            *speed_up(low_), mean_ms(run), mean_ms(run) / mean_ms(low_), short_count(*mean_of(run, "key_triangles")));
    }
    std::string why_dear(const RunResult& run) const {
        double all = cost(run);
        return fmt::format("of it {:.0f} % are the picture's pixels, {:.0f} % those of keys, {:.0f} % keys' indices",
                           100 * 0.2 * picture_px_ / all, 100 * 0.2 * *mean_of(run, "key_pixels") / all,
                           100 * 3 * *mean_of(run, "key_triangles") / all);
    }
    std::string why_many_triangles(const RunResult& run) const {
        double novel = *mean_of(run, "triangles") - *mean_of(run, "key_triangles");
        return fmt::format(
            "{} a frame are the picture's own, {:.1f} times the low cut's: near geometry, and frames without a key, which are "
            "drawn finer",
            short_count(novel), novel / *mean_of(low_, "triangles"));
    }
    std::string why_many_with_keys(const RunResult& run) const {
        return fmt::format("{:.0f} % of them are drawn into keys",
                           100 * *mean_of(run, "key_triangles") / *mean_of(run, "triangles"));
    }
    std::string why_off_floor(const RunResult& run, std::string_view name, Value settled) const {
        uint32_t first = first_key_frame(run), worst = first, key = first, last_key = first;
        double most = -1;
        for (const FrameRecord& frame : from_frame(run, first).frames) {
            if (frame.counters.event_count > 0) last_key = frame.frame;
            Value value = figure(name).of(frame);
            if (!value || *value <= most) continue;
            most = *value;
            worst = frame.frame;
            key = last_key;
        }
        return fmt::format(
            "frames before the first key, which is whole at frame {}, are drawn coarser; from then on it is {}, worst at frame "
            "{}, "
            "{} frames after a key took over",
            first, settled ? short_number(*settled) : "not measured", worst, worst - key);
    }
    std::string why_many_keys(const RunResult& run) const {
        return fmt::format(
            "{} keys, each for {:.0f} frames: due by the 99th percentile of a bounded error, not by its mean square",
            swept_from(run, nullptr, kThreshold_px).keyframes, 1 / *keyframes(run));
    }

  private:
    double cost(const RunResult& run) const {
        return mean_over(run, [&](const FrameRecord& frame) { return counted_cost(frame.counters, picture_px_); });
    }

    const Flown& flown_;
    const RunResult &high_, &low_;
    double picture_px_ = 0;
};

struct Told {
    Target target;
    std::function<Value(const RunResult&)> measured;
    std::function<std::string(const RunResult&)> why;
};

Target at_least(const char* name, const char* printed, double goal, const char* note) {
    return {name, printed, goal, true, {}, note, ""};
}
Target at_most(const char* name, const char* printed, double goal, const char* note) {
    return {name, printed, goal, false, {}, note, ""};
}
using Run = const RunResult&;

std::vector<Told> costs_told_by(const Teller& teller) {
    auto uneven = [](Run) {
        return std::string("frames in which a key fades in, is begun or is finished, and the machine's own noise");
    };
    return {
        {at_least("speed-up of the mean frame over drawing everything at the high cut", "9.9", Printed::kSpeedUp,
                  "times, one run"),
         [&](Run run) { return teller.speed_up(run); }, [&](Run run) { return teller.why_slow(run); }},
        {at_least("the same in counted cost", "-", 15, "indices + 0.2 x pixels"), [&](Run run) { return teller.cost_ratio(run); },
         [&](Run run) { return teller.why_dear(run); }},
        {at_most("99th percentile of the frame times over the median", "19", 1.5, "680 / 36 ms in the paper"),
         [&](Run run) { return teller.p99_over_p50(run); }, uneven},
        {at_most("slowest frame over the high cut's median frame", "1.3", 1, "680 / 526 ms in the paper"),
         [&](Run run) { return teller.slowest(run); }, uneven},
        {at_least("triangles: high cut over frames between keyframes", "about 100", 100, "means"),
         [&](Run run) { return teller.novel_triangles(run); }, [&](Run run) { return teller.why_many_triangles(run); }},
        {at_least("triangles: high cut over all frames, keyframes included", "-", 33, "means"),
         [&](Run run) { return teller.triangles(run); }, [&](Run run) { return teller.why_many_with_keys(run); }},
    };
}

std::vector<Told> pictures_told_by(const Teller& teller) {
    auto nothing = [](Run) { return std::string(); };
    auto below = [](Run) { return std::string("by which parallaxes: below, where keys are held"); };
    constexpr double kShare = double(Printed::kKeyframes) / Printed::kFrames;
    return {
        {at_most("E, mean over frames, over the floor's", "-", 1.02, "LDR-FLIP, mean over pixels"),
         [&](Run run) { return teller.over_floor(run, "e_mean_flip", 0); },
         [&](Run run) {
             return teller.why_off_floor(run, "e_mean_flip", teller.over_floor(run, "e_mean_flip", first_key_frame(run)));
         }},
        {at_most("W, mean over frames, over the floor's", "-", 1.02, "change from frame to frame that should not be"),
         [&](Run run) { return teller.over_floor(run, "w_luma", 0); },
         [&](Run run) { return teller.why_off_floor(run, "w_luma", teller.over_floor(run, "w_luma", first_key_frame(run))); }},
        {at_most("E, 99th percentile, over the floor's", "-", 1.3, "over pixels, then over frames"),
         [&](Run run) { return teller.e_p99(run, 0); },
         [&](Run run) { return teller.why_off_floor(run, "e_p99_flip", teller.e_p99(run, first_key_frame(run))); }},
        {at_most("ghosts up to 32 px of parallax", "-", HeldGoals::kGhosts, "0.013 of a prototype of the paper"),
         [&](Run run) { return teller.ghosts(run); }, below},
        {at_most("losses up to 32 px of parallax", "-", HeldGoals::kLosses, "0.128 of a prototype of the paper"),
         [&](Run run) { return teller.losses(run); }, below},
        {at_most("share of keyframes", "0.0267", kShare, "16 of 600 in the paper; at 1 px"),
         [&](Run run) { return teller.keyframes(run); }, [&](Run run) { return teller.why_many_keys(run); }},
        {at_most("share of keyframes with the most frames over that with the fewest", "falls", 1, "figure 12"),
         [&](Run run) { return teller.fall(run); }, nothing},
    };
}

}  // namespace

double counted_cost(const Counters& counters, double picture_px) {
    return double(counters.vertex_reference_count) + 0.2 * (picture_px + double(counters.key_pixel_count));
}

std::vector<Target> targets_of(const Flown& flown) {
    Teller teller(flown);
    std::vector<const RunResult*> sprites = sprites_of(flown);
    std::vector<Target> targets;
    std::vector<Told> all = costs_told_by(teller), pictures = pictures_told_by(teller);
    std::move(pictures.begin(), pictures.end(), std::back_inserter(all));
    for (Told& told : all) {
        for (const RunResult* sprite : sprites) told.target.measured.push_back(told.measured(*sprite));
        size_t last = sprites.size() - 1;
        if (told.target.measured[last] && !told.target.is_reached(last)) told.target.why = told.why(*sprites[last]);
        targets.push_back(std::move(told.target));
    }
    return targets;
}

}  // namespace overlook::measure::paper::sprite
