#include "tests/bench/inputs.h"

#include <cstdlib>
#include <filesystem>
#include <memory>

#include "tests/tools/synthetic_dem.h"
#include "tools/bake/terrain.h"

namespace overlook::bench {
namespace {

std::string path_of(const std::string& name) {
    const char* folder = std::getenv("OVERLOOK_DATA");
    return folder == nullptr ? "" : std::string(folder) + "/dem/" + name;
}

Result<dem::Raster> dem_of(const std::string& name) {
    constexpr std::string_view kHills = "hills_";
    if (!name.starts_with(kHills)) return dem::open(path_of(name), {});
    uint32_t side = uint32_t(std::stoul(name.substr(kHills.size())));
    return test::make_hills(side, side, 1);
}

}  // namespace

std::vector<std::string> landscape_names(bool small) {
    if (small) return {"hills_129"};
    std::vector<std::string> names = {"hills_1025", "hills_4097"};
    for (const char* name : {"N44W072.hgt", "everest_srtm3_voids.tif", "greenriver_lidar_1m.tif"})
        if (std::filesystem::exists(path_of(name))) names.push_back(name);
    return names;
}

Result<const Landscape*> landscape(const std::string& name) {
    static std::string kept_name;
    static std::unique_ptr<Landscape> kept;
    if (kept && kept_name == name) return kept.get();
    kept.reset();
    Result<dem::Raster> dem = dem_of(name);
    if (!dem) return tl::unexpected(dem.error());
    Result<terrain::Terrain> terrain = terrain::bake(*dem, {}, [](double) {});
    if (!terrain) return tl::unexpected(terrain.error());
    kept = std::make_unique<Landscape>(Landscape{std::move(*dem), std::move(*terrain)});
    kept_name = name;
    return kept.get();
}

std::function<void(benchmark::State&)> with(const std::string& name,
                                            std::function<void(benchmark::State&, const Landscape&)> body) {
    return [=](benchmark::State& state) {
        Result<const Landscape*> land = landscape(name);
        if (!land) return state.SkipWithError(land.error().message.c_str());
        body(state, **land);
    };
}

view::Camera overview(const terrain::Terrain& terrain, double highest_m, double turn_deg) {
    view::Camera camera;
    double width_m = terrain.shape.width * terrain.frame.metres_per_column,
           height_m = terrain.shape.height * terrain.frame.metres_per_row;
    camera.position_m = {width_m / 2, -height_m / 2, highest_m + 0.01 * width_m};
    camera.heading_deg = turn_deg, camera.pitch_deg = -15;
    return camera;
}

}  // namespace overlook::bench
