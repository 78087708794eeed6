// The page's sentences, each made from the run's numbers.
#pragma once

#include <string>
#include <string_view>

#include "tools/measure/run.h"

namespace overlook::measure {

// What the chart of this name shows, in a sentence or two.
std::string chart_sentence(std::string_view chart_name, const CourseResult& course);

// What a worst frame shows: how bad, against the floor, and where in the picture.
std::string worst_sentence(const RunResult& run, const RunResult& floor, bool is_e);

// "2,097,152"; "10.1 MB"; "0.0532": as many digits as mean something.
std::string short_count(double count);
std::string short_bytes(double bytes);
std::string short_number(double number);

}  // namespace overlook::measure
