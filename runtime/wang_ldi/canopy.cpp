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
// Of a model, from the lowest up, and what all up to each take together.
struct Leaves {
    std::vector<double> heights_m, sums_m2;

    explicit Leaves(std::vector<Leaf> all) {
        std::sort(all.begin(), all.end(), [](const Leaf& a, const Leaf& b) {
            return a.height_m < b.height_m || (a.height_m == b.height_m && a.shade_m2 < b.shade_m2);
        });
        double sum_m2 = 0;
        for (const Leaf& leaf : all) heights_m.push_back(leaf.height_m), sums_m2.push_back(sum_m2 += leaf.shade_m2);
    }
    double up_to_m2(double height_m) const {
        auto above = size_t(std::upper_bound(heights_m.begin(), heights_m.end(), height_m) - heights_m.begin());
        return above == 0 ? 0 : sums_m2[above - 1];
    }
};
constexpr double kLowestSun = 1e-3;  // what of to_sun goes up; a lower one is taken as that low

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

double top_of(const Planting& planting, std::span<const Leaves> leaves) {
    double top_m = 0;
    for (const auto& tile : planting.tiles)
        for (const Planted& object : tile)
            if (const Leaves& own = leaves[object.model]; !own.heights_m.empty())
                top_m = std::max(top_m, own.heights_m.back() * double(object.scale));
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
    std::vector<Leaves> leaves;
    for (const discrete::Chain& chain : chains) leaves.emplace_back(leaves_of(chain));
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
        for (const Planted& object : tile) {
            const Leaves& own = leaves[object.model];
            double scale = double(object.scale), step_m = canopy.top_m / (kCanopySteps - 1) / scale, below_layer_m2 = 0;
            for (size_t layer = 0; layer < kCanopySteps; ++layer) {
                double up_m = layer + 1 < kCanopySteps ? (double(layer) + 0.5) * step_m : INFINITY;
                double sum_m2 = own.up_to_m2(up_m);
                shade[layer] += (sum_m2 - below_layer_m2) * scale * scale / ground_m2;
                below_layer_m2 = sum_m2;
            }
        }
    double above = 0;
    for (size_t layer = kCanopySteps; layer-- > 0;) {
        double here = above + shade[layer] / 2;
        canopy.open[layer] = {std::exp(-here / std::max(to_sun.z, kLowestSun)), sky_through(here)};
        above += shade[layer];
    }
    return canopy;
}

}  // namespace overlook::wang_ldi
