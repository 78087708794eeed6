// Independent checks of a cut as what it is: triangles over raster samples. Shares no code with baking or refinement.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "formats/terrain.h"

namespace overlook::terrain {

// A sample of the raster at which something is not as promised.
struct Place {
    uint32_t column = 0, row = 0;
    double measured_m = 0, promised_m = 0;
    std::string what;
};

// The worst places found and how many there were, worst first.
class Places {
  public:
    void add(Place place);
    uint64_t count() const { return count_; }
    const std::vector<Place>& worst() const { return worst_; }
    void join(const Places& other);

  private:
    uint64_t count_ = 0;
    std::vector<Place> worst_;  // at most 10
};

// Heights of the source, [height, width] in metres, NaN = void.
struct Source {
    uint32_t width = 0, height = 0;
    std::vector<double> heights_m;
    double at(uint32_t column, uint32_t row) const { return heights_m[size_t(row) * width + column]; }
};

struct RasterPoint {
    int64_t x = 0, y = 0;
};

// Greatest vertical distance of a triangle, given by three samples and their heights, from the source samples inside it or on its
// border, and where; a void that it covers counts as infinite. Exact point-in-triangle arithmetic, barycentric heights.
Place triangle_deviation(const Source& source, const RasterPoint corners[3], const double heights_m[3]);

struct CutReport {
    uint64_t triangle_count = 0;
    uint64_t covered_samples = 0;
    uint64_t uncovered_valid_samples = 0;  // no triangle of three valid corners can reach them
    uint64_t open_interior_edges = 0;      // of one triangle alone, neither on the raster's border nor on the rim of a void
    uint64_t overused_edges = 0;           // of more than two triangles, or of two on the same side
    uint64_t wrongly_covered_cells =
        0;  // finest cell triangles with valid corners not covered exactly once, or others covered at all
    double greatest_deviation_m = 0;
    Places places;  // samples beyond the tolerance, voids covered
    bool is_sound() const {
        return open_interior_edges == 0 && overused_edges == 0 && wrongly_covered_cells == 0 && places.count() == 0;
    }
};

// Checks every sample, edge and cell of a cut ([3n] indices row * width + column) against the source. O(samples + triangles log
// triangles).
CutReport check_cut(const Terrain& terrain, const Source& source, std::span<const uint32_t> indices, double tolerance_m);

}  // namespace overlook::terrain
