// Plants' levels laid out for a processor that draws their triangles itself.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "formats/discrete.h"

namespace overlook::wang_ldi {

// What a surface is covered with, in linear light: a picture and its halves, times the surface's own colour.
struct Skin {
    struct Level {
        uint32_t width = 0, height = 0;
        std::vector<std::array<uint16_t, 4>> texels;  // red, green, blue, opacity: 65,535 is 1; top row first
    };
    static constexpr size_t kMostTexels = size_t(1) << 22;  // a level: 45 MB with its halves
    std::vector<Level> levels;                              // at least one; the last may be any size
    float alpha_cutoff = 0;                                 // what is more transparent is not drawn
    bool is_two_sided = false;

    // A picture of more texels than kMostTexels is halved first: memory. rgba: [height, width, 4], colours sRGB-encoded, opacity
    // linear; a level's size is at least 1.
    void add_level(uint32_t width, uint32_t height, std::span<const uint8_t> rgba, const caveclod::Surface& surface);
    // From the last level down to a single texel, each half as large, rounded down: plain means, of opacity as of light.
    void add_halves();
};
// Of a surface without a picture, with its colour alone.
Skin plain_skin(const caveclod::Surface& surface);

// Which of a triangle's corners have normals on the side from which it is counter-clockwise: a bit each.
using CornerSides = uint8_t;

// Neighbouring triangles of one skin, with vertices of their own.
struct ShapeBunch {
    glm::vec3 middle_m{0}, half_m{0};  // a box round them, in the chain's own world
    uint32_t skin = 0;
    uint32_t first_vertex = 0, vertex_count = 0;
    uint32_t first_index = 0, index_count = 0;
};
constexpr uint32_t kMostInBunch = 128;  // triangles

struct ShapeLevel {
    ShapeBunch all;  // the box round everything
    std::vector<ShapeBunch> bunches;
    std::vector<float> x_m, y_m, z_m;           // [vertices], upright from the chain's own foot at (0, 0, 0)
    std::vector<std::array<float, 3>> normals;  // [vertices], of length 1; none: faces have their own
    std::vector<std::array<float, 4>> tints;    // [vertices], linear, fourth opacity
    std::vector<std::array<float, 2>> uvs;      // [vertices]
    std::vector<uint16_t> indices;              // three a triangle, from its bunch's first vertex
    std::vector<CornerSides> sides;             // [indices / 3]
};

struct PlantShape {
    std::vector<ShapeLevel> levels;  // as the chain's
    std::vector<Skin> skins;         // as shape_of was given
};

// Whether a processor draws it as OpenGL does: nothing of it moves, and no level is cards with pictures.
bool can_be_shaped(const discrete::Chain& chain);
// skins: one a surface. O(vertices + triangles).
PlantShape shape_of(const discrete::Chain& chain, std::vector<Skin> skins);

}  // namespace overlook::wang_ldi
