#include "tools/bake/wang_ldi/recipe.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <numbers>

#include "tools/bake/wang_ldi/toml_table.h"

namespace overlook::wang_ldi {
namespace {

constexpr double kLeast_m = 1e-6, kMost_m = 1e6;
constexpr size_t kMostModels = 65536;

// How the models' counts are told: shares of all, or so many a square metre each.
struct Counts {
    bool has_shares = false, has_densities = false;
    double density_per_m2 = 0;  // of all models that say theirs
};

PlantModel read_model(TomlTable& table, double tile_size_m, Counts& counts) {
    PlantModel model;
    model.packing_radius_m = float(table.number("packing_radius_m", 0, kLeast_m, kMost_m));
    model.tight_radius_m = float(table.number("tight_radius_m", double(model.packing_radius_m), kLeast_m, kMost_m));
    for (const char* key : {"packing_radius_m", "tight_radius_m"}) {
        double radius_m = double(key[0] == 'p' ? model.packing_radius_m : model.tight_radius_m);
        if (!table.has(key) && key[0] == 'p')
            table.refuse(key, "is missing: the radius in metres that no other object's overlaps");
        if (radius_m > tile_size_m)
            table.refuse(key, fmt::format("{:g} m is larger than the tile of {:g} m", radius_m, tile_size_m));
    }
    if (model.tight_radius_m > model.packing_radius_m)
        table.refuse("tight_radius_m",
                     fmt::format("{:g} m is larger than packing_radius_m, {:g} m", model.tight_radius_m, model.packing_radius_m));
    std::array<double, 2> scale = table.range("scale", {1, 1}, 1e-3, 1e3);
    std::array<double, 2> turn_deg = table.range("turn_deg", {0, 360}, 0, 360);
    model.least_scale = scale[0], model.most_scale = scale[1];
    model.least_turn_rad = turn_deg[0] * std::numbers::pi / 180, model.most_turn_rad = turn_deg[1] * std::numbers::pi / 180;
    if (double(model.packing_radius_m) * scale[1] > tile_size_m)
        table.refuse("scale", fmt::format("{:g} times packing_radius_m is {:g} m, larger than the tile of {:g} m", scale[1],
                                          double(model.packing_radius_m) * scale[1], tile_size_m));

    bool has_share = table.has("share"), has_density = table.has("density_per_m2");
    model.weight = table.number("share", 1, 1e-6, 1e6);
    if (double density = table.number("density_per_m2", 0, 1e-9, 1e9); has_density)
        model.weight = density, counts.density_per_m2 += density;
    model.per_tile = uint32_t(table.count("per_tile", 0, 1, 10000));
    for (double variant : table.numbers("variants", 0, 254)) model.variants.push_back(uint32_t(variant));
    if (has_share && has_density) table.refuse("share", "contradicts density_per_m2 of the same model; keep one of them");
    if (model.per_tile > 0 && (has_share || has_density))
        table.refuse("per_tile",
                     fmt::format("contradicts {} of the same model; keep one of them", has_share ? "share" : "density_per_m2"));
    if (model.per_tile == 0 && table.has("variants"))
        table.refuse("variants", "is of models that stand per_tile; that is missing");
    counts.has_densities |= has_density, counts.has_shares |= !has_density && model.per_tile == 0;
    return model;
}

void read_file(TomlTable& table, const std::string& recipe, Recipe& into) {
    std::string file = table.text("file", "");
    if (file.empty()) return table.refuse("file", "is missing: the model's file");
    std::filesystem::path path = std::filesystem::path(recipe).parent_path() / file;
    std::error_code reason;
    if (!std::filesystem::exists(path, reason))
        table.refuse("file", fmt::format("\"{}\" is missing: {} is not there", file, path.string()));
    else if (!std::filesystem::is_regular_file(path, reason))
        table.refuse("file", fmt::format("\"{}\" is no file", file));
    auto share = [&](const char* key) {
        std::optional<float> value;
        if (table.has(key)) value = float(table.number(key, 1, 0, 1));
        return value;
    };
    table.number("roughness", 1, 0, 1), table.number("metallic", 0, 0, 1);
    into.roughness.push_back(share("roughness")), into.metallic.push_back(share("metallic"));
    into.plant.models.back().name = path.filename().string();
    into.files.push_back(path.string());
}

Result<void> read_models(TomlTable& root, const std::string& path, Recipe& recipe) {
    Counts counts;
    std::vector<TomlTable> tables = root.tables("model");
    if (tables.empty()) root.refuse("model", "there is none: what is to be planted, as [[model]]");
    if (tables.size() > kMostModels)
        root.refuse("model", fmt::format("there are {}, at most {} are planted", tables.size(), kMostModels));
    for (TomlTable& table : tables) {
        recipe.plant.models.push_back(read_model(table, recipe.plant.tile_size_m, counts));
        read_file(table, path, recipe);
        if (counts.has_shares && counts.has_densities)
            table.refuse("density_per_m2", "some models say it and others do not; let all say it, or share");
        if (auto finished = table.finish(); !finished) return finished;
    }
    bool is_by_share =
        std::any_of(recipe.plant.models.begin(), recipe.plant.models.end(), [](auto& m) { return m.per_tile == 0; });
    if (!tables.empty() && !is_by_share) root.refuse("model", "all stand per_tile; one at least has to fill the rest");
    if (counts.has_densities && root.has("density_per_m2"))
        root.refuse("density_per_m2", "contradicts density_per_m2 of the models; keep one of them");
    if (counts.has_densities) recipe.plant.density_per_m2 = counts.density_per_m2;
    return {};
}

void read_set(TomlTable& root, SetOptions& set) {
    if (auto chosen = choose_tiles(root.word("tiles", "12"), set); !chosen) root.refuse("tiles", chosen.error().message);
    uint64_t colours = root.count("colours", set.horizontal_colours, 1, 15);
    set.horizontal_colours = set.vertical_colours = uint32_t(colours);
    if (set.kind == SetKind::stochastic && root.has("colours") && !root.has("tiles"))
        set.tiles = uint32_t(std::min<uint64_t>(3 * colours * colours, colours * colours * colours * colours));
    set.has_borders = root.flag("borders", false);
    set.variants = uint32_t(root.count("variants", 1, 1, 255));
    set.candidates = uint32_t(root.count("set_candidates", set.candidates, 1, 1000000));
    std::vector<double> densities = root.numbers("corner_density", 0, 1);
    if (root.has("corner_density") && set.kind != SetKind::corners) root.refuse("corner_density", "is of tiles = \"corners\"");
    if (root.has("corner_density") && (densities.size() < 2 || densities.size() > 3))
        root.refuse("corner_density", "two or three numbers from 0 to 1 are wanted");
    if (!densities.empty()) set.corner_density.assign(densities.begin(), densities.end());
}

}  // namespace

Result<void> choose_tiles(const std::string& text, SetOptions& set) {
    if (text == "robinson" || text == "corners") {
        set.kind = text == "robinson" ? SetKind::robinson : SetKind::corners;
        return {};
    }
    uint32_t tiles = 0;
    auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), tiles);
    if (error != std::errc() || end != text.data() + text.size() || tiles < 1 || tiles > 255)
        return bad_input("\"{}\" is no set of tiles: 1, 8, 12, 16, another count up to 255, \"robinson\" or \"corners\" is",
                         text);
    set.kind = SetKind::stochastic, set.tiles = tiles;
    // One tile has one colour; more tiles, in place of one, have more again.
    bool has_one_colour = set.horizontal_colours * set.vertical_colours == 1;
    if (tiles == 1 || has_one_colour)
        set.horizontal_colours = set.vertical_colours = tiles == 1 ? 1 : SetOptions().vertical_colours;
    return {};
}

