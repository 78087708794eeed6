// What a viewer in a cell sees of a tile, as samples: rays from eyes all over the cell, each first thing they meet within the
// tile kept once for each small cube of space.
//
// Based on: J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth Images, 2000, section 4; J. Shade, S. Gortler, L. He,
// R. Szeliski, Layered Depth Images, 1998, section 4 (rays at random; what is met twice is averaged); I. J. Good, The Population
// Frequencies of Species and the Estimation of Population Parameters, 1953 (what was met once tells of what was not). Different:
// rays go in coherent rasters, one for each eye, and stop when what is met is known to be nearly all, rather than after a fixed
// count; what is met by one eye counts as met once, however many of its rays meet it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tools/bake/wang_ldi/stage.h"

namespace overlook::wang_ldi {

// Which eyes an image is for, and how it is divided.
struct Wedge {
    double tile_m = 0, low_m = 0, high_m = 0;
    uint32_t side_px = 0;                  // cubes are tile_m / side_px wide
    double nearest_m = 0, farthest_m = 0;  // on the ground, from the eye to the tile's middle
    double eye_low_m = 0, eye_high_m = 0;
    double heading_rad = 0, half_width_rad = 0;  // of the eye, seen from the tile's middle, clockwise from north
};

// In the middle of its eyes.
glm::vec3 middle_eye_m(const Wedge& wedge);

struct SampleOptions {
    uint64_t seed = 1;
    double unseen_goal = 0.02;         // sampling stops below, after 4 / unseen_goal hits at least
    uint64_t fixed_rays = 0;           // or after so many rays, whatever is unseen; 0: by the goal
    uint64_t most_rays = 400'000'000;  // or after so many, with more unseen than was asked
    uint32_t least_eyes = 16;          // before anything is estimated
    uint32_t rays_per_eye = 1u << 15;  // of the raster over the tile's box, about, at most
};
// Rays of each eye's raster: of a coarse image fewer, so that its rays come from more eyes.
uint32_t rays_per_eye(const Wedge& wedge, const SampleOptions& options);

struct Sample {
    uint32_t pixel = 0;   // row * side_px + column
    uint32_t layer = 0;   // of cubes above low_m: with the pixel, which cube it is
    float height_m = 0;   // above low_m, mean over what was met
    glm::vec3 albedo{0};  // linear, mean over the first of what was met
    glm::vec3 normal{0};  // likewise, of length 1
    uint32_t met = 0;     // how often
    // Where the first of what was met faces its eye most, in which stage and whence: what is lit.
    uint32_t stage = 0;
    rays::Hit hit;
    glm::vec3 seen_along{0};
};

struct Sampled {
    std::vector<Sample> samples;  // by pixel, then from the lowest up
    uint64_t rays = 0;            // that were shot: those of the rasters that pass the tile's box
    uint64_t hits = 0;            // that met something in the tile
    uint64_t eyes = 0;
    double unseen_share = 0;  // of hits, those in cubes that one eye alone has met; 0 if nothing was
};

// stages: one or more, of the same tile among different neighbours; eyes take them in turn. Same arguments, same samples.
Sampled sampled(const Models& models, std::span<const TraceStage> stages, const Wedge& wedge, const SampleOptions& options);

// Of `rays` more rays of eyes of another seed, the share of hits that meet no sample's cube.
double unseen_of_held_out(std::span<const TraceStage> stages, const Wedge& wedge, const Sampled& of, uint64_t rays,
                          uint64_t seed);

// The `index`-th point of a sequence (an additive recurrence) that fills the unit cube evenly however many there are.
std::array<double, 3> evenly_spread(uint64_t seed, uint64_t index);

// An eye, with the rays of its raster that pass the tile's box.
struct Eye {
    glm::vec3 at_m{0};
    std::vector<rays::Ray> rays;  // farthest: where they leave the box; along: of length 1
};
// Makes `eye` the `index`-th of a sequence that fills the wedge evenly, its rays jittered (R. L. Cook,
// Stochastic Sampling in Computer Graphics, 1986), in blocks of 4 x 4. What it was before does not matter.
void set_eye(const Wedge& wedge, uint64_t seed, uint64_t index, uint32_t rays_per_eye, Eye& eye);

}  // namespace overlook::wang_ldi
