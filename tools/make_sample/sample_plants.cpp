#include "tools/make_sample/sample_plants.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <span>

#include "tools/make_sample/glb.h"
#include "tools/make_sample/meadow.h"
#include "tools/make_sample/noise.h"
#include "tools/make_sample/plant_field.h"
#include "tools/make_sample/plant_land.h"
#include "tools/make_sample/sample_folder.h"
#include "tools/make_sample/sunflower.h"

namespace overlook::sample {
namespace {

constexpr double kCovered = 0.6;
constexpr double kPi = 3.141592653589793;

double up_to_mm(double m) {
    return std::ceil(m * 1000) / 1000;
}

Result<PlantSet> sunflowers(uint64_t seed) {
    auto cut = sunflower_surfaces(seed, false), cards = sunflower_surfaces(seed, true);
    if (!cut) return tl::unexpected(cut.error());
    if (!cards) return tl::unexpected(cards.error());
    PlantSet set;
    set.per_tile = kSunflowersPerTile;
    for (int i = 0; i < kSunflowers; ++i) {
        Sunflower sunflower = sunflower_of(seed, i);
        mesh::Mesh mesh = sunflower_mesh(sunflower, hash_of(seed, 101, uint64_t(i)), sunflower.has_leaf_cards ? *cards : *cut);
        // A field's heads all look the way of the morning's sun.
        set.plants.push_back({fmt::format("sunflower-{:02}.glb", i), std::move(mesh), 1, 0.92, 1.04, 0, 40});
    }
    return set;
}

struct MeadowKind {
    const char* name;
    int count;
    double share;
    Result<std::vector<mesh::Surface>> (*surfaces)(uint64_t seed);
    mesh::Mesh (*mesh)(uint64_t seed, int number, const std::vector<mesh::Surface>& surfaces);
};

Result<PlantSet> meadow(uint64_t seed) {
    PlantSet set;
    double shares = 0, triangles = 0;
    for (const MeadowKind& kind : {MeadowKind{"grass", kGrasses, 1, grass_surfaces, grass_mesh},
                                   MeadowKind{"dandelion", kDandelions, 0.2, dandelion_surfaces, dandelion_mesh},
                                   MeadowKind{"buttercup", kButtercups, 0.2, buttercup_surfaces, buttercup_mesh}}) {
        auto surfaces = kind.surfaces(seed);
        if (!surfaces) return tl::unexpected(surfaces.error());
        for (int i = 0; i < kind.count; ++i) {
            Plant plant{fmt::format("{}-{:02}.glb", kind.name, i), kind.mesh(seed, i, *surfaces), kind.share, 0.85, 1.2, 0, 360};
            shares += plant.share, triangles += plant.share * double(plant.mesh.faces.size());
            set.plants.push_back(std::move(plant));
        }
    }
    set.per_tile = std::round(kGrassTileTriangles * shares / triangles);
    return set;
}

std::string text_of(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string readme_of(const std::string& name, const PlantSet& set, uint32_t count) {
    std::string text = fmt::format(
        "# {}\n\nPlants to be planted on tiles, as recipe.toml says; about {:g} on each. Metres; the foot at the origin.\n\n"
        "{} of them on hills, drawn as chains of levels:\n\n    for model in *.glb; do bake-lod discrete $model -o "
        "${{model%.glb}}.ovl; done\n    player scene.json --flight flight.json\n\n"
        "All over the hills, as tiles of layered depth images (planting.json's models are those chains):\n\n    bake-lod terrain "
        "land.tif --texture land.png -o land.ovl\n    bake-wang-ldi recipe.toml -o planting.ovl\n    player planting.json "
        "--flight "
        "walk.json\n\n"
        "| model | triangles | high, m | from its foot, m |\n|---|---|---|---|\n",
        name, set.per_tile, count);
    for (const Plant& plant : set.plants) {
        double top_m = 0;
        for (const glm::vec3& at : plant.mesh.positions_m) top_m = std::max(top_m, double(at.z));
        fmt::format_to(std::back_inserter(text), "| {} | {} | {:.2f} | {:.3f} |\n", plant.file, plant.mesh.faces.size(), top_m,
                       tight_radius_m(plant.mesh));
    }
    return text;
}

}  // namespace

Result<PlantSet> plant_set(const std::string& name, uint64_t seed) {
    return name == "sunflowers" ? sunflowers(seed) : meadow(seed);
}

double tight_radius_m(const mesh::Mesh& mesh) {
    double most_m = 0;
    for (const glm::vec3& at : mesh.positions_m) most_m = std::max(most_m, std::hypot(double(at.x), double(at.y)));
    return up_to_mm(most_m);
}

double packing_radius_m(const Plant& plant) {
    return up_to_mm(1.08 * tight_radius_m(plant.mesh));
}

std::string plant_recipe(const PlantSet& set, uint64_t seed) {
    double shares = 0, discs_m2 = 0;
    for (const Plant& plant : set.plants) {
        double scale = 0.5 * (plant.least_scale + plant.most_scale), radius_m = scale * packing_radius_m(plant);
        shares += plant.share, discs_m2 += plant.share * kPi * radius_m * radius_m;
    }
    double tile_m = std::sqrt(set.per_tile * discs_m2 / shares / kCovered);
    std::string text = fmt::format(
        "# For bake-wang-ldi: about {:g} plants on a tile.\ntile_size_m = {:.2f}\ndensity_per_m2 = {:.3f}\nseed = {}\n",
        set.per_tile, tile_m, set.per_tile / (tile_m * tile_m), seed);
    for (const Plant& plant : set.plants)
        fmt::format_to(
            std::back_inserter(text),
            "\n[[model]]\nfile = \"{}\"\nshare = {:g}\ntight_radius_m = {:.3f}\npacking_radius_m = {:.3f}\nscale = [{:g}, "
            "{:g}]\nturn_deg = [{:g}, {:g}]\n",
            plant.file, plant.share, tight_radius_m(plant.mesh), packing_radius_m(plant), plant.least_scale, plant.most_scale,
            plant.least_turn_deg, plant.most_turn_deg);
    return text;
}

Result<std::vector<std::string>> make_plants(const std::string& name, const PlantOptions& options, const std::string& folder) {
    Result<PlantSet> set = plant_set(name, options.seed);
    if (!set) return tl::unexpected(set.error());
    PlantField field = plant_field(*set, options.count, options.seed);
    double weeds = name == "sunflowers" ? 0.5 : 0.95, eye_m = name == "sunflowers" ? 1.75 : 0.8;
    Result<GlbNode> hills = hills_of(field, weeds, options.seed);
    if (!hills) return tl::unexpected(hills.error());
    Result<std::vector<std::byte>> land = land_png(weeds, options.seed);
    if (!land) return tl::unexpected(land.error());
    Result<SampleFolder> made = SampleFolder::make(folder);
    if (!made) return tl::unexpected(made.error());

    std::vector<std::pair<std::string, std::string>> files;
    for (const Plant& plant : set->plants)
        files.emplace_back(plant.file,
                           glb_text({{plant.file.substr(0, plant.file.find('.')), plant.mesh, {0, 0, 0}, {0, 0, 0}}}, 0));
    files.emplace_back("recipe.toml", plant_recipe(*set, options.seed));
    files.emplace_back("hills.glb", glb_text({*hills}, 0));
    files.emplace_back("scene.json", scene_of_field(*set, field));
    files.emplace_back("flight.json", scene::json_from_flight(flight_of_field(field, eye_m)));
    files.emplace_back("land.tif", text_of(land_tiff(options.seed)));
    files.emplace_back("land.png", text_of(*land));
    files.emplace_back("planting.json", scene::json_from_scene(land_scene(*set, options.seed)));
    files.emplace_back("walk.json", scene::json_from_flight(land_walk(eye_m, options.seed)));
    files.emplace_back("README.md", readme_of(name, *set, options.count));
    if (Result<void> written = made->write(files); !written) return tl::unexpected(written.error());
    return made->files();
}

}  // namespace overlook::sample
