// What LOD-sprite sits on, as its deciding half needs it: anything that is cut for a camera, coarsely for novel frames and
// finely, in slices, for keys. What its drawing half needs of it stands in draw_geometry.h.
#pragma once

#include <cstdint>

#include "runtime/view/camera.h"
#include "runtime/view/pixel_detail.h"

namespace overlook::lod_sprite {

struct CutCount {
    uint64_t triangle_count = 0;
    uint64_t tested_count = 0;  // places looked at to decide
};

// Cameras are in the thing's own frame.
class Geometry {
  public:
    virtual ~Geometry() = default;

    // The camera with its near plane where it cuts nothing off for certain, and where depths as shares of it have room.
    virtual view::Camera with_near_plane(const view::Camera& camera) const = 0;

    // Settles the coarse cut: within each part's error of the finest that there is.
    virtual CutCount cut_coarse(const view::Camera& camera, const view::PixelDetail& detail) = 0;
    // To be called for every coarse cut, once: of its triangles those all of whose corners are nearer than near_depth_m >= 0,
    // along the camera's axis, come first. Returns how many these are.
    virtual uint64_t put_near_first(const view::Camera& camera, double near_depth_m) = 0;

    // Begins a key's cut: of error_px > 0, for a camera.
    virtual void begin_key(const view::Camera& camera, double error_px) = 0;
    // The cut's next slice. All slices together hold each of its triangles once; of about triangles_wanted > 0 each, fewer where
    // deciding took its share of the work, and all that there are left for the greatest number.
    struct Slice {
        CutCount count;
        bool is_last = false;
    };
    virtual Slice next_slice(uint64_t triangles_wanted) = 0;

    // No place of the true surface is farther than that from any coarse cut, metres; and in what direction: the vertical alone
    // (then the cut is raised by that, to cover outlines), or any (then it is refined along them).
    virtual double most_slack_m() const = 0;
    virtual bool is_error_vertical() const = 0;
};

}  // namespace overlook::lod_sprite
