#include "tools/bake/wang_ldi/planter.h"

#include <algorithm>

#include "tools/bake/wang_ldi/free_area.h"

namespace overlook::wang_ldi {
namespace {

bool is_in(const std::vector<Bounds>& rects, double x, double y) {
    return std::any_of(rects.begin(), rects.end(),
                       [&](const Bounds& r) { return x >= r.low_x && x <= r.high_x && y >= r.low_y && y <= r.high_y; });
}

// One planting at full density, of everything that owns objects.
//
// What a corner or an edge owns is what a planting without tiles would have there: its surroundings are filled too, and what
// stands in them is dropped. So nothing crowds at the border of its area, but near that border places may be left that only the
// dropped ones filled. Interiors are thrown anew until none is left; where that fails again and again, the edge or corner gets
// one more object.
class Planter : public OwnedObjects {
  public:
    Planter(const TileSet& set, const PlantOptions& options, uint64_t attempt)
        : set_(set), options_(options), regions_(options), random_(options.seed, attempt), choice_(options) {}

    // Exit::bad_input if something that is wanted in every tile has no place.
    Result<void> run() {
        Bounds about{-2 * regions_.arm, -2 * regions_.arm, 2 * regions_.arm, 2 * regions_.arm};
        for (size_t c = 0; c < set_.corner_density.size(); ++c)
            corners.push_back(fill({about}, regions_.corner(), regions_.corner(deep()), {}, Owner::corner,
                                   1.0 / double(set_.corner_density.size())));
        for (const EdgeColour& edge : set_.horizontal) horizontals.push_back(plant_edge(edge, true));
        for (const EdgeColour& edge : set_.vertical) verticals.push_back(plant_edge(edge, false));
        interiors.resize(set_.tiles.size());
        std::vector<bool> is_full(set_.tiles.size(), false);
        for (size_t t = 0; t < set_.tiles.size();) {
            if (is_full[t]) {
                ++t;
                continue;
            }
            auto left = plant_tile(t);
            if (!left) return tl::unexpected(left.error());
            is_full[t] = true;
            if (!*left) continue;
            for (size_t u : give_to_owner(t, **left)) is_full[u] = false;
            t = 0;
        }
        return {};
    }

  private:
    // A grid about the tile, of what is there already.
    DiscGrid grid_of(const std::vector<Disc>& discs) const {
        double around = 2 * regions_.arm, size = regions_.size;
        DiscGrid grid({-around, -around, size + around, size + around}, greatest_radius(options_) + slack());
        for (const Disc& disc : discs) grid.add({disc.x, disc.y, disc.radius + slack()});
        return grid;
    }
    double slack() const { return kRounding * options_.tile_size_m; }

    double deep() const { return std::min(least_radius(options_), 0.999 * regions_.reach); }

    // Fills `all`, keeps what stands in `own`, and then fills what that leaves of `deep`.
    Objects fill(const std::vector<Bounds>& all, const std::vector<Bounds>& own, const std::vector<Bounds>& deep,
                 const std::vector<Disc>& around, Owner owner, double share) {
        Objects objects;
        throw_until_full(all, own, around, owner, share, objects);
        if (!deep.empty()) throw_until_full(deep, own, around, owner, share, objects);
        double shift = random_.next_unit();
        for (size_t i = 0; i < objects.size(); ++i) objects[i].rank = (double(i) + shift) / double(objects.size());
        return objects;
    }

    void throw_until_full(const std::vector<Bounds>& all, const std::vector<Bounds>& own, const std::vector<Disc>& around,
                          Owner owner, double share, Objects& objects) {
        DiscGrid grid = grid_of(around);
        for (const Placed& object : objects) grid.add({object.x, object.y, object.radius + slack()});
        double least = least_radius(options_);
        FreeArea area(all, least + slack(), kPlaceTolerance * least);
        while (auto place = area.draw(grid, random_)) {
            bool is_own = is_in(own, place->x, place->y);
            Placed object{place->x, place->y, 0, 0, choice_.choose(place->clearance - slack(), is_own ? share : 0, random_)};
            object.planted.owner = owner, object.radius = packing_radius(options_, object.planted);
            grid.add({object.x, object.y, object.radius + slack()});
            if (is_own) objects.push_back(object);
        }
    }

