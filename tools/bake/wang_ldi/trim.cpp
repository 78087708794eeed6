#include "tools/bake/wang_ldi/trim.h"

#include <algorithm>
#include <cmath>

#include "formats/steady_math.h"

namespace overlook::wang_ldi {
namespace {

constexpr double kSlack_px = 0.01, kLeastGain = 0.05, kMostTexels = 1 << 22, kLeastArea_px2 = 1e-6;
constexpr int kSides = 8;

// A corner of what is left of a triangle.
struct Corner {
    glm::dvec2 at_px;    // in the picture, which repeats
    glm::dvec3 weights;  // of the triangle's corners
};
using Polygon = std::vector<Corner>;

// The part of a polygon with dot(along, at) <= most.
Polygon clipped(const Polygon& polygon, const glm::dvec2& along, double most) {
    Polygon kept;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const Corner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        double over_a = glm::dot(along, a.at_px) - most, over_b = glm::dot(along, b.at_px) - most;
        if (over_a <= 0) kept.push_back(a);
        if ((over_a < 0 && over_b > 0) || (over_a > 0 && over_b < 0)) {
            double t = over_a / (over_a - over_b);
            kept.push_back({a.at_px + t * (b.at_px - a.at_px), a.weights + t * (b.weights - a.weights)});
        }
    }
    return kept;
}

double area_of(const Polygon& polygon) {
    double sum = 0;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 &a = polygon[i].at_px, &b = polygon[(i + 1) % polygon.size()].at_px;
        sum += a.x * b.y - b.x * a.y;
    }
    return std::abs(sum) / 2;
}

// What of a picture a triangle shows.
struct Shown {
    bool has_solid = false, has_holes = false;
    std::array<double, kSides> most;  // of the solid texels' corners along each direction

    Shown() { most.fill(-INFINITY); }
};

glm::dvec2 direction(int side) {
    double angle = 2 * M_PI * side / kSides;
    steady::SinCos at = steady::sin_cos(angle);
    return {at.cos, at.sin};
}

void add_texel(Shown& shown, double column, double row) {
    for (int side = 0; side < kSides; ++side)
        for (int corner = 0; corner < 4; ++corner) {
            glm::dvec2 at(column + ((corner & 1) ? 1 + kSlack_px : -kSlack_px),
                          row + ((corner & 2) ? 1 + kSlack_px : -kSlack_px));
            shown.most[size_t(side)] = std::max(shown.most[size_t(side)], glm::dot(direction(side), at));
        }
}

// Of a row of texels, from and to where the triangle may be over it.
glm::dvec2 span_of_row(const Polygon& triangle, double row) {
    Polygon band = clipped(clipped(triangle, {0, 1}, row + 1 + kSlack_px), {0, -1}, kSlack_px - row);
    glm::dvec2 span(INFINITY, -INFINITY);
    for (const Corner& corner : band)
        span = {std::min(span.x, corner.at_px.x - kSlack_px), std::max(span.y, corner.at_px.x + kSlack_px)};
    return span;
}

Shown shown_of(const Polygon& triangle, const rays::Mask& mask, double first_row, double last_row) {
    Shown shown;
    auto is_solid = [&](double column, double row) {
        auto wrapped = [](double at, uint32_t count) { return size_t(at - std::floor(at / count) * count); };
        return mask.opacity[wrapped(row, mask.height_px) * mask.width_px + wrapped(column, mask.width_px)] >= mask.least;
    };
    for (double row = first_row; row <= last_row; ++row) {
        glm::dvec2 span = span_of_row(triangle, row);
        if (span.x > span.y) continue;
        double first = INFINITY, last = -INFINITY;
        for (double column = std::floor(span.x); column <= std::floor(span.y); ++column) {
            bool solid = is_solid(column, row);
            shown.has_holes |= !solid;
            if (solid) first = std::min(first, column), last = column;
        }
        if (last < first) continue;
        shown.has_solid = true;
        add_texel(shown, first, row), add_texel(shown, last, row);  // those between lie within their outline
    }
    return shown;
}

class Trimmer {
  public:
    Trimmer(rays::Mesh& mesh, Skin& skin) : mesh_(mesh), skin_(skin), old_(mesh), old_skin_(skin) {}
    TrimReport run();

  private:
    void trim(uint32_t triangle);
    void keep(uint32_t triangle, uint32_t mask);
    void add_polygon(uint32_t triangle, const Polygon& polygon);
    void add_corners(uint32_t triangle, const std::array<Corner, 3>& corners, const std::array<uint32_t, 3>& positions);
    double area_m2(uint32_t triangle) const;

    rays::Mesh& mesh_;
    Skin& skin_;
    const rays::Mesh old_;
    const Skin old_skin_;
    TrimReport report_;
};

double Trimmer::area_m2(uint32_t triangle) const {
    const auto& corners = old_.triangles[triangle];
    glm::dvec3 a(old_.positions_m[corners[0]]), b(old_.positions_m[corners[1]]), c(old_.positions_m[corners[2]]);
    return glm::length(glm::cross(b - a, c - a)) / 2;
}

