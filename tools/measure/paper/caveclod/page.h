// Section 4 of the CAVECLOD paper as one page.
#pragma once

#include <string>
#include <vector>

#include "tools/measure/paper/caveclod/flown.h"
#include "tools/measure/tables.h"

namespace overlook::measure::paper::cameras {

struct CaveclodPage {
    const Flown& flown;
    const RunSetup& setup;
    const std::vector<Chart>& charts;
    bool has_charts = true;
};
// One file without scripts or anything from elsewhere; links are relative to its folder.
std::string caveclod_page_html(const CaveclodPage& page);

}  // namespace overlook::measure::paper::cameras
