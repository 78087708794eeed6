// A set of plants scattered over gentle hills, as instances of chains of levels: what planting is compared with.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/scene.h"
#include "tools/make_sample/glb.h"
#include "tools/make_sample/sample_plants.h"

namespace overlook::sample {

struct PlantedPlace {
    uint32_t plant = 0;  // number in the set
    glm::dvec3 at_m{0};
    double turn_deg = 0, scale = 1;
};

struct PlantField {
    double side_m = 0;
    std::vector<PlantedPlace> places;  // [count], the largest first
};

// Height of the ground in the field's middle part and round about; slopes of at most 0.21.
double hill_m(const PlantField& field, double x_m, double y_m);

// count plants by their shares on a square about the origin, no two packing radii overlapping. O(count) throws.
PlantField plant_field(const PlantSet& set, uint32_t count, uint64_t seed);

// Earth with weeds, a share of 0..1 of it, whose edges meet; u, v: 0..1.
glm::dvec4 soil_at(uint64_t seed, double weeds, double u, double v);

// The ground, somewhat larger than the field; weeds: how much of it is green, 0..1. Fails as png_bytes does.
Result<GlbNode> hills_of(const PlantField& field, double weeds, uint64_t seed);
// hills.ovl and NAME.ovl of each model that stands somewhere, by the method discrete.
std::string scene_of_field(const PlantSet& set, const PlantField& field);
// Northwards through the field at eye_m above the ground.
scene::Flight flight_of_field(const PlantField& field, double eye_m);

}  // namespace overlook::sample
