#include <algorithm>
#include <optional>

#include "tools/bake/wang_ldi/plant_parts.h"

namespace overlook::wang_ldi {
namespace {

// A place in a tile, and which of its edges own it.
struct Dart {
    Planted planted;
    double x = 0, y = 0, radius = 0;
    bool is_high = false;  // of an edge: the north or the east one
};

class RoundRobin {
  public:
    RoundRobin(const TileSet& set, const PlantOptions& options)
        : set_(set), options_(options), size_(options.tile_size_m), random_(options.seed, 0x7061), choice_(options) {
        double around = 2 * greatest_radius(options);
        discs_.assign(set.tiles.size(), DiscGrid({-around, -around, size_ + around, size_ + around}, greatest_radius(options)));
        planting_.tile_size_m = size_, planting_.models = models_of(options), planting_.tiles.resize(set.tiles.size());
    }

    Planting run(PlantReport& report) {
        double wanted = options_.density_per_m2 * size_ * size_ * double(set_.tiles.size());
        auto is_enough = [&] { return wanted > 0 && double(objects_) >= wanted; };
        for (bool has_placed = true; has_placed && !is_enough(); ++report.rounds) {
            has_placed = false;
            for (size_t t = 0; t < set_.tiles.size() && !is_enough(); ++t) has_placed |= visit(t);
        }
        report.density_per_m2 = double(objects_) / double(set_.tiles.size()) / (size_ * size_);
        report.full_density_per_m2 = report.density_per_m2, report.candidates = 1;
        return std::move(planting_);
    }

  private:
    // One object, at up to so many places; that found none has had its turn.
    bool visit(size_t t) {
        Planted object = choice_.choose(HUGE_VAL, 1, random_);
        for (uint32_t i = 0; i < options_.tries; ++i) {
            std::optional<Dart> dart = throw_dart(object);
            if (!dart || !has_place(t, *dart)) continue;
            add(t, *dart);
            return true;
        }
        return false;
    }

    // None if its tight radius would protrude across a corner.
    std::optional<Dart> throw_dart(const Planted& object) {
        Dart dart;
        dart.planted = object;
        dart.planted.x_m = float(random_.next_unit() * size_), dart.planted.y_m = float(random_.next_unit() * size_);
        if (double(dart.planted.x_m) >= size_ || double(dart.planted.y_m) >= size_) return std::nullopt;
        dart.x = double(dart.planted.x_m), dart.y = double(dart.planted.y_m);
        dart.radius = packing_radius(options_, dart.planted);
        double tight = tight_radius(options_, dart.planted);
        double from_vertical = std::min(dart.x, size_ - dart.x), from_horizontal = std::min(dart.y, size_ - dart.y);
        if (from_vertical < tight && from_horizontal < tight) return std::nullopt;
        bool is_horizontal = from_horizontal <= from_vertical;
        if (std::min(from_vertical, from_horizontal) < dart.radius) {
            dart.planted.owner = is_horizontal ? Owner::horizontal_edge : Owner::vertical_edge;
            dart.is_high = is_horizontal ? dart.y > size_ / 2 : dart.x > size_ / 2;
        }
        return dart;
    }

    // Calls visit(tile, x, y) for every tile that sees the dart: its own; of an edge's all that have that edge there, and all
    // that have it as their opposite, from outside.
    template <typename Visit>
    void visit_tiles(size_t t, const Dart& dart, Visit visit) {
        if (dart.planted.owner == Owner::interior) return visit(t, dart.x, dart.y);
        bool is_horizontal = dart.planted.owner == Owner::horizontal_edge;
        auto colour_at = [&](const Tile& tile, bool is_high) {
            return is_horizontal ? (is_high ? tile.north : tile.south) : (is_high ? tile.east : tile.west);
        };
        uint8_t colour = colour_at(set_.tiles[t], dart.is_high);
        double move = dart.is_high ? -size_ : size_;
        for (size_t u = 0; u < set_.tiles.size(); ++u) {
            if (colour_at(set_.tiles[u], dart.is_high) == colour) visit(u, dart.x, dart.y);
            if (colour_at(set_.tiles[u], !dart.is_high) == colour)
                visit(u, dart.x + (is_horizontal ? 0 : move), dart.y + (is_horizontal ? move : 0));
        }
    }

    bool has_place(size_t t, const Dart& dart) {
        bool has = true;
        visit_tiles(t, dart, [&](size_t u, double x, double y) {
            if (has)
                discs_[u].visit_near(x, y, [&](const Disc& disc) {
                    double reach = dart.radius + disc.radius;
                    has = (x - disc.x) * (x - disc.x) + (y - disc.y) * (y - disc.y) >= reach * reach;
                    return has;
                });
        });
        return has;
    }

    void add(size_t t, const Dart& dart) {
        visit_tiles(t, dart, [&](size_t u, double x, double y) {
            discs_[u].add({x, y, dart.radius});
            if (x == dart.x && y == dart.y) planting_.tiles[u].push_back(dart.planted), ++objects_;
        });
    }

    const TileSet& set_;
    const PlantOptions& options_;
    double size_;
    Random random_;
    ModelChoice choice_;
    std::vector<DiscGrid> discs_;  // [tile]: what it sees, from outside too
    Planting planting_;
    uint64_t objects_ = 0;
};

}  // namespace

Result<Planting> plant_as_paper(const TileSet& set, const PlantOptions& options, PlantReport& report) {
    if (auto fits = check_tile_size(set, options); !fits) return tl::unexpected(fits.error());
    if (std::any_of(set.corner_density.begin(), set.corner_density.end(), [](float density) { return density < 1; }))
        return bad_input(
            "planting: \"paper\" plants no borders and no corners of less density; leave these out, or plant \"corners\"");
    for (const PlantModel& model : options.models)
        if (model.per_tile > 0)
            return bad_input("{}: per_tile: planting \"paper\" knows shares alone; give it one, or plant \"corners\"",
                             model.name);
    report = {};
    return RoundRobin(set, options).run(report);
}

}  // namespace overlook::wang_ldi
