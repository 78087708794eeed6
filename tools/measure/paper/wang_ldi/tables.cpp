#include "tools/measure/paper/wang_ldi/flown.h"

namespace overlook::measure::paper::wang {
namespace {

struct Row {
    const char* bake;
    const BakeReport& report;
};
std::vector<Row> rows_of(const Plants& plants) {
    return {{"paper", plants.paper}, {"own", plants.own}, {"single", plants.single}, {"robinson", plants.robinson}};
}

std::string judged_csv(const std::optional<Judged>& judged) {
    if (!judged) return ",,,,,,,";
    auto text = [](const std::optional<double>& number) { return number ? fmt::format("{}", *number) : std::string(); };
    return fmt::format("{},{},{},{},{},{},{},{}", judged->hole_share, judged->filled_hole_share, judged->deeper_share,
                       judged->e_mean, judged->e_p99, judged->unfilled_e_mean, text(judged->covered_times),
                       text(judged->filled_covered_times));
}

}  // namespace

std::string sets_csv(const Flown& flown) {
    std::string csv =
        "plants,bake,tiles,correlation,spectrum_share_of_top_hundredth,equal_neighbours,disagreeing_neighbours,planting,objects,"
        "density_corner,density_edge,density_inside,relative_radius,more_per_tile,tiles_with_a_place,neighbourhoods,"
        "tight_overlaps,images,samples,bytes,rays,seconds,unseen_share_mean,unseen_share_most\n";
    for (const Plants& plants : flown.plants)
        for (const auto& [bake, r] : rows_of(plants)) {
            csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", plants.name, bake, r.tiles, r.correlation,
                               r.spectrum_share, r.equal_neighbours, r.disagreeing_neighbours, r.method, r.objects,
                               r.density_corner, r.density_edge, r.density_inside, r.relative_radius, r.more_per_tile,
                               r.tiles_with_a_place, r.neighbourhoods, r.tight_overlaps);
            if (!r.images)
                csv += ",,,,,,,\n";
            else
                csv += fmt::format(",{},{},{},{},{},{},{}\n", r.images->all.images, r.images->all.samples, r.images->all.bytes,
                                   r.images->all.rays, r.images->seconds, r.images->all.unseen_share_mean,
                                   r.images->unseen_share_most);
        }
    return csv;
}

std::string levels_csv(const Flown& flown) {
    std::string csv =
        "plants,bake,side_px,nearest_m,images,samples,bytes,rays,unseen_share_mean,hole_share,filled_hole_share,deeper_share,"
        "e_mean_flip,e_p99_flip,unfilled_e_mean_flip,covered_times,filled_covered_times,foreign_hole_share,"
        "foreign_filled_hole_share,foreign_deeper_share,"
        "foreign_e_mean_flip,foreign_e_p99_flip,foreign_unfilled_e_mean_flip,foreign_covered_times,"
        "foreign_filled_covered_times\n";
    for (const Plants& plants : flown.plants)
        for (const auto& [bake, report] : rows_of(plants)) {
            if (!report.images) continue;
            for (const LevelReport& level : report.images->levels)
                csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", plants.name, bake, level.side_px, level.nearest_m,
                                   level.images, level.samples, level.bytes, level.rays, level.unseen_share_mean,
                                   judged_csv(level.own), judged_csv(level.foreign));
        }
    return csv;
}

std::string planting_csv(const Flown& flown) {
    std::string csv = "plants,bake,zone,distance_m,density\n";
    for (const Plants& plants : flown.plants)
        for (const auto& [bake, report] : {Row{"paper", plants.paper}, Row{"own", plants.own}})
            for (const auto& [zone, densities] :
                 {std::pair("corner", &report.density_by_corner_distance), std::pair("edge", &report.density_by_edge_distance)})
                for (size_t i = 0; i < densities->size(); ++i)
                    csv += fmt::format("{},{},{},{},{}\n", plants.name, bake, zone, (double(i) + 0.5) * report.distance_step_m,
                                       (*densities)[i]);
    return csv;
}

std::string figure_2_csv(const Flown& flown) {
    std::string csv =
        "plants,way,away_m,views,e_mean_flip,e_p99_flip,unfilled_e_mean_flip,hole_share,filled_hole_share,beyond_rim_share,wrong_"
        "share,order_share,"
        "samples_warped,warp_ms,samples,bytes\n";
    for (const Plants& plants : flown.plants) csv += figure_2_csv(plants.name, plants.figure_2);
    return csv;
}

}  // namespace overlook::measure::paper::wang
