#include "tools/bake/caveclod/surface_distance.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>

#include "tools/bake/caveclod/distances.h"

namespace overlook::caveclod {
namespace {

constexpr uint32_t kLeafSize = 4;

double distance2_to_box(const glm::dvec3& p, const glm::dvec3& low, const glm::dvec3& high) {
    glm::dvec3 off = glm::max(glm::max(low - p, p - high), glm::dvec3(0));
    return glm::dot(off, off);
}

double distance_m(const glm::dvec3& p, const Triangle& t) {
    return std::sqrt(distance2_to_triangle(p, probe_of(t[0], t[1], t[2])));
}

// A piece of one triangle of `from`.
struct Piece {
    Triangle corners;
    std::array<TriangleTree::Nearest, 3> nearest;  // to each corner
    double most_m = 0;
    bool operator<(const Piece& other) const { return most_m < other.most_m; }
};

// Over the whole piece no point is farther from `to` than from any one triangle of it, and there the farthest is a corner.
double most_of(const Piece& piece, const TriangleTree& to) {
    double most_m = 1e300;
    for (const TriangleTree::Nearest& candidate : piece.nearest) {
        double worst_m = 0;
        for (const glm::dvec3& corner : piece.corners)
            worst_m = std::max(worst_m, distance_m(corner, to.triangle(candidate.triangle)));
        most_m = std::min(most_m, worst_m);
    }
    return most_m;
}

}  // namespace

TriangleTree::TriangleTree(std::span<const Triangle> triangles)
    : triangles_(triangles.begin(), triangles.end()), order_(triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    nodes_.reserve(triangles.size() + 1);
    nodes_.emplace_back();
    if (!triangles.empty()) build(0, 0, uint32_t(triangles.size()));
}

void TriangleTree::build(uint32_t node, uint32_t begin, uint32_t end) {
    glm::dvec3 low(1e300), high(-1e300), middle_low(1e300), middle_high(-1e300);
    auto middle = [&](uint32_t t) { return triangles_[t][0] + triangles_[t][1] + triangles_[t][2]; };
    for (uint32_t i = begin; i < end; ++i) {
        for (const glm::dvec3& p : triangles_[order_[i]]) low = glm::min(low, p), high = glm::max(high, p);
        middle_low = glm::min(middle_low, middle(order_[i])), middle_high = glm::max(middle_high, middle(order_[i]));
    }
    nodes_[node] = {low, high, begin, end - begin};
    if (end - begin <= kLeafSize) return;
    glm::dvec3 size = middle_high - middle_low;
    int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    uint32_t half = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end, [&](uint32_t a, uint32_t b) {
        double at_a = middle(a)[axis], at_b = middle(b)[axis];
        return at_a != at_b ? at_a < at_b : a < b;
    });
    uint32_t child = uint32_t(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    nodes_[node].first = child, nodes_[node].count = 0;
    build(child, begin, half);
    build(child + 1, half, end);
}

TriangleTree::Nearest TriangleTree::nearest(const glm::dvec3& p, double below_m) const {
    Nearest best{0xffffffff, below_m};
    double best2 = below_m < 1e150 ? below_m * below_m : 1e300;
    if (triangles_.empty()) return best;
    std::array<std::pair<double, uint32_t>, 128> pending;
    size_t count = 0;
    pending[count++] = {distance2_to_box(p, nodes_[0].low, nodes_[0].high), 0};
    while (count > 0) {
        auto [away2, index] = pending[--count];
        if (away2 >= best2) continue;
        const Node& node = nodes_[index];
        for (uint32_t i = node.first; i < node.first + node.count; ++i) {
            const Triangle& t = triangles_[order_[i]];
            double distance2 = distance2_to_triangle(p, probe_of(t[0], t[1], t[2]));
            if (distance2 < best2) best2 = distance2, best.triangle = order_[i];
        }
        if (node.count > 0) continue;
        double left2 = distance2_to_box(p, nodes_[node.first].low, nodes_[node.first].high);
        double right2 = distance2_to_box(p, nodes_[node.first + 1].low, nodes_[node.first + 1].high);
        bool left_first = left2 <= right2;
        pending[count++] = left_first ? std::pair{right2, node.first + 1} : std::pair{left2, node.first};
        pending[count++] = left_first ? std::pair{left2, node.first} : std::pair{right2, node.first + 1};
    }
    best.distance_m = std::sqrt(best2);
    return best;
}

Distance one_sided_distance(const TriangleTree& from, const TriangleTree& to, double gap, double floor_m, uint64_t most_steps) {
    if (from.triangles().empty()) return {};
    if (to.triangles().empty()) return {1e300, 1e300};
    Distance found;
    std::priority_queue<Piece> pending;
    auto is_done = [&](double most_m) { return most_m <= found.least_m * (1 + gap) + floor_m; };
    auto push = [&](Piece piece) {
        piece.most_m = most_of(piece, to);
        found.most_m = std::max(found.most_m, std::min(piece.most_m, is_done(piece.most_m) ? piece.most_m : 0));
        if (!is_done(piece.most_m)) pending.push(piece);
    };
    auto reach = [&](const glm::dvec3& p) {
        TriangleTree::Nearest nearest = to.nearest(p);
        found.least_m = std::max(found.least_m, nearest.distance_m);
        return nearest;
    };
    for (const Triangle& t : from.triangles()) push({t, {reach(t[0]), reach(t[1]), reach(t[2])}, 0});
    uint64_t steps = 0;
    for (; !pending.empty() && !is_done(pending.top().most_m) && steps < most_steps; ++steps) {
        Piece piece = pending.top();
        pending.pop();
        int longest = 0;
        for (int c = 1; c < 3; ++c)
            if (glm::distance(piece.corners[c], piece.corners[(c + 1) % 3]) >
                glm::distance(piece.corners[longest], piece.corners[(longest + 1) % 3]))
                longest = c;
        int other = (longest + 1) % 3;
        glm::dvec3 middle = (piece.corners[longest] + piece.corners[other]) * 0.5;
        TriangleTree::Nearest nearest = reach(middle);
        for (int replaced : {longest, other}) {
            Piece half = piece;
            half.corners[replaced] = middle, half.nearest[replaced] = nearest;
            push(half);
        }
    }
    if (!pending.empty()) found.most_m = std::max(found.most_m, pending.top().most_m);
    found.most_m = std::max(found.most_m, found.least_m);
    return found;
}

Distance two_sided_distance(const TriangleTree& a, const TriangleTree& b, double gap, double floor_m, uint64_t most_steps) {
    Distance there = one_sided_distance(a, b, gap, floor_m, most_steps),
             back = one_sided_distance(b, a, gap, floor_m, most_steps);
    return {std::max(there.least_m, back.least_m), std::max(there.most_m, back.most_m)};
}

}  // namespace overlook::caveclod
