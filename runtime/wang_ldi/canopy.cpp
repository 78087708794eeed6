#include "runtime/wang_ldi/canopy.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace overlook::wang_ldi {
namespace {

constexpr int kAngles = 64;

// A triangle: what it takes of light, whichever way it is turned, and how high its middle is.
struct Leaf {
    double height_m, shade_m2;
};

// Of a leaf that hangs at random half of its area is seen; of what is closed, half of that half lies behind the rest.
std::vector<Leaf> leaves_of(const discrete::Chain& chain) {
    std::vector<Leaf> leaves;
    const discrete::Level& level = chain.levels.front();
    for (const discrete::Draw& draw : level.draws) {
        double share = chain.surfaces[draw.surface].is_two_sided ? 0.5 : 0.25;
        for (uint32_t i = draw.first_index; i + 2 < draw.first_index + draw.index_count; i += 3) {
            std::array<glm::dvec3, 3> at;
            for (uint32_t c = 0; c < 3; ++c) at[c] = discrete::position_m(chain, level.vertices[level.indices[i + c]]);
            double area_m2 = glm::length(glm::cross(at[1] - at[0], at[2] - at[0])) / 2;
            leaves.push_back({(at[0].z + at[1].z + at[2].z) / 3, share * area_m2});
        }
    }
    return leaves;
}

double top_of(const Planting& planting, std::span<const std::vector<Leaf>> leaves) {
    double top_m = 0;
    for (const auto& tile : planting.tiles)
        for (const Planted& object : tile)
            for (const Leaf& leaf : leaves[object.model]) top_m = std::max(top_m, leaf.height_m * double(object.scale));
    return top_m;
}

// Of the whole sky, by the cosine of its directions, through leaves that take `shade` of a ray straight up.
double sky_through(double shade) {
    double sum = 0, weights = 0;
    for (int n = 0; n < kAngles; ++n) {
        double up = (n + 0.5) / kAngles;
        sum += up * std::exp(-shade / up), weights += up;
    }
    return sum / weights;
}

}  // namespace

Canopy canopy_of(const Planting& planting, std::span<const discrete::Chain> chains, const glm::dvec3& to_sun) {
    std::vector<std::vector<Leaf>> leaves;
    for (const discrete::Chain& chain : chains) leaves.push_back(leaves_of(chain));
    Canopy canopy;
    canopy.open.fill(glm::vec2(1));
    canopy.top_m = top_of(planting, leaves);
    if (canopy.top_m <= 0) return canopy;
    // Shade of each layer, then of all layers above it.
    std::array<double, kCanopySteps> shade{};
    double ground_m2 = double(planting.tiles.size()) * planting.tile_size_m * planting.tile_size_m, below_m2 = 0;
    for (const auto& tile : planting.tiles)
        for (const Planted& object : tile) {
            double radius_m = double(planting.models[object.model].tight_radius_m) * double(object.scale);
            below_m2 += M_PI * radius_m * radius_m;
        }
    if (below_m2 > 0) ground_m2 = std::min(ground_m2, below_m2);
    for (const auto& tile : planting.tiles)
        for (const Planted& object : tile)
            for (const Leaf& leaf : leaves[object.model]) {
                double place = leaf.height_m * double(object.scale) / canopy.top_m * (kCanopySteps - 1);
                auto layer = size_t(std::clamp(std::round(place), 0.0, double(kCanopySteps - 1)));
                shade[layer] += leaf.shade_m2 * double(object.scale) * double(object.scale) / ground_m2;
            }
    double above = 0;
    for (size_t layer = kCanopySteps; layer-- > 0;) {
        double here = above + shade[layer] / 2;
        canopy.open[layer] = {std::exp(-here / to_sun.z), sky_through(here)};
        above += shade[layer];
    }
    return canopy;
}

}  // namespace overlook::wang_ldi
