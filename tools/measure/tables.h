// The run as tables and as JSON.
#pragma once

#include <string>
#include <vector>

#include "runtime/gl/context.h"
#include "tools/measure/run.h"

namespace overlook::measure {

// Where and how it was measured; stands in every report.
struct RunSetup {
    std::string version;               // of Overlook
    std::vector<std::string> command;  // as it was typed
    std::string scene, scene_hash;     // the file's bare name, and the hash of its content
    std::string flight, flight_hash;
    std::string processor;  // "AMD EPYC 7B13", as the system names it
    unsigned processor_threads = 0;
    gl::Renderer renderer;
    bool is_wall_clock = false;
    uint32_t width_px = 0, height_px = 0;
    double step_s = 0;
};

// The system's name of the processor; "unknown processor" where it has none.
std::string processor_name();

// frames.csv: a row per frame and run, figures() as columns; what was not taken is empty.
std::string frames_csv(const CourseResult& course, double step_s);
// runs.csv: a row per run with the medians and 99th percentiles that the charts draw.
std::string runs_csv(const CourseResult& course);
// honesty.csv: a row per curve (all runs of a method and variant) and step of what was promised: how many things, and the
// measured displacement of the median one, of the 99th percentile and of the one that comes worst off against its promise.
std::string honesty_csv(const CourseResult& course);
// runs.json: schema samples/schema/runs.schema.json.
std::string runs_json(const CourseResult& course, const RunSetup& setup);

}  // namespace overlook::measure
