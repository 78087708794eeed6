// What section 4 of the LOD-sprite paper is run with: run.json of `make-sample lod-sprite`, and the methods beside each other.
//
//     {"version": 1, "high_px": 0.0283, "low_px": 6.87,
//      "views": [{"figure": 6, "time_s": 0, "high_triangles": 387937, "low_triangles": 1503}]}      the paper's counts
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/result.h"
#include "tools/measure/method.h"

namespace overlook::measure::paper::sprite {

constexpr int kPlanVersion = 1;
constexpr double kThreshold_px = 1;  // at which the paper flies all but figures 13 and 14

// A view of figure 6 or 7: where the flight is at that time.
struct PlanView {
    int figure = 0;
    double time_s = 0;
    double high_triangle_count = 0, low_triangle_count = 0;  // the paper's
};

struct Plan {
    double high_px = 0, low_px = 0;  // of the cuts of keyframes and of the frames between them
    std::vector<PlanView> views;     // 1..8
};

// Parses run.json. Every failure is Exit::bad_input, as of scene::parse_scene, and further:
//   "run.json:2:3: /low_px: 0.02 is not above high_px, 0.0283"
Result<Plan> parse_plan(std::string_view text, const std::string& name);
Result<Plan> read_plan(const std::string& path);

// The runs that a plan asks for: everything drawn at the high cut, everything at the low one (hard levels, one sample a pixel),
// and each method with its cuts at the same thresholds.
struct Cast {
    MethodSpec high, low;
    std::vector<MethodSpec> sprites;
};

// methods: as of measure's --method; a setting of error-px, low-error-px, samples or a key's threshold that is not given there is
// the plan's, 1 sample and kThreshold_px. Fails as parse_method.
Result<Cast> cast_from(const Plan& plan, const std::vector<std::string>& methods);

// The same method at another threshold of its keyframes (of its error, if it has no keyframes).
MethodSpec at_threshold(const MethodSpec& spec, double threshold_px);

}  // namespace overlook::measure::paper::sprite
