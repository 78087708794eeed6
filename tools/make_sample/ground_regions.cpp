#include "tools/make_sample/ground_regions.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace overlook::sample {
namespace {

struct Regions {
    std::vector<uint32_t> of;                  // [F]
    std::vector<std::vector<uint32_t>> faces;  // of each region
};

Regions find_regions(const MeshGrid& grid, std::span<const uint32_t> surface) {
    constexpr uint32_t kNone = 0xffffffff;
    Regions regions{std::vector<uint32_t>(surface.size(), kNone), {}};
    for (uint32_t first = 0; first < surface.size(); ++first) {
        if (regions.of[first] != kNone) continue;
        uint32_t region = uint32_t(regions.faces.size());
        std::vector<uint32_t> open = {first};
        regions.of[first] = region;
        for (size_t i = 0; i < open.size(); ++i)
            for (int64_t other : faces_beside(grid, open[i])) {
                if (other < 0 || regions.of[size_t(other)] != kNone || surface[size_t(other)] != surface[first]) continue;
                regions.of[size_t(other)] = region;
                open.push_back(uint32_t(other));
            }
        regions.faces.push_back(std::move(open));
    }
    return regions;
}

uint32_t ground_bordered_most(const MeshGrid& grid, std::span<const uint32_t> faces, std::span<const uint32_t> surface) {
    std::map<uint32_t, uint32_t> edges;
    for (uint32_t face : faces)
        for (int64_t other : faces_beside(grid, face))
            if (other >= 0 && surface[size_t(other)] != surface[face]) ++edges[surface[size_t(other)]];
    auto most = std::max_element(edges.begin(), edges.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == edges.end() ? surface[faces.front()] : most->first;
}

// The faces round a position within a number of cells, as offsets from the first face of the cell south-east of it, and which of
// n sectors each lies in: sectors are equal shares of the six faces at the position itself, followed outward along the grid's
// three directions.
struct Rosette {
    std::vector<int64_t> offsets;
    std::vector<uint32_t> sectors;
};

// Which of the six faces at the position points towards (x, y) in cells east and south of it: between the directions of the
// grid's edges, east, south-east (a diagonal), south, west, north-west, north.
uint32_t sixth_towards(double x, double y) {
    if (x >= 0 && y >= 0) return y <= x ? 0 : 1;
    if (x < 0 && y >= 0) return 2;
    if (x < 0) return y >= x ? 3 : 4;
    return 5;
}

Rosette rosette(const MeshGrid& grid, double radius, size_t sector_count) {
    Rosette made;
    int reach = int(radius) + 1;
    for (int dy = -reach; dy < reach; ++dy)
        for (int dx = -reach; dx < reach; ++dx)
            for (int half = 0; half < 2; ++half) {
                double x = dx + (half == 0 ? 1.0 : 2.0) / 3, y = dy + (half == 0 ? 2.0 : 1.0) / 3;
                if (x * x + y * y > radius * radius) continue;
                made.offsets.push_back(2 * (int64_t(dy) * (grid.columns - 1) + dx) + half);
                made.sectors.push_back(uint32_t(sixth_towards(x, y) * sector_count / 6));
            }
    return made;
}

}  // namespace

void drop_islands(const MeshGrid& grid, uint32_t least_count, std::vector<uint32_t>& surface) {
    for (bool has_changed = true; has_changed;) {
        has_changed = false;
        Regions regions = find_regions(grid, surface);
        std::vector<uint32_t> order(regions.faces.size());
        std::iota(order.begin(), order.end(), 0u);
        std::stable_sort(order.begin(), order.end(),
                         [&](uint32_t a, uint32_t b) { return regions.faces[a].size() < regions.faces[b].size(); });
        std::set<uint32_t> is_stale;  // regions beside one that changed: looked at again in the next round
        for (uint32_t region : order) {
            const std::vector<uint32_t>& faces = regions.faces[region];
            if (faces.size() >= least_count) break;
            if (is_stale.count(region)) continue;
            uint32_t next = ground_bordered_most(grid, faces, surface);
            if (next == surface[faces.front()]) continue;
            for (uint32_t face : faces) {
                surface[face] = next;
                for (int64_t other : faces_beside(grid, face))
                    if (other >= 0) is_stale.insert(regions.of[size_t(other)]);
            }
            has_changed = true;
        }
    }
}

uint32_t make_meeting(const MeshGrid& grid, std::span<const uint32_t> surfaces, double radius_cells, uint32_t first_row,
                      std::vector<uint32_t>& surface) {
    uint32_t margin = uint32_t(3 * radius_cells) + 2, best_column = margin, best_row = margin;
    Rosette round = rosette(grid, radius_cells, surfaces.size());
    auto first_face = [&](uint32_t column, uint32_t row) { return 2 * (int64_t(row) * (grid.columns - 1) + column); };
    size_t best_kept = 0;
    for (uint32_t row = std::max(margin, first_row); row + margin < grid.rows; ++row)
        for (uint32_t column = margin; column + margin < grid.columns; ++column) {
            const uint32_t* here = &surface[size_t(first_face(column, row))];
            size_t kept = 0;
            for (size_t i = 0; i < round.offsets.size(); ++i) kept += here[round.offsets[i]] == surfaces[round.sectors[i]];
            if (kept <= best_kept) continue;
            best_kept = kept;
            best_column = column;
            best_row = row;
        }
    for (size_t i = 0; i < round.offsets.size(); ++i)
        surface[size_t(first_face(best_column, best_row) + round.offsets[i])] = surfaces[round.sectors[i]];
    return grid.index(best_column, best_row);
}

}  // namespace overlook::sample
