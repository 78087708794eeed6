// All that was flown and filmed: the tables, the charts, the targets and the page are made of it.
#pragma once

#include <string>
#include <vector>

#include "formats/image.h"
#include "tools/measure/charts.h"
#include "tools/measure/paper/fsi/film.h"
#include "tools/measure/paper/fsi/sizes.h"

namespace overlook::measure::paper::fsi {

struct Picture {
    int figure = 0;    // of the paper; 0: of none
    std::string name;  // of its file: images/figure-7.png
    std::string caption;
    ImageRgb8 image;
};

struct Flown {
    uint32_t frames = 0;              // of figure 8
    std::vector<std::string> scenes;  // names of subjects, in their order
    std::vector<Point> points;        // figure 8
    std::vector<Film> films;          // every way, of each scene and chain
    std::vector<Picture> pictures;
};

// Figures 2 and 8, by gnuplot from the tables: a chart of figure 8 a scene.
std::vector<Chart> charts_of(const Flown& flown);

// ramps.csv: figure 2's visibility function from the code that runs (runtime/discrete/transition.h).
std::string ramps_csv();

}  // namespace overlook::measure::paper::fsi