Result<Recipe> read_recipe(const std::string& path) {
    auto root = TomlTable::open(path);
    if (!root) return tl::unexpected(root.error());
    Recipe recipe;
    recipe.seed = root->count("seed", 1, 0, uint64_t(1) << 62);
    recipe.plant.tile_size_m = root->number("tile_size_m", 0, kLeast_m, kMost_m);
    if (!root->has("tile_size_m")) root->refuse("tile_size_m", "is missing: a side of a tile in metres");
    recipe.plant.density_per_m2 = root->number("density_per_m2", 0, 1e-9, 1e9);
    std::string planting = root->text("planting", "corners");
    if (planting != "corners" && planting != "paper") root->refuse("planting", "\"corners\" or \"paper\" is wanted");
    recipe.is_as_paper = planting == "paper";
    recipe.plant.candidates = uint32_t(root->count("candidates", recipe.plant.candidates, 1, 100000));
    recipe.plant.tries = uint32_t(root->count("tries", recipe.plant.tries, 1, 1000000));
    read_set(*root, recipe.set);
    if (auto read = read_models(*root, path, recipe); !read) return tl::unexpected(read.error());
    if (auto finished = root->finish(); !finished) return tl::unexpected(finished.error());
    return recipe;
}

}  // namespace overlook::wang_ldi
