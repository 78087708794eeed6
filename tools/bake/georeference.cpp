// True distances of a raster's cells, through GeographicLib (whose only source file in the bakers is this one).
//
// Scales. Degrees: a step of longitude is N cos(lat), a step of latitude is M, the two radii of curvature of the ellipsoid. UTM:
// C. F. F. Karney, "Transverse Mercator with an accuracy of a few nanometers", 2011, gives scale and convergence. Web mercator
// (EPSG:3857) takes the latitude of the ellipsoid through the formulas of the sphere, so it is stretched by a / (N cos(lat))
// to the east but a / (M cos(lat)) to the north.

#include "tools/bake/georeference.h"

#include <GeographicLib/Ellipsoid.hpp>
#include <GeographicLib/TransverseMercator.hpp>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace overlook::dem {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;
constexpr double kUtmScale = 0.9996, kFalseEasting_m = 500000, kFalseNorthing_m = 10000000;
// Beyond this distance from the zone's middle UTM is no map any more, and Krueger's series lose their accuracy.
constexpr double kUtmReach_m = 3000000;
constexpr double kLeastCosine = 1e-6;  // nearer to a pole a cell has no width

// What the reference does at one point.
struct LocalScale {
    double metres_per_x = 1;  // true metres per coordinate unit, to the grid's east
    double metres_per_y = 1;  // and to its north
    double latitude_deg = 0;
    double longitude_deg = 0;
    double convergence_deg = 0;  // of the grid's north, clockwise from true north
};

// The projections of a reference, built once.
struct Projection {
    Crs crs;
    GeographicLib::Ellipsoid ellipsoid;
    GeographicLib::TransverseMercator transverse_mercator;

    explicit Projection(const Crs& of)
        : crs(of),
          ellipsoid(of.equatorial_radius_m, of.flattening),
          transverse_mercator(of.equatorial_radius_m, of.flattening, kUtmScale) {}
};

LocalScale scale_in_degrees(const Projection& projection, double x, double y) {
    // CircleRadius(lat) = N cos(lat).
    return {projection.ellipsoid.CircleRadius(y) * kRadiansPerDegree,
            projection.ellipsoid.MeridionalCurvatureRadius(y) * kRadiansPerDegree, y, x, 0};
}

LocalScale scale_in_utm(const Projection& projection, double x, double y) {
    const Crs& crs = projection.crs;
    const double easting_m = x * crs.metres_per_unit - kFalseEasting_m;
    const double northing_m = y * crs.metres_per_unit - (crs.is_south ? kFalseNorthing_m : 0);
    double latitude_deg = 0, longitude_deg = 0, convergence_deg = 0, scale = 1;
    projection.transverse_mercator.Reverse(6.0 * crs.zone - 183, easting_m, northing_m, latitude_deg, longitude_deg,
                                           convergence_deg, scale);
    return {crs.metres_per_unit / scale, crs.metres_per_unit / scale, latitude_deg, longitude_deg, convergence_deg};
}

LocalScale scale_in_web_mercator(const Projection& projection, double x, double y) {
    const double radius_m = projection.crs.equatorial_radius_m, unit = projection.crs.metres_per_unit;
    const double latitude_deg = std::atan(std::sinh(y * unit / radius_m)) / kRadiansPerDegree;
    const double cosine = std::cos(latitude_deg * kRadiansPerDegree);
    return {unit * projection.ellipsoid.CircleRadius(latitude_deg) / radius_m,
            unit * projection.ellipsoid.MeridionalCurvatureRadius(latitude_deg) * cosine / radius_m, latitude_deg,
            x * unit / radius_m / kRadiansPerDegree, 0};
}

LocalScale scale_at(const Projection& projection, double x, double y) {
    switch (projection.crs.kind) {
        case CrsKind::degrees:
            return scale_in_degrees(projection, x, y);
        case CrsKind::utm:
            return scale_in_utm(projection, x, y);
        case CrsKind::web_mercator:
            return scale_in_web_mercator(projection, x, y);
    }
    return {};
}

