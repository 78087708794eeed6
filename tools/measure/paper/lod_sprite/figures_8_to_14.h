// Figures 8 to 14 of the LOD-sprite paper as tables and charts, the paper's numbers beside ours.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/measure/charts.h"
#include "tools/measure/paper/lod_sprite/fly.h"
#include "tools/measure/paper/lod_sprite/held_keys.h"
#include "tools/measure/paper/lod_sprite/remedies.h"

namespace overlook::measure::paper::sprite {

// What section 4 states of the paper's own run.
struct Printed {
    static constexpr double kHighMean_ms = 526, kLowMean_ms = 22, kKeyframeMean_ms = 680, kNovelMean_ms = 36, kMean_ms = 53;
    static constexpr double kSpeedUp = 9.9, kKneeThreshold_px = 1;
    static constexpr uint32_t kFrames = 600, kKeyframes = 16;
};

// All that was flown.
struct Flown {
    Plan plan;
    Cast cast;
    CourseResult beside;  // high, low, the sprites, the floor
    double step_s = 0;    // of it
    std::vector<Swept> thresholds, frame_counts;
    std::vector<ViewPictures> views;
    std::vector<PathPoint> path;
    RemedyTable remedies;
    std::vector<HeldRun> held;  // empty: not flown
};
inline const RunResult& high_of(const Flown& flown) {
    return flown.beside.runs[0];
}
inline const RunResult& low_of(const Flown& flown) {
    return flown.beside.runs[1];
}
std::vector<const RunResult*> sprites_of(const Flown& flown);
std::vector<std::string> sprite_names(const Flown& flown);

// thresholds.csv and frame_counts.csv: a row a method and threshold or number of frames.
std::string swept_csv(const std::vector<Swept>& swept);
// path.csv: a row a frame; is_key: the first sprite makes a keyframe there.
std::string path_csv(const Flown& flown);
// map.csv: the ground's heights on at most 160 x 160 points, in gnuplot's blocks.
std::string map_csv(const World& world);

// charts/figure-8-map, figure-8-profile, figure-9 .. figure-14, from those tables and frames.csv; without what was not swept.
std::vector<Chart> charts_8_to_14(const Flown& flown);

// Where a falling curve turns from steep to flat: of its points the one farthest below the straight line from the first to the
// last, both axes scaled to 0..1 (Satopaa et al., Finding a "Kneedle" in a Haystack, 2011; here without smoothing). points: x
// ascending. Nothing of fewer than three points, or where none is below the line.
struct CurvePoint {
    double x = 0, y = 0;
};
std::optional<double> knee_of(const std::vector<CurvePoint>& points);

}  // namespace overlook::measure::paper::sprite
