// The page that shows a run: index.html, which opens from disk.
#pragma once

#include <string>
#include <vector>

#include "tools/measure/charts.h"
#include "tools/measure/run.h"
#include "tools/measure/tables.h"

namespace overlook::measure {

struct PageInput {
    const CourseResult& course;
    const RunSetup& setup;
    const std::vector<Chart>& charts;
    bool has_charts = true;  // drawn, not only their scripts
};

// One file without scripts or anything from elsewhere; links are relative to its folder. What was run, the table of runs (99th
// percentiles first), each chart and each run's worst frames with a sentence that its numbers make.
std::string page_html(const PageInput& input);

// The pictures of a run's worst frames, as the page names them: path relative to the page's folder.
enum class Shown { test, reference, error };
std::string picture_path(const RunResult& run, const WorstFrame& worst, bool is_e, Shown what);

}  // namespace overlook::measure
