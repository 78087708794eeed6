// Samples of an image brought to a picture, many at once: the inner loop of the fast warper. Compiled several times, for
// processors with and without wider vectors; all give the same numbers.
#pragma once

#include <cstdint>

namespace overlook::wang_ldi {

// What is the same for all samples of an image on a plane.
struct SampleFrame {
    float corner[3], east[3], north[3], up[3];  // as Eye::seen: of the tile's corner, of a metre east, north and up
    float pixel_m, step_m, splat;               // splat: times the focal length, in metres, of a sample; or of a unit of `splats`
    float near_m, middle_px[2];
    int32_t width_px, height_px, most_side;  // most_side: of splats, up to 256
    int32_t stride, origin;                  // pixel (x, y) is origin + y * stride + x, also left of and above the picture
    int32_t nowhere;  // where splats go that are not drawn: of one pixel, but it may be painted as if wider
};

// [count], and up to 8 more are written.
struct Projected {
    int32_t* pixels;  // of the splat's left upper corner
    int32_t* sides;   // of the splat, 1 .. most_side
    float* depths_m;
};

struct ProjectedCounts {
    uint64_t drawn = 0, pixels = 0;                 // as WarpCounts
    int32_t least_side = INT32_MAX, most_side = 0;  // of those drawn
};

// All readable for 8 more.
struct SamplesOfRows {
    const uint32_t* places;  // as PreparedLdi
    const uint16_t* rows;
    const uint8_t *colours, *splats;  // as PreparedLdi; splats: null if there are none
    uint32_t count;
};
using ProjectSamples = void (*)(const SampleFrame& frame, const SamplesOfRows& samples, const Projected& out,
                                ProjectedCounts& counts);

// For any processor of the kind this is compiled for.
void project_samples_anywhere(const SampleFrame& frame, const SamplesOfRows& samples, const Projected& out,
                              ProjectedCounts& counts);
// For those with AVX2; where there are none such, the same as the other.
void project_samples_avx2(const SampleFrame& frame, const SamplesOfRows& samples, const Projected& out, ProjectedCounts& counts);
// The fastest that this processor has.
ProjectSamples best_project_samples();

}  // namespace overlook::wang_ldi
