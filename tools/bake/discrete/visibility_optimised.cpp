#include "tools/bake/discrete/visibility_optimised.h"

#include <algorithm>
#include <cmath>

#include "formats/parallel.h"
#include "tools/bake/discrete/volume.h"

namespace overlook::discrete {
namespace {

constexpr uint32_t kCells = 48;
constexpr size_t kPoints = 1 << 16;
// Where the levels lie on each other there is still a change of shading: so much of what a place in the open changes by.
constexpr double kShadingShare = 0.15;

// What points of one level tell the cells they are in.
struct Cells {
    std::vector<double> area_m2, off_m3;  // sums: area, and area times the distance to the other level
};

void add_points(const Chain& chain, const Level& of, const Level& other, const VolumeFrame& frame, Cells& cells) {
    std::vector<SurfacePoint> points = surface_points(chain, of, kPoints);
    caveclod::TriangleTree tree(triangles_of(chain, other));
    std::vector<double> off_m(points.size());
    parallel_ranges(points.size(), 1024, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) off_m[i] = tree.nearest(points[i].at_m).distance_m;
    });
    for (size_t i = 0; i < points.size(); ++i) {
        size_t cell = frame.cell_of(points[i].at_m);
        cells.area_m2[cell] += points[i].area_m2;
        cells.off_m3[cell] += points[i].area_m2 * off_m[i];
    }
}

}  // namespace

Visibility optimised_visibility(const Chain& chain, size_t fine) {
    VolumeFrame frame = frame_of(chain, kCells);
    size_t count = size_t(kCells) * kCells * kCells;
    Cells cells{std::vector<double>(count, 0), std::vector<double>(count, 0)};
    const Level &a = chain.levels[fine], &b = chain.levels[fine + 1];
    add_points(chain, a, b, frame, cells);
    add_points(chain, b, a, frame, cells);

    double cell_m = frame.side_m / kCells;
    glm::dvec3 middle_m = frame.origin_m + glm::dvec3(frame.side_m / 2);
    std::vector<double> order(count, std::nan("")), weight(count, 0);
    for (size_t cell = 0; cell < count; ++cell) {
        if (cells.area_m2[cell] <= 0) continue;
        double off_m = cells.off_m3[cell] / cells.area_m2[cell];
        weight[cell] = cells.area_m2[cell] * (kShadingShare + std::min(1.0, off_m / (cell_m / 2)));
        // Where nothing stands out the order follows the place, so that neighbours come together.
        double place = glm::distance(frame.middle_m(cell), middle_m) / frame.side_m;
        order[cell] = off_m + 0.05 * cell_m * place;
    }
    return volume_by_order(frame, std::move(order), weight);
}

}  // namespace overlook::discrete
