// Figure 2: a whole ground as one layered depth image, as one tile that repeats and as Wang tiles, beside rays: from the image's
// own place and away from it.
#pragma once

#include <string>
#include <vector>

#include "tools/measure/paper/leave.h"
#include "tools/measure/paper/wang_ldi/subject.h"
#include "tools/measure/paper/wang_ldi/wood.h"

namespace overlook::measure::paper::wang {

// One way of drawing, from so far off the place of the one image: means over the views there, unless said otherwise.
struct SeenFrom {
    double away_m = 0;
    uint32_t views = 0;
    double e_mean = 0, e_p99 = 0;             // over all pixels of the views, small holes filled
    double unfilled_e_mean = 0;               // nothing filled
    double hole_share = 0, filled_share = 0;  // holes before and after small ones were filled
    double beyond_share = 0;                  // of the former those of places beyond the one image's rim; 0 of tiles
    double wrong_share = 0;
    double order_share = 0;           // pixels that another sample has where depths decide, not order
    double samples = 0, warp_ms = 0;  // one thread
};
struct Way {
    std::string name;                 // "one LDI", "a single tile"
    uint64_t samples = 0, bytes = 0;  // of all its images
    std::vector<SeenFrom> rows;       // by distance
};

struct Figure2 {
    std::vector<Way> ways;  // one LDI, a single tile, the paper's tiles, Overlook's
    uint32_t width_px = 0, height_px = 0, tiles_a_side = 0, most_layers = 0;  // most_layers: of the one image, in a pixel
    double cell_m = 0, unseen_share = 0;                                      // of the one image
    std::vector<Picture> pictures;
};

// Every way beside pictures by rays of its own ground: the one image and the paper's tiles of the same, a single tile and
// Overlook's tiles each of their own. Fails as Wood::draw.
Result<Figure2> figure_2(const Subject& subject);

// figure-2.csv: a row a way and distance.
std::string figure_2_csv(const std::string& plants, const Figure2& figure);

}  // namespace overlook::measure::paper::wang
