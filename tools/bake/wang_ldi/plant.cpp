#include "tools/bake/wang_ldi/plant.h"

#include <algorithm>

#include "tools/bake/wang_ldi/evenness.h"
#include "tools/bake/wang_ldi/planter.h"

namespace overlook::wang_ldi {
namespace {

// Tiles with those objects whose rank is below the density where they stand.
class Assembler {
  public:
    Assembler(const TileSet& set, const PlantOptions& options, const OwnedObjects& owned, double density)
        : set_(set), size_(options.tile_size_m), owned_(owned), density_(density) {
        planting_.tile_size_m = options.tile_size_m, planting_.models = models_of(options);
    }

    Planting run() {
        for (const Tile& tile : set_.tiles) {
            auto t = planting_.tiles.size();
            planting_.tiles.emplace_back();
            std::array<uint8_t, 4> c = corners_of(set_, tile);
            for (size_t i = 0; i < 4; ++i) place(owned_.corners[c[i]], c, (i & 1) ? size_ : 0, (i >> 1) ? size_ : 0);
            place(owned_.horizontals[tile.south], c, 0, 0), place(owned_.horizontals[tile.north], c, 0, size_);
            place(owned_.verticals[tile.west], c, 0, 0), place(owned_.verticals[tile.east], c, size_, 0);
            place(owned_.interiors[t], c, 0, 0);
        }
        return std::move(planting_);
    }

  private:
    // Of an edge only its own two corners count, so that both sides of it agree.
    double density_at(const Placed& object, const std::array<uint8_t, 4>& corners, double x, double y) const {
        auto of = [&](size_t i) { return double(set_.corner_density[corners[i]]); };
        double u = std::clamp(x / size_, 0.0, 1.0), v = std::clamp(y / size_, 0.0, 1.0);
        if (object.planted.owner == Owner::corner) u = std::round(u), v = std::round(v);
        if (object.planted.owner == Owner::horizontal_edge) v = std::round(v);
        if (object.planted.owner == Owner::vertical_edge) u = std::round(u);
        return density_ * ((1 - v) * ((1 - u) * of(0) + u * of(1)) + v * ((1 - u) * of(2) + u * of(3)));
    }

    void place(const Objects& objects, const std::array<uint8_t, 4>& corners, double move_x, double move_y) {
        for (const Placed& object : objects) {
            // The middle as it is stored decides which tile holds it.
            double x = object.x + move_x, y = object.y + move_y;
            bool is_here = x >= 0 && y >= 0 && x < size_ && y < size_;
            if (!is_here || !(object.rank < density_at(object, corners, x, y))) continue;
            Planted planted = object.planted;
            planted.x_m = std::min(float(x), std::nextafter(float(size_), 0.0f)),
            planted.y_m = std::min(float(y), std::nextafter(float(size_), 0.0f));
            planting_.tiles.back().push_back(planted);
        }
    }

    const TileSet& set_;
    double size_;
    const OwnedObjects& owned_;
    double density_;
    Planting planting_;
};

// Of the models by weight, in the tiles that are planted in full, if there are some.
double mean_density(const TileSet& set, const PlantOptions& options, const Planting& planting) {
    Planting full = fully_planted(set, planting);
    size_t objects = 0;
    for (const auto& tile : full.tiles)
        for (const Planted& object : tile) objects += options.models[object.model].per_tile == 0;
    return double(objects) / double(full.tiles.size()) / (planting.tile_size_m * planting.tile_size_m);
}

// The density, as a share of the full one, at which the mean is nearest to what is asked for.
double share_for(const TileSet& set, const PlantOptions& options, const OwnedObjects& owned) {
    auto mean_at = [&](double share) { return mean_density(set, options, Assembler(set, options, owned, share).run()); };
    double low = 0, high = 1;
    for (int step = 0; step < 24; ++step) {
        double middle = (low + high) / 2;
        (mean_at(middle) < options.density_per_m2 ? low : high) = middle;
    }
    return options.density_per_m2 - mean_at(low) < mean_at(high) - options.density_per_m2 ? low : high;
}

}  // namespace

Result<Planting> plant(const TileSet& set, const PlantOptions& options, PlantReport& report) {
    if (auto fits = check_tile_size(set, options); !fits) return tl::unexpected(fits.error());
    Planting best;
    double least = HUGE_VAL;
    report.candidates = options.candidates;
    for (uint32_t attempt = 0; attempt < options.candidates; ++attempt) {
        auto made = plant_once(set, options, attempt);
        if (!made) return tl::unexpected(made.error());
        const OwnedObjects& owned = *made;
        Planting planting = Assembler(set, options, owned, 1).run();
        double full = mean_density(set, options, planting);
        if (options.density_per_m2 > 0 && full >= options.density_per_m2)
            planting = Assembler(set, options, owned, share_for(set, options, owned)).run();
        double unevenness = unevenness_of(set, planting, edge_reach_m(options));
        bool is_met = full >= options.density_per_m2;
        if (full > report.full_density_per_m2) report.full_density_per_m2 = full;
        if (!is_met || unevenness >= least) continue;
        least = unevenness, report.kept = attempt, report.density_per_m2 = mean_density(set, options, planting);
        best = std::move(planting);
    }
    if (best.tiles.empty())
        return bad_input("density_per_m2: {:g} a square metre do not fit; {:.4g} do, {:.4g} on a tile of {:g} m",
                         options.density_per_m2, report.full_density_per_m2,
                         report.full_density_per_m2 * options.tile_size_m * options.tile_size_m, options.tile_size_m);
    return best;
}

}  // namespace overlook::wang_ldi
