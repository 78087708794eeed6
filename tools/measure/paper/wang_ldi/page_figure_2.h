// What the page says of figure 2, and how it shows pictures.
#pragma once

#include <string>
#include <vector>

#include "tools/measure/paper/wang_ldi/figure_2.h"

namespace overlook::measure::paper::wang {

// Those of the paper's figures from `least` to `most`, wide ones by themselves after the others.
std::string figures_html(const std::vector<Picture>& pictures, int least, int most);

// The table, what it is of, and the pictures.
std::string figure_2_html(const Figure2& figure);

}  // namespace overlook::measure::paper::wang
