// Chains of levels drawn from frame to frame, for tests.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "runtime/discrete/draw_frames.h"
#include "runtime/gl/target.h"
#include "tests/gl/fixture.h"
#include "tests/runtime/discrete/chains.h"

namespace overlook::discrete::made {

constexpr double kStep_s = 1.0 / 60;

inline view::Camera camera_from(const glm::dvec3& position_m) {
    view::Camera camera;  // looks north
    camera.position_m = position_m;
    camera.width_px = 96, camera.height_px = 80, camera.near_m = 0.01, camera.fov_y_deg = 40;
    return camera;
}

inline Placement placed(const glm::dvec3& at_m, double scale = 1) {
    Placement placement;
    placement.translation_m = at_m, placement.scale = scale;
    return placement;
}

// Chosen by distance: level 1 from 10 m on, level 2 from 20 m on, ... An eye that is put elsewhere begins changes of level.
inline FrameOptions by_distance(Variant variant) {
    FrameOptions options = defaults_of(variant);
    options.select.criterion = Criterion::distance;
    options.select.distance_m = 10;
    options.select.refine_share = 1;
    options.select.coarsen_share = 0.99;
    options.remedies.knows_cuts = false;
    return options;
}

// A context must be current.
class Film {
  public:
    Film(const Chain& chain, std::vector<Placement> placements, const FrameOptions& options, uint32_t samples = 1,
         const view::Camera& size_of = camera_from({}))
        : drawing_(*Drawing::make(chain)),
          target_(*gl::Target::make(size_of.width_px, size_of.height_px, samples)),
          frames_(*FrameDrawer::make(drawing_, placements, options)) {}

    ImageRgb8 frame(const view::Camera& camera, double dt_s = kStep_s) {
        frames_->decide(camera, dt_s, 0);
        return again(target_);
    }
    ImageRgb8 again(const gl::Target& target) {
        Result<FrameCounts> drawn = frames_->draw(target, {});
        EXPECT_TRUE(drawn);
        counts = *drawn;
        return target.read();
    }
    // Goes on until a change of level is about so far on its way.
    ImageRgb8 until(const view::Camera& camera, double phase) {
        ImageRgb8 picture = frame(camera);
        for (int i = 0; i < 100 && transition().phase < phase; ++i) picture = frame(camera);
        return picture;
    }
    const Transition& transition() const { return frames_->director().transition(0); }
    FrameDrawer& frames() { return *frames_; }
    const gl::Target& target() const { return target_; }

    FrameCounts counts;

  private:
    Drawing drawing_;
    gl::Target target_;
    std::unique_ptr<FrameDrawer> frames_;
};

// Pixels that differ in any channel by more than `tolerance`.
inline size_t differing(const ImageRgb8& a, const ImageRgb8& b, int tolerance = 0) {
    size_t count = 0;
    for (size_t i = 0; i < a.pixels.size(); i += 3) {
        bool differs = false;
        for (size_t k = i; k < i + 3; ++k) differs = differs || std::abs(int(a.pixels[k]) - int(b.pixels[k])) > tolerance;
        count += differs;
    }
    return count;
}
// Pixels outside what lies between two pictures, by more than `tolerance` in any channel.
inline size_t beyond(const ImageRgb8& image, const ImageRgb8& a, const ImageRgb8& b, int tolerance) {
    size_t count = 0;
    for (size_t i = 0; i < image.pixels.size(); i += 3) {
        bool is_beyond = false;
        for (size_t k = i; k < i + 3; ++k) {
            int low = std::min(a.pixels[k], b.pixels[k]), high = std::max(a.pixels[k], b.pixels[k]);
            is_beyond = is_beyond || image.pixels[k] < low - tolerance || image.pixels[k] > high + tolerance;
        }
        count += is_beyond;
    }
    return count;
}
inline double mean_difference(const ImageRgb8& a, const ImageRgb8& b) {
    double sum = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) sum += std::abs(int(a.pixels[i]) - int(b.pixels[i]));
    return sum / double(a.pixels.size());
}

}  // namespace overlook::discrete::made