    Objects plant_edge(const EdgeColour& edge, bool is_horizontal) {
        std::vector<Disc> around;
        double along_x = is_horizontal ? regions_.size : 0, along_y = is_horizontal ? 0 : regions_.size;
        for (const Placed& object : corners[edge.low]) around.push_back(object.disc());
        for (const Placed& object : corners[edge.high]) around.push_back(object.disc(along_x, along_y));
        double reach = 3 * regions_.reach;
        Bounds about = is_horizontal ? Bounds{0, -reach, regions_.size, reach} : Bounds{-reach, 0, reach, regions_.size};
        return fill({about}, is_horizontal ? regions_.horizontal_edge() : regions_.vertical_edge(),
                    is_horizontal ? regions_.horizontal_edge(deep()) : regions_.vertical_edge(deep()), around,
                    is_horizontal ? Owner::horizontal_edge : Owner::vertical_edge,
                    1.0 / double(is_horizontal ? set_.horizontal.size() : set_.vertical.size()));
    }

    // Throws a tile's interior until nothing more has a place anywhere in the tile; a place that is left, if that fails.
    Result<std::optional<FreeArea::Place>> plant_tile(size_t t) {
        constexpr int kThrows = 16;
        std::optional<FreeArea::Place> left;
        for (int i = 0; i < kThrows; ++i) {
            ModelChoice before = choice_;
            auto planted = plant_interior(t);
            if (!planted) return tl::unexpected(planted.error());
            interiors[t] = std::move(*planted);
            left = place_left(t);
            if (!left) return left;
            choice_ = before;
        }
        return left;
    }

    // A place outside of the interior's own area; what is left of that, between the squares of fill(), is planted.
    std::optional<FreeArea::Place> place_left(size_t t) {
        std::vector<Disc> discs = around_tile(set_.tiles[t]);
        for (const Placed& object : interiors[t]) discs.push_back(object.disc());
        DiscGrid grid = grid_of(discs);
        Bounds tile{0, 0, regions_.size, regions_.size};
        FreeArea area(std::span(&tile, 1), least_radius(options_) + slack(), kPlaceTolerance * least_radius(options_));
        while (auto place = area.draw(grid, random_)) {
            if (!is_in(regions_.interior(), place->x, place->y)) return place;
            double share = 1.0 / double(set_.tiles.size());
            Placed object{place->x, place->y, 0, random_.next_unit(), choice_.choose(place->clearance - slack(), share, random_)};
            object.radius = packing_radius(options_, object.planted);
            grid.add({object.x, object.y, object.radius + slack()}), interiors[t].push_back(object);
        }
        return std::nullopt;
    }

    // One more object for the edge or the corner in whose area the place is; returns the tiles that it stands about.
    std::vector<size_t> give_to_owner(size_t t, const FreeArea::Place& place) {
        const Tile& tile = set_.tiles[t];
        double size = regions_.size, x = place.x, y = place.y;
        bool is_east = x > size / 2, is_north = y > size / 2;
        double from_x = is_east ? x - size : x, from_y = is_north ? y - size : y;
        std::vector<size_t> touched;
        Placed object{from_x, from_y, 0, random_.next_unit(), choice_.choose(place.clearance - slack(), 0.5, random_)};
        object.radius = packing_radius(options_, object.planted);
        if (is_in(regions_.corner(), from_x, from_y)) {
            uint8_t colour = corners_of(set_, tile)[size_t(is_east) + 2 * size_t(is_north)];
            object.planted.owner = Owner::corner;
            corners[colour].push_back(object);
            drop_edges_at(object, colour);
            for (size_t u = 0; u < set_.tiles.size(); ++u)
                for (uint8_t c : corners_of(set_, set_.tiles[u]))
                    if (c == colour) touched.push_back(u);
            return touched;
        }
        bool is_horizontal = std::abs(from_y) <= regions_.reach;
        uint8_t colour = is_horizontal ? (is_north ? tile.north : tile.south) : (is_east ? tile.east : tile.west);
        object.planted.owner = is_horizontal ? Owner::horizontal_edge : Owner::vertical_edge;
        if (is_horizontal) object.x = x;
        if (!is_horizontal) object.y = y;
        (is_horizontal ? horizontals : verticals)[colour].push_back(object);
        for (size_t u = 0; u < set_.tiles.size(); ++u) {
            const Tile& other = set_.tiles[u];
            if (is_horizontal ? other.north == colour || other.south == colour : other.east == colour || other.west == colour)
                touched.push_back(u);
        }
        return touched;
    }

