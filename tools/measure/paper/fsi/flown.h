// All that was flown and filmed: the tables, the charts, the targets and the page are made of it.
#pragma once

#include <string>
#include <vector>

#include "formats/image.h"
#include "tools/measure/charts.h"
#include "tools/measure/paper/fsi/combining.h"
#include "tools/measure/paper/fsi/drawbacks.h"
#include "tools/measure/paper/fsi/film.h"
#include "tools/measure/paper/fsi/sizes.h"
#include "tools/measure/paper/leave.h"

namespace overlook::measure::paper::fsi {

struct Flown {
    uint32_t frames = 0;              // of figure 8
    std::vector<std::string> scenes;  // names of subjects, in their order
    std::vector<Point> points;        // figure 8
    std::vector<Film> films;          // every way, of each scene and chain
    std::vector<Film> varied;         // variations(), of some
    std::vector<Film> optimised;      // of scenes with a visibility that was optimised: `switch` and the ways that use one
    std::vector<Combining> combining;
    std::vector<std::pair<std::string, std::vector<Drawback>>> drawbacks;  // by scene
    std::vector<Picture> pictures, sequences;                              // figures 1 to 7; of each film
};

// Figures 2 and 8, by gnuplot from the tables: a chart of figure 8 a scene.
std::vector<Chart> charts_of(const Flown& flown);

// ramps.csv: figure 2's visibility function from the code that runs (runtime/discrete/transition.h).
std::string ramps_csv();

}  // namespace overlook::measure::paper::fsi
