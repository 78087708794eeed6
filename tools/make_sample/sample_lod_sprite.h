// make-sample lod-sprite: the landscape, the flight and the thresholds on which section 4 of the LOD-sprite paper is run anew.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "formats/image.h"
#include "formats/result.h"
#include "formats/scene.h"
#include "tools/make_sample/landscape.h"

namespace overlook::sample {

constexpr double kLodSpriteExtent_m = 511 * 60;  // from the first sample to the last, at any size

struct LodSpriteOptions {
    uint64_t seed = 1;
    uint32_t side = 512;  // samples a side, as in the paper; kLeastSide..kGreatestSide
};

// A view whose triangles the paper counts, and where the flight has it.
struct FigureView {
    uint32_t figure = 0;
    double time_s = 0;
    uint64_t high_triangle_count = 0, low_triangle_count = 0;  // of the paper
};
constexpr std::array<FigureView, 2> kLodSpriteViews = {FigureView{6, 0, 387'937, 1'503}, FigureView{7, 10, 156'884, 2'007}};

// The thresholds at which the cuts of the default landscape have about as many triangles in both views, at 512 x 512 pixels.
constexpr double kLodSpriteHigh_px = 0.0283;
constexpr double kLodSpriteLow_px = 6.87;

struct LodSpriteReport {
    std::vector<std::string> files;  // written, in order
    double lowest_m = 0, highest_m = 0;
};

// Writes `dem.tif`, `texture.ppm`, `recipe.toml`, `scene.json` (of `sample.ovl`, to be baked beside it from the two),
// `flight.json` and `run.json` (the thresholds and the views of figures 6 and 7) into a folder, which it makes where there is
// none. Fails with Exit::cannot_write, or with Exit::bad_command: "--size 20 is outside 33..4097".
Result<LodSpriteReport> make_lod_sprite(const LodSpriteOptions& options, const std::string& folder);

// A range from west to east between two plains.
LandscapeOptions lod_sprite_landscape(const LodSpriteOptions& options);

// Shaded relief, a texel a sample.
ImageRgb8 lod_sprite_texture(const Landscape& landscape, double cell_size_m);

// 600 frames, the way of figure 8: from away, down to the southern plain, up over the range and onto the northern plain. Spread
// over any other number of frames it is the same way.
scene::Flight lod_sprite_flight();

}  // namespace overlook::sample
