// Runs made by hand, whose numbers and gates are known.
#pragma once

#include "tools/measure/figures.h"
#include "tools/measure/methods.h"

namespace overlook::measure {

inline WorstFrame worst_of(uint32_t frame, double value) {
    WorstFrame worst{true, frame, value, {4, 4, std::vector<uint8_t>(48, 90)}, {4, 4, std::vector<uint8_t>(48, 80)}, {}};
    worst.map.assign(16, 0.0f);
    worst.map[0] = 0.5f;
    return worst;
}

// Ten frames; frame i costs base + i milliseconds and has E e + i / 1000 on every fifth.
inline RunResult run_of(const MethodSpec& spec, double base_ms, double e) {
    RunResult run;
    run.spec = spec;
    run.label = label_of(spec);
    for (uint32_t i = 0; i < 10; ++i) {
        FrameRecord record;
        record.frame = i;
        record.counters.triangle_count = 1000 + i;
        record.counters.predicted_error_px = is_floor(spec) ? 0 : setting(spec, "error-px") / 2;
        record.decide_ms = 1;
        record.draw_ms = base_ms + i - 1;
        if (i % 5 == 0) record.numbers.e_p99 = record.numbers.e_mean = e + i / 1000.0;
        if (i > 0) record.numbers.w = e / 10;
        record.numbers.s_p95_px = record.numbers.s_max_px = 1;
        record.numbers.hole_count = record.numbers.hole_allowed_count = 0;
        record.numbers.psnr_db = 40;
        record.numbers.luma_difference = 0.01;
        run.frames.push_back(record);
    }
    if (!is_floor(spec)) {
        for (uint32_t frame : {0u, 9u}) {
            std::vector<float> predicted_px = {0.5f, 1, 0}, measured_px = {0.25f, 0.75f, 0};
            run.frames[frame].numbers.g = run.g.add(predicted_px, measured_px);
        }
    }
    run.worst_e = worst_of(5, e + 0.005);
    run.worst_w = worst_of(3, e / 10);
    return run;
}

inline CourseResult a_course() {
    CourseResult course;
    course.runs.push_back(run_of(*parse_method("terrain@error-px=1"), 5, 0.2));
    course.runs.push_back(run_of(*parse_method("terrain@error-px=4"), 2, 0.4));
    course.runs.push_back(run_of(floor_spec(4), 50, 0.1));
    for (RunResult& run : course.runs) run.floor = 2;
    course.runs[1].pop.index = 3;
    course.runs[1].pop.frame = 3;
    course.references_drawn = 10;
    return course;
}

}  // namespace overlook::measure
