// make-sample NAME -o DIR: generated inputs, ready to bake.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "runtime/command/command.h"
#include "tools/make_sample/sample_dem.h"
#include "tools/make_sample/sample_instances.h"
#include "tools/make_sample/sample_lod_sprite.h"
#include "tools/make_sample/sample_objects.h"
#include "tools/make_sample/sample_plants.h"
#include "tools/make_sample/sample_slopes.h"
#include "tools/make_sample/sample_terrains.h"

namespace {

using namespace overlook;

int make_dem(const sample::DemOptions& options, const std::string& folder, const command::Common& common) {
    Result<sample::DemReport> report = sample::make_dem(options, folder);
    if (!report) return command::fail("make-sample dem", report.error());

    for (const std::string& file : report->files) command::note(common, "wrote " + file);
    command::detail(common,
                    fmt::format("{} samples a side every {} m, {:.1f}..{:.1f} m high, {} void", options.landscape.side,
                                options.landscape.cell_size_m, report->lowest_m, report->highest_m, report->void_samples));
    if (common.json) {
        nlohmann::ordered_json json = {
            {"files", report->files},       {"size", options.landscape.side}, {"cell_size_m", options.landscape.cell_size_m},
            {"lowest_m", report->lowest_m}, {"highest_m", report->highest_m}, {"void_samples", report->void_samples}};
        fmt::print("{}\n", json.dump(2));
    }
    return int(Exit::done);
}

int make_lod_sprite(const sample::LodSpriteOptions& options, const std::string& folder, const command::Common& common) {
    Result<sample::LodSpriteReport> report = sample::make_lod_sprite(options, folder);
    if (!report) return command::fail("make-sample lod-sprite", report.error());

    for (const std::string& file : report->files) command::note(common, "wrote " + file);
    command::detail(common,
                    fmt::format("{} samples a side, {:.1f}..{:.1f} m high", options.side, report->lowest_m, report->highest_m));
    if (common.json) {
        nlohmann::ordered_json json = {
            {"files", report->files}, {"size", options.side}, {"lowest_m", report->lowest_m}, {"highest_m", report->highest_m}};
        fmt::print("{}\n", json.dump(2));
    }
    return int(Exit::done);
}

int say_files(const std::string& name, const Result<std::vector<std::string>>& files, const command::Common& common) {
    if (!files) return command::fail("make-sample " + name, files.error());
    for (const std::string& file : *files) command::note(common, "wrote " + file);
    if (common.json) fmt::print("{}\n", nlohmann::ordered_json({{"files", *files}}).dump(2));
    return int(Exit::done);
}

int make_mesh(const std::string& name, uint64_t seed, const std::string& source, const std::string& folder,
              const command::Common& common) {
    Result<sample::MeshSample> made = name == sample::kThreeLakes.name ? sample::three_lakes(seed)
                                      : name == sample::kCliff.name    ? sample::cliff(seed)
                                                                       : sample::canyon(seed, source);
    if (!made) return command::fail("make-sample " + name, made.error());
    Result<sample::MeshSampleReport> report = sample::write_mesh_sample(*made, folder);
    if (!report) return command::fail("make-sample " + name, report.error());

    for (const std::string& file : report->files) command::note(common, "wrote " + file);
    command::detail(common, fmt::format("{} positions, {} triangles, {} surface groups in {} ids, index array {:.1f} % in use",
                                        report->position_count, report->face_count, report->group_count, report->packed_count,
                                        100 * report->dense_population));
    if (common.json) {
        nlohmann::ordered_json json = {{"files", report->files},
                                       {"positions", report->position_count},
                                       {"triangles", report->face_count},
                                       {"surface_groups", report->group_count},
                                       {"packed_ids", report->packed_count},
                                       {"dense_population", report->dense_population}};
        fmt::print("{}\n", json.dump(2));
    }
    return int(Exit::done);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Makes inputs to try Overlook on", "make-sample");
    app.require_subcommand(1);

    command::Common common;
    sample::DemOptions options;
    std::string folder;
    CLI::App* dem = app.add_subcommand("dem", "A landscape as an elevation model: dem.tif, recipe.toml, scene.json, flight.json");
    dem->add_option("-o,--output", folder, "Folder to write into")->required();
    dem->add_option("--size", options.landscape.side, "Samples a side")->capture_default_str();
    dem->add_option("--cell-size-m", options.landscape.cell_size_m, "Metres between samples")->capture_default_str();
    dem->add_option("--voids", options.void_count, "Holes without data to dig")->capture_default_str();
    command::add_common(*dem, common, command::Uses::seed);

    sample::LodSpriteOptions lod_sprite_options;
    CLI::App* lod_sprite = app.add_subcommand(
        "lod-sprite",
        "The LOD-sprite paper's run: dem.tif, texture.ppm, recipe.toml, scene.json, flight.json, run.json (thresholds, views)");
    lod_sprite->add_option("-o,--output", folder, "Folder to write into")->required();
    lod_sprite->add_option("--size", lod_sprite_options.side, "Samples a side")->capture_default_str();
    command::add_common(*lod_sprite, common, command::Uses::seed);

    CLI::App* slopes = app.add_subcommand("slopes", "Ridges whose sides rise at 40, 60 and 75 degrees: dem.tif, scene.json");
    slopes->add_option("-o,--output", folder, "Folder to write into")->required();
    command::add_common(*slopes, common);

    std::vector<CLI::App*> objects;
    for (const auto& [name, what] :
         {std::pair("vase", "A fluted vase to fly round: vase.obj, vase.mtl, scene.json, flight.json"),
          std::pair("masts", "Thin masts and railings on a ground: masts.obj, masts.mtl, scene.json, flight.json")}) {
        objects.push_back(app.add_subcommand(name, what));
        objects.back()->add_option("-o,--output", folder, "Folder to write into")->required();
        command::add_common(*objects.back(), common);
    }

    std::vector<CLI::App*> crowds;
    sample::InstancesOptions crowd_options;
    for (const auto& [name, what] :
         {std::pair("trees", "4,000 trees on a plain: tree-0.glb (93,000 triangles) to tree-4.glb (5,000)"),
          std::pair("windmills", "4,000 windmills whose sails turn: windmill-0.glb (18,000 triangles) to windmill-3.glb (100)"),
          std::pair("simple", "Spheres that become cubes: simple-0.glb, simple-1.glb")}) {
        CLI::App* crowd = app.add_subcommand(name, std::string("A scene of the frame-sequential interpolation paper. ") + what +
                                                       ", plain.glb, scene.json, flight.json, README.md");
        crowd->add_option("-o,--output", folder, "Folder to write into")->required();
        crowd->add_option("--count", crowd_options.count, "How many stand about (default 4,000; of simple 400)")
            ->check(CLI::Range(1, 100000));
        command::add_common(*crowd, common, command::Uses::seed);
        crowds.push_back(crowd);
    }

    std::vector<CLI::App*> plants;
    sample::PlantOptions plant_options;
    for (const auto& [name, what] :
         {std::pair("sunflowers", "11 sunflowers of 35,000 triangles: sunflower-00.glb to sunflower-10.glb"),
          std::pair("grass",
                    "A meadow: grass-00.glb to grass-14.glb, dandelion-00.glb to -08.glb, buttercup-00.glb to -14.glb")}) {
        plants.push_back(app.add_subcommand(
            name, std::string("Plants of the paper on tiled layered depth images. ") + what +
                      ", recipe.toml, hills.glb, scene.json, flight.json, land.tif, land.png, planting.json, walk.json, "
                      "README.md"));
        plants.back()->add_option("-o,--output", folder, "Folder to write into")->required();
        plants.back()
            ->add_option("--count", plant_options.count, "How many stand in the scene")
            ->check(CLI::Range(1, 100000))
            ->capture_default_str();
        command::add_common(*plants.back(), common, command::Uses::seed);
    }

    const std::string writes = "mesh (OBJ), textures, recipe.toml, scene.json, flight-a.json to flight-d.json";
    std::vector<CLI::App*> terrains;
    std::string source;
    for (const auto& [name, what] : {std::pair(sample::kThreeLakes.name, "80,000 triangles, nine textures: "),
                                     std::pair(sample::kCliff.name, "107,184 triangles, normals that break at its rim: "),
                                     std::pair(sample::kCanyon.name, "126,480 triangles, one texture: ")}) {
        CLI::App* terrain = app.add_subcommand(name, "The CAVECLOD paper's terrain of " + (what + writes));
        terrain->add_option("-o,--output", folder, "Folder to write into")->required();
        if (std::string(name) == sample::kCanyon.name)
            terrain->add_option("--source", source,
                                "Folder with elevation_1200_8bit.png and colour_1024.png of the Grand Canyon");
        command::add_common(*terrain, common, command::Uses::seed);
        terrains.push_back(terrain);
    }

    return command::run(app, common, argc, argv, [&] {
        if (slopes->parsed()) return say_files("slopes", sample::make_slopes(folder), common);
        for (const CLI::App* crowd : crowds) {
            if (!crowd->parsed()) continue;
            bool is_default = crowd->get_option("--count")->empty();
            if (is_default && crowd->get_name() == "simple") crowd_options.count = sample::kSimpleCount;
            crowd_options.seed = common.seed;
            return say_files(crowd->get_name(), sample::make_instances(crowd->get_name(), crowd_options, folder), common);
        }
        for (const CLI::App* plant : plants) {
            if (!plant->parsed()) continue;
            plant_options.seed = common.seed;
            return say_files(plant->get_name(), sample::make_plants(plant->get_name(), plant_options, folder), common);
        }
        for (const CLI::App* object : objects)
            if (object->parsed()) return say_files(object->get_name(), sample::make_object(object->get_name(), folder), common);
        for (const CLI::App* terrain : terrains)
            if (terrain->parsed()) return make_mesh(terrain->get_name(), common.seed, source, folder, common);
        if (lod_sprite->parsed()) {
            lod_sprite_options.seed = common.seed;
            return make_lod_sprite(lod_sprite_options, folder, common);
        }
        options.landscape.seed = common.seed;
        return make_dem(options, folder, common);
    });
}
