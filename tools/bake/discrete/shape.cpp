#include "tools/bake/discrete/shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace overlook::discrete {
namespace {

caveclod::Triangle triangle_of(const Shape& shape, size_t face) {
    const auto& [a, b, c] = shape.faces[face];
    return {shape.vertices[a].at_m, shape.vertices[b].at_m, shape.vertices[c].at_m};
}

std::vector<caveclod::Triangle> triangles_if(const Chain& chain, const Level& level, const auto& takes) {
    std::vector<caveclod::Triangle> triangles;
    for (size_t i = 0; i < level.indices.size(); i += 3) {
        caveclod::Triangle triangle;
        for (size_t c = 0; c < 3; ++c) triangle[c] = position_m(chain, level.vertices[level.indices[i + c]]);
        if (takes(level.vertices[level.indices[i]].part)) triangles.push_back(triangle);
    }
    return triangles;
}

// A sphere about `pivot` that holds the part at rest turns into itself: what a part reaches is its pivot's way, and that radius.
double reach_m(const Chain& chain, const Part& part, double radius_m) {
    double most_m = 0;
    for (const Pose& pose : part.poses)
        most_m = std::max(most_m, glm::distance(glm::dvec3(part.pivot_m) + glm::dvec3(pose.move_m), chain.middle_m));
    return most_m + radius_m;
}

}  // namespace

Shape Shape::without(std::span<const uint8_t> is_gone) const {
    Shape rest;
    std::vector<uint32_t> number(vertices.size(), ~0u);
    for (size_t f = 0; f < faces.size(); ++f) {
        if (is_gone[f] != 0) continue;
        std::array<uint32_t, 3> face{};
        for (size_t c = 0; c < 3; ++c) {
            uint32_t v = faces[f][c];
            if (number[v] == ~0u) number[v] = uint32_t(rest.vertices.size()), rest.vertices.push_back(vertices[v]);
            face[c] = number[v];
        }
        rest.faces.push_back(face);
        rest.face_surface.push_back(face_surface[f]);
    }
    return rest;
}

void Shape::add(const Shape& other) {
    auto first = uint32_t(vertices.size());
    vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const auto& [a, b, c] : other.faces) faces.push_back({first + a, first + b, first + c});
    face_surface.insert(face_surface.end(), other.face_surface.begin(), other.face_surface.end());
}

std::vector<caveclod::Triangle> Shape::triangles_of(uint32_t part) const {
    std::vector<caveclod::Triangle> triangles;
    for (size_t f = 0; f < faces.size(); ++f)
        if (vertices[faces[f][0]].part == part) triangles.push_back(triangle_of(*this, f));
    return triangles;
}

std::vector<caveclod::Triangle> Shape::triangles() const {
    std::vector<caveclod::Triangle> triangles;
    for (size_t f = 0; f < faces.size(); ++f) triangles.push_back(triangle_of(*this, f));
    return triangles;
}

double Shape::area_m2() const {
    double area_m2 = 0;
    for (size_t f = 0; f < faces.size(); ++f) {
        caveclod::Triangle t = triangle_of(*this, f);
        area_m2 += glm::length(glm::cross(t[1] - t[0], t[2] - t[0])) / 2;
    }
    return area_m2;
}

Grid grid_of(std::span<const Shape> shapes) {
    glm::dvec3 low(1e300), high(-1e300);
    glm::dvec2 uv_low(1e300), uv_high(-1e300);
    for (const Shape& shape : shapes)
        for (const ShapeVertex& v : shape.vertices) {
            low = glm::min(low, v.at_m), high = glm::max(high, v.at_m);
            uv_low = glm::min(uv_low, glm::dvec2(v.uv)), uv_high = glm::max(uv_high, glm::dvec2(v.uv));
        }
    constexpr double kSteps = 65535;
    glm::dvec3 size = high - low;
    glm::dvec2 uv_size = uv_high - uv_low;
    // A hair wider than it must be, so that rounding never leads out of the steps.
    auto step = [&](double wide) { return wide > 0 ? wide / kSteps * (1 + 1e-9) : 1; };
    return {low, step(std::max({size.x, size.y, size.z})), uv_low, step(std::max(uv_size.x, uv_size.y))};
}

std::vector<caveclod::Triangle> triangles_of(const Chain& chain, const Level& level, uint32_t part) {
    return triangles_if(chain, level, [&](uint32_t of) { return of == part; });
}
std::vector<caveclod::Triangle> triangles_of(const Chain& chain, const Level& level) {
    return triangles_if(chain, level, [](uint32_t) { return true; });
}

float rounded_up(double value) {
    auto rounded = float(value);
    return double(rounded) >= value ? rounded : std::nextafter(rounded, std::numeric_limits<float>::infinity());
}

void fit_sphere(Chain& chain) {
    glm::dvec3 low(1e300), high(-1e300);
    for (const Level& level : chain.levels)
        for (const Vertex& v : level.vertices) {
            glm::dvec3 at_m = position_m(chain, v);
            low = glm::min(low, at_m), high = glm::max(high, at_m);
        }
    chain.middle_m = (low + high) / 2.0;
    std::vector<double> from_pivot_m(chain.parts.size(), 0);
    double most_m = 0;
    for (const Level& level : chain.levels)
        for (const Vertex& v : level.vertices) {
            glm::dvec3 at_m = position_m(chain, v);
            const Part& part = chain.parts[v.part];
            double& radius_m = from_pivot_m[v.part];
            radius_m = std::max(radius_m, glm::distance(at_m, glm::dvec3(part.pivot_m)));
            if (part.at_s.empty()) most_m = std::max(most_m, glm::distance(at_m, chain.middle_m));
        }
    for (size_t p = 0; p < chain.parts.size(); ++p)
        if (!chain.parts[p].at_s.empty()) most_m = std::max(most_m, reach_m(chain, chain.parts[p], from_pivot_m[p]));
    chain.radius_m = most_m * (1 + 1e-6) + 1e-9;
}

}  // namespace overlook::discrete
