// The grid of a GeoTIFF: which place each sample has. Source: OGC 19-008r4, "OGC GeoTIFF Standard 1.1", 2019, section 7.

#include <cmath>

#include "tools/bake/georeference.h"

namespace overlook::dem {
namespace {

// Of the corner of cell (0, 0), or of its middle: as the tags have it.
Result<GridPlacement> placement_of_raster_space(const GeoTiffTags& tags, const std::string& name) {
    if (!tags.transformation.empty()) {
        const std::vector<double>& m = tags.transformation;
        return GridPlacement{m[3], m[7], m[0], m[4], m[1], m[5]};
    }
    if (tags.pixel_scale.empty() && tags.tie_points.size() > 6)
        return bad_input(
            "{}: is placed by {} control points, not by a grid; warp it first, or give the size of its cells with "
            "--cell-size-m",
            name, tags.tie_points.size() / 6);
    if (tags.pixel_scale.empty() || tags.tie_points.empty())
        return bad_input(
            "{}: has a coordinate reference system but no grid in it (ModelPixelScale and ModelTiepoint, or "
            "ModelTransformation); give the size of its cells with --cell-size-m",
            name);
    const double scale_x = tags.pixel_scale[0], scale_y = tags.pixel_scale[1];
    const std::vector<double>& t = tags.tie_points;
    return GridPlacement{t[3] - t[0] * scale_x, t[4] + t[1] * scale_y, scale_x, 0, 0, -scale_y};
}

}  // namespace

Result<GridPlacement> placement_from_tags(const GeoTiffTags& tags, const std::string& name) {
    Result<GridPlacement> grid = placement_of_raster_space(tags, name);
    if (!grid) return grid;
    if (!(std::hypot(grid->column_x, grid->column_y) > 0) || !(std::hypot(grid->row_x, grid->row_y) > 0))
        return bad_input("{}: a step of its grid is zero; give the size of its cells with --cell-size-m", name);
    constexpr uint16_t kPixelIsArea = 1, kPixelIsPoint = 2;
    const uint16_t raster_type = tags.key(kGtRasterType).value_or(kPixelIsArea);
    if (raster_type != kPixelIsArea && raster_type != kPixelIsPoint)
        return bad_input("{}: GTRasterType is {}, neither 1 (area) nor 2 (point)", name, raster_type);
    if (raster_type == kPixelIsArea) {
        grid->origin_x += 0.5 * (grid->column_x + grid->row_x);
        grid->origin_y += 0.5 * (grid->column_y + grid->row_y);
    }
    return grid;
}

Mirroring mirroring_of(const GridPlacement& grid) {
    Mirroring mirroring;
    mirroring.rows = grid.row_y > 0;
    const double row_x = mirroring.rows ? -grid.row_x : grid.row_x, row_y = mirroring.rows ? -grid.row_y : grid.row_y;
    // Right of "up" (against the rows) must be the columns' direction.
    mirroring.columns = grid.column_x * -row_y - grid.column_y * -row_x < 0;
    return mirroring;
}

GridPlacement mirrored(const GridPlacement& grid, const Mirroring& mirroring, uint32_t width, uint32_t height) {
    GridPlacement result = grid;
    if (mirroring.columns) {
        result.origin_x += grid.column_x * (width - 1);
        result.origin_y += grid.column_y * (width - 1);
        result.column_x = -grid.column_x;
        result.column_y = -grid.column_y;
    }
    if (mirroring.rows) {
        result.origin_x += grid.row_x * (height - 1);
        result.origin_y += grid.row_y * (height - 1);
        result.row_x = -grid.row_x;
        result.row_y = -grid.row_y;
    }
    return result;
}

}  // namespace overlook::dem
