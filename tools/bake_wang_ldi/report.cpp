#include <nlohmann/json.hpp>

#include "tools/bake_wang_ldi/ground.h"
#include "tools/bake_wang_ldi/images.h"
#include "tools/bake_wang_ldi/scene.h"

namespace overlook::bake_wang_ldi {
namespace {

using nlohmann::ordered_json;

ordered_json tiles_json(const GroundDone& done) {
    const wang_ldi::Figures& figures = done.figures;
    ordered_json json{{"count", done.ground.set.tiles.size()},
                      {"horizontal_colours", done.ground.set.horizontal.size()},
                      {"vertical_colours", done.ground.set.vertical.size()},
                      {"corner_colours", done.ground.set.corner_density.size()},
                      {"edges", wang_ldi::text_of(done.ground.set)},
                      {"correlation", figures.correlation.value},
                      {"correlation_lag", {figures.correlation.x, figures.correlation.y}},
                      {"spectrum_greatest", figures.spectrum.greatest},
                      {"spectrum_share_of_top_hundredth", figures.spectrum.share_of_top_hundredth},
                      {"avoids_equal_neighbours", figures.avoids_equal_neighbours},
                      {"equal_neighbours", figures.neighbours.equal},
                      {"disagreeing_neighbours", figures.neighbours.disagreeing},
                      {"border_tiles", figures.border_tiles},
                      {"border_bytes", figures.border_bytes}};
    json["repeated_densities"] = wang_ldi::repeated_densities(done.ground.set);
    json["random_access_block"] = figures.block > 0 ? ordered_json(figures.block) : ordered_json();
    if (done.search.candidates > 0)
        json["search"] = {{"candidates", done.search.candidates},
                          {"exhaustive", done.search.is_exhaustive},
                          {"best", done.search.best},
                          {"worst", done.search.worst},
                          {"dead_ending", done.search.dead_ending}};
    return json;
}

ordered_json planting_json(const GroundDone& done) {
    const wang_ldi::Figures& figures = done.figures;
    size_t objects = 0, least = SIZE_MAX, most = 0;
    for (const auto& tile : done.ground.planting.tiles)
        objects += tile.size(), least = std::min(least, tile.size()), most = std::max(most, tile.size());
    ordered_json json{{"method", done.recipe.is_as_paper ? "paper" : "corners"},
                      {"tile_size_m", done.ground.planting.tile_size_m},
                      {"models", done.ground.planting.models.size()},
                      {"objects", objects},
                      {"objects_per_tile", {least, most}},
                      {"density_per_m2", done.plant.density_per_m2},
                      {"full_density_per_m2", done.plant.full_density_per_m2},
                      {"density_corner", figures.zones.corner},
                      {"density_edge", figures.zones.edge},
                      {"density_inside", figures.zones.inside},
                      {"density_by_edge_distance", figures.by_edge_distance},
                      {"density_by_corner_distance", figures.by_corner_distance},
                      {"distance_step_m", figures.edge_reach_m / 2},
                      {"relative_radius", figures.relative_radius},
                      {"neighbourhoods", figures.overlaps.neighbourhoods},
                      {"tight_overlaps", figures.overlaps.tight_overlaps},
                      {"packing_overlaps", figures.overlaps.packing_overlaps},
                      {"least_tight_gap_m", figures.overlaps.least_tight_gap_m},
                      {"tiles_with_a_place", figures.tiles_with_a_place},
                      {"more_per_tile", figures.more_per_tile}};
    if (figures.power.side > 0)
        json["spectrum"] = {{"frequency_step_per_m", figures.power.frequency_step},
                            {"radial_power", figures.power.radial_power},
                            {"anisotropy_db", figures.power.anisotropy_db},
                            {"greatest_peak", figures.power.greatest_peak},
                            {"poisson_radial_power", figures.plain_power.radial_power},
                            {"poisson_anisotropy_db", figures.plain_power.anisotropy_db},
                            {"poisson_greatest_peak", figures.plain_power.greatest_peak}};
    return json;
}

}  // namespace

void report_ground(const GroundArgs& args, const GroundDone& done, uint64_t bytes, const wang_ldi::ImageReport* images,
                   const wang_ldi::SceneMade* scene, uint64_t scene_bytes, const command::Common& common) {
    if (common.json) {
        ordered_json json{{"file", args.output}, {"tiles", tiles_json(done)}, {"planting", planting_json(done)}, {"bytes", bytes},
                          {"set_s", done.set_s}, {"plant_s", done.plant_s},   {"measure_s", done.measure_s}};
        if (images) json["images"] = ordered_json::parse(images_json(*images));
        if (scene) json["scene"] = ordered_json::parse(scene_json(*scene, scene_bytes));
        fmt::print("{}\n", json.dump(2, ' ', false, ordered_json::error_handler_t::replace));
        return;
    }
    const wang_ldi::Figures& figures = done.figures;
    size_t objects = 0, tiles = done.ground.set.tiles.size();
    for (const auto& tile : done.ground.planting.tiles) objects += tile.size();
    command::note(common,
                  fmt::format("{}: {} tiles, correlation {:.4f} at most; {:.1f} objects a tile, {:.3f} a square metre, {} bytes",
                              args.output, tiles, std::abs(figures.correlation.value), double(objects) / double(tiles),
                              done.plant.density_per_m2, bytes));
    std::string room =
        done.recipe.plant.density_per_m2 > 0 ? "" : fmt::format("; {:.2f} more a tile have a place", figures.more_per_tile);
    command::note(common,
                  fmt::format("density {:.2f} at corners, {:.2f} at edges, {:.2f} inside; relative radius {:.3f}; {} tight radii "
                              "overlap in {} neighbourhoods{}",
                              figures.zones.corner, figures.zones.edge, figures.zones.inside, figures.relative_radius,
                              figures.overlaps.tight_overlaps, figures.overlaps.neighbourhoods, room));
    for (float density : wang_ldi::repeated_densities(done.ground.set))
        command::note(common,
                      fmt::format("ground of density {:g} is one tile over and over: one corner colour has it; give it to two in "
                                  "corner_density, or ask for --variants",
                                  density));
    if (done.search.candidates > 0)
        command::detail(
            common, fmt::format("tiles (north east south west): {}; of {} sets {:.4f} to {:.4f}",
                                wang_ldi::text_of(done.ground.set), done.search.candidates, done.search.best, done.search.worst));
    if (figures.block > 0)
        command::detail(common, fmt::format("any tile by itself, from borders of {} x {} tiles", figures.block, figures.block));
    else
        command::detail(common, figures.no_random_access);
    command::detail(common,
                    fmt::format("set {:.2f} s, planting {:.2f} s, measuring {:.2f} s", done.set_s, done.plant_s, done.measure_s));
    if (images) say_images(*images, common);
    if (scene) say_scene(*scene, scene_bytes, common);
}

}  // namespace overlook::bake_wang_ldi
