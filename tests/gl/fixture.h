// A small terrain to draw, and a renderer to draw it with.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "formats/image.h"
#include "formats/terrain.h"
#include "runtime/gl/context.h"
#include "runtime/terrain/refine.h"
#include "runtime/view/camera.h"

namespace overlook::test {

// A processor's renderer, the same everywhere; null and a reason where there is none.
std::optional<gl::Context> software_context(std::string& reason);

struct Rgb {
    uint8_t red = 0, green = 0, blue = 0;
    bool operator==(const Rgb&) const = default;
};
Rgb pixel(const ImageRgb8& image, uint32_t x, uint32_t y);  // y from the top
// Whether the colours differ by at most `tolerance` in every channel.
bool is_near(const Rgb& a, const Rgb& b, int tolerance);

// side x side samples, 10 m apart, at height 0; four colours: red north-west, green north-east, blue south-west, yellow
// south-east.
terrain::Terrain flat_terrain(uint32_t side);
// The same size and colours, with hills up to 200 m high.
terrain::Terrain hilly_terrain(uint32_t side);

// All triangles of the raster.
terrain::Cut everything(const terrain::Terrain& terrain);

// Looks straight down on the middle, north up, from height_m.
view::Camera from_above(const terrain::Terrain& terrain, double height_m, uint32_t width_px, uint32_t height_px);
// Looks north over the terrain from behind its southern edge.
view::Camera from_south(const terrain::Terrain& terrain, uint32_t width_px, uint32_t height_px);

}  // namespace overlook::test

// Stops a test with a line that says why, where OpenGL cannot be had.
#define OVERLOOK_NEEDS_SOFTWARE_RENDERER(name)                               \
    std::string name##_reason;                                               \
    std::optional<gl::Context> name = test::software_context(name##_reason); \
    if (!name) GTEST_SKIP() << "no software renderer: " << name##_reason
