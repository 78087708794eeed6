// All that a run found out of its subjects: the tables, the charts, the targets and the page are made of it.
#pragma once

#include <string>
#include <vector>

#include "tools/measure/charts.h"
#include "tools/measure/paper/leave.h"
#include "tools/measure/paper/wang_ldi/figure_2.h"
#include "tools/measure/paper/wang_ldi/flown_fields.h"
#include "tools/measure/paper/wang_ldi/one_direction.h"
#include "tools/measure/paper/wang_ldi/report.h"
#include "tools/measure/paper/wang_ldi/wood.h"

namespace overlook::measure::paper::wang {

// What a file takes.
struct Size {
    uint64_t samples = 0, stored_bytes = 0, file_bytes = 0;
};

struct Plants {
    std::string name;
    BakeReport paper, own, single, robinson;
    std::optional<BakeReport> gloss, gloss_none, every;  // as Subject's
    Size paper_size, own_size;
    Figure2 figure_2;
    std::vector<FlownLand> lands;            // section 6; none: the folder has no scenes
    std::optional<OneDirection> directions;  // none: the folder has no bakes of one and of eight
    std::vector<Picture> pictures;           // in the order of their figures
};

struct Flown {
    std::vector<Plants> plants;
};

// sets.csv: a row a bake; levels.csv: a row a bake and level; planting.csv: density by distance; figure-2.csv: a row a way of
// drawing a whole ground and a distance.
std::string sets_csv(const Flown& flown);
std::string levels_csv(const Flown& flown);
std::string planting_csv(const Flown& flown);
std::string figure_2_csv(const Flown& flown);
// fields.csv: a row a run of section 6.
std::string fields_csv(const Flown& flown);

// Of section 6: times, errors and radii.
std::vector<Chart> charts_of_fields(const Plants& plants);

// By gnuplot from the tables: of each, how densely corners and edges are planted, and how pictures of a whole ground differ from
// rays the farther away they are seen.
std::vector<Chart> charts_of(const Flown& flown);

}  // namespace overlook::measure::paper::wang
