#include "tools/make_sample/sample_lod_sprite.h"

#include <algorithm>
#include <span>

#include "tools/bake/relief.h"
#include "tools/make_sample/geotiff.h"
#include "tools/make_sample/sample_flight.h"
#include "tools/make_sample/sample_folder.h"

namespace overlook::sample {
namespace {

constexpr double kStep_s = 1.0 / 32;
constexpr double kFovY_deg = 60;

std::string recipe_of(const LodSpriteOptions& options) {
    return fmt::format(
        "# Written by make-sample; the same lines give the same bytes.\n"
        "sample = \"lod-sprite\"\nversion = \"{}\"\nseed = {}\nsize = {}\n\n"
        "[dem]\nfile = \"dem.tif\"\nepsg = {}\n\n[texture]\nfile = \"texture.ppm\"\n",
        OVERLOOK_VERSION, options.seed, options.side, Placement{}.epsg);
}

std::string run_json() {
    std::string views;
    for (const FigureView& view : kLodSpriteViews) {
        views +=
            fmt::format("{}\n    {{\"figure\": {}, \"time_s\": {}, \"high_triangles\": {}, \"low_triangles\": {}}}",
                        views.empty() ? "" : ",", view.figure, view.time_s, view.high_triangle_count, view.low_triangle_count);
    }
    return fmt::format("{{\n  \"version\": 1,\n  \"high_px\": {},\n  \"low_px\": {},\n  \"views\": [{}\n  ]\n}}\n",
                       kLodSpriteHigh_px, kLodSpriteLow_px, views);
}

// Netpbm's binary colour format.
std::vector<std::byte> ppm_bytes(const ImageRgb8& image) {
    std::string head = fmt::format("P6\n{} {}\n255\n", image.width, image.height);
    std::span<const std::byte> head_bytes = std::as_bytes(std::span(head)), pixels = std::as_bytes(std::span(image.pixels));
    std::vector<std::byte> bytes(head_bytes.begin(), head_bytes.end());
    bytes.insert(bytes.end(), pixels.begin(), pixels.end());
    return bytes;
}

// The air of a fair day would hide the far plain, and what it hides no method has to draw.
scene::Scene clear_scene() {
    scene::Scene made = sample_scene();
    made.light.haze = 0.25;
    made.camera.fov_y_deg = kFovY_deg;
    return made;
}

}  // namespace

LandscapeOptions lod_sprite_landscape(const LodSpriteOptions& options) {
    return {options.seed, options.side, kLodSpriteExtent_m / (options.side - 1), Relief::between};
}

ImageRgb8 lod_sprite_texture(const Landscape& landscape, double cell_size_m) {
    dem::Raster dem;
    dem.width = dem.height = landscape.side;
    dem.samples = landscape.height_m;
    dem.frame.metres_per_column = dem.frame.metres_per_row = cell_size_m;
    return shade_relief(dem, ReliefOptions{});
}

scene::Flight lod_sprite_flight() {
    scene::Flight flight{kStep_s, scene::Interpolation::smooth, {}};
    auto fly_to = [&](double time_s, double x_m, double y_m, double z_m, double heading_deg, double pitch_deg) {
        flight.keys.push_back({time_s, {x_m, y_m, z_m}, heading_deg, pitch_deg, kFovY_deg});
    };
    fly_to(kLodSpriteViews[0].time_s, 15300, -44000, 11200, 0, -20);
    fly_to(3, 15300, -39000, 8800, 0, -20);
    fly_to(6, 15000, -31500, 6200, 2, -18);
    fly_to(8, 14900, -27200, 5700, 1, -17);
    fly_to(kLodSpriteViews[1].time_s, 15300, -23000, 6300, 0, -18);
    fly_to(12.5, 16200, -18400, 6200, 6, -22);
    fly_to(15.5, 17600, -13200, 4600, 8, -22);
    fly_to(599 * kStep_s, 18800, -8600, 3600, 2, -18);
    return flight;
}

Result<LodSpriteReport> make_lod_sprite(const LodSpriteOptions& options, const std::string& folder) {
    if (options.side < kLeastSide || options.side > kGreatestSide)
        return bad_command("--size {} is outside {}..{}", options.side, kLeastSide, kGreatestSide);
    Result<SampleFolder> made = SampleFolder::make(folder);
    if (!made) return tl::unexpected(made.error());

    LandscapeOptions of_land = lod_sprite_landscape(options);
    Landscape landscape = make_landscape(of_land);
    LodSpriteReport report;
    auto [lowest, highest] = std::minmax_element(landscape.height_m.begin(), landscape.height_m.end());
    report.lowest_m = *lowest;
    report.highest_m = *highest;

    Placement placement;
    placement.cell_m = of_land.cell_size_m;
    std::vector<std::byte> tiff = geotiff_bytes(landscape.height_m, landscape.side, landscape.side, placement, {});
    std::vector<std::byte> texture = ppm_bytes(lod_sprite_texture(landscape, of_land.cell_size_m));
    std::string recipe = recipe_of(options), scene = scene::json_from_scene(clear_scene());
    std::string flight = scene::json_from_flight(lod_sprite_flight()), run = run_json();
    auto bytes_of = [](const std::string& text) { return std::as_bytes(std::span(text)); };
    for (const auto& [name, bytes] :
         std::initializer_list<std::pair<const char*, std::span<const std::byte>>>{{"dem.tif", tiff},
                                                                                   {"texture.ppm", texture},
                                                                                   {"recipe.toml", bytes_of(recipe)},
                                                                                   {"scene.json", bytes_of(scene)},
                                                                                   {"flight.json", bytes_of(flight)},
                                                                                   {"run.json", bytes_of(run)}}) {
        if (Result<void> written = made->write(name, bytes); !written) return tl::unexpected(written.error());
    }
    report.files = made->files();
    return report;
}

}  // namespace overlook::sample
