// Layered depth images drawn exactly, on the processor: tiles back to front, in each tile its samples back to front, every sample
// a square of pixels.
//
// Based on: J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth Images, 2000, section 5.2; L. McMillan, Computing
// Visibility Without Depth, 1995; J. Shade, S. Gortler, L. He, R. Szeliski, Layered Depth Images, 1998, section 5. Whole fields,
// whose tiles are sheared in halves and give way to each other: warp_field.h. Holes are not filled.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "formats/image.h"
#include "formats/wang_ldi.h"
#include "runtime/view/camera.h"

namespace overlook::wang_ldi {

// Pixels [height_px, width_px], top row first.
struct Warped {
    uint32_t width_px = 0, height_px = 0;
    std::vector<uint32_t> colours;  // red in the lowest byte, then green, blue, sRGB-encoded, then 255; 0: nothing is there
    std::vector<float> depth_m;     // along the camera's axis, of what is shown; infinity where nothing is

    void clear(uint32_t width, uint32_t height);
};

// For the eye: where nothing is it is grey.
ImageRgb8 picture_of(const Warped& warped);

// What was done for a picture. Of tiles that are found to lie outside of it, nothing is counted.
struct WarpCounts {
    uint64_t samples = 0;         // brought to where the camera sees them; texels of far tiles too
    uint64_t samples_drawn = 0;   // those of them of which a pixel at least lies in the picture
    uint64_t pixels_written = 0;  // of the picture, by all splats; by depth those too that something hid
    uint64_t images_missing = 0;  // images that are shown and were not at hand

    void add(const WarpCounts& other) {
        samples += other.samples, samples_drawn += other.samples_drawn;
        pixels_written += other.pixels_written, images_missing += other.images_missing;
    }
    bool operator==(const WarpCounts&) const = default;
};

// An image and where its tile lies: (x, y, z) of it at origin_m + (x, y, z + slope . (x, y)).
struct Drawn {
    const Ldi* ldi = nullptr;
    uint32_t level = 0;
    glm::dvec3 origin_m{0};  // of the tile's south-west corner
    glm::dvec2 slope{0};     // metres up for a metre east and north: a vertical shear
    float splat_scale = 1;   // times the splats of the image
};

// How what is hidden is found out: by order alone (what is drawn last is seen, its depth overwrites), or by each pixel's depth.
enum class Hiding { by_order, by_depth };

// Draws over what is there. `back_to_front`: order of the tiles (see order_of_tiles); within each the order follows from the eye.
// Colours are those of the image (unlit where the set has normals). Nearer than camera.near_m nothing is drawn; a splat has at
// most 64 pixels a side. O(samples + pixels written).
void warp(const view::Camera& camera, const ImageSet& set, std::span<const Drawn> back_to_front, Hiding hiding, Warped& picture);

// Sorts tiles of a lattice of tile_m so that none hides one after it: by rows towards the eye's row, in each by columns towards
// the eye's column, whatever the terrain's height and slope.
void order_of_tiles(const glm::dvec3& eye_m, double tile_m, std::span<Drawn> tiles);

}  // namespace overlook::wang_ldi
