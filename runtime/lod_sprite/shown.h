// Where in a camera's picture a key can show what is there.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/lod_sprite/key.h"
#include "runtime/lod_sprite/reuse.h"
#include "runtime/view/camera.h"

namespace overlook::lod_sprite {

// Samples in the middles of an even grid of cells over the picture.
struct Shown {
    uint32_t columns = 0, rows = 0;
    std::vector<uint8_t> is_open;              // [rows, columns], top row first: not proven to be in the key
    std::vector<double> inverse_depths_per_m;  // of the same samples: of what the key saw there; <= 0: sky or nothing
    double surface_share = 0;                  // of the picture: a surface, not the sky, that is proven to be in the key
    // Of the picture: seen from behind what the key saw, or through what hid things from it from its own side. Neither torn open
    // (Reuse::opened_share) nor beyond the key's picture (Reuse::outside_share).
    double behind_share = 0, nothing_share = 0;  // the second: no part of the key comes there at all
};

// What a key does not know lies behind what it saw, or outside its four sides. The surface of all that it saw, closed across
// steps in depth, therefore is what a ray passes first on its way into the unknown: where that is a part that the key saw, from
// its own side, the key shows what is there; where it is a step that has torn open or the other side of a part, something unknown
// may be seen. This surface is drawn here, from the key's depth grid, with depths compared (triangles by their homogeneous edges:
// Olano and Greer, "Triangle scan conversion using 2D homogeneous coordinates", 1997, so that none need be clipped). Steps that
// have torn by less than about 1.5 pixels pass for shown, and so does what is smaller than the grid's cells. A part whose texels
// have become wider than most_texel_px (> 0, in the camera's pixels) counts as open. Cost O(grid + samples).
Shown shown_by(const Key& key, const view::Camera& camera, double most_texel_px);

// Shown::is_open, and open as well what is beside samples nearer than depth_m >= 0 without being so itself. Nearer things are
// drawn as they are; keys that saw them elsewhere do not show what has come out from behind their outlines.
std::vector<uint8_t> open_beside_nearer(const Shown& shown, double depth_m);

}  // namespace overlook::lod_sprite
