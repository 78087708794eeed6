// Frame-sequential interpolation beside its paper, as one page.
#pragma once

#include <string>
#include <vector>

#include "tools/measure/paper/fsi/flown.h"
#include "tools/measure/tables.h"

namespace overlook::measure::paper::fsi {

struct FsiPage {
    const Flown& flown;
    const RunSetup& setup;
    const std::vector<Chart>& charts;
    bool has_charts = true;
};
// One file without scripts or anything from elsewhere; links are relative to its folder.
std::string fsi_page_html(const FsiPage& page);

}  // namespace overlook::measure::paper::fsi
