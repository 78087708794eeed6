// Equations 1 and 2 of Chen, Swan and Kuo, LOD-Sprite Technique for Accelerated Terrain Rendering (1999), section 3.2: by what
// angle a sprite taken from v1 shows things beside their place when it lies on low-resolution ground and is seen from v2.
//
// The text contradicts itself. It asks for the angle at "the central vertex of each low-resolution quadtree quadrant", says "we
// calculate the central vertex by averaging the four corner vertices", and lets C' be where the ray from v1 through C meets "the
// plane spanned by the estimated central vertex and two original vertices of the quadrant". If C is that average it lies on the
// plane, C' is C, and the error is zero from everywhere. The words "estimated central vertex" and figure 4, where C is a vertex
// of the full-resolution data and C' lies on the low-resolution edge below it, say what is meant: C is the data's own vertex in
// the middle of the quadrant, and the average of the corners, M, stands for the low-resolution surface. So it is done here.
//
// Two further things the text leaves open. Which two corners: those of the side that the ray leaves through, since the ray meets
// the surface beyond C where C is above M, and before C where it is below. And what if the ray does not meet the plane before v1,
// as one that passes over flat ground and rises: then the sprite carries C's colour to whatever lies behind, and C' is taken to
// be infinitely far along the ray.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "formats/terrain.h"
#include "runtime/lod_sprite/paper_quadrants.h"
#include "runtime/terrain/refine.h"
#include "runtime/view/camera.h"

namespace overlook::lod_sprite::paper {

// The plane on which C' lies.
enum class Plane {
    fan,    // through the mean of the four corners and two of them, as the text says
    drawn,  // through three corners: the triangle that the low cut draws there (figure 4's edge AB)
};

// A quadrant with its heights, metres. Corners: north-west, north-east, south-east, south-west; the drawn diagonal runs from the
// first to the third, or else between the others.
struct QuadrantShape {
    glm::dvec3 corners[4];
    glm::dvec3 centre{0};  // of the full-resolution data
    bool is_main_diagonal = true;
};

// The angle between C' and C as v2 (now) sees them, 0 .. pi. By the cross and the dot product: from the dot product alone, as the
// paper takes it, angles below 1e-8 rad are lost to rounding. Zero where v1 = v2 or where C lies on the plane.
double parallax_rad(const QuadrantShape& quadrant, const glm::dvec3& key_eye_m, const glm::dvec3& now_eye_m, Plane plane);

// The view angle of a single pixel, "the field of view over the screen resolution", radians.
double pixel_angle_rad(const view::Camera& camera);

struct ErrorFigures {
    // The root of equation 2's left side over beta: the paper draws a new keyframe where it is not below its epsilon.
    double rms_px = 0;
    // What the mean hides, for charts.
    double p99_px = 0;  // the least that 99 % of the quadrants do not exceed
    double max_px = 0;
    uint64_t quadrant_count = 0;     // n: those in view, with and without a centre
    uint64_t with_centre_count = 0;  // of them, those looked at; the others are single cells with an error of zero
};

struct ErrorOptions {
    Plane plane = Plane::fan;
    int levels = kCutLevels;  // of the quadrants below the roots (more than there are: all there are), or as the cut goes
};

class ErrorMetric {
  public:
    // The terrain must outlive it.
    explicit ErrorMetric(const terrain::Terrain& terrain, const ErrorOptions& options = {})
        : terrain_(terrain), options_(options) {}

    // How far a sprite taken by `key` is off in the view of `now`, over the quadrants in now's view: those of which corners and
    // centre are not all beyond the same side of it. `low` is what is drawn now. Cameras in the terrain's own frame. Cost
    // O(triangles of low); no memory in the steady state.
    ErrorFigures measure(const view::Camera& key, const view::Camera& now, const terrain::Cut& low);

  private:
    const terrain::Terrain& terrain_;
    ErrorOptions options_;
    Quadrants quadrants_;
    std::vector<double> angles_rad_;
};

}  // namespace overlook::lod_sprite::paper
