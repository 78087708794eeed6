#include "runtime/player/report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
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

void put_planting(const wang_ldi::FrameCounts& planting, Json& json) {
    const wang_ldi::FieldCounts& field = planting.field;
    json["tiles"] = field.tiles_listed;
    json["far_blocks"] = field.blocks_listed;
    json["eye_outside_cell"] = planting.is_eye_outside;
    json["outside_cell_tiles"] = field.outside_cell;
    json["cut_tiles"] = field.cut_tiles;
    json["displaced_tiles"] = field.displaced_tiles;
    json["planting_error_px"] = planting.planting_error_px;
    json["near_plants"] = planting.plants.plant_count;
    json["images"] = planting.images.images;
    json["stand_in_images"] = planting.images.stand_ins;
    json["missing_images"] = planting.images.missing;
    json["samples_listed"] = field.samples;
    json["samples_warped"] = planting.warp.samples;
    json["samples_drawn"] = planting.warp.samples_drawn;
    json["holes_filled_px"] = planting.holes_filled;
    json["pixels_written"] = planting.warp.pixels_written;
    json["times_listed"] = planting.times_listed;
    json["list_ms"] = planting.list_ms;
    json["warp_ms"] = planting.warp_ms;
    json["plants_by_processor"] = planting.are_plants_by_processor;
    json["plants_ms"] = planting.plants_ms;
    json["warp_threads"] = planting.threads;
    json["warped_by_card"] = planting.is_warped_by_card;
    json["latency_frames"] = planting.latency_frames;
}

void put_stream(const FrameRecord& frame, Json& json) {
    const StreamRecord& stream = *frame.stream;
    bool is_mesh = frame.mesh.has_value();
    const char* what = is_mesh ? "blocks" : frame.planting ? "images" : "tiles";
    json["resident_bytes"] = stream.counts.resident_bytes;
    json["streamed_bytes"] = stream.counts.uploaded_bytes;
    json[fmt::format("asked_{}", what)] = stream.counts.asked_count;
    json[fmt::format("refused_{}", what)] = stream.counts.refused_count;
    json[fmt::format("dropped_{}", what)] = stream.counts.dropped_count;
    if (is_mesh) {
        json["blocks"] = stream.block_count;
        json["resident_blocks"] = stream.resident_block_count;
        json["missing_error_px"] = frame.mesh->missing_px;
    } else if (!frame.planting) {
        json["stopped_triangles"] = stream.stopped_count;
    }
}

Json frame_json(const FrameRecord& frame) {
    Json json = {{"triangles", frame.triangle_count},
                 {"void_rim_triangles", frame.void_rim_triangle_count},
                 {"tested", frame.tested_count},
                 {"refine_ms", frame.refine_ms},
                 {"draw_ms", frame.draw_ms},
                 {"uploaded_bytes", frame.uploaded_bytes},
                 {"asked_error_px", frame.asked_error_px},
                 {"predicted_error_px", frame.predicted_error_px}};
    if (frame.mesh) {
        json["splits"] = frame.mesh->split_count;
        json["forced_splits"] = frame.mesh->forced_count;
        json["collapses"] = frame.mesh->collapse_count;
        json["wrong_corners"] = frame.mesh->wrong_corner_count;
        json["camera_bytes"] = frame.mesh->camera_bytes;
        json["settled"] = frame.mesh->is_settled;
    }
    if (frame.chain) {
        json["instances_in_view"] = frame.chain->in_view_count;
        json["changes_begun"] = frame.chain->begun_count;
        json["under_way"] = frame.chain->fading_count;
        json["draw_calls"] = frame.chain->draw_call_count;
        json["settled_triangles"] = frame.chain->settled_triangle_count;
    }
    if (frame.planting) put_planting(*frame.planting, json);
    if (frame.stream) put_stream(frame, json);
    if (!frame.sprite) return json;
    const lod_sprite::FrameCounts& sprite = *frame.sprite;
    json["key_triangles"] = sprite.key_triangle_count;
    json["key_pixels"] = sprite.key_pixel_count;
    json["keys"] = sprite.live_key_count;
    json["rekeyed"] = std::string(lod_sprite::name_of(sprite.rekeyed));
    json["lost_share"] = sprite.lost_share;
    return json;
}

bool has_sprites(const std::vector<FrameRecord>& frames) {
    return std::any_of(frames.begin(), frames.end(), [](const FrameRecord& frame) { return frame.sprite.has_value(); });
}

// Frames with which a new key took over, for this reason; for any without one.
uint64_t rekeyed_count(const std::vector<FrameRecord>& frames, std::optional<lod_sprite::Cause> cause) {
    return uint64_t(std::count_if(frames.begin(), frames.end(), [&](const FrameRecord& frame) {
        if (!frame.sprite || frame.sprite->rekeyed == lod_sprite::Cause::none) return false;
        return !cause || frame.sprite->rekeyed == *cause;
    }));
}

