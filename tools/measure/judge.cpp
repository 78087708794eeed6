#include "tools/measure/judge.h"

#include <algorithm>
#include <set>

#include "tools/measure/numbers/flip.h"
#include "tools/measure/numbers/silhouette.h"

namespace overlook::measure {
namespace {

ImageRgb8 picture_of(const Frame& frame) {
    return {frame.width, frame.height, frame.rgb};
}

void remember(WorstFrame& worst, uint32_t frame, double value, const Frame& test, const Frame& reference) {
    worst.is_there = true;
    worst.frame = frame;
    worst.value = value;
    worst.test = picture_of(test);
    worst.reference = picture_of(reference);
}

// W of each tile over all of its pixels: where in the frame it changed.
std::vector<float> map_of(const TemporalError& error, uint32_t width, uint32_t height) {
    std::vector<float> map(size_t(width) * height);
    for (size_t i = 0; i < map.size(); ++i) {
        size_t column = i % width / kTilePx, row = i / width / kTilePx;
        map[i] = std::min(1.0f, error.tiles[row * error.columns + column] / float(kMostShownW));
    }
    return map;
}

// The holes of all things in the frame.
HolePixels holes_of(const Frame& test, const Frame& reference, const HoleRule& rule) {
    std::set<uint32_t> things(reference.ids.begin(), reference.ids.end());
    things.erase(kBackground);
    HolePixels all;
    for (uint32_t thing : things) {
        HolePixels holes = hole_pixels(test, reference, thing, rule);
        all.count += holes.count;
        all.allowed += holes.allowed;
        all.needs_surroundings |= holes.needs_surroundings;
    }
    return all;
}

}  // namespace

double promised_px(const MethodSpec& spec, const Counters& counters) {
    auto value_of = [&](std::string_view name) {
        auto one = std::find_if(spec.settings.begin(), spec.settings.end(), [&](const auto& each) { return each.first == name; });
        return one == spec.settings.end() ? 0 : one->second;
    };
    // A budget of triangles raises the error where it must: then the frame's own promise is all there is.
    return value_of("triangles") > 0 ? counters.predicted_error_px : std::min(value_of("error-px"), counters.predicted_error_px);
}

Result<void> judge_picture(const Frame& test, const Frame& reference, const HoleRule& rule, const Surroundings& around,
                           Numbers& numbers) {
    numbers.psnr_db = psnr_db(rgb_of(test), rgb_of(reference));
    numbers.luma_difference = luma_difference_mean(rgb_of(test), rgb_of(reference));
    SilhouetteError outline = silhouette_error(test, reference);
    numbers.s_p95_px = outline.p95_px;
    numbers.s_max_px = outline.max_px;

    HolePixels holes = holes_of(test, reference, rule);
    if (holes.needs_surroundings) {
        Result<Frame> wide = around(surroundings_px(rule.promised_px));
        if (!wide) return tl::unexpected(wide.error());
        HoleRule with_surroundings = rule;
        with_surroundings.around = &*wide;
        holes = holes_of(test, reference, with_surroundings);
    }
    numbers.hole_count = double(holes.count);
    numbers.hole_allowed_count = double(holes.allowed);
    return {};
}

void judge_e(const Frame& test, const Frame& reference, FrameRecord& record, WorstFrame& worst) {
    FlipError error = flip(rgb_of(test), rgb_of(reference));
    record.numbers.e_p99 = error.p99;
    record.numbers.e_mean = error.mean;
    if (worst.is_there && error.p99 <= worst.value) return;
    remember(worst, record.frame, error.p99, test, reference);
    worst.map = std::move(error.map);
}

TemporalError judge_w(const Motion& motion, const Frame& before, const Frame& now, const Frame& reference_before,
                      const Frame& reference_now, FrameRecord& record, WorstFrame& worst) {
    TemporalError error = temporal_error(motion, rgb_of(before), rgb_of(now), rgb_of(reference_before), rgb_of(reference_now));
    error.frame = record.frame;
    record.numbers.w = error.mean;
    if (worst.is_there && error.mean <= worst.value) return error;
    remember(worst, record.frame, error.mean, now, reference_now);
    worst.map = map_of(error, now.width, now.height);
    return error;
}

}  // namespace overlook::measure
