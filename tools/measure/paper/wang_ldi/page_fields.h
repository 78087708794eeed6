// Section 6 of the page: figures 1 and 10, and what flying costs and shows.
#pragma once

#include "tools/measure/paper/wang_ldi/page.h"

namespace overlook::measure::paper::wang {

std::string fields_html(const WangPage& page, const Plants& plants);
// One image for all sides beside eight; empty where that was not baked.
std::string directions_html(const Plants& plants);

}  // namespace overlook::measure::paper::wang
