// The page's sentences, each made from the run's numbers.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tools/measure/run.h"

namespace overlook::measure {

// What the chart of this name shows, in a sentence or two.
std::string chart_sentence(std::string_view chart_name, const CourseResult& course);

// What a worst frame shows: how bad, against the floor, and where in the picture.
std::string worst_sentence(const RunResult& run, const RunResult& floor, bool is_e);

// "&lt;" and the like.
std::string escaped(std::string_view text);

// A run's label, or a text that holds some, as HTML: a label breaks before a setting and nowhere else, least of all at a hyphen.
std::string with_labels_html(std::string_view text);

// A command's words as HTML, quoted as a shell wants them; a line breaks between words.
std::string command_html(const std::vector<std::string>& words);

// "2,097,152"; "10.1 MB"; "0.0532": as many digits as mean something.
std::string short_count(double count);
std::string short_bytes(double bytes);
std::string short_number(double number);

}  // namespace overlook::measure
