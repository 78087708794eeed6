// All that a run found out of its subjects: the tables, the charts, the targets and the page are made of it.
#pragma once

#include <string>
#include <vector>

#include "tools/measure/charts.h"
#include "tools/measure/paper/leave.h"
#include "tools/measure/paper/wang_ldi/flown_fields.h"
#include "tools/measure/paper/wang_ldi/one_direction.h"
#include "tools/measure/paper/wang_ldi/one_ldi.h"
#include "tools/measure/paper/wang_ldi/report.h"
#include "tools/measure/paper/wang_ldi/wood.h"

namespace overlook::measure::paper::wang {

// What a file takes.
struct Size {
    uint64_t samples = 0, stored_bytes = 0, file_bytes = 0;
};

// One LDI of the whole scene, seen from so far aside.
struct Moved {
    double aside_m = 0;
    Broken broken;
};

struct Plants {
    std::string name;
    BakeReport paper, own, single, robinson;
    std::optional<BakeReport> gloss, gloss_none;
    Size paper_size, own_size;
    WoodCounts by_paper, by_own, by_single;  // figure 2's view
    uint64_t one_samples = 0;                // of the one LDI
    uint32_t one_layers = 0;
    std::vector<Moved> moved;
    std::vector<FlownLand> lands;            // section 6; none: the folder has no scenes
    std::optional<OneDirection> directions;  // none: the folder has no bakes of one and of eight
    std::vector<Picture> pictures;           // in the order of their figures
};

struct Flown {
    std::vector<Plants> plants;
};

// sets.csv: a row a bake; levels.csv: a row a bake and level; planting.csv: density by distance; one-ldi.csv: a row a place.
std::string sets_csv(const Flown& flown);
std::string levels_csv(const Flown& flown);
std::string planting_csv(const Flown& flown);
std::string one_ldi_csv(const Flown& flown);
// fields.csv: a row a run of section 6.
std::string fields_csv(const Flown& flown);

// Of section 6: times, errors and radii.
std::vector<Chart> charts_of_fields(const Plants& plants);

// By gnuplot from the tables: of each, how densely corners and edges are planted, and how one LDI breaks.
std::vector<Chart> charts_of(const Flown& flown);

}  // namespace overlook::measure::paper::wang