struct Point {
    double x = 0, y = 0;
};
Point point_at(const GridPlacement& grid, double column, double row) {
    return {grid.origin_x + grid.column_x * column + grid.row_x * row, grid.origin_y + grid.column_y * column + grid.row_y * row};
}

// The raster's corners lie where the reference means something; what lies between them then does too.
Result<void> check_reach(const Crs& crs, const GridPlacement& grid, uint32_t width, uint32_t height, const std::string& name) {
    for (const double column : {0.0, double(width - 1)})
        for (const double row : {0.0, double(height - 1)}) {
            const Point p = point_at(grid, column, row);
            if (crs.kind == CrsKind::degrees && !(std::abs(p.y) <= 90 + 1e-9))
                return bad_input("{}: reaches latitude {:.6g}; is its reference ({}) right?", name, p.y, crs.name);
            if (crs.kind == CrsKind::degrees && !(std::abs(p.x) <= 720))
                return bad_input("{}: reaches longitude {:.6g}; is its reference ({}) right?", name, p.x, crs.name);
            const double easting_m = p.x * crs.metres_per_unit - kFalseEasting_m, northing_m = p.y * crs.metres_per_unit;
            if (crs.kind == CrsKind::utm && !(std::abs(easting_m) <= kUtmReach_m && std::abs(northing_m) <= 2 * kFalseNorthing_m))
                return bad_input("{}: reaches easting {:.6g}, northing {:.6g}; is its reference ({}) right?", name, p.x, p.y,
                                 crs.name);
            const double world_m = 1.01 * std::numbers::pi * crs.equatorial_radius_m;
            if (crs.kind == CrsKind::web_mercator &&
                !(std::max(std::abs(p.x), std::abs(p.y)) * crs.metres_per_unit <= 4 * world_m))
                return bad_input("{}: reaches easting {:.6g}, northing {:.6g}; is its reference ({}) right?", name, p.x, p.y,
                                 crs.name);
        }
    return {};
}

// Columns and rows are at right angles in the reference and, where that turns true angles, along its axes.
Result<void> check_shape(const Crs& crs, const GridPlacement& grid, const std::string& name) {
    const double column = std::hypot(grid.column_x, grid.column_y), row = std::hypot(grid.row_x, grid.row_y);
    const double cosine = (grid.column_x * grid.row_x + grid.column_y * grid.row_y) / (column * row);
    if (!(std::abs(cosine) <= 1e-6))
        return bad_input("{}: its grid is sheared: columns and rows meet at {:.4g} degrees; warp it to a right-angled one", name,
                         std::acos(std::clamp(cosine, -1.0, 1.0)) / kRadiansPerDegree);
    const double turn_deg = std::atan2(grid.column_y, grid.column_x) / kRadiansPerDegree;
    if (crs.kind != CrsKind::utm && std::abs(grid.column_y) > 1e-6 * column)
        return bad_input("{}: its grid is turned by {:.4g} degrees, which {} cannot have with square corners; warp it", name,
                         turn_deg, crs.name);
    return {};
}

// True lengths of one step along columns and rows at a point.
struct CellSize {
    double column_m = 0, row_m = 0;
};
CellSize cell_size(const LocalScale& scale, const GridPlacement& grid) {
    return {std::hypot(grid.column_x * scale.metres_per_x, grid.column_y * scale.metres_per_y),
            std::hypot(grid.row_x * scale.metres_per_x, grid.row_y * scale.metres_per_y)};
}

// Where along a line from a to b the coordinate passes zero (equator, central meridian), as a share of it.
std::optional<double> crossing(double a, double b, double zero) {
    if ((a - zero) * (b - zero) >= 0) return std::nullopt;
    return (zero - a) / (b - a);
}

