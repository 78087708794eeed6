// The coordinate reference systems that Overlook knows: degrees, UTM and web mercator.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "formats/result.h"
#include "tools/bake/geotiff_tags.h"

namespace overlook::dem {

enum class CrsKind { degrees, utm, web_mercator };

struct Crs {
    CrsKind kind = CrsKind::degrees;
    double equatorial_radius_m = 6378137;
    double flattening = 1 / 298.257223563;
    int zone = 0;                // of UTM, 1..60
    bool is_south = false;       // UTM's false northing of 10,000 km
    double metres_per_unit = 1;  // of its coordinates, unless degrees
    std::string name;            // "EPSG:32611"
};

// A reference by its EPSG code; nothing if it is none of those above.
std::optional<Crs> crs_from_epsg(uint32_t code);

// The reference that a GeoTIFF's keys name. Fails with Exit::bad_input:
//   "NAME: has no coordinate reference system; give the size of its cells with --cell-size-m"
//   "NAME: coordinate reference system EPSG:2154 ("RGF93 / Lambert-93") is not known; ...; give the size of its cells with
//   --cell-size-m"
Result<Crs> crs_from_keys(const GeoTiffTags& tags, const std::string& name);

// Metres per unit of length by its EPSG code (9001 metre, 9002 foot, 9003 US survey foot); nothing if unknown.
std::optional<double> metres_per_unit(uint32_t code);

// Metres per unit of the heights, by the keys VerticalUnits, else VerticalType; 1 if there are none. Fails with Exit::bad_input:
//   "NAME: heights are in unit 9036, which is not known; give metres per unit with --height-scale-m"
Result<double> height_scale_from_keys(const GeoTiffTags& tags, const std::string& name);

}  // namespace overlook::dem
