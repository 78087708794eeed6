// The figures of a frame, each with its name, unit and meaning: the columns of frames.csv and the summaries of runs.json.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "tools/measure/numbers/percentiles.h"
#include "tools/measure/run.h"

namespace overlook::measure {

struct Figure {
    std::string_view name;  // with its unit: "draw_ms"
    std::string_view meaning;
    std::optional<double> (*of)(const FrameRecord&);
    bool repeats;  // the same on every run: counters and numbers, not times
};

std::span<const Figure> figures();
// Of that name, which must exist.
const Figure& figure(std::string_view name);

// The values of a figure over the frames that have one, in order of time.
std::vector<double> values_of(const RunResult& run, const Figure& figure);
Percentiles percentiles_of(const RunResult& run, std::string_view figure_name);
// The mean of these; none if no frame has one.
std::optional<double> mean_of(const RunResult& run, std::string_view figure_name);

// What a default run must keep, and whether it did: at most `limit`, or at least.
struct Gate {
    std::string_view name;
    double value = 0, limit = 0;
    bool is_least = false;
    bool is_kept() const { return is_least ? value >= limit : value <= limit; }
};
// Holes 0 and pop index 1.2 of every run; the predicted error of one that was asked for pixels, or, within a budget, its
// triangles from the 20th frame on, to 5 %; G of one that promises something of each thing it draws: never more than 1, in the
// median at least 0.3. Empty for runs without pictures.
std::vector<Gate> gates_of(const RunResult& run);

// Whether E's 99th percentile (over pixels, then over frames) is at most 1.02 times the floor's.
bool is_at_floor(const RunResult& run, const RunResult& floor);

}  // namespace overlook::measure
