#include "tools/measure/tables.h"

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "tools/measure/figures.h"
#include "tools/measure/methods.h"
#include "tools/measure/numbers/flip.h"
#include "tools/measure/numbers/frame_times.h"

namespace overlook::measure {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormVersion = 1;

Json json_of(const Percentiles& percentiles) {
    return {{"p50", percentiles.p50}, {"p95", percentiles.p95}, {"p99", percentiles.p99}, {"max", percentiles.max}};
}

Json json_of(const MissedDeadlines& missed) {
    return {{"count", missed.count}, {"longest_run", missed.longest_run}};
}

Json json_of(const PopIndex& pop) {
    return {{"index", pop.index},
            {"frame", pop.frame},
            {"tile_column", pop.tile_column},
            {"tile_row", pop.tile_row},
            {"excess_w_luma", pop.excess},
            {"floor_median_w_luma", pop.floor_median},
            {"median_w_luma", pop.method_median}};
}

Json json_of(const Honesty& honesty, size_t frames) {
    return {{"frames", frames},
            {"things", honesty.count},
            {"above_prediction", honesty.above_prediction},
            {"broken_zeros", honesty.broken_zeros},
            {"exact", honesty.exact},
            {"ratio_max", honesty.ratio_max},
            {"ratio_median", honesty.ratio_median},
            {"measured_max_px", honesty.measured_max_px},
            {"predicted_max_px", honesty.predicted_max_px},
            {"is_kept", is_honest(honesty)}};
}

Json summary_of(const RunResult& run) {
    Json summary = Json::object();
    for (const Figure& one : figures()) {
        std::vector<double> values = values_of(run, one);
        if (!values.empty()) summary[std::string(one.name)] = json_of(percentiles_of(std::span<const double>(values)));
    }
    return summary;
}

Json json_of(const RunResult& run, const std::vector<RunResult>& runs) {
    Json settings = Json::object();
    for (const auto& [name, value] : run.spec.settings) settings[name] = value;
    Json json = {{"run", run.label},
                 {"method", run.spec.name},
                 {"variant", run.spec.variant},
                 {"settings", settings},
                 {"is_floor", is_floor(run.spec)},
                 {"floor", runs[run.floor].label},
                 {"frames", run.frames.size()},
                 {"summary", summary_of(run)}};
    std::vector<double> times_ms = values_of(run, figure("frame_ms"));
    FrameTimes times = frame_times_of(times_ms);
    json["missed_deadlines"] = {{"16.7_ms", json_of(times.missed_60)}, {"33.3_ms", json_of(times.missed_30)}};
    json["gates"] = Json::array();
    for (const Gate& gate : gates_of(run)) {
        json["gates"].push_back({{"name", gate.name},
                                 {"value", gate.value},
                                 {"limit", gate.limit},
                                 {"is_least", gate.is_least},
                                 {"is_kept", gate.is_kept()}});
    }
    if (!run.worst_e.is_there) return json;
    json["pop"] = json_of(run.pop);
    if (run.g.all().count > 0) json["honesty"] = json_of(run.g.all(), values_of(run, figure("g_max")).size());
    json["is_at_floor"] = is_at_floor(run, runs[run.floor]);
    return json;
}

}  // namespace

std::string processor_name() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        size_t colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
    }
    return "unknown processor";
}

std::string frames_csv(const CourseResult& course, double step_s) {
    std::string csv = "run,frame,time_s";
    for (const Figure& one : figures()) csv += "," + std::string(one.name);
    csv += "\n";
    for (const RunResult& run : course.runs) {
        for (const FrameRecord& frame : run.frames) {
            csv += fmt::format("{},{},{}", run.label, frame.frame, frame.frame * step_s);
            for (const Figure& one : figures()) {
                std::optional<double> value = one.of(frame);
                csv += value ? fmt::format(",{}", *value) : ",";
            }
            csv += "\n";
        }
    }
    return csv;
}

std::string runs_csv(const CourseResult& course) {
    std::string csv =
        "run,method,is_floor,e_p99_flip,w_p99_luma,pop_index,frame_ms_p50,frame_ms_p99,triangles_p50,resident_bytes_max,"
        "predicted_error_px_max\n";
    for (const RunResult& run : course.runs) {
        Percentiles times_ms = percentiles_of(run, "frame_ms");
        csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", run.label, family_of(run.spec), is_floor(run.spec) ? 1 : 0,
                           percentiles_of(run, "e_p99_flip").p99, percentiles_of(run, "w_luma").p99, run.pop.index, times_ms.p50,
                           times_ms.p99, percentiles_of(run, "triangles").p50, percentiles_of(run, "resident_bytes").max,
                           percentiles_of(run, "predicted_error_px").max);
    }
    return csv;
}

std::string honesty_csv(const CourseResult& course) {
    std::map<std::string, HonestyTally> curves;
    for (const RunResult& run : course.runs) {
        if (run.g.all().count > 0) curves[family_of(run.spec)].add(run.g);
    }
    std::string csv = "method,promised_px,things,measured_p50_px,measured_p99_px,worst_px,worst_promised_px\n";
    for (const auto& [family, tally] : curves) {
        for (const HonestyBin& bin : tally.bins()) {
            if (!std::isfinite(bin.to_px) || bin.from_px == 0) continue;
            double middle_px = std::sqrt(bin.from_px * bin.to_px);
            csv += fmt::format("{},{},{},{},{},{},{}\n", family, middle_px, bin.count, bin.ratio_median * middle_px,
                               bin.ratio_p99 * middle_px, bin.worst_px, bin.worst_promised_px);
        }
    }
    return csv;
}

std::string runs_json(const CourseResult& course, const RunSetup& setup) {
    Json json = {
        {"form", "overlook runs"},
        {"form_version", kFormVersion},
        {"overlook", setup.version},
        {"command", setup.command},
        {"scene", {{"name", setup.scene}, {"content_hash", setup.scene_hash}}},
        {"flight", {{"name", setup.flight}, {"content_hash", setup.flight_hash}}},
        {"machine",
         {{"processor", setup.processor},
          {"threads", setup.processor_threads},
          {"renderer", setup.renderer.name},
          {"opengl", setup.renderer.version},
          {"is_software", setup.renderer.is_software}}},
        {"clock", setup.is_wall_clock ? "wall" : "logical"},
        {"step_s", setup.step_s},
        {"width_px", setup.width_px},
        {"height_px", setup.height_px},
        {"pixels_per_degree", kPixelsPerDegree},
        {"references",
         {{"supersampling", fmt::format("{0} x {0}", kSupersampling)},
          {"drawn", course.references_drawn},
          {"kept_from_before", course.references_kept},
          {"refused_as_damaged", course.references_damaged}}},
        {"runs", Json::array()},
    };
    for (const RunResult& run : course.runs) json["runs"].push_back(json_of(run, course.runs));
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace overlook::measure
