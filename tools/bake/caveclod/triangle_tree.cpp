#include "tools/bake/caveclod/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/bake/caveclod/distances.h"

namespace overlook::caveclod {
namespace {

constexpr uint32_t kLeafSize = 4;
constexpr size_t kMostPending = 128;
constexpr size_t kBins = 12;
constexpr uint32_t kDeepest = 60;  // below, splits are by count: no list of pending nodes overflows
// Sines and cosines are kept as float; a bound must not miss by their rounding.
constexpr float kSineSlack = 1e-5f;
constexpr double kTie = 1e-6;

double distance2_to_box(const glm::dvec3& p, const glm::vec3& low, const glm::vec3& high) {
    glm::dvec3 off = glm::max(glm::max(glm::dvec3(low) - p, p - glm::dvec3(high)), glm::dvec3(0));
    return glm::dot(off, off);
}

double distance2_to(const glm::dvec3& p, const Triangle& t) {
    return distance2_to_triangle(p, probe_of(t[0], t[1], t[2]));
}

glm::dvec3 unit_normal(const Triangle& t) {
    glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    double length = glm::length(normal);
    return length > 0 ? normal / length : glm::dvec3(0);
}

glm::vec3 rounded_down(const glm::dvec3& p) {
    glm::vec3 r(p);
    for (glm::length_t a = 0; a < 3; ++a)
        if (double(r[a]) > p[a]) r[a] = std::nextafter(r[a], -std::numeric_limits<float>::infinity());
    return r;
}

glm::vec3 rounded_up(const glm::dvec3& p) {
    return -rounded_down(-p);
}

struct Box {
    glm::vec3 low{1e30f}, high{-1e30f};
    void add(const glm::vec3& l, const glm::vec3& h) { low = glm::min(low, l), high = glm::max(high, h); }
    float area() const {
        glm::vec3 size = high - low;
        return size.x < 0 ? 0 : size.x * size.y + size.y * size.z + size.z * size.x;
    }
};

// The best of the planes between bins of the items' middles, along the axis where these reach farthest; 0 if none parts them.
template <class Item>
struct Bins {
    glm::length_t axis = 0;
    float low = 0, scale = 0;
    size_t plane = 0;  // items in bins below it go left

