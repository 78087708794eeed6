#include "tools/bake/wang_ldi/plant_parts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace overlook::wang_ldi {
namespace {

// Squares of a packing radius, of which about a sixth hold an object: memory for one tile's, and what a file holds of all tiles'.
constexpr double kMostSquaresOfATile = 1 << 24, kMostSquares = 1 << 26;

// From the end of one edge's band to the nearest of another's it is sqrt(2) * (arm - reach), which has to be 2 * reach.
double arm_of(double reach) {
    return reach * (1 + std::numbers::sqrt2);
}

}  // namespace

double edge_reach_m(const PlantOptions& options) {
    double reach = 0;
    for (const PlantModel& model : options.models)
        if (model.per_tile == 0) reach = std::max(reach, double(model.packing_radius_m) * model.most_scale);
    return reach + kRounding * options.tile_size_m;
}

double least_tile_size_m(const PlantOptions& options) {
    double reach = edge_reach_m(options), inside = 0;
    for (const PlantModel& model : options.models)
        if (model.per_tile > 0) inside = std::max(inside, 2 * double(model.packing_radius_m) * model.most_scale);
    return std::max(2 * (arm_of(reach) + reach), inside);
}

double least_radius(const PlantOptions& options) {
    double least = HUGE_VAL;
    for (const PlantModel& model : options.models)
        if (model.per_tile == 0) least = std::min(least, double(model.packing_radius_m) * model.least_scale);
    return least;
}

double greatest_radius(const PlantOptions& options) {
    double greatest = 0;
    for (const PlantModel& model : options.models)
        greatest = std::max(greatest, double(model.packing_radius_m) * model.most_scale);
    return greatest;
}

Regions::Regions(const PlantOptions& options) : size(options.tile_size_m), reach(edge_reach_m(options)), arm(arm_of(reach)) {}

std::vector<Bounds> Regions::corner(double inset) const {
    double a = arm - inset, r = reach - inset;
    return {{-a, -r, a, r}, {-r, r, r, a}, {-r, -a, r, -r}};
}
std::vector<Bounds> Regions::horizontal_edge(double inset) const {
    return {{arm, inset - reach, size - arm, reach - inset}};
}
std::vector<Bounds> Regions::vertical_edge(double inset) const {
    return {{inset - reach, arm, reach - inset, size - arm}};
}
std::vector<Bounds> Regions::interior() const {
    return {{reach, reach, size - reach, size - reach}};
}

double packing_radius(const PlantOptions& options, const Planted& object) {
    return double(options.models[object.model].packing_radius_m) * double(object.scale);
}
double tight_radius(const PlantOptions& options, const Planted& object) {
    return double(options.models[object.model].tight_radius_m) * double(object.scale);
}

ModelChoice::ModelChoice(const PlantOptions& options) : options_(&options), counts_(options.models.size(), 0) {
    for (const PlantModel& model : options.models)
        if (model.per_tile == 0) weights_ += model.weight;
}

Planted ModelChoice::choose(double room, double share, Random& random) {
    uint32_t best = 0;
    double most_missing = -HUGE_VAL;
    for (uint32_t m = 0; m < options_->models.size(); ++m) {
        const PlantModel& model = options_->models[m];
        if (model.per_tile > 0) continue;
        double chance = random.next_unit();
        if (double(model.packing_radius_m) * model.least_scale > room * (1 + kRounding) || model.weight <= 0) continue;
        double missing = model.weight / weights_ * (all_ + share) - counts_[m] + share * chance;
        if (missing > most_missing) best = m, most_missing = missing;
    }
    all_ += share, counts_[best] += share;
    return of_model(best, room, random);
}

Planted ModelChoice::of_model(uint32_t m, double room, Random& random) const {
    const PlantModel& model = options_->models[m];
    double most = std::min(model.most_scale, room / double(model.packing_radius_m));
    double scale = model.least_scale + random.next_unit() * std::max(0.0, most - model.least_scale);
    double turn = model.least_turn_rad + random.next_unit() * (model.most_turn_rad - model.least_turn_rad);
    Planted planted;
    planted.model = m, planted.scale = float(scale), planted.turn_rad = float(turn);
    return planted;
}

std::vector<Model> models_of(const PlantOptions& options) {
    std::vector<Model> models;
    for (const PlantModel& model : options.models) models.push_back({model.name, model.tight_radius_m, model.packing_radius_m});
    return models;
}

Result<void> check_tile_size(const TileSet& set, const PlantOptions& options) {
    double least = least_tile_size_m(options);
    if (options.tile_size_m < least)
        return bad_input(
            "tile_size_m: {:g} is too small: corners and edges of tiles with packing radii up to {:g} m take {:.4g} m",
            options.tile_size_m, greatest_radius(options), least);
    double tiles = double(set.tiles.size()), most_radii = std::sqrt(std::min(kMostSquaresOfATile, kMostSquares / tiles));
    for (const PlantModel& model : options.models) {
        double radius_m = double(model.packing_radius_m) * model.least_scale;
        if (options.tile_size_m > most_radii * radius_m)
            return bad_input(
                "tile_size_m: {:g} is too large: {} tiles are planted up to {:.4g} times as wide as a packing radius, that of {} "
                "is "
                "{:g} m; ask for tiles of {:.4g} m at most, fewer of them or a greater packing_radius_m",
                options.tile_size_m, set.tiles.size(), most_radii, model.name, radius_m, most_radii * radius_m);
    }
    return {};
}

}  // namespace overlook::wang_ldi
