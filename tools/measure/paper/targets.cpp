#include "tools/measure/paper/targets.h"

#include <algorithm>
#include <functional>

#include "tools/measure/figures.h"

namespace overlook::measure::paper {
namespace {

using Value = std::optional<double>;

double mean_over(const RunResult& run, const std::function<double(const FrameRecord&)>& of) {
    double sum = 0;
    for (const FrameRecord& frame : run.frames) sum += of(frame);
    return sum / double(run.frames.size());
}

Value mean_of(const RunResult& run, std::string_view figure_name) {
    std::vector<double> values = values_of(run, figure(figure_name));
    if (values.empty()) return std::nullopt;
    double sum = 0;
    for (double value : values) sum += value;
    return sum / double(values.size());
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

Value slowest_against_high(const RunResult& high, const RunResult& run) {
    return ratio(percentiles_of(run, "frame_ms").max, percentiles_of(high, "frame_ms").p50);
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

}  // namespace

double counted_cost(const Counters& counters, double picture_px) {
    return double(counters.vertex_reference_count) + 0.2 * (picture_px + double(counters.key_pixel_count));
}

std::vector<Target> targets_of(const Flown& flown) {
    const RunResult &high = high_of(flown), &low = low_of(flown);
    double picture_px = flown.views.empty() ? 0 : double(flown.views[0].high.image.width) * flown.views[0].high.image.height;
    auto cost = [&](const RunResult& run) {
        return mean_over(run, [&](const FrameRecord& frame) { return counted_cost(frame.counters, picture_px); });
    };
    auto count = [](const RunResult& run) {
        return mean_over(run, [](const FrameRecord& frame) { return double(frame.counters.triangle_count); });
    };
    std::vector<Target> targets = {
        {"speed-up of the mean frame over drawing everything at the high cut", "9.9", 9.9, true, {}, "times, one run"},
        {"the same in counted cost: indices + 0.2 x pixels",
         "-",
         15,
         true,
         {},
         fmt::format("the low cut by itself: {:.1f}", cost(high) / cost(low))},
        {"99th percentile of the frame times over the median", "19", 1.5, false, {}, "680 / 36 ms in the paper"},
        {"slowest frame over the high cut's median frame", "1.3", 1, false, {}, "680 / 526 ms in the paper"},
        {"triangles: high cut over frames between keyframes",
         "about 100",
         100,
         true,
         {},
         fmt::format("the low cut by itself: {:.0f}", count(high) / count(low))},
        {"triangles: high cut over all frames, keyframes included", "-", 33, true, {}, "means"},
        {"E, mean over frames, over the floor's", "-", 1.02, false, {}, "LDR-FLIP, mean over pixels"},
        {"W, mean over frames, over the floor's", "-", 1.02, false, {}, ""},
        {"E, 99th percentile, over the floor's", "-", 1.3, false, {}, "over pixels, then over frames"},
        {"share of keyframes",
         fmt::format("{:.4f}", double(Printed::kKeyframes) / Printed::kFrames),
         double(Printed::kKeyframes) / Printed::kFrames,
         false,
         {},
         "at 1 px"},
        {"share of keyframes with the most frames over that with the fewest (figure 12)", "falls", 1, false, {}, ""},
    };
    for (const RunResult* sprite : sprites_of(flown)) {
        const RunResult& floor = flown.beside.runs[sprite->floor];
        Percentiles times_ms = percentiles_of(*sprite, "frame_ms");
        auto e_p99 = [](const RunResult& run) { return Value(percentiles_of(run, "e_p99_flip").p99); };
        std::string family = family_of(sprite->spec);
        const Value measured[] = {
            mean_ms(high) / mean_ms(*sprite),
            cost(high) / cost(*sprite),
            ratio(times_ms.p99, times_ms.p50),
            slowest_against_high(high, *sprite),
            novel_triangle_ratio(high, *sprite),
            count(high) / count(*sprite),
            ratio(mean_of(*sprite, "e_mean_flip"), mean_of(floor, "e_mean_flip")),
            ratio(mean_of(*sprite, "w_luma"), mean_of(floor, "w_luma")),
            ratio(e_p99(*sprite), e_p99(floor)),
            swept_from(*sprite, nullptr, kThreshold_px).keyframe_share(),
            fall_of_keyframes(flown, family),
        };
        for (size_t i = 0; i < targets.size(); ++i) targets[i].measured.push_back(measured[i]);
    }
    return targets;
}

}  // namespace overlook::measure::paper
