#include "tools/measure/paper/wang_ldi/report.h"

#include <nlohmann/json.hpp>

#include "formats/mapped_file.h"

namespace overlook::measure::paper::wang {
namespace {

using nlohmann::json;

std::optional<Judged> judged_of(const json& level, const char* among) {
    if (!level.contains(among)) return std::nullopt;
    const json& of = level.at(among);
    auto said = [&](const char* name) { return of.contains(name) ? std::optional<double>(of.at(name)) : std::nullopt; };
    return Judged{of.at("hole_share"), of.at("filled_hole_share"), of.at("deeper_share"), of.at("e_mean"),
                  of.at("e_p99"),      of.at("unfilled_e_mean"),   said("covered_times"), said("filled_covered_times")};
}

LevelReport level_of(const json& of) {
    LevelReport level;
    level.images = of.at("images"), level.samples = of.at("samples"), level.bytes = of.at("bytes"), level.rays = of.at("rays");
    level.unseen_share_mean = of.at("unseen_share_mean");
    level.own = judged_of(of, "among_its_neighbours"), level.foreign = judged_of(of, "among_foreign_neighbours");
    return level;
}

ImagesReport images_of(const json& of) {
    ImagesReport images;
    images.all = level_of(of);
    images.unseen_share_most = of.at("unseen_share_most"), images.directions = of.at("directions");
    images.seconds = of.at("seconds"), images.taken_from_parts = of.at("taken_from_parts");
    for (const json& one : of.at("levels")) {
        LevelReport level = level_of(one);
        level.side_px = one.at("side_px"), level.nearest_m = one.at("nearest_m");
        images.levels.push_back(level);
    }
    if (!images.levels.empty()) images.all.side_px = images.levels[0].side_px, images.all.nearest_m = images.levels[0].nearest_m;
    return images;
}

BakeReport report_of(const json& of) {
    const json &tiles = of.at("tiles"), &planting = of.at("planting");
    BakeReport report;
    report.tiles = tiles.at("count"), report.correlation = tiles.at("correlation");
    report.spectrum_share = tiles.at("spectrum_share_of_top_hundredth");
    report.avoids_equal_neighbours = tiles.at("avoids_equal_neighbours");
    report.equal_neighbours = tiles.at("equal_neighbours"), report.disagreeing_neighbours = tiles.at("disagreeing_neighbours");
    report.method = planting.at("method"), report.tile_size_m = planting.at("tile_size_m");
    report.objects = planting.at("objects"), report.neighbourhoods = planting.at("neighbourhoods");
    report.tight_overlaps = planting.at("tight_overlaps"), report.tiles_with_a_place = planting.at("tiles_with_a_place");
    report.density_corner = planting.at("density_corner"), report.density_edge = planting.at("density_edge");
    report.density_inside = planting.at("density_inside"), report.relative_radius = planting.at("relative_radius");
    report.more_per_tile = planting.at("more_per_tile"), report.distance_step_m = planting.at("distance_step_m");
    report.density_by_corner_distance = planting.at("density_by_corner_distance").get<std::vector<double>>();
    report.density_by_edge_distance = planting.at("density_by_edge_distance").get<std::vector<double>>();
    if (of.contains("images")) report.images = images_of(of.at("images"));
    return report;
}

}  // namespace

Result<BakeReport> read_report(const std::string& path) {
    auto file = MappedFile::open(path);
    if (!file) return tl::unexpected(file.error());
    std::string text(reinterpret_cast<const char*>(file->bytes().data()), file->bytes().size());
    try {
        return report_of(json::parse(text));
    } catch (const json::exception& problem) {
        return bad_input("{}: is not what bake-wang-ldi --json says: {}", path, problem.what());
    }
}

}  // namespace overlook::measure::paper::wang
