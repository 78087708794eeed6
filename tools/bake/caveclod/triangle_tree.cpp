// Looking for triangles in a tree of them.
#include <algorithm>
#include <cmath>

#include "tools/bake/caveclod/triangle_tree.h"

namespace overlook::caveclod {
namespace {

constexpr size_t kMostPending = 128;
constexpr double kTie = 1e-6;
constexpr double kBoxRounding = 1e-6;  // several times what float32 may take from a coordinate or a distance

template <class Comparison>
inline bool is_any(const Comparison& c) {
    return (c[0] | c[1] | c[2]) != 0;
}

// Of one whose normal has length 1, or 0: then 0.
inline double distance2_to_plane(const glm::dvec3& p, const TriangleProbe& t) {
    double height = glm::dot(p - t.a, t.normal);
    return height * height * t.inverse_normal2;
}

}  // namespace

// What is looked at round a point: all boxes in its reach, and some beyond by no more than rounding.
struct TriangleTree::Ball {
    Lanes middle;
    double rounding_m = 0;  // of the middle, and of what is computed with it
    double limit2 = 0;
    float box_limit2 = 0;

    Ball(const glm::dvec3& p, double limit_m)
        : middle(lanes_of(glm::vec3(p))), rounding_m(kBoxRounding * std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)})) {
        shrink(limit_m);
    }
    void shrink(double limit_m) {
        limit2 = limit_m * limit_m;
        double reach_m = (limit_m + rounding_m) * (1 + kBoxRounding);
        box_limit2 = float(std::min(reach_m * reach_m, 1e37));
    }
    float away2(const Node& node) const {
        Lanes below = node.low - middle, above = middle - node.high, zero = {0, 0, 0, 0};
        Lanes off = below > above ? below : above;
        off = off > zero ? off : zero;
        off = off * off;
        return off[0] + off[1] + off[2];
    }
    bool reaches(const TriangleProbe& t, const glm::dvec3& p) const { return distance2_to_plane(p, t) <= limit2; }
};

// Nearer children first. `take` is called with each triangle (its place in the leaves) whose node and plane are in the ball, and
// its squared distance; it may shrink the ball.
template <class Take>
void TriangleTree::visit_near(const glm::dvec3& p, const Ball& ball, const Take& take) const {
    std::array<std::pair<float, uint32_t>, kMostPending> pending;
    size_t count = 0;
    if (!triangles_.empty()) pending[count++] = {ball.away2(nodes_[0]), 0};
    while (count > 0) {
        auto [node_away2, index] = pending[--count];
        if (node_away2 > ball.box_limit2) continue;
        const Node& node = nodes_[index];
        for (uint32_t i = node.first; i < node.first + node.count; ++i)
            if (ball.reaches(probes_[i], p)) take(i, distance2_to_triangle(p, probes_[i]));
        if (node.count > 0) continue;
        std::pair<float, uint32_t> near{ball.away2(nodes_[node.first]), node.first};
        std::pair<float, uint32_t> far{ball.away2(nodes_[node.first + 1]), node.first + 1};
        if (far.first < near.first) std::swap(near, far);
        if (far.first <= ball.box_limit2) pending[count++] = far;
        if (near.first <= ball.box_limit2) pending[count++] = near;
    }
}

TriangleTree::Nearest TriangleTree::nearest(const glm::dvec3& p, double below_m) const {
    Nearest best{0xffffffff, below_m};
    double best2 = below_m < 1e150 ? below_m * below_m : 1e300;
    Ball ball(p, std::sqrt(best2));
    visit_near(p, ball, [&](uint32_t place, double distance2) {
        if (distance2 >= best2) return;
        best2 = distance2, best.triangle = order_[place];
        ball.shrink(std::sqrt(best2));
    });
    best.distance_m = std::sqrt(best2);
    return best;
}

double TriangleTree::facing_within(const glm::dvec3& p, const glm::dvec3& direction, double limit_m) const {
    Ball ball(p, limit_m);
    double best = -2;
    visit_near(p, ball, [&](uint32_t place, double distance2) {
        if (distance2 <= ball.limit2) best = std::max(best, glm::dot(probes_[place].normal, direction));
    });
    return best < -1.5 ? 0 : best;
}

double TriangleTree::facing_of_nearest(const glm::dvec3& p, const glm::dvec3& direction, double slack_m, uint32_t& guess) const {
    constexpr size_t kMostFound = 64;
    std::array<std::pair<double, uint32_t>, kMostFound> found;  // all within the ball, and some that were before it shrank
    size_t count = 0;
    bool is_complete = true;
    double best2 = guess == 0xffffffff ? 1e300 : distance2_to_triangle(p, probes_[place_[guess]]);
    auto limit_m = [&] { return std::sqrt(best2) * (1 + kTie) + slack_m; };
    Ball ball(p, limit_m());
    visit_near(p, ball, [&](uint32_t place, double distance2) {
        if (distance2 < best2) best2 = distance2, guess = order_[place], ball.shrink(limit_m());
        if (distance2 > ball.limit2) return;
        auto is_out = [&](const auto& f) { return f.first > ball.limit2; };
        if (count == kMostFound) count = size_t(std::remove_if(found.begin(), found.end(), is_out) - found.begin());
        is_complete &= count < kMostFound;
        if (is_complete) found[count++] = {distance2, place};
    });
    if (!is_complete) return facing_within(p, direction, limit_m());
    double best = -2;
    for (size_t i = 0; i < count; ++i)
        if (found[i].first <= ball.limit2) best = std::max(best, glm::dot(probes_[found[i].second].normal, direction));
    return best < -1.5 ? 0 : best;
}

bool TriangleTree::nearest_face(const glm::dvec3& p, const glm::dvec3& direction, double slack_m, uint32_t triangle) const {
    Ball ball(p, std::sqrt(distance2_to_triangle(p, probes_[place_[triangle]])) * (1 + kTie) + slack_m);
    std::array<uint32_t, kMostPending> pending;
    size_t count = 0;
    glm::vec3 ahead(direction);
    pending[count++] = 0;
    while (count > 0) {
        const Node& node = nodes_[pending[--count]];
        if (ball.away2(node) > ball.box_limit2 || glm::dot(node.axis, ahead) > node.sine) continue;
        for (uint32_t i = node.first; i < node.first + node.count; ++i)
            if (!(glm::dot(probes_[i].normal, direction) > 0) && ball.reaches(probes_[i], p) &&
                distance2_to_triangle(p, probes_[i]) <= ball.limit2)
                return false;
        if (node.count == 0) pending[count++] = node.first, pending[count++] = node.first + 1;
    }
    return true;
}

bool TriangleTree::all_face(const glm::vec3& low, const glm::vec3& high, std::span<const glm::vec3> directions) const {
    std::array<uint32_t, kMostPending> pending;
    size_t count = 0;
    Lanes lowest = lanes_of(low), highest = lanes_of(high);
    if (!triangles_.empty()) pending[count++] = 0;
    while (count > 0) {
        const Node& node = nodes_[pending[--count]];
        if (is_any(node.high < lowest) || is_any(highest < node.low)) continue;
        auto is_within = [&](const glm::vec3& d) { return glm::dot(node.axis, d) > node.sine; };
        if (std::all_of(directions.begin(), directions.end(), is_within)) continue;
        if (node.count > 0) return false;
        pending[count++] = node.first, pending[count++] = node.first + 1;
    }
    return true;
}

}  // namespace overlook::caveclod