    explicit Bins(std::span<const Item> items) {
        Box middles;
        for (const Item& item : items) middles.add(item.low + item.high, item.low + item.high);
        glm::vec3 size = middles.high - middles.low;
        axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        low = middles.low[axis];
        scale = size[axis] > 0 ? float(kBins) * 0.9999f / size[axis] : 0;
        if (scale > 0 && std::isfinite(scale)) choose(items);
    }
    size_t bin_of(const Item& item) const {
        return std::min(kBins - 1, size_t((item.low[axis] + item.high[axis] - low) * scale));
    }
    void choose(std::span<const Item> items) {
        std::array<Box, kBins> boxes;
        std::array<size_t, kBins> counts{};
        for (const Item& item : items) boxes[bin_of(item)].add(item.low, item.high), ++counts[bin_of(item)];
        std::array<float, kBins> right_cost{};
        Box grown;
        size_t count = 0;
        for (size_t b = kBins - 1; b > 0; --b) {
            grown.add(boxes[b].low, boxes[b].high), count += counts[b];
            right_cost[b] = grown.area() * float(count);
        }
        grown = {}, count = 0;
        float least = std::numeric_limits<float>::max();
        for (size_t b = 1; b < kBins; ++b) {
            grown.add(boxes[b - 1].low, boxes[b - 1].high), count += counts[b - 1];
            float cost = grown.area() * float(count) + right_cost[b];
            if (count > 0 && count < items.size() && cost < least) least = cost, plane = b;
        }
    }
};

}  // namespace

TriangleTree::TriangleTree(std::span<const Triangle> triangles) : triangles_(triangles.begin(), triangles.end()) {
    std::vector<Item> items;
    items.reserve(triangles.size());
    for (uint32_t i = 0; i < triangles.size(); ++i) {
        const Triangle& t = triangles[i];
        items.push_back({rounded_down(glm::min(glm::min(t[0], t[1]), t[2])), rounded_up(glm::max(glm::max(t[0], t[1]), t[2])), i});
    }
    order_.resize(triangles.size());
    nodes_.reserve(triangles.size() + 1);
    nodes_.emplace_back();
    if (!items.empty()) build(0, items, 0, 0);
}

void TriangleTree::build(uint32_t node, std::span<Item> items, uint32_t begin, uint32_t depth) {
    if (items.size() <= kLeafSize) {
        for (size_t i = 0; i < items.size(); ++i) order_[begin + i] = items[i].triangle;
        nodes_[node].first = begin, nodes_[node].count = uint32_t(items.size());
        return fit_leaf(nodes_[node]);
    }
    size_t half = 0;
    if (depth < kDeepest) {
        Bins<Item> bins(items);
        auto is_left = [&](const Item& item) { return bins.bin_of(item) < bins.plane; };
        if (bins.plane > 0) half = size_t(std::partition(items.begin(), items.end(), is_left) - items.begin());
    }
    if (half == 0) half = items.size() / 2;
    uint32_t child = uint32_t(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    nodes_[node].first = child;
    build(child, items.first(half), begin, depth + 1);
    build(child + 1, items.subspan(half), begin + uint32_t(half), depth + 1);
    fit_parent(nodes_[node]);
}

void TriangleTree::fit_leaf(Node& node) const {
    std::array<glm::dvec3, kLeafSize> normals;
    glm::dvec3 sum(0);
    for (uint32_t i = 0; i < node.count; ++i) {
        const Triangle& t = triangles_[order_[node.first + i]];
        glm::dvec3 low = glm::min(glm::min(t[0], t[1]), t[2]), high = glm::max(glm::max(t[0], t[1]), t[2]);
        node.low = glm::min(node.low, rounded_down(low)), node.high = glm::max(node.high, rounded_up(high));
        normals[i] = unit_normal(t);
        sum += normals[i];
    }
    double length = glm::length(sum), least = 1;
    if (!(length > 0)) return;
    for (uint32_t i = 0; i < node.count; ++i) least = std::min(least, glm::dot(normals[i], sum) / length);
    node.axis = glm::vec3(sum / length);
    if (least > 0) node.sine = float(std::sqrt(std::max(0.0, 1 - least * least))) + kSineSlack;
}

void TriangleTree::fit_parent(Node& node) const {
    const Node &a = nodes_[node.first], &b = nodes_[node.first + 1];
    node.low = glm::min(a.low, b.low), node.high = glm::max(a.high, b.high);
    if (a.sine >= 1 || b.sine >= 1) return;
    glm::vec3 sum = a.axis + b.axis;
    float length = glm::length(sum);
    if (!(length > 0)) return;
    node.axis = sum / length;
    auto angle = [&](const Node& child) {
        return std::acos(std::clamp(glm::dot(node.axis, child.axis), -1.0f, 1.0f)) + std::asin(child.sine);
    };
    float widest = std::max(angle(a), angle(b));
    if (widest < 1.57f) node.sine = std::sin(widest) + kSineSlack;
}

TriangleTree::Nearest TriangleTree::nearest(const glm::dvec3& p, double below_m) const {
    Nearest best{0xffffffff, below_m};
    double best2 = below_m < 1e150 ? below_m * below_m : 1e300;
    std::array<std::pair<double, uint32_t>, kMostPending> pending;
    size_t count = 0;
    auto away2 = [&](uint32_t node) { return distance2_to_box(p, nodes_[node].low, nodes_[node].high); };
    if (!triangles_.empty()) pending[count++] = {away2(0), 0};
    while (count > 0) {
        auto [node_away2, index] = pending[--count];
        if (node_away2 >= best2) continue;
        const Node& node = nodes_[index];
        for (uint32_t i = node.first; i < node.first + node.count; ++i) {
            double distance2 = distance2_to(p, triangles_[order_[i]]);
            if (distance2 < best2) best2 = distance2, best.triangle = order_[i];
        }
        if (node.count > 0) continue;
        std::pair<double, uint32_t> left{away2(node.first), node.first}, right{away2(node.first + 1), node.first + 1};
        pending[count++] = std::max(left, right);
        pending[count++] = std::min(left, right);
    }
    best.distance_m = std::sqrt(best2);
    return best;
}

double TriangleTree::facing_of_nearest(const glm::dvec3& p, const glm::dvec3& direction, double slack_m) const {
    double limit_m = nearest(p).distance_m * (1 + kTie) + slack_m, best = -2;
    std::array<uint32_t, kMostPending> pending;
    size_t count = 0;
    if (!triangles_.empty()) pending[count++] = 0;
    while (count > 0) {
        const Node& node = nodes_[pending[--count]];
        if (distance2_to_box(p, node.low, node.high) > limit_m * limit_m) continue;
        for (uint32_t i = node.first; i < node.first + node.count; ++i) {
            const Triangle& t = triangles_[order_[i]];
            if (distance2_to(p, t) <= limit_m * limit_m) best = std::max(best, glm::dot(unit_normal(t), direction));
        }
        if (node.count == 0) pending[count++] = node.first, pending[count++] = node.first + 1;
    }
    return best < -1.5 ? 0 : best;
}

bool TriangleTree::all_face(const glm::vec3& low, const glm::vec3& high, std::span<const glm::vec3> directions) const {
    std::array<uint32_t, kMostPending> pending;
    size_t count = 0;
    if (!triangles_.empty()) pending[count++] = 0;
    while (count > 0) {
        const Node& node = nodes_[pending[--count]];
        if (glm::any(glm::lessThan(node.high, low)) || glm::any(glm::lessThan(high, node.low))) continue;
        auto is_within = [&](const glm::vec3& d) { return glm::dot(node.axis, d) > node.sine; };
        if (std::all_of(directions.begin(), directions.end(), is_within)) continue;
        if (node.count > 0) return false;
        pending[count++] = node.first, pending[count++] = node.first + 1;
    }
    return true;
}

}  // namespace overlook::caveclod
