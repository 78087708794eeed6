// Where a bunch's vertices are in the picture, and which of its triangles show anything there: the inner loops of drawing plants.
// Compiled several times, for processors with and without wider vectors; all give the same numbers.
#pragma once

#include <cstdint>

namespace overlook::wang_ldi {

constexpr int kCornerBits = 8, kCornerSteps = 1 << kCornerBits;  // of a pixel: where corners lie
constexpr float kFarthest_px = 16000;                            // from the picture's middle, as corners may lie

// Of a vertex: which sides of the picture it is behind, or that it is behind the near plane, and that it cannot be brought there.
constexpr int32_t kLeft = 1, kRight = 2, kAbove = 4, kBelow = 8, kNear = 16, kFar = 32;

// How a plant's vertices come to the picture.
struct VertexFrame {
    float right[4], up[4], forward[4];  // of its own x, y and z, and of its foot: as Eye::seen
    float middle_px[2], size_px[2], near_m;
};
struct PlacedVertices {
    int32_t *x, *y;   // steps from the picture's left and top; 0 of what is near or far
    float* nearness;  // of the depth in metres; 1 of what is near
    int32_t* behind;
};

// Part of a canvas that triangles are drawn on.
struct SiftFrame {
    int32_t left, right, height_px;  // columns [left, right)
    int64_t stride;                  // of keys from row to row
    const int64_t* keys;             // of pixel (0, 0), as pixel_key
};
constexpr uint16_t kIsCut = 0x8000;

struct PlantLoops {
    // x_m, y_m, z_m: [count], the plant's own.
    void (*place)(const VertexFrame& frame, const float* x_m, const float* y_m, const float* z_m, uint32_t count,
                  const PlacedVertices& placed);
    // indices: [3 count] of the placed, count < 2^15. Writes the numbers of those triangles that may show something, and of those
    // that must be cut first, kIsCut more; returns how many. Left out are triangles that are behind one of the picture's sides,
    // have no area or no pixel's middle, and those of one pixel that is nearer already.
    uint32_t (*sift)(const SiftFrame& frame, const PlacedVertices& placed, const uint16_t* indices, uint32_t count,
                     uint16_t* kept);
};
extern const PlantLoops kPlantLoopsAnywhere, kPlantLoopsAvx2;  // kPlantLoopsAvx2: where there is none such, the same
// The fastest that this processor has.
const PlantLoops& best_plant_loops();

}  // namespace overlook::wang_ldi
