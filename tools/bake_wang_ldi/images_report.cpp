#include <nlohmann/json.hpp>

#include "formats/numbers.h"
#include "tools/bake_wang_ldi/images.h"

namespace overlook::bake_wang_ldi {
namespace {

using nlohmann::ordered_json;
using wang_ldi::ImageRow;
using wang_ldi::Judgement;

// Sums over images.
struct Total {
    uint64_t images = 0, samples = 0, bytes = 0, rays = 0, hits = 0;
    double unseen_most = 0, unseen_sum = 0;
    Judgement own, foreign;

    void add(const ImageRow& row) {
        ++images, samples += row.samples, bytes += row.stored_bytes, rays += row.rays, hits += row.hits;
        unseen_most = std::max(unseen_most, row.unseen_share), unseen_sum += row.unseen_share;
        own.add(row.judgement), foreign.add(row.foreign);
    }
};

ordered_json judgement_json(const Judgement& judgement) {
    auto pixels = double(std::max<uint64_t>(1, judgement.pixels));
    return {{"pixels", judgement.pixels},
            {"hole_share", double(judgement.holes) / pixels},
            {"deeper_share", double(judgement.deeper) / pixels},
            {"nearer_share", double(judgement.nearer) / pixels},
            {"filled_hole_share", double(judgement.holes_left) / pixels},
            {"covered_times", judgement.covered_times()},
            {"filled_covered_times", judgement.covered_times_filled()},
            {"e_mean", judgement.mean_error()},
            {"e_p99", judgement.p99_error()},
            {"unfilled_e_mean", judgement.mean_unfilled_error()}};
}

ordered_json total_json(const Total& total) {
    ordered_json json{{"images", total.images},
                      {"samples", total.samples},
                      {"bytes", total.bytes},
                      {"bytes_per_sample", total.samples > 0 ? double(total.bytes) / double(total.samples) : 0},
                      {"rays", total.rays},
                      {"hits", total.hits},
                      {"unseen_share_mean", total.images > 0 ? total.unseen_sum / double(total.images) : 0},
                      {"unseen_share_most", total.unseen_most}};
    if (total.own.error_pixels > 0) json["among_its_neighbours"] = judgement_json(total.own);
    if (total.foreign.error_pixels > 0) json["among_foreign_neighbours"] = judgement_json(total.foreign);
    return json;
}

Total total_of(const wang_ldi::ImageReport& report) {
    Total total;
    for (const ImageRow& row : report.rows) total.add(row);
    return total;
}

ordered_json textures_json(const wang_ldi::ImageReport& report) {
    uint64_t rays = 0, hits = 0, pixels = 0;
    double unseen = 0, unseen_most = 0, error = 0, error_most = 0, coverage = 0, drawn = 0, off = 0;
    for (const wang_ldi::TextureRow& row : report.textures) {
        rays += row.rays, hits += row.hits, unseen += row.unseen_share, error += row.standard_error;
        unseen_most = std::max(unseen_most, row.unseen_share), error_most = std::max(error_most, row.standard_error);
        auto of = double(row.judgement.pixels);
        pixels += row.judgement.pixels, off += of * row.judgement.mean_error;
        coverage += row.judgement.coverage, drawn += row.judgement.drawn_coverage;
    }
    auto count = double(std::max<size_t>(1, report.textures.size()));
    ordered_json json{{"count", report.textures.size()},
                      {"side_px", report.texture_side_px},
                      {"rays", rays},
                      {"hits", hits},
                      {"unseen_share_mean", unseen / count},
                      {"unseen_share_most", unseen_most},
                      {"standard_error_mean", error / count},
                      {"standard_error_most", error_most}};
    if (pixels > 0)
        json["judged"] = {{"pixels", pixels},
                          {"coverage", coverage / count},
                          {"drawn_coverage", drawn / count},
                          {"mean_luma_error", off / double(pixels)}};
    return json;
}

ordered_json rate_json(const wang_ldi::Rate& rate) {
    return {{"rays", rate.rays},
            {"shadow_rays", rate.shadow_rays},
            {"sampled_s", rate.sampled_s},
            {"bare_s", rate.bare_s},
            {"lit_s", rate.lit_s},
            {"bare_shadow_s", rate.bare_shadow_s},
            {"sampling_share", rate.sampling_share()},
            {"share", rate.share()}};
}

std::string rate_in_words(const wang_ldi::Rate& rate) {
    auto million_a_second = [](uint64_t rays, double seconds) { return double(rays) / std::max(seconds, 1e-9) * 1e-6; };
    return fmt::format(
        "sampled at {:.1f} % of the rate of the same rays alone ({:.2f} of {:.2f} million a second and core), lit at {:.1f} % "
        "({:.2f} of {:.2f} million shadow rays), together {:.1f} %",
        100 * rate.sampling_share(), million_a_second(rate.rays, rate.sampled_s), million_a_second(rate.rays, rate.bare_s),
        100 * rate.bare_shadow_s / std::max(rate.lit_s, 1e-9), million_a_second(rate.shadow_rays, rate.lit_s),
        million_a_second(rate.shadow_rays, rate.bare_shadow_s), 100 * rate.share());
}

}  // namespace

std::string images_json(const wang_ldi::ImageReport& report) {
    ordered_json json = total_json(total_of(report));
    json["directions"] = report.set.direction_count, json["contexts"] = report.set.context_count;
    json["eyes_m"] = {report.set.cell.eye_low_m, report.set.cell.eye_high_m};
    json["distances_m"] = {report.set.cell.nearest_m, report.set.cell.farthest_m};
    if (report.trial_tiles > 0) json["trial_tiles"] = report.trial_tiles;
    json["images_above_goal"] = report.above_goal;
    json["taken_from_parts"] = report.taken_from_parts, json["baked"] = report.made, json["seconds"] = report.seconds;
    if (report.rate.bare_s > 0) json["rate"] = rate_json(report.rate);
    if (report.texture_side_px > 0) json["textures"] = textures_json(report);
    if (report.leaves.masked_before > 0)
        json["leaves"] = {{"masked_triangles", report.leaves.masked_before},
                          {"trimmed_to", report.leaves.masked_after},
                          {"without_holes", report.leaves.solid},
                          {"area_m2", report.leaves.area_before_m2},
                          {"trimmed_area_m2", report.leaves.area_after_m2}};
    for (uint32_t k = 0; k < report.set.levels.size(); ++k) {
        const wang_ldi::Level& level = report.set.levels[k];
        Total of_level;
        std::vector<Total> of_directions(report.set.direction_count);
        for (const ImageRow& row : report.rows) {
            if (row.which.level != k) continue;
            of_level.add(row), of_directions[row.which.direction].add(row);
        }
        ordered_json one{{"side_px", level.side_px}, {"nearest_m", level.nearest_m}, {"height_step_m", level.height_step_m}};
        one.update(total_json(of_level));
        for (const Total& total : of_directions)
            if (total.images > 0) one["by_direction"].push_back(total_json(total));
        json["levels"].push_back(one);
    }
    return json.dump();
}

void say_images(const wang_ldi::ImageReport& report, const command::Common& common) {
    if (report.rows.empty()) {
        command::note(common, fmt::format("{} images baked, {} were there", with_commas(report.made),
                                          with_commas(report.taken_from_parts)));
        return;
    }
    Total total = total_of(report);
    command::note(
        common,
        fmt::format("{} images of {} levels and {} directions: {} samples, {:.2f} bytes each; {} rays, {:.1f} s", total.images,
                    report.set.levels.size(), report.set.direction_count, with_commas(total.samples),
                    double(total.bytes) / double(std::max<uint64_t>(1, total.samples)), with_commas(total.rays), report.seconds));
    command::note(common,
                  fmt::format("unseen: {:.2f} % on average, {:.2f} % at most; right for eyes {} to {} m up, {:.1f} to {:.1f} m "
                              "from a tile's middle",
                              100 * total.unseen_sum / double(total.images), 100 * total.unseen_most, report.set.cell.eye_low_m,
                              report.set.cell.eye_high_m, report.set.cell.nearest_m, report.set.cell.farthest_m));
    if (report.above_goal > 0)
        command::note(common, fmt::format("{} of {} images have more unseen than --unseen asks for, {:.2f} % at most: they took "
                                          "the most rays that are shot; ask for more error or a greater nearest distance",
                                          report.above_goal, total.images, 100 * total.unseen_most));
    if (report.rate.bare_s > 0) command::note(common, rate_in_words(report.rate));
    if (total.own.error_pixels > 0) {
        auto share = [](uint64_t of, const Judgement& all) {
            return 100 * double(of) / double(std::max<uint64_t>(1, all.pixels));
        };
        for (const Judgement* judged : {&total.own, &total.foreign})
            command::note(common, fmt::format("warped among {} neighbours: holes in {:.2f} % of pixels, {:.2f} % when filled; "
                                              "{:.2f} times as much covered; E {:.3f}, p99 {:.3f}",
                                              judged == &total.own ? "its own" : "foreign", share(judged->holes, *judged),
                                              share(judged->holes_left, *judged), judged->covered_times_filled(),
                                              judged->mean_error(), judged->p99_error()));
    }
    if (report.texture_side_px > 0) {
        ordered_json textures = textures_json(report);
        command::note(common, fmt::format("{} textures of {} texels a side; {} rays", report.textures.size(),
                                          report.texture_side_px, with_commas(textures["rays"].get<uint64_t>())));
    }
    if (report.taken_from_parts > 0)
        command::detail(common, fmt::format("{} images were done before", with_commas(report.taken_from_parts)));
}

}  // namespace overlook::bake_wang_ldi
