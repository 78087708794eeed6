// Figure 8: frame time against the size of the viewport, for every method and scene.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tools/measure/paper/fsi/cast.h"
#include "tools/measure/paper/fsi/subject.h"
#include "tools/measure/run.h"

namespace overlook::measure::paper::fsi {

constexpr uint32_t kSides_px[] = {256, 512, 1024};  // of square viewports

// How a scene is flown: what is off by so many pixels of a viewport of kAsked_px is drawn coarser. At other sizes the same levels
// are drawn, so that only pixels change, as in the paper.
constexpr uint32_t kAsked_px = 512;
struct Asked {
    double error_px = 1;
    uint32_t frames_share = 1;  // of the frames flown, one of so many: scenes that are dear
};
// SIMPLE has two levels that differ by its whole size: 8 px. TREES: 8 px. Others: 1 px.
Asked asked_of(const std::string& name);

struct Point {
    std::string scene, chain, method;
    uint32_t side_px = 0, frames = 0;
    // Over the frames.
    double p50_ms = 0, max_ms = 0, decide_p50_ms = 0;
    double triangles = 0, draw_calls = 0, fading = 0;  // a frame, in the mean
    double odd_even = 0;                               // mean difference of consecutive frames' triangles, share
    uint64_t resident_bytes = 0, state_bytes = 0;
};

// How points of the scene's own chain are named whose pixels are shaded by kHeavyRounds lights more (figure 8 is of a shader that
// is simple: "the penalty looks exaggerated in comparison to the more common case of realistic fragment shaders").
constexpr const char* kHeavy = "heavy shader";
constexpr uint32_t kHeavyRounds = 48;

// Every way over the scene's own chain, with its shader and with a heavy one, and, of `switch` and `fsi:paper`, over the levels
// made by hand; frames take turns. frames:
// at least 2. Fails as run_course.
Result<std::vector<Point>> fly_sizes(Subject& subject, const gl::Renderer& renderer, uint32_t frames,
                                     const std::function<void(double)>& done);

// How points are named of so many things that the scene's field stands again and again beside itself, until there are kMany.
constexpr const char* kManyChain = "100,000 things";
constexpr uint32_t kMany = 100'000;

// `switch` and `fsi` over kMany of the scene's things at kAsked_px; frames: at least 2. Fails as run_course.
Result<std::vector<Point>> fly_many(const Subject& subject, const gl::Renderer& renderer, uint32_t frames);

// "error-px": 4 where asked 2 at kAsked_px and the viewport has twice as many pixels a side.
std::string settings_at(const Asked& asked, uint32_t side_px, const Way& way);

const Point* find(const std::vector<Point>& points, const std::string& scene, const std::string& chain, std::string_view method,
                  uint32_t side_px);

// sizes.csv: a row a point.
std::string sizes_csv(const std::vector<Point>& points);

}  // namespace overlook::measure::paper::fsi
