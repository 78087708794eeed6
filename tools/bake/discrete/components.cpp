#include "tools/bake/discrete/components.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "tools/bake/caveclod/disjoint_sets.h"

namespace overlook::discrete {
namespace {

constexpr double kSmall = 8;  // times the distance

struct Component {
    std::vector<uint32_t> faces;
    glm::dvec3 low_m{1e300}, high_m{-1e300};
    double area_m2 = 0;
    bool is_gone = false;

    double size_m() const { return glm::length(high_m - low_m); }
};

caveclod::Triangle triangle_of(const Shape& shape, uint32_t face) {
    const auto& [a, b, c] = shape.faces[face];
    return {shape.vertices[a].at_m, shape.vertices[b].at_m, shape.vertices[c].at_m};
}

// Faces that share a place hang together.
std::vector<Component> components_of(const Shape& shape) {
    std::map<std::array<double, 3>, uint32_t> at;
    std::vector<uint32_t> place(shape.vertices.size());
    for (uint32_t v = 0; v < place.size(); ++v) {
        const glm::dvec3& p = shape.vertices[v].at_m;
        place[v] = at.try_emplace({p.x, p.y, p.z}, v).first->second;
    }
    caveclod::DisjointSets sets(place.size());
    for (const auto& [a, b, c] : shape.faces) sets.unite(place[a], place[b]), sets.unite(place[a], place[c]);
    std::map<uint32_t, uint32_t> number;
    std::vector<Component> components;
    for (uint32_t f = 0; f < shape.faces.size(); ++f) {
        uint32_t own = number.try_emplace(sets.find(place[shape.faces[f][0]]), uint32_t(number.size())).first->second;
        if (own == components.size()) components.emplace_back();
        Component& component = components[own];
        component.faces.push_back(f);
        caveclod::Triangle t = triangle_of(shape, f);
        for (const glm::dvec3& p : t)
            component.low_m = glm::min(component.low_m, p), component.high_m = glm::max(component.high_m, p);
        component.area_m2 += glm::length(glm::cross(t[1] - t[0], t[2] - t[0])) / 2;
    }
    return components;
}

// Over a triangle the distance to any one other is greatest at a corner.
double distance_m(const Shape& shape, const Component& component, const caveclod::TriangleTree& to, double enough_m) {
    double most_m = 0;
    for (uint32_t f : component.faces) {
        caveclod::Triangle t = triangle_of(shape, f);
        const caveclod::Triangle& near = to.triangle(to.nearest((t[0] + t[1] + t[2]) / 3.0).triangle);
        caveclod::TriangleProbe probe = caveclod::probe_of(near[0], near[1], near[2]);
        for (const glm::dvec3& p : t) most_m = std::max(most_m, std::sqrt(caveclod::distance2_to_triangle(p, probe)));
        if (most_m > enough_m) break;
    }
    return most_m;
}

Shape rest_of(const Shape& shape, const std::vector<Component>& components) {
    std::vector<uint8_t> is_gone(shape.faces.size(), 0);
    for (const Component& component : components)
        for (uint32_t f : component.faces) is_gone[f] = component.is_gone;
    return shape.without(is_gone);
}

}  // namespace

WithoutComponents without_small_components(const Shape& shape, const Shape& beside, double limit_m) {
    WithoutComponents without;
    std::vector<Component> components = components_of(shape);
    auto largest = std::max_element(components.begin(), components.end(),
                                    [](const Component& a, const Component& b) { return a.area_m2 < b.area_m2; });
    std::vector<caveclod::Triangle> staying = beside.triangles();
    std::vector<Component*> small;
    for (Component& component : components) {
        if (component.size_m() <= kSmall * limit_m && &component != &*largest) {
            small.push_back(&component);
            continue;
        }
        for (uint32_t f : component.faces) staying.push_back(triangle_of(shape, f));
    }
    if (small.empty() || staying.empty()) {
        without.shape = shape;
        return without;
    }
    caveclod::TriangleTree tree(staying);
    for (Component* component : small) {
        double off_m = distance_m(shape, *component, tree, limit_m);
        component->is_gone = off_m <= limit_m;
        if (!component->is_gone) continue;
        without.distance_m = std::max(without.distance_m, off_m);
        without.lost_m2 += component->area_m2;
        ++without.lost_count;
    }
    without.shape = rest_of(shape, components);
    return without;
}

}  // namespace overlook::discrete
