// Making a tree of triangles.
#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/bake/caveclod/triangle_tree.h"

namespace overlook::caveclod {
namespace {

constexpr uint32_t kLeafSize = 2;
constexpr size_t kBins = 12;
constexpr uint32_t kDeepest = 60;  // below, splits are by count: no list of pending nodes overflows
// Sines and cosines are kept as float; a bound must not miss by their rounding.
constexpr float kSineSlack = 1e-5f;
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

Lanes low_of(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return lanes_of(rounded_down(glm::min(glm::min(a, b), c)));
}

Lanes high_of(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return -lanes_of(rounded_down(-glm::max(glm::max(a, b), c)));
}

struct Box {
    Lanes low = lanes_of(glm::vec3(1e30f)), high = lanes_of(glm::vec3(-1e30f));
    void add(const Lanes& l, const Lanes& h) { low = l < low ? l : low, high = h > high ? h : high; }
    float area() const {
        Lanes size = high - low;
        return size[0] < 0 ? 0 : size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
    }
};

// The best of the planes between bins of the items' middles, along the axis where these reach farthest; 0 if none parts them.
template <class Item>
struct Bins {
    size_t axis = 0;
    float low = 0, scale = 0;
    size_t plane = 0;  // items in bins below it go left

    explicit Bins(std::span<const Item> items) {
        Box middles;
        for (const Item& item : items) middles.add(item.low + item.high, item.low + item.high);
        Lanes size = middles.high - middles.low;
        axis = size[0] >= size[1] && size[0] >= size[2] ? 0 : size[1] >= size[2] ? 1 : 2;
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
        for (const Item& item : items) {
            size_t bin = bin_of(item);
            boxes[bin].add(item.low, item.high), ++counts[bin];
        }
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
        items.push_back({low_of(t[0], t[1], t[2]), high_of(t[0], t[1], t[2]), i});
    }
    order_.resize(triangles.size()), place_.resize(triangles.size()), probes_.resize(triangles.size());
    nodes_.reserve(2 * triangles.size() + 1);
    nodes_.emplace_back();
    if (!items.empty()) build(0, items, 0, 0);
}

void TriangleTree::build(uint32_t node, std::span<Item> items, uint32_t begin, uint32_t depth) {
    if (items.size() <= kLeafSize) {
        for (uint32_t i = 0; i < items.size(); ++i) put(begin + i, items[i].triangle);
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

void TriangleTree::put(uint32_t place, uint32_t triangle) {
    const Triangle& t = triangles_[triangle];
    order_[place] = triangle, place_[triangle] = place;
    glm::dvec3 normal = unit_normal(t);
    probes_[place] = {t[0], t[1], t[2], normal, normal == glm::dvec3(0) ? 0.0 : 1.0};
}

void TriangleTree::fit_leaf(Node& node) const {
    glm::dvec3 sum(0);
    Box box;
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
        const TriangleProbe& t = probes_[i];
        box.add(low_of(t.a, t.b, t.c), high_of(t.a, t.b, t.c));
        sum += t.normal;
    }
    node.low = box.low, node.high = box.high;
    double length = glm::length(sum), least = 1;
    if (!(length > 0)) return;
    for (uint32_t i = node.first; i < node.first + node.count; ++i)
        least = std::min(least, glm::dot(probes_[i].normal, sum) / length);
    node.axis = glm::vec3(sum / length);
    if (least > 0) node.sine = float(std::sqrt(std::max(0.0, 1 - least * least))) + kSineSlack;
}

void TriangleTree::fit_parent(Node& node) const {
    const Node &a = nodes_[node.first], &b = nodes_[node.first + 1];
    node.low = a.low < b.low ? a.low : b.low, node.high = a.high > b.high ? a.high : b.high;
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

}  // namespace overlook::caveclod
