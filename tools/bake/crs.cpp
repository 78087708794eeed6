// Tables of coordinate reference systems. Source: IOGP, EPSG Geodetic Parameter Dataset (codes, ellipsoids, zones).

#include "tools/bake/crs.h"

namespace overlook::dem {
namespace {

struct Ellipsoid {
    double equatorial_radius_m;
    double flattening;
};
constexpr Ellipsoid kWgs84{6378137, 1 / 298.257223563};
constexpr Ellipsoid kGrs80{6378137, 1 / 298.257222101};
constexpr Ellipsoid kClarke1866{6378206.4, (6378206.4 - 6356583.8) / 6378206.4};

struct Geographic {
    uint32_t code;
    const Ellipsoid& ellipsoid;
};
constexpr Geographic kGeographic[] = {
    {4326, kWgs84},       // WGS 84
    {4979, kWgs84},       // WGS 84, three-dimensional
    {4258, kGrs80},       // ETRS89
    {4267, kClarke1866},  // NAD27
    {4269, kGrs80},       // NAD83
    {4283, kGrs80},       // GDA94
    {4617, kGrs80},       // NAD83(CSRS)
    {4674, kGrs80},       // SIRGAS 2000
    {4759, kGrs80},       // NAD83(NSRS2007)
    {6318, kGrs80},       // NAD83(2011)
    {7844, kGrs80},       // GDA2020
};

// Codes first..last are the zones first_zone.. of one hemisphere.
struct UtmRange {
    uint32_t first, last;
    int first_zone;
    bool is_south;
    const Ellipsoid& ellipsoid;
};
constexpr UtmRange kUtm[] = {
    {32601, 32660, 1, false, kWgs84},                                          // WGS 84
    {32701, 32760, 1, true, kWgs84},       {25828, 25838, 28, false, kGrs80},  // ETRS89
    {26701, 26722, 1, false, kClarke1866},                                     // NAD27
    {26901, 26923, 1, false, kGrs80},                                          // NAD83
    {3372, 3373, 59, false, kGrs80},       {2955, 2957, 11, false, kGrs80},    // NAD83(CSRS)
    {2958, 2962, 17, false, kGrs80},       {3154, 3157, 7, false, kGrs80},
    {3158, 3160, 14, false, kGrs80},       {3706, 3707, 59, false, kGrs80},   // NAD83(NSRS2007)
    {3708, 3726, 1, false, kGrs80},        {6328, 6329, 59, false, kGrs80},   // NAD83(2011)
    {6330, 6348, 1, false, kGrs80},        {28348, 28358, 48, true, kGrs80},  // GDA94, as MGA
    {7846, 7859, 46, true, kGrs80},                                           // GDA2020, as MGA
    {31965, 31976, 11, false, kGrs80},                                        // SIRGAS 2000
    {31977, 31985, 17, true, kGrs80},      {3097, 3101, 51, false, kGrs80},   // JGD2000
    {6688, 6692, 51, false, kGrs80},                                          // JGD2011
};

constexpr uint16_t kUserDefined = 32767;
constexpr const char* kKnown = "known are degrees, UTM and EPSG:3857";
constexpr const char* kWayOut = "give the size of its cells with --cell-size-m";

Crs utm(int zone, bool is_south, const Ellipsoid& ellipsoid, std::string name) {
    return {CrsKind::utm, ellipsoid.equatorial_radius_m, ellipsoid.flattening, zone, is_south, 1, std::move(name)};
}

// ' ("the file's own words")', or nothing.
std::string quoted_citation(const GeoTiffTags& tags) {
    return tags.citation.empty() ? "" : fmt::format(" (\"{}\")", tags.citation);
}

// UTM spelt out instead of named: ProjectedType user-defined, Projection 160zz or 161zz, on a known geographic reference.
std::optional<Crs> utm_from_projection(const GeoTiffTags& tags) {
    const uint32_t projection = tags.key(kProjection).value_or(0);
    const std::optional<Crs> base = crs_from_epsg(tags.key(kGeographicType).value_or(0));
    const bool is_north = projection >= 16001 && projection <= 16060, is_south = projection >= 16101 && projection <= 16160;
    if (!base || base->kind != CrsKind::degrees || !(is_north || is_south)) return std::nullopt;
    const int zone = int(projection % 100);
    return utm(zone, is_south, {base->equatorial_radius_m, base->flattening},
               fmt::format("{} as UTM {}{}", base->name, zone, is_south ? 'S' : 'N'));
}

Result<Crs> projected_from_keys(const GeoTiffTags& tags, uint16_t code, const std::string& name) {
    std::optional<Crs> crs = code == kUserDefined ? utm_from_projection(tags) : crs_from_epsg(code);
    if (!crs && code == kUserDefined)
        return bad_input("{}: a user-defined coordinate reference system{} is not known; {}; {}", name, quoted_citation(tags),
                         kKnown, kWayOut);
    if (!crs || crs->kind == CrsKind::degrees)
        return bad_input("{}: coordinate reference system EPSG:{}{} is not known; {}; {}", name, code, quoted_citation(tags),
                         kKnown, kWayOut);
    const uint16_t unit = tags.key(kProjLinearUnits).value_or(9001);
    const std::optional<double> metres = metres_per_unit(unit);
    if (!metres) return bad_input("{}: its coordinates are in unit {}, which is not known; {}", name, unit, kWayOut);
    crs->metres_per_unit = *metres;
    return *crs;
}

}  // namespace

std::optional<Crs> crs_from_epsg(uint32_t code) {
    if (code == 3857) return Crs{CrsKind::web_mercator, kWgs84.equatorial_radius_m, kWgs84.flattening, 0, false, 1, "EPSG:3857"};
    for (const Geographic& known : kGeographic)
        if (known.code == code)
            return Crs{CrsKind::degrees,
                       known.ellipsoid.equatorial_radius_m,
                       known.ellipsoid.flattening,
                       0,
                       false,
                       1,
                       fmt::format("EPSG:{}", code)};
    for (const UtmRange& range : kUtm)
        if (code >= range.first && code <= range.last)
            return utm(range.first_zone + int(code - range.first), range.is_south, range.ellipsoid, fmt::format("EPSG:{}", code));
    return std::nullopt;
}

Result<Crs> crs_from_keys(const GeoTiffTags& tags, const std::string& name) {
    if (const auto projected = tags.key(kProjectedType)) return projected_from_keys(tags, *projected, name);
    const auto geographic = tags.key(kGeographicType);
    if (!geographic) return bad_input("{}: has no coordinate reference system; {}", name, kWayOut);
    const uint16_t model = tags.key(kGtModelType).value_or(2);
    if (model != 2)
        return bad_input("{}: its coordinates are no longitudes and latitudes (GTModelType {}); {}", name, model, kWayOut);
    const std::optional<Crs> crs = crs_from_epsg(*geographic);
    if (!crs || crs->kind != CrsKind::degrees)
        return bad_input("{}: coordinate reference system EPSG:{}{} is not known; {}; {}", name, *geographic,
                         quoted_citation(tags), kKnown, kWayOut);
    const uint16_t unit = tags.key(kGeogAngularUnits).value_or(9102);
    if (unit != 9102) return bad_input("{}: its angles are in unit {}, not in degrees (9102); {}", name, unit, kWayOut);
    return *crs;
}

std::optional<double> metres_per_unit(uint32_t code) {
    switch (code) {
        case 9001:
            return 1.0;
        case 9002:
            return 0.3048;
        case 9003:
            return 1200.0 / 3937.0;
        default:
            return std::nullopt;
    }
}

Result<double> height_scale_from_keys(const GeoTiffTags& tags, const std::string& name) {
    constexpr uint16_t kNgvd29Foot = 5702, kNavd88SurveyFoot = 6360, kNavd88Foot = 8228;
    if (const auto unit = tags.key(kVerticalUnits)) {
        if (const auto metres = metres_per_unit(*unit)) return *metres;
        return bad_input("{}: heights are in unit {}, which is not known; give metres per unit with --height-scale-m", name,
                         *unit);
    }
    const uint16_t type = tags.key(kVerticalType).value_or(0);
    if (type == kNgvd29Foot || type == kNavd88SurveyFoot) return *metres_per_unit(9003);
    if (type == kNavd88Foot) return *metres_per_unit(9002);
    return 1.0;
}

}  // namespace overlook::dem