// The greatest relative error of `middle` anywhere in the raster. In degrees and web mercator the sizes depend on the latitude
// alone and are monotone in its distance from the equator; in UTM the scale grows with the distance from the central meridian. So
// the extremes lie on the raster's rim or where the equator or the central meridian crosses it. Sampled is a lattice of 65 x 65,
// and on each of its lines that crossing. (A rim point between two samples is off by the second order: 3e-5 of what the scale
// varies over the raster.)
double greatest_relative_error(const Projection& projection, const GridPlacement& grid, uint32_t width, uint32_t height,
                               const CellSize& middle) {
    constexpr int kSteps = 64;
    double greatest = 0;
    const auto visit = [&](double column, double row) {
        const Point p = point_at(grid, column, row);
        const CellSize size = cell_size(scale_at(projection, p.x, p.y), grid);
        greatest = std::max({greatest, std::abs(size.column_m / middle.column_m - 1), std::abs(size.row_m / middle.row_m - 1)});
    };
    const bool is_utm = projection.crs.kind == CrsKind::utm;
    const double central_x = kFalseEasting_m / projection.crs.metres_per_unit;
    for (int i = 0; i <= kSteps; ++i) {
        const double row = double(height - 1) * i / kSteps, column = double(width - 1) * i / kSteps;
        for (int j = 0; j <= kSteps; ++j) visit(double(width - 1) * j / kSteps, row);
        const Point left = point_at(grid, 0, row), right = point_at(grid, width - 1, row);
        const Point top = point_at(grid, column, 0), bottom = point_at(grid, column, height - 1);
        const auto along_row = is_utm ? crossing(left.x, right.x, central_x) : std::nullopt;
        const auto along_column = is_utm ? crossing(top.x, bottom.x, central_x) : crossing(top.y, bottom.y, 0);
        if (along_row) visit(*along_row * (width - 1), row);
        if (along_column) visit(column, *along_column * (height - 1));
    }
    return greatest;
}

// An angle brought into (-180, 180].
double wrapped_deg(double angle_deg) {
    const double rest = std::remainder(angle_deg, 360.0);
    return rest <= -180 ? rest + 360 : rest;
}

}  // namespace

Result<terrain::Frame> frame_of(const Crs& crs, const GridPlacement& grid, uint32_t width, uint32_t height,
                                const std::string& name) {
    if (auto r = check_shape(crs, grid, name); !r) return tl::unexpected(r.error());
    if (auto r = check_reach(crs, grid, width, height, name); !r) return tl::unexpected(r.error());
    try {
        const Projection projection(crs);
        const Point middle = point_at(grid, (width - 1) / 2.0, (height - 1) / 2.0);
        const LocalScale scale = scale_at(projection, middle.x, middle.y);
        if (!(std::cos(scale.latitude_deg * kRadiansPerDegree) > kLeastCosine))
            return bad_input("{}: its middle is at a pole, where a cell has no width; use a projected one", name);
        const CellSize size = cell_size(scale, grid);
        if (!std::isfinite(size.column_m) || !std::isfinite(size.row_m) || !(size.column_m > 0) || !(size.row_m > 0))
            return bad_input("{}: its cells measure {:.6g} x {:.6g} m; is its reference ({}) right?", name, size.column_m,
                             size.row_m, crs.name);

        terrain::Frame frame;
        frame.metres_per_column = size.column_m;
        frame.metres_per_row = size.row_m;
        frame.is_georeferenced = true;
        frame.centre_latitude_deg = scale.latitude_deg;
        frame.centre_longitude_deg = wrapped_deg(scale.longitude_deg);
        const double up_from_grid_north_deg = std::atan2(-grid.row_x, -grid.row_y) / kRadiansPerDegree;
        frame.convergence_deg = wrapped_deg(scale.convergence_deg + up_from_grid_north_deg);
        frame.scale_distortion = greatest_relative_error(projection, grid, width, height, size);
        frame.crs = crs.name;
        return frame;
    } catch (const std::exception& problem) {
        return bad_input("{}: its place in {} cannot be computed: {}", name, crs.name, problem.what());
    }
}

}  // namespace overlook::dem
