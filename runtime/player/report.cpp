#include "runtime/player/report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <utility>

#include "formats/atomic_file.h"
#include "formats/numbers.h"

namespace overlook::player {
namespace {

using Json = nlohmann::ordered_json;

std::vector<double> values_of(const std::vector<FrameRecord>& frames, const std::function<double(const FrameRecord&)>& value) {
    std::vector<double> values;
    for (const FrameRecord& frame : frames) values.push_back(value(frame));
    return values;
}

Json summary_of(const std::vector<double>& values) {
    return {{"p50", percentile(values, 0.50)},
            {"p95", percentile(values, 0.95)},
            {"p99", percentile(values, 0.99)},
            {"max", percentile(values, 1.00)}};
}

Json frame_json(const FrameRecord& frame) {
    return {{"triangles", frame.triangle_count},
            {"void_rim_triangles", frame.void_rim_triangle_count},
            {"tested", frame.tested_count},
            {"refine_ms", frame.refine_ms},
            {"draw_ms", frame.draw_ms},
            {"uploaded_bytes", frame.uploaded_bytes},
            {"asked_error_px", frame.asked_error_px},
            {"predicted_error_px", frame.predicted_error_px}};
}

Json summaries(const std::vector<FrameRecord>& frames) {
    auto of = [&](auto member) {
        return summary_of(values_of(frames, [member](const FrameRecord& frame) { return double(frame.*member); }));
    };
    return {{"triangles", of(&FrameRecord::triangle_count)},      {"tested", of(&FrameRecord::tested_count)},
            {"refine_ms", of(&FrameRecord::refine_ms)},           {"draw_ms", of(&FrameRecord::draw_ms)},
            {"uploaded_bytes", of(&FrameRecord::uploaded_bytes)}, {"predicted_error_px", of(&FrameRecord::predicted_error_px)}};
}

}  // namespace

double percentile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    size_t rank = size_t(std::ceil(share * double(values.size())));
    return values[std::clamp<size_t>(rank, 1, values.size()) - 1];
}

std::string report_json(const Plan& plan, const gl::Renderer& renderer, const std::vector<FrameRecord>& frames) {
    Json report = {
        {"file", plan.options.file.substr(plan.options.file.rfind('/') + 1)},
        {"renderer", {{"name", renderer.name}, {"opengl", renderer.version}, {"software", renderer.is_software}}},
        {"width_px", plan.width_px},
        {"height_px", plan.height_px},
        {"samples", plan.options.samples},
        {"error_px", plan.options.error_px},
        {"morph", plan.options.morph},
        {"summary", summaries(frames)},
        {"frames", Json::array()},
    };
    for (const FrameRecord& frame : frames) report["frames"].push_back(frame_json(frame));
    return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string summary_line(const Plan& plan, const gl::Renderer& renderer, const std::vector<FrameRecord>& frames) {
    if (frames.empty()) return "no frame was drawn";
    auto middle = [&](auto member) {
        return percentile(values_of(frames, [member](const FrameRecord& frame) { return double(frame.*member); }), 0.5);
    };
    return fmt::format(
        "{} frame{} of {} triangles, refined in {:.2f} ms, drawn in {:.1f} ms by {}{}; error asked {} px, predicted "
        "{:.2f} px",
        with_commas(frames.size()), frames.size() == 1 ? "" : "s", with_commas(uint64_t(middle(&FrameRecord::triangle_count))),
        middle(&FrameRecord::refine_ms), middle(&FrameRecord::draw_ms), renderer.name, renderer.is_software ? " (software)" : "",
        plan.options.error_px, middle(&FrameRecord::predicted_error_px));
}

Result<void> deliver_report(const Plan& plan, const command::Common& common, const gl::Renderer& renderer,
                            const std::vector<FrameRecord>& frames) {
    std::string json = report_json(plan, renderer, frames);
    if (!plan.options.report.empty()) {
        if (Result<void> written = write_file(plan.options.report, std::string_view(json)); !written) return written;
    }
    if (common.json) std::fputs(json.c_str(), stdout);
    command::note(common, "player: " + summary_line(plan, renderer, frames));
    return {};
}

}  // namespace overlook::player
