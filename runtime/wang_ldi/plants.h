// What is planted, one by one, where it stands on its ground: for drawing it as geometry.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/discrete/select.h"
#include "runtime/view/camera.h"
#include "runtime/wang_ldi/planted_field.h"

namespace overlook::wang_ldi {

// Of one model. Same length each.
struct PlantPlaces {
    std::vector<discrete::Placement> placements;
    std::vector<float> shares;  // 0..1, how much of it is drawn; the rest is left to something else
};

// Adds all that stand on a tile, upright, their feet on the ground: each plant belongs to the tile that its middle is on.
// by_model: [models of the planting].
void add_plants(const PlantedField& planted, int64_t i, int64_t j, float share, std::vector<PlantPlaces>& by_model);

// All on planted tiles up to radius_m from the eye of which something may be in the picture. O(tiles within the radius).
std::vector<PlantPlaces> plants_in_sight(const PlantedField& planted, const view::Camera& camera, double radius_m);

}  // namespace overlook::wang_ldi
