// Where the camera of a flight is at a time: the same bits on every machine and with every compiler (only + - * / and remainder,
// which IEEE 754 rounds in one way; products and sums are never fused).
#pragma once

#include "formats/scene.h"
#include "runtime/view/camera.h"

namespace overlook::view {

// The camera of `flight` at time_s, any number. Before the first key it stands on the first, after the last on the last; at a
// key's time it is exactly there. Between keys i and i+1, with h = t[i+1] - t[i], s = (time_s - t[i]) / h and, for each of x, y,
// z, heading, pitch and field of view, delta[i] from key to key:
//
//     constant   p[i]
//     linear     p[i] + s delta[i]
//     smooth     p[i] + (3 s^2 - 2 s^3) delta[i] + (s^3 - 2 s^2 + s) h m[i] + (s^3 - s^2) h m[i+1]
//
// where m[i] is the slope at t[i] of the parabola through keys i-1, i and i+1 (of the nearest three at the flight's ends; the
// straight line if there are but two): with d = delta / h, m[i] = (h[i] d[i-1] + h[i-1] d[i]) / (h[i-1] + h[i]). The path so has
// no jump in its velocity, and a flight that is a parabola in time is kept as it is. (Catmull and Rom, A class of local
// interpolating splines, 1974, with Overhauser's slopes for times that are not equally far apart.)
//
// Angles go the shorter way: delta of the heading is within -180..180, and the heading itself may grow beyond 360. Where the
// cubic leaves what a camera can have, pitch ends at -90 and 90 and the field of view at 1 and 170.
//
// base: everything that the flight does not say: size, near plane, the field of view of keys that name none.
// flight.keys must not be empty. Cost O(log keys).
Camera camera_at(const scene::Flight& flight, double time_s, const Camera& base);

// The camera as an asset's own frame sees it (its position, heading and near plane), so that what is drawn there is the same
// picture; and back. Exact for a transform that does nothing; error_px means the same in both frames.
Camera camera_into(const scene::Transform& transform, const Camera& camera);
Camera camera_out_of(const scene::Transform& transform, const Camera& camera);

}  // namespace overlook::view
