// Where the camera stands, frame by frame.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "formats/terrain.h"
#include "runtime/view/camera.h"

namespace overlook::player {

// The camera at `share` (0..1) of the way through the keys, which are equally far apart in time; between two keys everything
// changes evenly, the heading the shorter way round. keys must not be empty.
view::Camera camera_at(const std::vector<view::Camera>& keys, double share);

// A view over the whole terrain from above one of its southern corners, the horizon in the upper third.
// lowest_m, highest_m: range of its heights.
view::Camera overview(const terrain::Terrain& terrain, double lowest_m, double highest_m, uint32_t width_px, uint32_t height_px);

// Height of the ground at x, y: the highest of the four samples round about; none beyond the raster or where one is void.
std::optional<double> ground_m(const terrain::Terrain& terrain, double x_m, double y_m);

}  // namespace overlook::player
