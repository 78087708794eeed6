#include "tools/make_sample/sample_slopes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/make_sample/geotiff.h"
#include "tools/make_sample/sample_folder.h"

namespace overlook::sample {
namespace {

constexpr double kHalfWidth_m = 240, kSpacing_m = 760, kFirst_m = 520;  // of ridges; between their crests; of the first crest
constexpr double kWave_m = 5, kAcross_m = 110, kAlong_m = 170;          // height and lengths of the waves
constexpr double kHeightStep_m = 0.125;

}  // namespace

double slope_height_m(double east_m, double south_m) {
    constexpr double kTurn = 2 * std::numbers::pi;
    double height_m = 0;
    for (size_t i = 0; i < kSlopes_deg.size(); ++i) {
        double inside_m = kHalfWidth_m - std::abs(east_m - (kFirst_m + double(i) * kSpacing_m));
        if (inside_m <= 0) continue;
        double waves = std::sin(kTurn * inside_m / kAcross_m) * std::sin(kTurn * south_m / kAlong_m);
        height_m = inside_m * std::tan(kSlopes_deg[i] * std::numbers::pi / 180) + kWave_m * waves;
    }
    return height_m;
}

scene::Flight slopes_flight() {
    scene::Flight flight;
    flight.step_s = 1.0 / 32;
    flight.interpolation = scene::Interpolation::linear;
    flight.keys = {
        {0, {1280, -2900, 900}, 0, -22, {}}, {4, {1480, -2500, 800}, -6, -22, {}}, {7.5, {1900, -2100, 760}, -24, -25, {}}};
    return flight;
}

Result<std::vector<std::string>> make_slopes(const std::string& folder) {
    Result<SampleFolder> made = SampleFolder::make(folder);
    if (!made) return tl::unexpected(made.error());

    std::vector<float> samples;
    for (uint32_t row = 0; row < kSlopesSide; ++row)
        for (uint32_t column = 0; column < kSlopesSide; ++column) {
            double height_m = slope_height_m(column * kSlopesCell_m, row * kSlopesCell_m);
            samples.push_back(float(kHeightStep_m * std::round(height_m / kHeightStep_m)));
        }
    Placement placement;
    placement.cell_m = kSlopesCell_m;
    std::vector<std::byte> tiff = geotiff_bytes(samples, kSlopesSide, kSlopesSide, placement, std::nullopt);
    scene::Scene scene;
    scene.layers.resize(1);
    scene.layers[0].asset = "slopes.ovl", scene.layers[0].method = "terrain";
    std::string text = scene::json_from_scene(scene);

    if (Result<void> written = made->write("dem.tif", tiff); !written) return tl::unexpected(written.error());
    if (Result<void> written = made->write("scene.json", text); !written) return tl::unexpected(written.error());
    return made->files();
}

}  // namespace overlook::sample
