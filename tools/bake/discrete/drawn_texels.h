// What is drawn of a picture's opaque texels: from below and from above, so that distances of it can be proven.
#pragma once

#include <vector>

#include "formats/result.h"
#include "tools/bake/caveclod/surface_distance.h"
#include "tools/bake/discrete/shape.h"

namespace overlook::discrete {

// A picture as its opacity's threshold sees it.
struct Mask {
    uint32_t width = 0, height = 0;
    std::vector<uint8_t> is_opaque;  // [height, width]
    bool is_all_or_nothing = true;   // no texel is between fully opaque and fully transparent

    bool at(int64_t x, int64_t y) const {
        return x >= 0 && y >= 0 && x < int64_t(width) && y < int64_t(height) && is_opaque[size_t(y) * width + size_t(x)] != 0;
    }
};

struct DrawnTriangle {
    std::array<glm::dvec3, 3> at_m{};
    std::array<glm::dvec2, 3> uv{};
};

// Triangles, which may be flat or a point.
struct DrawnSets {
    std::vector<caveclod::Triangle> least;  // drawn for certain
    std::vector<caveclod::Triangle> most;   // nothing else is
};

// Adds what is drawn of a triangle with a picture, its opacity taken between the four texels round a place. All that lies between
// texels' middles that are opaque is drawn; and where no texel is half opaque and the threshold is half, nothing farther than
// sqrt(1/2) of a texel, along either axis, from the middle of one that is (with a hundredth more for coarse arithmetic of
// renderers; a whole texel for any other picture). Of a triangle whose corners show one place all or nothing is drawn. Of one
// that reaches beyond the middles of the border's texels nothing is for certain, and all may be.
void add_drawn(const Mask& mask, const DrawnTriangle& triangle, DrawnSets& sets);

// The two-sided distance of a thing to what is drawn of another, from below and from above. enough_m: as one_sided_distance.
caveclod::Distance distance_to_drawn(const std::vector<caveclod::Triangle>& thing, const DrawnSets& drawn, double gap,
                                     double floor_m, uint64_t most_steps, double enough_m = 0);

// Its most_m alone, for half the work.
double most_distance_to_drawn(const std::vector<caveclod::Triangle>& thing, const DrawnSets& drawn, double gap, double floor_m,
                              uint64_t most_steps);

// [picture_count] of the chain's last surfaces. Fails with Exit::bad_input where one cannot be read, or as images.h.
Result<std::vector<Mask>> masks_of(const Chain& chain);
// A level's triangles of one part, those of pictures by their texels.
DrawnSets drawn_sets(const Chain& chain, const Level& level, uint32_t part, const std::vector<Mask>& masks);

}  // namespace overlook::discrete
