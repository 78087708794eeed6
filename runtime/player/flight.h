// Where the camera stands where nobody says it, and over what. Flights are interpolated by runtime/view/flight.h.
#pragma once

#include <cstdint>
#include <optional>

#include "formats/terrain.h"
#include "runtime/view/camera.h"

namespace overlook::player {

// A view over the whole terrain from above one of its southern corners, the horizon in the upper third.
// lowest_m, highest_m: range of its heights.
view::Camera overview(const terrain::Terrain& terrain, double lowest_m, double highest_m, uint32_t width_px, uint32_t height_px);

// Height of the ground at x, y: the highest of the four samples round about; none beyond the raster or where one is void.
std::optional<double> ground_m(const terrain::Terrain& terrain, double x_m, double y_m);

}  // namespace overlook::player
