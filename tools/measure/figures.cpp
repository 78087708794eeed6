#include "tools/measure/figures.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "tools/measure/methods.h"

namespace overlook::measure {
namespace {

using R = const FrameRecord&;
using O = std::optional<double>;

constexpr double kMostPopIndex = 1.2;
constexpr double kAtFloor = 1.02;
constexpr double kBudgetBand = 0.05;  // as S19 of the stability suite, and
constexpr uint32_t kSettledFrames = 20;

// Of G, where there is any.
template <class Value>
std::optional<double> of_g(R record, Value value) {
    return record.numbers.g ? std::optional(double(value(*record.numbers.g))) : std::nullopt;
}

constexpr std::array<Figure, 38> kFigures = {{
    {"e_p99_flip", "LDR-FLIP against the reference, 99th percentile over pixels", [](R r) -> O { return r.numbers.e_p99; }, true},
    {"e_mean_flip", "the same, mean over pixels", [](R r) -> O { return r.numbers.e_mean; }, true},
    {"w_luma", "change from frame to frame that the reference does not have", [](R r) -> O { return r.numbers.w; }, true},
    {"s_p95_px", "distance of the outlines from the reference's, 95th percentile", [](R r) -> O { return r.numbers.s_p95_px; },
     true},
    {"s_max_px", "the same, greatest", [](R r) -> O { return r.numbers.s_max_px; }, true},
    {"hole_px", "pixels that show through what should be there", [](R r) -> O { return r.numbers.hole_count; }, true},
    {"hole_allowed_px", "pixels that would be holes, but for the error that was promised",
     [](R r) -> O { return r.numbers.hole_allowed_count; }, true},
    {"ghost_share", "of the surface's pixels, those shown from a keyframe that did not see them",
     [](R r) -> O { return r.numbers.ghost_share; }, true},
    {"loss_share", "of the surface's pixels, those that a keyframe saw but none shows; near geometry is neither",
     [](R r) -> O { return r.numbers.loss_share; }, true},
    {"near_share", "of the surface's pixels, those drawn as geometry on purpose", [](R r) -> O { return r.numbers.near_share; },
     true},
    {"psnr_db", "peak signal to noise against the reference", [](R r) -> O { return r.numbers.psnr_db; }, true},
    {"luma_difference", "mean absolute difference of luma, 0..1", [](R r) -> O { return r.numbers.luma_difference; }, true},
    {"frame_ms", "deciding and drawing", [](R r) -> O { return r.frame_ms(); }, false},
    {"decide_ms", "deciding what to draw", [](R r) -> O { return r.decide_ms; }, false},
    {"draw_ms", "submitting and waiting until it is drawn", [](R r) -> O { return r.draw_ms; }, false},
    {"triangles", "submitted", [](R r) -> O { return double(r.counters.triangle_count); }, true},
    {"vertex_references", "indices submitted", [](R r) -> O { return double(r.counters.vertex_reference_count); }, true},
    {"draw_calls", "", [](R r) -> O { return double(r.counters.draw_call_count); }, true},
    {"uploaded_bytes", "sent to the renderer", [](R r) -> O { return double(r.counters.uploaded_bytes); }, true},
    {"tested", "places looked at to decide", [](R r) -> O { return double(r.counters.tested_count); }, true},
    {"resident_bytes", "in the renderer's memory", [](R r) -> O { return double(r.counters.resident_bytes); }, true},
    {"streamed_bytes", "of what is streamed, there: what its budget counts",
     [](R r) -> O { return double(r.counters.streamed_bytes); }, true},
    {"events", "sudden changes that the method knows of", [](R r) -> O { return double(r.counters.event_count); }, true},
    {"key_triangles", "of the triangles, those drawn into keyframes",
     [](R r) -> O { return double(r.counters.key_triangle_count); }, true},
    {"key_pixels", "of keyframes, drawn besides the picture's own", [](R r) -> O { return double(r.counters.key_pixel_count); },
     true},
    {"operations", "splits and collapses, of all cameras", [](R r) -> O { return double(r.counters.operation_count); }, true},
    {"transitions", "instances on their way from level to level", [](R r) -> O { return double(r.counters.transition_count); },
     true},
    {"samples_warped", "of layered depth images", [](R r) -> O { return double(r.counters.sample_count); }, true},
    {"tiles", "of planted ground, drawn by layered depth images", [](R r) -> O { return double(r.counters.tile_count); }, true},
    {"outside_tiles", "of those, seen from where they were not sampled for",
     [](R r) -> O { return double(r.counters.outside_count); }, true},
    {"missing_images", "for which another stood in, or none", [](R r) -> O { return double(r.counters.missing_count); }, true},
    {"camera_bytes", "what cameras keep in main memory beside what they share",
     [](R r) -> O { return double(r.counters.camera_bytes); }, true},
    {"wrong_corners", "corners of triangles drawn with the attributes of another face",
     [](R r) -> O { return double(r.counters.wrong_corner_count); }, true},
    {"predicted_error_px", "what the method promises of this frame", [](R r) -> O { return r.counters.predicted_error_px; },
     true},
    {"g_max", "measured over predicted displacement of a thing drawn, greatest",
     [](R r) -> O { return of_g(r, [](const Honesty& g) { return g.ratio_max; }); }, true},
    {"g_median", "the same, median", [](R r) -> O { return of_g(r, [](const Honesty& g) { return g.ratio_median; }); }, true},
    {"g_above", "things displaced by more than predicted",
     [](R r) -> O { return of_g(r, [](const Honesty& g) { return g.above_prediction; }); }, true},
    {"g_measured_px", "greatest displacement measured",
     [](R r) -> O { return of_g(r, [](const Honesty& g) { return g.measured_max_px; }); }, true},
}};

double settled_triangles(const RunResult& run) {
    double most = 0;
    for (const FrameRecord& frame : run.frames) {
        if (frame.frame >= kSettledFrames) most = std::max(most, double(frame.counters.triangle_count));
    }
    return most;
}

}  // namespace

std::span<const Figure> figures() {
    return kFigures;
}

const Figure& figure(std::string_view name) {
    auto found = std::find_if(kFigures.begin(), kFigures.end(), [&](const Figure& one) { return one.name == name; });
    assert(found != kFigures.end());
    return *found;
}

std::vector<double> values_of(const RunResult& run, const Figure& figure) {
    std::vector<double> values;
    for (const FrameRecord& frame : run.frames) {
        if (std::optional<double> value = figure.of(frame)) values.push_back(*value);
    }
    return values;
}

Percentiles percentiles_of(const RunResult& run, std::string_view figure_name) {
    return percentiles_of(values_of(run, figure(figure_name)));
}

std::optional<double> mean_of(const RunResult& run, std::string_view figure_name) {
    std::vector<double> values = values_of(run, figure(figure_name));
    if (values.empty()) return std::nullopt;
    double sum = 0;
    for (double value : values) sum += value;
    return sum / double(values.size());
}

std::vector<Gate> gates_of(const RunResult& run) {
    std::vector<Gate> gates;
    if (values_of(run, figure("hole_px")).empty()) return gates;
    gates.push_back({"hole_px", percentiles_of(run, "hole_px").max, 0});
    gates.push_back({"pop_index", run.pop.index, kMostPopIndex});
    double budget = budget_of(run.spec);
    if (budget > 0) gates.push_back({"triangles", settled_triangles(run), (1 + kBudgetBand) * budget});
    for (const auto& [name, value] : run.spec.settings) {
        if (name == "error-px" && budget == 0)
            gates.push_back({"predicted_error_px", percentiles_of(run, "predicted_error_px").max, value});
    }
    if (run.g.all().count > 0) gates.push_back({"g_max", run.g.all().ratio_max, 1});
    if (has_ratios(run.g.all())) gates.push_back({"g_median", run.g.all().ratio_median, kIdleRatio, true});
    return gates;
}

bool is_at_floor(const RunResult& run, const RunResult& floor) {
    return percentiles_of(run, "e_p99_flip").p99 <= kAtFloor * percentiles_of(floor, "e_p99_flip").p99;
}

}  // namespace overlook::measure
