// From a raster's place in a coordinate reference system to the flat metric frame it is drawn in.
#pragma once

#include <cstdint>
#include <string>

#include "formats/result.h"
#include "formats/terrain.h"
#include "tools/bake/crs.h"

namespace overlook::dem {

// Sample (column, row) stands at origin + column * column_step + row * row_step, in the reference's own coordinates (x to the
// east, y to the north; degrees, or its unit of length).
struct GridPlacement {
    double origin_x = 0, origin_y = 0;
    double column_x = 1, column_y = 0;
    double row_x = 0, row_y = -1;
};

// The grid of a GeoTIFF, moved so that it speaks of samples (the middles of cells where the raster says pixel-is-area).
// Fails with Exit::bad_input if it has none, is placed by control points, or its steps are zero.
Result<GridPlacement> placement_from_tags(const GeoTiffTags& tags, const std::string& name);

// How a raster must be mirrored so that its rows go down the map and its columns to the right of them, its first row the
// northernmost as far as a raster that may be turned can have one.
struct Mirroring {
    bool columns = false;
    bool rows = false;
};
Mirroring mirroring_of(const GridPlacement& grid);
// The same grid after mirroring a raster of width x height samples.
GridPlacement mirrored(const GridPlacement& grid, const Mirroring& mirroring, uint32_t width, uint32_t height);

// The frame of a raster of width x height samples (after mirroring). Cell sizes are true ones on the ellipsoid at the raster's
// middle; scale_distortion is their greatest relative error anywhere in it; the middle's latitude and longitude are of the
// reference's own datum. Cost: about 4000 evaluations of the projection. Fails with Exit::bad_input:
//   "NAME: its grid is sheared: columns and rows meet at 84.3 degrees; warp it to a right-angled one"
//   "NAME: its grid is turned by 12 degrees, which EPSG:4326 cannot have with square corners; warp it"
//   "NAME: reaches latitude 95.2; is its reference right?"
Result<terrain::Frame> frame_of(const Crs& crs, const GridPlacement& grid, uint32_t width, uint32_t height,
                                const std::string& name);

}  // namespace overlook::dem
