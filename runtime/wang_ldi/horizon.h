// What of planted ground the ground itself hides from an eye.
//
// Based on: L. Downs, T. Moeller, C. Sequin, Occlusion Horizons for Driving through Urban Scenery, 2001 (how high what has been
// passed on the way away from the eye rises in its picture, direction by direction). Different: kept for every distance, so that
// what stands anywhere may be asked about in any order; of the ground's own triangles, the lowest on each line across a
// direction, so that nothing is hidden by what is not there.
#pragma once

#include <vector>

#include "runtime/view/camera.h"
#include "runtime/wang_ldi/ground.h"

namespace overlook::wang_ldi {

class Horizon {
  public:
    Horizon() = default;  // hides nothing
    // Of the ground in the camera's picture. It hides nothing where the camera sees it from below or from outside of its extent,
    // or looks down or up so steeply that directions along the ground say little. O(picture's width * size of the ground,
    // in cells) where all of it is seen, else less; by as many threads as there are.
    Horizon(const Ground& ground, const view::Camera& camera);
    bool is_empty() const { return rises_.empty(); }
    bool is_of(const Ground& ground, const view::Camera& camera) const;

    // Whether nothing of the box over a rectangle can be seen in the picture, nor any splat so wide, in metres, about a point of
    // it, where the ground is drawn and no place of it more than error_px from where it should be. May be false where nothing is
    // seen. high_m: of the box.
    bool hides(const Rect& rect, double high_m, double wide_m, double error_px) const;

  private:
    double bearing(size_t line) const { return bearing_most_ * (2.0 * double(line) / double(sectors_) - 1); }
    void look_along(const Ground& ground, size_t sector);

    const Ground* ground_ = nullptr;
    view::Camera camera_;
    glm::dvec2 eye_m_{0}, forward_{0}, right_{0};  // along the ground
    double eye_high_m_ = 0, focal_px_ = 0;
    // Bearings are ways to the right for a way forward. All pixels of the picture, and what they need of their neighbours, lie
    // between -bearing_most_ and this.
    double bearing_most_ = 0;
    double depth_most_ = 0;       // of any pixel's, of its way forward
    double slant_ = 1;            // of a pixel up or down, as a way aside changes by it, and one aside, at most
    size_t sectors_ = 0;          // of bearings
    std::vector<double> ways_m_;  // forward, where it was looked at
    // [sectors, ways]: every line of sight of the sector that rises less for its way forward has met the ground up to there.
    std::vector<float> rises_;
};

}  // namespace overlook::wang_ldi
