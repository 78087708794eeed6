#include "tests/gl/fixture.h"

#include <cmath>
#include <cstdlib>

#include "tools/bake/terrain.h"

namespace overlook::test {
namespace {

constexpr double kCell_m = 10;

ImageRgb8 four_colours(uint32_t side) {
    ImageRgb8 image{side, side, {}};
    const Rgb colours[] = {{220, 30, 30}, {30, 200, 30}, {30, 30, 220}, {220, 210, 40}};
    for (uint32_t row = 0; row < side; ++row) {
        for (uint32_t column = 0; column < side; ++column) {
            const Rgb& colour = colours[(row >= side / 2 ? 2 : 0) + (column >= side / 2 ? 1 : 0)];
            image.pixels.insert(image.pixels.end(), {colour.red, colour.green, colour.blue});
        }
    }
    return image;
}

template <class Height>
terrain::Terrain baked(uint32_t side, Height height_m) {
    dem::Raster dem;
    dem.width = dem.height = side;
    dem.frame.metres_per_column = dem.frame.metres_per_row = kCell_m;
    dem.samples_are_integers = true;
    dem.source_name = "test";
    dem.source_hash = std::string(32, '0');
    for (uint32_t row = 0; row < side; ++row) {
        for (uint32_t column = 0; column < side; ++column) dem.samples.push_back(float(std::lround(height_m(column, row))));
    }
    terrain::Terrain terrain = *terrain::bake(dem, {}, [](double) {});
    terrain.texture = four_colours(side);
    return terrain;
}

}  // namespace

std::optional<gl::Context> software_context(std::string& reason) {
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    Result<gl::Context> context = gl::Context::headless();
    if (context && context->renderer().is_software) return std::move(*context);
    reason = context ? "only hardware is offered: " + context->renderer().name : context.error().message;
    return std::nullopt;
}

Rgb pixel(const ImageRgb8& image, uint32_t x, uint32_t y) {
    const uint8_t* at = &image.pixels[(size_t(y) * image.width + x) * 3];
    return {at[0], at[1], at[2]};
}

bool is_near(const Rgb& a, const Rgb& b, int tolerance) {
    return std::abs(a.red - b.red) <= tolerance && std::abs(a.green - b.green) <= tolerance &&
           std::abs(a.blue - b.blue) <= tolerance;
}

terrain::Terrain flat_terrain(uint32_t side) {
    return baked(side, [](uint32_t, uint32_t) { return 0.0; });
}

terrain::Terrain hilly_terrain(uint32_t side) {
    return baked(side, [](uint32_t column, uint32_t row) {
        return 100 + 60 * std::sin(0.21 * column) * std::cos(0.17 * row) + 40 * std::sin(0.07 * (column + row));
    });
}

terrain::Cut everything(const terrain::Terrain& terrain) {
    terrain::Cut cut;
    const uint32_t width = terrain.shape.width;
    for (uint32_t row = 0; row + 1 < terrain.shape.height; ++row) {
        for (uint32_t column = 0; column + 1 < width; ++column) {
            uint32_t a = row * width + column;
            cut.indices.insert(cut.indices.end(), {a, a + width, a + 1, a + 1, a + width, a + width + 1});
        }
    }
    return cut;
}

view::Camera from_above(const terrain::Terrain& terrain, double height_m, uint32_t width_px, uint32_t height_px) {
    view::Camera camera;
    double middle_m = kCell_m * (terrain.shape.width - 1) / 2;
    camera.position_m = {middle_m, -middle_m, height_m};
    camera.pitch_deg = -90;
    camera.width_px = width_px;
    camera.height_px = height_px;
    return camera;
}

view::Camera from_south(const terrain::Terrain& terrain, uint32_t width_px, uint32_t height_px) {
    view::Camera camera = from_above(terrain, 420, width_px, height_px);
    camera.position_m.y = -kCell_m * (terrain.shape.height - 1) - 150;
    camera.pitch_deg = -20;
    return camera;
}

}  // namespace overlook::test
