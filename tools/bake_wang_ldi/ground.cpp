#include "tools/bake_wang_ldi/ground.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>

#include "formats/mapped_file.h"

namespace overlook::bake_wang_ldi {
namespace {

double seconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

Result<wang_ldi::Recipe> recipe_of(const GroundArgs& args, const command::Common& common) {
    auto recipe = wang_ldi::read_recipe(args.recipe);
    if (!recipe) return recipe;
    if (!args.tiles.empty()) {
        if (auto chosen = wang_ldi::choose_tiles(args.tiles, recipe->set); !chosen)
            return bad_command("--tiles: {}", chosen.error().message);
    }
    if (args.colours > 0) recipe->set.horizontal_colours = recipe->set.vertical_colours = args.colours;
    uint32_t pairs = args.colours * args.colours;
    if (args.colours > 0 && args.tiles.empty()) recipe->set.tiles = std::min(3 * pairs, pairs * pairs);
    if (!args.planting.empty()) recipe->is_as_paper = args.planting == "paper";
    if (args.has_borders) recipe->set.has_borders = true;
    if (args.variants > 0) recipe->set.variants = args.variants;
    if (args.has_seed) recipe->seed = common.seed;
    recipe->set.seed = recipe->plant.seed = recipe->seed;
    return recipe;
}

std::string tiles_in_words(const wang_ldi::SetOptions& set) {
    if (set.kind == wang_ldi::SetKind::robinson) return "robinson";
    return set.kind == wang_ldi::SetKind::corners ? "corners" : fmt::format("{}", set.tiles);
}

}  // namespace

void add_ground_options(CLI::App& app, GroundArgs& args) {
    app.add_option("RECIPE", args.recipe, "What is planted and how (TOML): models, radii, shares, the tile's size")->required();
    app.add_option("-o,--output", args.output, "The baked file (.ovl)")->required();
    app.add_option(
           "--only", args.only,
           "planting: the set of tiles and where everything stands, and no more. scene: besides, no images of the tiles but one "
           "perspective image of a whole ground of them, and pictures of it by rays (see --scene-tiles and on)")
        ->check(CLI::IsMember({"planting", "scene"}));
    app.add_option("--tiles", args.tiles,
                   "In place of the recipe's. 8, 12, 16 or more: the least periodic set of so many, found by search; 1: one that "
                   "repeats; robinson: the aperiodic 16; corners: a tile for every four corners");
    app.add_option("--colours", args.colours, "Of edges, each way (default: the recipe's, or 2)")->check(CLI::Range(1u, 15u));
    app.add_option("--variants", args.variants, "Of each prototile, the same at its edges and others inside")
        ->check(CLI::Range(1u, 255u));
    app.add_flag("--borders", args.has_borders, "Add tiles for where the planting ends, one for every border");
    app.add_option("--planting", args.planting,
                   "corners: corners, then edges, then interiors, until nothing more has a place. paper: round-robin, as "
                   "published, with its voids at corners")
        ->check(CLI::IsMember({"corners", "paper"}));
    app.add_flag("--measure", args.measures, "Measure the planting's spectrum too, beside that of a Poisson disk set");
}

Result<GroundDone> make_ground(const GroundArgs& args, const command::Common& common) {
    GroundDone done;
    auto recipe = recipe_of(args, common);
    if (!recipe) return tl::unexpected(recipe.error());
    done.recipe = std::move(*recipe);
    for (const std::string& path : done.recipe.files)
        if (std::error_code is_no_file; std::filesystem::equivalent(path, args.output, is_no_file))
            return bad_command("{}: is read and would be overwritten; give another --output", args.output);
    auto at_recipe = [&](Error error) {
        bool is_the_recipes = error.exit == Exit::bad_input;
        return tl::unexpected(Error{error.exit, is_the_recipes ? args.recipe + ": " + error.message : error.message});
    };
    auto begin = std::chrono::steady_clock::now();
    auto set = wang_ldi::make_tile_set(done.recipe.set, done.search);
    if (!set)
        return at_recipe(args.tiles.empty() && args.colours == 0 ? Error{Exit::bad_input, set.error().message} : set.error());
    done.ground.set = std::move(*set), done.set_s = seconds_since(begin);

    begin = std::chrono::steady_clock::now();
    auto planting = done.recipe.is_as_paper ? wang_ldi::plant_as_paper(done.ground.set, done.recipe.plant, done.plant)
                                            : wang_ldi::plant(done.ground.set, done.recipe.plant, done.plant);
    if (!planting) return at_recipe(planting.error());
    if (auto fits = wang_ldi::check_size(*planting); !fits)
        return tl::unexpected(Error{fits.error().exit, args.recipe + ": " + fits.error().message});
    done.ground.planting = std::move(*planting), done.plant_s = seconds_since(begin);

    begin = std::chrono::steady_clock::now();
    auto figures = wang_ldi::measure_ground(done.ground.set, done.ground.planting, done.recipe, args.measures);
    if (!figures) return tl::unexpected(figures.error());
    done.figures = std::move(*figures), done.measure_s = seconds_since(begin);
    return done;
}

Result<container::Provenance> provenance_of(const GroundArgs& args, const GroundDone& done) {
    const wang_ldi::Recipe& recipe = done.recipe;
    container::Provenance provenance{"bake-wang-ldi", command::version(), {}, {}};
    auto add = [&](const char* name, const std::string& value) { provenance.options.emplace_back(name, value); };
    add("tiles", tiles_in_words(recipe.set)), add("planting", recipe.is_as_paper ? "paper" : "corners");
    add("seed", fmt::format("{}", recipe.seed));
    if (recipe.set.kind == wang_ldi::SetKind::stochastic) add("colours", fmt::format("{}", recipe.set.horizontal_colours));
    if (recipe.set.variants > 1) add("variants", fmt::format("{}", recipe.set.variants));
    if (recipe.set.has_borders) add("borders", "true");
    if (!args.only.empty()) add("only", args.only);
    std::vector<std::string> files = recipe.files;
    files.insert(files.begin(), args.recipe);
    for (const std::string& path : files) {
        auto file = MappedFile::open(path);
        if (!file) return tl::unexpected(file.error());
        provenance.inputs.push_back({path.substr(path.rfind('/') + 1), content_hash(file->bytes())});
    }
    return provenance;
}

}  // namespace overlook::bake_wang_ldi
