// Small holes of a warped picture, closed with what lies round them.
//
// Based on: J. Shade, S. Gortler, L. He, R. Szeliski, Layered Depth Images, 1998, section 5 (holes between splats). Ours: only
// what is enclosed within two pixels of the picture is filled, so that no outline against what lies behind the picture grows.
#pragma once

#include <cstdint>

#include "runtime/wang_ldi/warp.h"

namespace overlook::wang_ldi {

constexpr uint32_t kWidestHole_px = 2;  // of the picture

// A pixel where nothing is is a hole if, along its row and along its column, something is on both sides with 2 empty pixels
// between at most: it lies in a gap of 2 x 2 pixels that is closed all round. It gets colour and depth of the farthest of those
// four (the lower colour if two are as far), since through a hole one sees what is behind. A gap that is open to one side or
// wider, such as the sky between two stems, stays. Nothing that was shown is changed. Returns how many were filled. Same picture
// with any number of threads. finer, >= 1: as Eye's, so many times 2 empty pixels lie between then.
uint64_t fill_holes(Warped& picture, uint32_t finer = 1);

}  // namespace overlook::wang_ldi
