// What is drawn: frame rates with and without CAVECLOD, and the pictures of figures 1, 2 and 5 to 9.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/measure/paper/caveclod/fly.h"
#include "tools/measure/paper/leave.h"

namespace overlook::measure::paper::cameras {

// Frames a second over a stretch of frames.
struct Rate {
    double time_s = 0;  // its middle, of flight
    double with_fps = 0, without_fps = 0;
};
// Figure 12: four cameras refined and drawn in their places, one sample a pixel, each with its own faces and all by one
// refinement, frame by frame in turns; until everything is drawn. Fails with Exit::impossible (targets). done: told the share of
// work done, 0..1.
Result<std::vector<Rate>> frame_rates(const Subject& subject, const Flying& flying, const std::function<void(double)>& done);
double mean_fps(const std::vector<Rate>& rates, double Rate::*which);

// Figures 7 to 9: the cameras' pictures in their places at that time of the flight, each drawn with its own faces,
// kPictureSamples samples a pixel.
constexpr uint32_t kPictureSamples = 4;
Result<Picture> flyover_picture(const Subject& subject, const Flying& flying, int figure, uint32_t cameras, double time_s);

// Figures 1, 2, 5 and 6: every face of a coloured mesh.
Result<Picture> coloured_picture(World& coloured, int figure, const view::Camera& camera, const std::string& caption);

}  // namespace overlook::measure::paper::cameras
