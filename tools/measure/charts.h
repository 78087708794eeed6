// The charts, drawn by gnuplot from the tables.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/result.h"
#include "tools/measure/run.h"

namespace overlook::measure {

struct Chart {
    std::string name;  // of its files: charts/NAME.gp, NAME.svg, NAME-narrow.svg, NAME.png
    std::string title;
    std::string script;  // gnuplot's, with relative paths: run it in charts/ to draw it again
};

// What every chart's script begins with: the terminal of its form, the look of axes and grid. key_rows: how many lines the key
// has.
std::string chart_head(size_t key_rows);
// A text as gnuplot takes it.
std::string gnuplot_text(const std::string& text);
// Names the horizontal axis, with room below for the key.
std::string x_label(const std::string& text);
// Which column of frames.csv a figure is in, as gnuplot counts them.
int frames_column(std::string_view figure_name);
// Colours that the colour-blind tell apart, by turns.
std::string chart_colour(size_t place);

// What can be drawn of the run: the front of cost against error in milliseconds and in triangles, steadiness and time over the
// flight, the distribution of errors, promised against measured pixels. Without pictures (wall clock) only the times.
std::vector<Chart> charts_of(const CourseResult& course);

// Writes the scripts into FOLDER/charts and has gnuplot draw each as SVG for wide and for narrow screens and as PNG. Returns
// false if gnuplot is not installed; the scripts are there then. Fails with Exit::cannot_write and Exit::impossible:
// "out/charts/front_ms.gp: gnuplot cannot draw it (status 1); run gnuplot on it to see why".
Result<bool> draw_charts(const std::vector<Chart>& charts, const std::string& folder);

}  // namespace overlook::measure
