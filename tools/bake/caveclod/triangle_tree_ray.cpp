// Looking along a ray for the triangle that it leaves through.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tools/bake/caveclod/triangle_tree.h"

namespace overlook::caveclod {
namespace {

constexpr size_t kMostPending = 128;
constexpr double kNever = std::numeric_limits<double>::infinity();
// Cosine to its plane below which a ray runs along a triangle rather than through it.
constexpr double kGlancing = 1e-6;

// Where it enters a box that is larger by the slack on all sides, or kNever.
double enters(const TriangleTree::Ray& ray, const Lanes& lowest, const Lanes& highest) {
    double begin = 0, end = kNever;
    for (int a = 0; a < 3; ++a) {
        double low = double(lowest[a]) - ray.slack_m - ray.from[a], high = double(highest[a]) + ray.slack_m - ray.from[a];
        if (ray.direction[a] == 0) {
            if (low > 0 || high < 0) return kNever;
            continue;
        }
        double one = low / ray.direction[a], other = high / ray.direction[a];
        begin = std::max(begin, std::min(one, other)), end = std::min(end, std::max(one, other));
    }
    return begin <= end ? begin : kNever;
}

// Where it leaves through a triangle, or kNever.
double leaves(const TriangleTree::Ray& ray, const TriangleProbe& t) {
    double cosine = glm::dot(ray.direction, t.normal);
    if (!(cosine > kGlancing)) return kNever;
    double away_m = glm::dot(t.a - ray.from, t.normal) / cosine;
    if (!(away_m > ray.slack_m)) return kNever;
    return distance2_to_triangle(ray.from + ray.direction * away_m, t) <= ray.slack_m * ray.slack_m ? away_m : kNever;
}

}  // namespace

TriangleTree::Nearest TriangleTree::ahead(const Ray& ray) const {
    Nearest best{0xffffffff, ray.below_m};
    std::array<std::pair<double, uint32_t>, kMostPending> pending;
    size_t count = 0;
    auto push = [&](std::pair<double, uint32_t> node) {
        if (node.first <= best.distance_m) pending[count++] = node;
    };
    if (!triangles_.empty()) push({enters(ray, nodes_[0].low, nodes_[0].high), 0});
    while (count > 0) {
        auto [entered_m, index] = pending[--count];
        if (entered_m > best.distance_m) continue;
        const Node& node = nodes_[index];
        for (uint32_t i = node.first; i < node.first + node.count; ++i) {
            Nearest found{order_[i], leaves(ray, probes_[i])};
            bool is_tie = found.distance_m == best.distance_m && found.triangle < best.triangle;
            if (found.distance_m < best.distance_m || is_tie) best = found;
        }
        if (node.count > 0) continue;
        const Node &one = nodes_[node.first], &other = nodes_[node.first + 1];
        std::pair<double, uint32_t> near{enters(ray, one.low, one.high), node.first},
            far{enters(ray, other.low, other.high), node.first + 1};
        if (far.first < near.first) std::swap(near, far);
        push(far), push(near);
    }
    return best;
}

}  // namespace overlook::caveclod