    // What stands on edges in the way of a corner's new object, whichever of their colours meet there.
    void drop_edges_at(const Placed& object, uint8_t corner) {
        auto drop = [&](std::vector<Objects>& edges, const std::vector<EdgeColour>& colours, double along_x, double along_y) {
            for (size_t c = 0; c < colours.size(); ++c)
                for (bool is_high : {false, true}) {
                    if ((is_high ? colours[c].high : colours[c].low) != corner) continue;
                    double x = object.x + (is_high ? along_x : 0), y = object.y + (is_high ? along_y : 0);
                    std::erase_if(edges[c], [&](const Placed& other) {
                        return std::hypot(other.x - x, other.y - y) < other.radius + object.radius + slack();
                    });
                }
        };
        drop(horizontals, set_.horizontal, regions_.size, 0);
        drop(verticals, set_.vertical, 0, regions_.size);
    }

    std::vector<Disc> around_tile(const Tile& tile) const {
        std::vector<Disc> around;
        double size = regions_.size;
        std::array<uint8_t, 4> colours = corners_of(set_, tile);
        for (size_t c = 0; c < 4; ++c)
            for (const Placed& object : corners[colours[c]])
                around.push_back(object.disc((c & 1) ? size : 0, (c >> 1) ? size : 0));
        for (const Placed& object : horizontals[tile.south]) around.push_back(object.disc());
        for (const Placed& object : horizontals[tile.north]) around.push_back(object.disc(0, size));
        for (const Placed& object : verticals[tile.west]) around.push_back(object.disc());
        for (const Placed& object : verticals[tile.east]) around.push_back(object.disc(size, 0));
        return around;
    }

    // What stands in every tile, then what else has a place.
    Result<Objects> plant_interior(size_t t) {
        std::vector<Disc> around = around_tile(set_.tiles[t]);
        Objects objects;
        auto variant = uint32_t(std::count(set_.tiles.begin(), set_.tiles.begin() + std::ptrdiff_t(t), set_.tiles[t]));
        for (uint32_t m = 0; m < options_.models.size(); ++m) {
            const PlantModel& model = options_.models[m];
            bool is_here = model.variants.empty() || std::count(model.variants.begin(), model.variants.end(), variant) > 0;
            if (auto stands = is_here ? plant_inside(m, around, objects) : Result<void>(); !stands)
                return tl::unexpected(stands.error());
        }
        Objects rest =
            fill(regions_.interior(), regions_.interior(), {}, around, Owner::interior, 1.0 / double(set_.tiles.size()));
        objects.insert(objects.end(), rest.begin(), rest.end());
        return objects;
    }

    Result<void> plant_inside(uint32_t m, std::vector<Disc>& around, Objects& objects) {
        const PlantModel& model = options_.models[m];
        for (uint32_t i = 0; i < model.per_tile; ++i) {
            DiscGrid grid = grid_of(around);
            Planted planted = choice_.of_model(m, greatest_radius(options_), random_);
            double radius = packing_radius(options_, planted), margin = std::max(radius, regions_.reach);
            Bounds inside{margin, margin, regions_.size - margin, regions_.size - margin};
            FreeArea area(std::span(&inside, 1), radius + slack(), kPlaceTolerance * radius);
            auto place = area.draw(grid, random_);
            if (!place)
                return bad_input("{}: per_tile: {} of packing radius {:g} m do not fit inside a tile of {:g} m; {} did",
                                 model.name, model.per_tile, radius, options_.tile_size_m, i);
            objects.push_back({place->x, place->y, radius, 0, planted});
            around.push_back({place->x, place->y, radius});
        }
        return {};
    }

    const TileSet& set_;
    const PlantOptions& options_;
    Regions regions_;
    Random random_;
    ModelChoice choice_;
};

}  // namespace

Result<OwnedObjects> plant_once(const TileSet& set, const PlantOptions& options, uint64_t attempt) {
    Planter planter(set, options, attempt);
    if (auto planted = planter.run(); !planted) return tl::unexpected(planted.error());
    return std::move(static_cast<OwnedObjects&>(planter));
}

}  // namespace overlook::wang_ldi