void Trimmer::keep(uint32_t triangle, uint32_t mask) {
    mesh_.triangles.push_back(old_.triangles[triangle]), mesh_.uvs.push_back(old_.uvs[triangle]);
    mesh_.masks_of.push_back(mask);
    if (!old_skin_.normals.empty()) skin_.normals.push_back(old_skin_.normals[triangle]);
    if (!old_skin_.colours.empty()) skin_.colours.push_back(old_skin_.colours[triangle]);
    if (!old_skin_.looks_of.empty()) skin_.looks_of.push_back(old_skin_.looks_of[triangle]);
}

void Trimmer::add_corners(uint32_t triangle, const std::array<Corner, 3>& corners, const std::array<uint32_t, 3>& positions) {
    keep(triangle, old_.masks_of[triangle]);
    mesh_.triangles.back() = positions;
    for (size_t c = 0; c < 3; ++c) {
        glm::dvec2 uv(0);
        for (int old = 0; old < 3; ++old) uv += corners[c].weights[old] * glm::dvec2(old_.uvs[triangle][size_t(old)]);
        mesh_.uvs.back()[c] = glm::vec2(uv);
        if (old_skin_.normals.empty()) continue;
        glm::dvec3 normal(0);
        for (int old = 0; old < 3; ++old)
            normal += corners[c].weights[old] * glm::dvec3(old_skin_.normals[triangle][size_t(old)]);
        double length = glm::length(normal);
        if (length > 1e-6) skin_.normals.back()[c] = glm::vec3(normal / length);
    }
}

void Trimmer::add_polygon(uint32_t triangle, const Polygon& polygon) {
    auto first = uint32_t(mesh_.positions_m.size());
    for (const Corner& corner : polygon) {
        glm::dvec3 at(0);
        for (int old = 0; old < 3; ++old)
            at += corner.weights[old] * glm::dvec3(old_.positions_m[old_.triangles[triangle][size_t(old)]]);
        mesh_.positions_m.push_back(glm::vec3(at));
    }
    for (uint32_t i = 1; i + 1 < polygon.size(); ++i) {
        add_corners(triangle, {polygon[0], polygon[i], polygon[i + 1]}, {first, first + i, first + i + 1});
        ++report_.masked_after;
    }
}

void Trimmer::trim(uint32_t triangle) {
    const rays::Mask& mask = old_.masks[old_.masks_of[triangle]];
    glm::dvec2 size(mask.width_px, mask.height_px), low(INFINITY), high(-INFINITY);
    Polygon whole;
    for (int c = 0; c < 3; ++c) {
        whole.push_back({glm::dvec2(old_.uvs[triangle][size_t(c)]) * size, glm::dvec3(c == 0, c == 1, c == 2)});
        low = glm::min(low, whole.back().at_px), high = glm::max(high, whole.back().at_px);
    }
    double area = area_of(whole), area_m = area_m2(triangle);
    ++report_.masked_before, report_.area_before_m2 += area_m;
    auto keep_whole = [&] { keep(triangle, old_.masks_of[triangle]), ++report_.masked_after, report_.area_after_m2 += area_m; };
    glm::dvec2 span = high - low;
    bool has_bounds = std::isfinite(area) && std::max(std::abs(low.x), std::abs(high.x)) < 1e9 &&
                      std::max(std::abs(low.y), std::abs(high.y)) < 1e9 && (span.x + 2) * (span.y + 2) <= kMostTexels;
    bool has_colours = !old_skin_.colours.empty() && (old_skin_.colours[triangle][0] != old_skin_.colours[triangle][1] ||
                                                      old_skin_.colours[triangle][0] != old_skin_.colours[triangle][2]);
    if (!has_bounds || has_colours || area < kLeastArea_px2) return keep_whole();

    Shown shown = shown_of(whole, mask, std::floor(low.y - kSlack_px), std::floor(high.y + kSlack_px));
    if (!shown.has_solid) return;
    if (!shown.has_holes) return keep(triangle, rays::kNone), void(++report_.solid);
    Polygon left = whole;
    for (int side = 0; side < kSides; ++side) left = clipped(left, direction(side), shown.most[size_t(side)]);
    double left_area = area_of(left);
    if (left.size() < 3) return;  // its solid texels lie beside it
    if (left_area > (1 - kLeastGain) * area) return keep_whole();
    report_.area_after_m2 += area_m * left_area / area;
    add_polygon(triangle, left);
}

TrimReport Trimmer::run() {
    mesh_.triangles.clear(), mesh_.uvs.clear(), mesh_.masks_of.clear();
    skin_.normals.clear(), skin_.colours.clear(), skin_.looks_of.clear();
    for (uint32_t t = 0; t < old_.triangles.size(); ++t) {
        if (old_.masks_of[t] == rays::kNone)
            keep(t, rays::kNone);
        else
            trim(t);
    }
    if (mesh_.triangles.empty() && !old_.triangles.empty()) keep(0, old_.masks_of[0]);
    return report_;
}

}  // namespace

void TrimReport::add(const TrimReport& other) {
    masked_before += other.masked_before, masked_after += other.masked_after, solid += other.solid;
    area_before_m2 += other.area_before_m2, area_after_m2 += other.area_after_m2;
}

TrimReport trim_to_masks(rays::Mesh& mesh, Skin& skin) {
    if (mesh.masks_of.empty() || mesh.uvs.empty()) return {};
    return Trimmer(mesh, skin).run();
}

}  // namespace overlook::wang_ldi
