#include "tools/baked/info_ground.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "formats/atomic_file.h"
#include "tools/bake/images.h"
#include "tools/bake/wang_ldi/evenness.h"
#include "tools/bake/wang_ldi/planting_check.h"
#include "tools/bake/wang_ldi/sheet.h"
#include "tools/bake/wang_ldi/texture_sheet.h"
#include "tools/bake/wang_ldi/tile_sets.h"
#include "tools/baked/info_images.h"

namespace overlook::baked {
namespace {

using nlohmann::ordered_json;

struct Counts {
    size_t objects = 0, owned[4] = {};
};
Counts counts_of(const wang_ldi::Planting& planting) {
    Counts counts;
    for (const auto& tile : planting.tiles)
        for (const wang_ldi::Planted& object : tile) ++counts.objects, ++counts.owned[size_t(object.owner)];
    return counts;
}

}  // namespace

std::string ground_json(const wang_ldi::PlantedTiles& ground) {
    const wang_ldi::Planting& planting = ground.planting;
    Counts counts = counts_of(planting);
    wang_ldi::OverlapReport overlaps = wang_ldi::check_overlaps(ground.set, planting);
    ordered_json json{{"tiles", ground.set.tiles.size()},
                      {"horizontal_colours", ground.set.horizontal.size()},
                      {"vertical_colours", ground.set.vertical.size()},
                      {"corner_density", ground.set.corner_density},
                      {"edges", wang_ldi::text_of(ground.set)},
                      {"tile_size_m", planting.tile_size_m},
                      {"objects", counts.objects},
                      {"objects_of_corners", counts.owned[0]},
                      {"objects_of_edges", counts.owned[1] + counts.owned[2]},
                      {"objects_of_interiors", counts.owned[3]},
                      {"neighbourhoods", overlaps.neighbourhoods},
                      {"tight_overlaps", overlaps.tight_overlaps},
                      {"relative_radius", counts.objects > 1 ? wang_ldi::relative_radius(planting, overlaps) : 0.0},
                      {"models", ordered_json::array()}};
    std::vector<size_t> of_model(planting.models.size(), 0);
    for (const auto& tile : planting.tiles)
        for (const wang_ldi::Planted& object : tile) ++of_model[object.model];
    for (size_t m = 0; m < planting.models.size(); ++m)
        json["models"].push_back({{"name", planting.models[m].name},
                                  {"tight_radius_m", double(planting.models[m].tight_radius_m)},
                                  {"packing_radius_m", double(planting.models[m].packing_radius_m)},
                                  {"objects", of_model[m]}});
    return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

void print_ground(const wang_ldi::PlantedTiles& ground) {
    Counts counts = counts_of(ground.planting);
    wang_ldi::OverlapReport overlaps = wang_ldi::check_overlaps(ground.set, ground.planting);
    double tiles = double(ground.set.tiles.size());
    fmt::print("ground: {} tiles of {:g} m, {} x {} colours of edges, {} of corners\n", ground.set.tiles.size(),
               ground.planting.tile_size_m, ground.set.horizontal.size(), ground.set.vertical.size(),
               ground.set.corner_density.size());
    fmt::print("edges (north east south west): {}\n", wang_ldi::text_of(ground.set));
    fmt::print("planting: {:.1f} objects a tile ({:.1f} of corners, {:.1f} of edges, {:.1f} inside), of {} models\n",
               double(counts.objects) / tiles, double(counts.owned[0]) / tiles, double(counts.owned[1] + counts.owned[2]) / tiles,
               double(counts.owned[3]) / tiles, ground.planting.models.size());
    fmt::print("promise: {}{} tight radii overlap in any of {} neighbourhoods\n", overlaps.tight_overlaps,
               overlaps.is_cut_short ? " or more" : "", overlaps.neighbourhoods);
}

Result<void> write_sheet(const std::string& file, const wang_ldi::PlantedTiles& ground, const wang_ldi::ImageReader* images,
                         const wang_ldi::TextureSet* textures, const std::string& folder) {
    auto made = wang_ldi::sheet_of(ground, 1);
    if (!made) return tl::unexpected(made.error());
    std::vector<NamedPicture> sheet;
    for (wang_ldi::SheetPicture& page : *made) sheet.push_back({page.name, std::move(page.picture)});
    if (images) {
        auto of_images = image_sheet(file, *images, ground);
        if (!of_images) return tl::unexpected(of_images.error());
        for (NamedPicture& page : *of_images) sheet.push_back(std::move(page));
    }
    if (textures)
        for (wang_ldi::SheetPicture& page : wang_ldi::sheet_of(*textures)) sheet.push_back({page.name, std::move(page.picture)});
    std::error_code reason;
    std::filesystem::create_directories(folder, reason);
    if (reason) return cannot_write("{}: cannot make the folder: {}", folder, reason.message());
    for (const NamedPicture& page : sheet) {
        auto png = png_bytes(page.picture);
        if (!png) return tl::unexpected(png.error());
        if (auto written = write_file((std::filesystem::path(folder) / page.name).string(), *png); !written) return written;
    }
    return {};
}

}  // namespace overlook::baked
