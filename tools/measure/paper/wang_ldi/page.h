// Tiling layered depth images beside their paper, as one page.
#pragma once

#include <string>
#include <vector>

#include "tools/measure/paper/wang_ldi/flown.h"
#include "tools/measure/tables.h"

namespace overlook::measure::paper::wang {

struct WangPage {
    const Flown& flown;
    const RunSetup& setup;
    const std::vector<Chart>& charts;
    bool has_charts = true;
    bool is_coarse = false;  // baked so
};
// One file without scripts or anything from elsewhere; links are relative to its folder.
std::string wang_page_html(const WangPage& page);

}  // namespace overlook::measure::paper::wang
