#include "tools/measure/honesty/nearest_point.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "runtime/view/nearest_in_triangle.h"

namespace overlook::measure {
namespace {

constexpr uint32_t kLeaf = 4;

double squared(const glm::dvec3& v) {
    return glm::dot(v, v);
}

double box_distance_squared(const glm::dvec3& place, const glm::dvec3& low, const glm::dvec3& high) {
    return squared(place - glm::clamp(place, low, high));
}

}  // namespace

NearestPoint::NearestPoint(std::span<const glm::dvec3> corners_m) : corners_m_(corners_m.begin(), corners_m.end()) {
    order_.resize(corners_m.size() / 3);
    std::iota(order_.begin(), order_.end(), 0u);
    nodes_.reserve(order_.size());
    nodes_.emplace_back();
    build(0, 0, uint32_t(order_.size()));
}

void NearestPoint::build(uint32_t node, uint32_t begin, uint32_t end) {
    constexpr double kFar = std::numeric_limits<double>::max();
    glm::dvec3 low(kFar), high(-kFar), middle_low(kFar), middle_high(-kFar);
    auto middle_of = [&](uint32_t triangle) {
        return (corners_m_[3 * size_t(triangle)] + corners_m_[3 * size_t(triangle) + 1] + corners_m_[3 * size_t(triangle) + 2]) /
               3.0;
    };
    for (uint32_t i = begin; i < end; ++i) {
        for (size_t k = 0; k < 3; ++k) {
            const glm::dvec3& corner = corners_m_[3 * size_t(order_[i]) + k];
            low = glm::min(low, corner), high = glm::max(high, corner);
        }
        glm::dvec3 middle = middle_of(order_[i]);
        middle_low = glm::min(middle_low, middle), middle_high = glm::max(middle_high, middle);
    }
    nodes_[node].low = low, nodes_[node].high = high;
    if (end - begin <= kLeaf) {
        nodes_[node].first = begin, nodes_[node].count = end - begin;
        return;
    }
    glm::dvec3 size = middle_high - middle_low;
    int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    uint32_t half = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end, [&](uint32_t a, uint32_t b) {
        double at_a = middle_of(a)[axis], at_b = middle_of(b)[axis];
        return at_a != at_b ? at_a < at_b : a < b;
    });
    uint32_t children = uint32_t(nodes_.size());
    nodes_[node].first = children, nodes_[node].count = 0;
    nodes_.resize(nodes_.size() + 2);
    build(children, begin, half);
    build(children + 1, half, end);
}

glm::dvec3 NearestPoint::operator()(const glm::dvec3& place_m) const {
    glm::dvec3 best = corners_m_[3 * size_t(order_[0])];
    double least = squared(best - place_m);
    std::array<std::pair<double, uint32_t>, 128> stack;
    size_t height = 0;
    stack[height++] = {0, 0};
    while (height > 0) {
        auto [distance, index] = stack[--height];
        if (distance >= least) continue;
        const Node& node = nodes_[index];
        for (uint32_t i = node.first; i < node.first + node.count; ++i) {
            const glm::dvec3* corner = &corners_m_[3 * size_t(order_[i])];
            glm::dvec3 at = view::nearest_in_triangle(place_m, corner[0], corner[1], corner[2]);
            double away = squared(at - place_m);
            if (away < least) least = away, best = at;
        }
        if (node.count > 0) continue;
        std::pair<double, uint32_t> one{0, node.first}, other{0, node.first + 1};
        for (auto* child : {&one, &other}) {
            child->first = box_distance_squared(place_m, nodes_[child->second].low, nodes_[child->second].high);
        }
        if (one.first < other.first) std::swap(one, other);
        stack[height++] = one;
        stack[height++] = other;  // the nearer first
    }
    return best;
}

}  // namespace overlook::measure
