// What the ways of planting share: which model stands where, and where corners, edges and interiors are.
#pragma once

#include <span>
#include <vector>

#include "runtime/wang_ldi/random.h"
#include "tools/bake/wang_ldi/discs.h"
#include "tools/bake/wang_ldi/plant.h"

namespace overlook::wang_ldi {

// An object in the frame of what owns it: a corner at (0, 0), an edge from (0, 0) on along x or y, or a tile's south-west.
struct Placed {
    double x = 0, y = 0;
    double radius = 0;  // packing, scaled
    double rank = 0;    // 0..1, in the order of planting: of a density below 1 those are left whose rank is below it
    Planted planted;

    Disc disc(double move_x = 0, double move_y = 0) const { return {x + move_x, y + move_y, radius}; }
};

// Places stored in single precision, and what is rounded by it, as a share of the tile's size.
constexpr double kRounding = 1e-6;
// Down to which squares are looked at for a free place, as a share of the least packing radius.
constexpr double kPlaceTolerance = 1e-4;

// Areas of middles: a plus about a corner, a band along an edge between two of them, a square within. So far apart that nothing
// of one edge or one interior touches another's.
struct Regions {
    double size = 0, reach = 0, arm = 0;

    explicit Regions(const PlantOptions& options);
    // inset: without what is so near the border to what is planted later. Metres, below reach.
    std::vector<Bounds> corner(double inset = 0) const;
    std::vector<Bounds> horizontal_edge(double inset = 0) const;
    std::vector<Bounds> vertical_edge(double inset = 0) const;
    std::vector<Bounds> interior() const;
};

double least_radius(const PlantOptions& options);     // packing, of those by weight
double greatest_radius(const PlantOptions& options);  // packing, of all

// Chooses models so that their counts keep to their weights.
class ModelChoice {
  public:
    explicit ModelChoice(const PlantOptions& options);
    // A model of those by weight, and a scale and a turn for it, that needs no more than `room` of packing radius; room:
    // least_radius or more. share: how many of it there will be in a tile on average.
    Planted choose(double room, double share, Random& random);
    Planted of_model(uint32_t model, double room, Random& random) const;

  private:
    const PlantOptions* options_;
    double weights_ = 0, all_ = 0;
    std::vector<double> counts_;
};

double packing_radius(const PlantOptions& options, const Planted& object);
double tight_radius(const PlantOptions& options, const Planted& object);

// Planting::models of the options.
std::vector<Model> models_of(const PlantOptions& options);
// What both ways ask of a tile's size: it is no smaller than corners and edges need, and no larger than can be planted and kept.
Result<void> check_tile_size(const TileSet& set, const PlantOptions& options);

}  // namespace overlook::wang_ldi