uint64_t key_triangles(const std::vector<FrameRecord>& frames) {
    uint64_t sum = 0;
    for (const FrameRecord& frame : frames) sum += frame.sprite ? frame.sprite->key_triangle_count : 0;
    return sum;
}

constexpr std::array<lod_sprite::Cause, 5> kCauses = {lod_sprite::Cause::first, lod_sprite::Cause::jump, lod_sprite::Cause::error,
                                                      lod_sprite::Cause::magnified, lod_sprite::Cause::turned};

// {"first": 1, "error": 3, ...}: how often why.
Json causes_of(const std::vector<FrameRecord>& frames) {
    Json causes = Json::object();
    for (lod_sprite::Cause cause : kCauses) causes[std::string(lod_sprite::name_of(cause))] = rekeyed_count(frames, cause);
    return causes;
}

// ", 4 keyframes of 81,920 triangles in all (1 first, 3 error)", or nothing.
std::string keyframes_text(const std::vector<FrameRecord>& frames) {
    if (!has_sprites(frames)) return "";
    std::string why;
    for (lod_sprite::Cause cause : kCauses) {
        uint64_t count = rekeyed_count(frames, cause);
        if (count > 0) why += fmt::format("{}{} {}", why.empty() ? " (" : ", ", count, lod_sprite::name_of(cause));
    }
    uint64_t keyframes = rekeyed_count(frames, std::nullopt);
    return fmt::format(", {} keyframe{} of {} triangles in all{}", with_commas(keyframes), keyframes == 1 ? "" : "s",
                       with_commas(key_triangles(frames)), why.empty() ? "" : why + ")");
}

// ", 1,234,567 samples of 300 tiles warped in 12.3 ms by 2 threads; ...", or nothing.
std::string planting_text(const std::vector<FrameRecord>& frames) {
    if (!frames.front().planting) return "";
    auto middle = [&](auto value) {
        return percentile(values_of(frames, [&](const FrameRecord& frame) { return double(value(*frame.planting)); }), 0.5);
    };
    using Counts = wang_ldi::FrameCounts;
    std::string text = fmt::format(", {} samples of {} tiles warped in {:.1f} ms by {} thread{}",
                                   with_commas(uint64_t(middle([](const Counts& c) { return c.warp.samples; }))),
                                   with_commas(uint64_t(middle([](const Counts& c) { return c.field.tiles_listed; }))),
                                   middle([](const Counts& c) { return c.warp_ms; }), frames.front().planting->threads,
                                   frames.front().planting->threads == 1 ? "" : "s");
    auto most = [&](auto value) {
        return uint64_t(
            percentile(values_of(frames, [&](const FrameRecord& frame) { return double(value(*frame.planting)); }), 1));
    };
    uint64_t outside = uint64_t(
        std::count_if(frames.begin(), frames.end(), [](const FrameRecord& frame) { return frame.planting->is_eye_outside; }));
    uint64_t lacking = most([](const Counts& c) { return c.images.stand_ins + c.images.missing; });
    if (outside > 0) text += fmt::format(", {} from heights that images were not sampled for", with_commas(outside));
    if (lacking > 0) text += fmt::format(", up to {} images not there yet", with_commas(lacking));
    return text;
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
        {"method", std::string(name_of(plan.method.value_or(Method::terrain)))},
        {"error_px", plan.options.error_px},
        {"morph", plan.options.morph},
        {"summary", summaries(frames)},
        {"frames", Json::array()},
    };
    if (has_sprites(frames)) {
        report["keyframes"] = {
            {"count", rekeyed_count(frames, std::nullopt)}, {"triangles", key_triangles(frames)}, {"causes", causes_of(frames)}};
    }
    for (const FrameRecord& frame : frames) report["frames"].push_back(frame_json(frame));
    return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string summary_line(const Plan& plan, const gl::Renderer& renderer, const std::vector<FrameRecord>& frames) {
    if (frames.empty()) return "no frame was drawn";
    auto middle = [&](auto member) {
        return percentile(values_of(frames, [member](const FrameRecord& frame) { return double(frame.*member); }), 0.5);
    };
    return fmt::format(
        "{} frame{} of {} triangles{}{}, refined in {:.2f} ms, drawn in {:.1f} ms by {}{}; error asked {} px, predicted "
        "{:.2f} px",
        with_commas(frames.size()), frames.size() == 1 ? "" : "s", with_commas(uint64_t(middle(&FrameRecord::triangle_count))),
        keyframes_text(frames), planting_text(frames), middle(&FrameRecord::refine_ms), middle(&FrameRecord::draw_ms),
        renderer.name, renderer.is_software ? " (software)" : "", plan.options.error_px,
        middle(&FrameRecord::predicted_error_px));
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
