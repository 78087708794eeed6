// A field's list as the graphics card draws it: of each image what its samples need to know, and points of far tiles.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "runtime/wang_ldi/far_images.h"
#include "runtime/wang_ldi/field.h"
#include "runtime/wang_ldi/prepared_ldi.h"

namespace overlook::wang_ldi {

// As the shaders have them (std430).
struct SplatPlane {
    glm::vec4 corner, east, north;  // of ImageFrame; then the splat's width, nothing, and 1 if the diagonal falls
};
struct SplatDraw {
    uint32_t first_plane = 0, sample_count = 0, side_px = 0, pieces = 1;
    uint32_t rung_from = 0, rung_to = 0, direction_from = 0, direction_to = 0;
    uint32_t number_low = 0, number_high = 0, coarser_px = 1, has_splats = 0;
    glm::vec4 up{0};     // then metres a step
    glm::vec4 pixel{0};  // metres
};
static_assert(sizeof(SplatPlane) == 48 && sizeof(SplatDraw) == 80);

struct SplatPoint {
    glm::vec3 at;  // as Eye::seen
    float wide;    // times the focal length, in metres
    uint32_t colour;
};
static_assert(sizeof(SplatPoint) == 20);

struct SplatLists {
    std::vector<SplatDraw> draws;
    std::vector<uint64_t> images;  // of each draw
    std::vector<SplatPlane> planes;
    std::vector<SplatPoint> points;
    uint64_t images_missing = 0;
};

// Of what may be on the picture. far: null: no far tiles. finer: as Eye's.
SplatLists splat_lists_of(const view::Camera& camera, const Field& field, const FieldList& list, const PreparedAt& image_at,
                          const FarImages* far, uint32_t finer = 1);

// A prepared image as the shaders have it: of each sample its place, and row + 65,536 (colour + 256 splat); then the palette.
std::vector<uint32_t> splat_words(const PreparedLdi& image);

}  // namespace overlook::wang_ldi
