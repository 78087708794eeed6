#include "tools/make_sample/sample_dem.h"

#include <algorithm>
#include <optional>

#include "tools/make_sample/geotiff.h"
#include "tools/make_sample/noise.h"
#include "tools/make_sample/sample_flight.h"
#include "tools/make_sample/sample_folder.h"

namespace overlook::sample {
namespace {

Result<void> check(const DemOptions& options) {
    const LandscapeOptions& landscape = options.landscape;
    if (landscape.side < kLeastSide || landscape.side > kGreatestSide)
        return bad_command("--size {} is outside {}..{}", landscape.side, kLeastSide, kGreatestSide);
    if (!(landscape.cell_size_m >= 1 && landscape.cell_size_m <= 1000))
        return bad_command("--cell-size-m {} is outside 1..1000", landscape.cell_size_m);
    if (options.void_count > 10000) return bad_command("--voids {} is outside 0..10000", options.void_count);
    return {};
}

std::string recipe_of(const DemOptions& options) {
    return fmt::format(
        "# Written by make-sample; the same lines give the same bytes.\n"
        "sample = \"dem\"\nversion = \"{}\"\nseed = {}\nsize = {}\ncell_size_m = {}\nvoids = {}\n\n"
        "[dem]\nfile = \"dem.tif\"\nepsg = {}\n",
        OVERLOOK_VERSION, options.landscape.seed, options.landscape.side, options.landscape.cell_size_m, options.void_count,
        Placement{}.epsg);
}

}  // namespace

uint64_t dig_voids(std::vector<float>& samples, uint32_t side, uint32_t count, uint64_t seed, float nodata) {
    uint64_t void_samples = 0;
    for (uint32_t n = 0; n < count; ++n) {
        double column = unit_from_hash(hash_of(seed, n, 1)) * side, row = unit_from_hash(hash_of(seed, n, 2)) * side;
        double share = unit_from_hash(hash_of(seed, n, 3));
        double radius = 1 + share * share * side / 32;
        uint32_t left = uint32_t(std::max(0.0, column - radius)), right = uint32_t(std::min(side - 1.0, column + radius));
        uint32_t top = uint32_t(std::max(0.0, row - radius)), bottom = uint32_t(std::min(side - 1.0, row + radius));
        for (uint32_t y = top; y <= bottom; ++y)
            for (uint32_t x = left; x <= right; ++x) {
                double dx = (x - column) / radius, dy = (y - row) / radius;
                double ragged = 0.6 + 0.5 * fractal_noise(seed + n, 2 * dx, 2 * dy, 3);
                float& sample = samples[size_t(y) * side + x];
                if (dx * dx + dy * dy > ragged || sample == nodata) continue;
                sample = nodata;
                ++void_samples;
            }
    }
    return void_samples;
}

Result<DemReport> make_dem(const DemOptions& options, const std::string& folder) {
    if (Result<void> fits = check(options); !fits) return tl::unexpected(fits.error());
    Result<SampleFolder> made = SampleFolder::make(folder);
    if (!made) return tl::unexpected(made.error());

    Landscape landscape = make_landscape(options.landscape);
    DemReport report;
    auto [lowest, highest] = std::minmax_element(landscape.height_m.begin(), landscape.height_m.end());
    report.lowest_m = *lowest;
    report.highest_m = *highest;
    std::string flight = scene::json_from_flight(overview_flight(landscape, options.landscape.cell_size_m));
    report.void_samples =
        dig_voids(landscape.height_m, landscape.side, options.void_count, options.landscape.seed + 7000, float(kNodata));

    Placement placement;
    placement.cell_m = options.landscape.cell_size_m;
    std::optional<int> nodata;
    if (options.void_count > 0) nodata = kNodata;
    std::vector<std::byte> tiff = geotiff_bytes(landscape.height_m, landscape.side, landscape.side, placement, nodata);
    if (Result<void> written = made->write("dem.tif", tiff); !written) return tl::unexpected(written.error());
    std::pair<std::string, std::string> texts[] = {
        {"recipe.toml", recipe_of(options)}, {"scene.json", scene::json_from_scene(sample_scene())}, {"flight.json", flight}};
    if (Result<void> written = made->write(texts); !written) return tl::unexpected(written.error());
    report.files = made->files();
    return report;
}

}  // namespace overlook::sample
