#include "tools/bake/discrete/volume.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace overlook::discrete {
namespace {

// Evenly spread pairs (M. Roberts, The Unreasonable Effectiveness of Quasirandom Sequences, 2018), folded into a triangle.
glm::dvec2 spread_in_triangle(size_t i) {
    double u = std::fmod(0.5 + 0.7548776662466927 * double(i), 1.0), v = std::fmod(0.5 + 0.5698402909980532 * double(i), 1.0);
    return u + v > 1 ? glm::dvec2(1 - u, 1 - v) : glm::dvec2(u, v);
}

constexpr std::array<std::array<int, 3>, 6> kNeighbours{{{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

// Mean of the neighbours that have a value, for each cell that has none, ring by ring.
void fill(const VolumeFrame& frame, std::vector<double>& value) {
    auto n = int64_t(frame.cells);
    bool has_gaps = std::any_of(value.begin(), value.end(), [](double v) { return std::isnan(v); });
    while (has_gaps) {
        std::vector<double> next = value;
        has_gaps = false;
        bool has_grown = false;
        for (int64_t cell = 0; cell < n * n * n; ++cell) {
            if (!std::isnan(value[size_t(cell)])) continue;
            int64_t x = cell % n, y = cell / n % n, z = cell / (n * n);
            double sum = 0;
            int count = 0;
            for (const auto& [dx, dy, dz] : kNeighbours) {
                int64_t a = x + dx, b = y + dy, c = z + dz;
                if (std::min({a, b, c}) < 0 || std::max({a, b, c}) >= n) continue;
                double neighbour = value[size_t((c * n + b) * n + a)];
                if (!std::isnan(neighbour)) sum += neighbour, ++count;
            }
            if (count > 0) next[size_t(cell)] = sum / count, has_grown = true;
            has_gaps = has_gaps || count == 0;
        }
        value = std::move(next);
        if (!has_grown) break;  // nothing has a value
    }
}

}  // namespace

std::vector<SurfacePoint> surface_points(const Chain& chain, const Level& level, size_t count) {
    std::vector<caveclod::Triangle> triangles = triangles_of(chain, level);
    auto area = [](const caveclod::Triangle& t) { return glm::length(glm::cross(t[1] - t[0], t[2] - t[0])) / 2; };
    double all_m2 = 0;
    for (const caveclod::Triangle& t : triangles) all_m2 += area(t);
    std::vector<SurfacePoint> points;
    if (!(all_m2 > 0)) return points;
    double owed = 0.5;
    for (const caveclod::Triangle& t : triangles) {
        double area_m2 = area(t);
        owed += area_m2 / all_m2 * double(count);
        auto n = size_t(owed);
        owed -= double(n);
        for (size_t i = 0; i < n; ++i) {
            glm::dvec2 at = n == 1 ? glm::dvec2(1.0 / 3) : spread_in_triangle(i);
            points.push_back({t[0] + at.x * (t[1] - t[0]) + at.y * (t[2] - t[0]), all_m2 / double(count)});
        }
    }
    return points;
}

size_t VolumeFrame::cell_of(const glm::dvec3& at_m) const {
    glm::dvec3 share = (at_m - origin_m) / side_m * double(cells);
    auto at = [&](double s) { return size_t(std::clamp(s, 0.0, double(cells - 1))); };
    return (at(share.z) * cells + at(share.y)) * cells + at(share.x);
}

glm::dvec3 VolumeFrame::middle_m(size_t cell) const {
    glm::dvec3 at(double(cell % cells), double(cell / cells % cells), double(cell / cells / cells));
    return origin_m + (at + 0.5) * (side_m / double(cells));
}

VolumeFrame frame_of(const Chain& chain, uint32_t cells) {
    std::array<uint16_t, 3> most{};
    for (const Level& level : chain.levels)
        for (const Vertex& v : level.vertices)
            for (size_t axis = 0; axis < 3; ++axis) most[axis] = std::max(most[axis], v.position[axis]);
    uint16_t longest = std::max({most[0], most[1], most[2], uint16_t(1)});
    return {chain.origin_m, chain.position_step_m * longest, cells};
}

Visibility volume_by_order(const VolumeFrame& frame, std::vector<double> order, const std::vector<double>& weight) {
    std::vector<uint32_t> cells;
    for (uint32_t cell = 0; cell < order.size(); ++cell)
        if (!std::isnan(order[cell])) cells.push_back(cell);
    std::stable_sort(cells.begin(), cells.end(), [&](uint32_t a, uint32_t b) { return order[a] < order[b]; });
    double all = 0, before = 0;
    for (uint32_t cell : cells) all += weight[cell];
    std::vector<double> value(order.size(), std::nan(""));
    for (uint32_t cell : cells) {
        value[cell] = 255 * (all > 0 ? (before + weight[cell] / 2) / all : 0.5);
        before += weight[cell];
    }
    fill(frame, value);
    Visibility visibility{Visibility::Lookup::volume, frame.cells, frame.cells, frame.cells, float(frame.side_m), {}};
    for (double v : value) visibility.values.push_back(std::isnan(v) ? 128 : uint8_t(std::clamp(std::round(v), 0.0, 255.0)));
    return visibility;
}

}  // namespace overlook::discrete
