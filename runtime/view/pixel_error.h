// The one place where metres of error become pixels: bakers and runtime alike ask here.
#pragma once

#include "runtime/view/camera.h"

namespace overlook::view {

// Bounds how far on the screen anything within error_m of where it should be is displaced, anywhere in the frame.
//
// Let a point p be in the frame at depth z = d cos(theta) (d its distance, theta its angle from the axis), and let p' lie
// within error_m of it. With u the unit vector p' - p, |x'/z' - x/z| = e |z u_x - x u_z| / (z z') <= e d / (z z'), and
// z' >= z - e, so the displacement is at most
//
//     focal_px * error_m * sec(theta) / (z - error_m)            [pixels]
//
// which grows with error_m and theta and falls with z: the largest over a region is at its least depth and widest angle.
// (With z = d cos(theta) this is f e / (d cos^2(theta)), less the error for motion towards the eye.)
//
// depth_min_m: least depth over the region's part in the frame, > 0; secant_max: of its widest angle in the frame, >= 1.
// Returns infinity where depth_min_m <= error_m (the error can reach the eye) and 0 for error_m = 0.
double error_px_bound(double focal_px, double error_m, double depth_min_m, double secant_max);

// The same where the error is along the world's vertical, as a height field's is: for it |z u_x - x u_z| and |z u_y - y u_z| are
// two sides of the cross product of p and the vertical u, whose length is p's horizontal distance h from the eye, and the depth
// changes by error_m * |u_z| at most. So the displacement is at most
//
//     focal_px * error_m * min(sec(theta), h / z) / (z - error_m * |u_z|)            [pixels]
//
// which is far less for a camera that looks down. horizontal_max_m: the region's greatest horizontal distance; axis_rise: |u_z|,
// the sine of the axis's pitch, 0 .. 1.
double error_px_bound_vertical(double focal_px, double error_m, double depth_min_m, double secant_max, double horizontal_max_m,
                               double axis_rise);

// The bound of error_px_bound for a sphere given by its middle's distance and angle: its least depth and widest angle are bounded
// by those of the sphere, and by the frame's corner (secant_corner) since what is outside the frame is not seen.
double error_px_bound_of_sphere(const Camera& camera, const glm::dvec3& middle_m, double radius_m, double error_m);

}  // namespace overlook::view
