// Section 4 of the LOD-sprite paper as one page, and the pictures of figures 6 and 7.
#pragma once

#include <string>
#include <vector>

#include "tools/measure/paper/lod_sprite/figures_8_to_14.h"
#include "tools/measure/tables.h"

namespace overlook::measure::paper::sprite {

// A picture of figure 6 or 7 as the page shows it.
struct FigurePicture {
    std::string name;     // of its file: images/figure-6a.png
    std::string caption;  // with the triangles counted
    ImageRgb8 image;
};
// Low (a), high (b), each sprite (c), and absolute differences from high of low (d) and of each sprite (e), the greatest of the
// three channels, kDifferenceGain times: c2 and e2 are the second sprite's.
constexpr int kDifferenceGain = 4;
std::vector<FigurePicture> pictures_of(const ViewPictures& views);

struct PaperPage {
    const Flown& flown;
    const RunSetup& setup;
    const std::vector<Chart>& charts;
    const std::vector<std::vector<FigurePicture>>& pictures;  // a row a view
    bool has_charts = true;
};
// One file without scripts or anything from elsewhere; links are relative to its folder.
std::string paper_page_html(const PaperPage& page);

}  // namespace overlook::measure::paper::sprite
