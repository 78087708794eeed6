#include "tools/make_sample/plant_land.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "tools/bake/images.h"
#include "tools/make_sample/geotiff.h"
#include "tools/make_sample/noise.h"
#include "tools/make_sample/plant_field.h"

namespace overlook::sample {
namespace {

constexpr double kHeightStep_m = 1.0 / 64, kStep_s = 1.0 / 32;
constexpr double kSide_m = kLandCell_m * (kLandSide - 1);
constexpr uint32_t kPicture_px = 512;
constexpr double kRepeats = 8;  // of the earth's pattern
// Where bake-wang-ldi has its sun.
constexpr double kSunHeading_deg = 140, kSunElevation_deg = 50, kSky = 0.45;

// How light the ground is beside a level one.
double light_at(uint64_t seed, double east_m, double south_m) {
    constexpr double kDegree = std::numbers::pi / 180;
    double east = (land_height_m(seed, east_m + 1, south_m) - land_height_m(seed, east_m - 1, south_m)) / 2;
    double north = (land_height_m(seed, east_m, south_m - 1) - land_height_m(seed, east_m, south_m + 1)) / 2;
    glm::dvec3 normal = glm::normalize(glm::dvec3(-east, -north, 1));
    double level = std::cos(kSunElevation_deg * kDegree), up = std::sin(kSunElevation_deg * kDegree);
    glm::dvec3 to_sun(level * std::sin(kSunHeading_deg * kDegree), level * std::cos(kSunHeading_deg * kDegree), up);
    return kSky + (1 - kSky) * std::max(0.0, glm::dot(normal, to_sun)) / up;
}

}  // namespace

double land_height_m(uint64_t seed, double east_m, double south_m) {
    constexpr double kTurn = 2 * std::numbers::pi;
    double lead_m = 300 * unit_from_hash(hash_of(seed, 600, 0));
    east_m += lead_m;
    double broad = std::sin(kTurn * east_m / 330 + 0.6) * std::cos(kTurn * south_m / 270);
    double small = std::sin(kTurn * (east_m + 0.7 * south_m) / 150);
    return 12 + 7.5 * broad + 1.2 * small;
}

std::vector<std::byte> land_tiff(uint64_t seed) {
    std::vector<float> samples;
    for (uint32_t row = 0; row < kLandSide; ++row)
        for (uint32_t column = 0; column < kLandSide; ++column) {
            double height_m = land_height_m(seed, column * kLandCell_m, row * kLandCell_m);
            samples.push_back(float(kHeightStep_m * std::round(height_m / kHeightStep_m)));
        }
    Placement placement;
    placement.cell_m = kLandCell_m;
    return geotiff_bytes(samples, kLandSide, kLandSide, placement, std::nullopt);
}

Result<std::vector<std::byte>> land_png(double weeds, uint64_t seed) {
    std::vector<uint8_t> pixels;
    for (uint32_t row = 0; row < kPicture_px; ++row)
        for (uint32_t column = 0; column < kPicture_px; ++column) {
            double u = kRepeats * (column + 0.5) / kPicture_px, v = kRepeats * (row + 0.5) / kPicture_px;
            glm::dvec4 soil = soil_at(seed, weeds, u - std::floor(u), v - std::floor(v));
            double light = light_at(seed, kSide_m * (column + 0.5) / kPicture_px, kSide_m * (row + 0.5) / kPicture_px);
            for (int channel = 0; channel < 3; ++channel)
                pixels.push_back(uint8_t(std::lround(255 * std::clamp(light * soil[channel], 0.0, 1.0))));
        }
    return png_bytes(kPicture_px, kPicture_px, 3, pixels);
}

scene::Scene land_scene(const PlantSet& set, uint64_t seed) {
    scene::Scene scene;
    scene::Layer land, planting;
    land.asset = "land.ovl", land.method = "terrain";
    planting.asset = "planting.ovl", planting.method = "wang-ldi";
    std::vector<std::string>& models = planting.planting.emplace().models;
    planting.planting->seed = uint32_t(seed);
    for (const Plant& plant : set.plants) models.push_back(plant.file.substr(0, plant.file.find('.')) + ".ovl");
    scene.layers = {land, planting};
    scene.camera.near_m = 0.05;
    return scene;
}

scene::Flight land_walk(double eye_m, uint64_t seed) {
    constexpr int kKeys = 12;
    scene::Flight flight{kStep_s, scene::Interpolation::smooth, {}};
    for (int i = 0; i <= kKeys; ++i) {
        double share = double(i) / kKeys;
        double east_m = kSide_m * (0.5 + 0.02 * std::sin(5 * share)), south_m = kSide_m * (0.55 - 0.05 * share);
        scene::Key key;
        key.time_s = 30 * share;
        key.position_m = {east_m, -south_m, land_height_m(seed, east_m, south_m) + eye_m};
        key.heading_deg = 12 * std::sin(4 * share);
        key.pitch_deg = -4;
        flight.keys.push_back(key);
    }
    return flight;
}

}  // namespace overlook::sample
