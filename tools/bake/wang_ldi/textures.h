// What eyes beyond the farthest level see of a tile, as a directional texture: rays from eyes all over the far part of a wedge,
// each lit where it ends, summed over the texels.
//
// Based on: J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth Images, 2000, section 8; I. J. Good, The Population
// Frequencies of Species and the Estimation of Population Parameters, 1953.
#pragma once

#include <cstdint>
#include <span>

#include "formats/wang_textures.h"
#include "tools/bake/wang_ldi/judge.h"
#include "tools/bake/wang_ldi/shade.h"

namespace overlook::wang_ldi {

struct TextureOptions {
    uint32_t side_px = 32;                          // of the finest picture, a power of two; 0: there are none
    double unseen_goal = 0.02;                      // rays stop when so few hits are in texels that one eye alone hits,
    double error_goal = 0.04;                       // and a texel's colour is so certain: standard error over the mean luma
    uint64_t most_rays = 20'000'000;                // or after so many
    uint32_t least_eyes = 16, rays_per_eye = 4096;  // rays: one for each finest texel, so many at most
    uint64_t seed = 1;
};

// A set of textures without any, for these images: eyes from where images begin to give way to kFarTimes as far as they reach.
constexpr double kFarTimes = 4;
TextureSet texture_set_of(const ImageSet& images, uint32_t side_px);

struct TextureSampled {
    DirectionalTexture texture;
    uint64_t rays = 0, hits = 0, eyes = 0;
};
// stages: as sampled(). Colours are lit by a sixteenth of the light's rays at each hit, which are many. Same arguments, same
// texture.
TextureSampled texture_of(const Models& models, std::span<const TraceStage> stages, const TextureSet& set, uint32_t direction,
                          const Light& light, const TextureOptions& options);

// How a texture's boxes, drawn over each other along sight lines, differ from what these meet; views from all over the far wedge.
// Of sight lines that reach the tile, 4 x 4 a pixel.
struct TextureJudgement {
    uint64_t pixels = 0;        // that see something of the tile
    double coverage = 0;        // of a view's sight lines that reach the tile, how many end in it: mean over the views
    double drawn_coverage = 0;  // likewise, by opacity
    double mean_error = 0;      // of |luma - luma|, sRGB-encoded, before a middle grey
};
TextureJudgement judged_texture(const Models& models, const TraceStage& stage, const TextureSet& set,
                                const DirectionalTexture& texture, uint32_t direction, double focal_px, const Light& light,
                                const Judging& judging);

// The eyes of a direction. side_px is the texture's.
Wedge far_wedge_of(const TextureSet& set, uint32_t direction);

}  // namespace overlook::wang_ldi
