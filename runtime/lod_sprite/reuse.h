// How well a key still serves a camera.
#pragma once

#include "runtime/lod_sprite/key.h"
#include "runtime/view/camera.h"

namespace overlook::lod_sprite {

struct Shown;

// A key that is whole: its camera, and its depths at a coarse grid of its texels.
struct Key {
    view::Camera camera;
    uint32_t scale = 1;   // texels a pixel of the frames that it was made for
    double error_px = 0;  // the promise of the cut that it shows, at its own camera
    DepthGrid depths;
};

// What a frame from a key would be, over the frame's pixels.
struct Reuse {
    double outside_share = 0;      // beyond what the key saw
    double opened_share = 0;       // hidden behind something in the key, open to the camera now
    double unproven_share = 0;     // seen from behind what the key saw, where that was looked at (shown_by)
    double magnification_p99 = 0;  // texels of the key become so many pixels wide: 1 = one pixel
    // Of the error bound of every pixel: the key's own promise at the camera's distance where the key shows it, the coarse cut's
    // where it does not.
    double error_p99_px = 0, error_max_px = 0;
    // The same if what is lost is drawn with lost_error_px.
    double drawn_p99_px = 0, drawn_max_px = 0;

    double lost_share() const { return outside_share + opened_share + unproven_share; }
};

// Walks over the cells of the key's depth grid as the camera sees them: one over a smooth surface carries the key's error, one
// torn open across a step in depth is lost. fallback_error_px: what is promised where the key shows nothing;
// lost_error_px: what is drawn there. shown: of the same two, or null, and nothing is taken to be seen from behind. What the grid
// is too coarse to show (a mast between two of its points) is not seen here; what a frame shows of the key is tested pixel by
// pixel. Cost O(grid).
Reuse reuse_of(const Key& key, const view::Camera& camera, double fallback_error_px, double lost_error_px,
               const Shown* shown = nullptr);

}  // namespace overlook::lod_sprite
