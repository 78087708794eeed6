// Flies what section 4 of the LOD-sprite paper flies.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "formats/scene.h"
#include "tools/measure/paper/lod_sprite/plan.h"
#include "tools/measure/run.h"

namespace overlook::measure::paper::sprite {

// Where it is flown, and how much of it.
struct Flying {
    World& world;  // uploaded
    gl::Renderer renderer;
    const scene::Flight& flight;
    uint32_t width_px = 512, height_px = 512, frames = 600;
    std::string cache_folder;  // for reference frames
};

// Cameras of a flight spread over so many frames (>= 2), as the world's terrain sees them.
std::vector<view::Camera> cameras_of(const Flying& flying, uint32_t frames);
double step_s(const Flying& flying, uint32_t frames);

// Figures 9 to 11 and the numbers: all of the cast side by side with their floor. Runs: high, low, the sprites, the floor. Fails
// as run_course.
Result<CourseResult> fly_beside(const Flying& flying, const Cast& cast, const std::function<void(double)>& done);

// One method at one threshold, or over one number of frames.
struct Swept {
    std::string family;
    double threshold_px = kThreshold_px;
    uint32_t frames = 0, keyframes = 0;    // frames on which a keyframe was begun or made
    double mean_ms = 0, high_mean_ms = 0;  // the latter of the high cut in the same run; 0 where it did not fly along
    double keyframe_share() const { return double(keyframes) / frames; }
    double speed_up() const { return high_mean_ms / mean_ms; }
};
Swept swept_from(const RunResult& run, const RunResult* high, double threshold_px);

// Figures 13 and 14: the sprites at each threshold, and the high cut, side by side; times and counters only.
Result<std::vector<Swept>> fly_thresholds(const Flying& flying, const Cast& cast, std::span<const double> thresholds_px,
                                          const std::function<void(double)>& done);
// Figure 12: the sprites over the same way in other numbers of frames; counters only.
Result<std::vector<Swept>> fly_frame_counts(const Flying& flying, const Cast& cast, std::span<const uint32_t> counts,
                                            const std::function<void(double)>& done);

double mean_ms(const RunResult& run);

// A view of figure 6 or 7: what every run of the cast draws there. A sprite's picture is the last of kStillFrames of a still
// camera: by then its keyframe is of this view.
constexpr uint32_t kStillFrames = 32;
struct ViewPicture {
    std::string family;
    uint64_t triangle_count = 0;  // of that frame
    ImageRgb8 image;
};
struct ViewPictures {
    PlanView view;
    ViewPicture low, high;
    std::vector<ViewPicture> sprites;
};
Result<ViewPictures> draw_view(const Flying& flying, const Cast& cast, const PlanView& view);

// Where the flight is above the ground, every of so many frames; the ground's nearest sample below, the nearest of the border
// outside.
struct PathPoint {
    double east_m = 0, north_m = 0, height_m = 0, ground_m = 0, flown_m = 0;
    bool is_over_terrain = false;
};
std::vector<PathPoint> path_of(const Flying& flying, uint32_t frames);

}  // namespace overlook::measure::paper::sprite
