// Where the camera stands where nobody says it, and over what. Flights are interpolated by runtime/view/flight.h.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "formats/terrain.h"
#include "runtime/player/controls.h"
#include "runtime/view/camera.h"

namespace overlook::player {

// A view over the whole terrain from above one of its southern corners, the horizon in the upper third.
// lowest_m, highest_m: range of its heights.
view::Camera overview(const terrain::Terrain& terrain, double lowest_m, double highest_m, uint32_t width_px, uint32_t height_px);
// The same of one of which only the head is known, with the mean of its heights, the greatest, and its ground at x, y.
view::Camera overview(const terrain::Terrain& head, double mean_m, double highest_m,
                      const std::function<std::optional<double>(double x_m, double y_m)>& ground, uint32_t width_px,
                      uint32_t height_px);

// Height of the ground at x, y: the highest of the four samples round about; none beyond the raster or where one is void.
std::optional<double> ground_m(const terrain::Terrain& terrain, double x_m, double y_m);

// A terrain, which must outlive it, as the hands feel it.
class TerrainGround : public Ground {
  public:
    explicit TerrainGround(const terrain::Terrain& terrain) : terrain_(terrain) {}
    std::optional<double> height_m(double x_m, double y_m) const override { return ground_m(terrain_, x_m, y_m); }
    double distance_m(const glm::dvec3& place_m) const override;
    double step_m() const override;  // a cell
    double least_speed_m_s() const override { return 4; }

  private:
    const terrain::Terrain& terrain_;
};

}  // namespace overlook::player
