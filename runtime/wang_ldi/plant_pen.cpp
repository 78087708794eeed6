#include "runtime/wang_ldi/plant_pen.h"

#include <algorithm>
#include <cmath>

namespace overlook::wang_ldi {
namespace {

// Of a triangle that is cut: as Eye::seen, and what changes evenly along it.
struct CutCorner {
    glm::vec3 seen{0};
    std::array<float, 2> uv{};
    Four colour{};
};
// Its corners, and up to five more.
struct Polygon {
    std::array<CutCorner, 8> corners;
    int count = 0;
};

// From a corner that is seen to one that is not, so that both triangles of an edge are cut at the same place.
CutCorner between(const CutCorner& in, const CutCorner& out, float in_side, float out_side) {
    float share = in_side / (in_side - out_side);
    CutCorner made;
    made.seen = in.seen + share * (out.seen - in.seen);
    for (size_t k = 0; k < 2; ++k) made.uv[k] = in.uv[k] + share * (out.uv[k] - in.uv[k]);
    made.colour = in.colour + share * (out.colour - in.colour);
    return made;
}

template <class Side>
Polygon cut(const Polygon& from, const Side& side) {
    Polygon made;
    for (int k = 0; k < from.count; ++k) {
        const CutCorner &one = from.corners[size_t(k)], &next = from.corners[size_t((k + 1) % from.count)];
        float here = side(one.seen), there = side(next.seen);
        if (here >= 0) made.corners[size_t(made.count++)] = one;
        if (here >= 0 && there < 0) made.corners[size_t(made.count++)] = between(one, next, here, there);
        if (here < 0 && there >= 0) made.corners[size_t(made.count++)] = between(next, one, there, here);
    }
    return made;
}

inline Four four(const glm::vec3& v, float last) {
    return Four{v.x, v.y, v.z, last};
}

}  // namespace

void PlantPen::stand(const discrete::Placement& placement) {
    cosine_ = float(placement.cosine), sine_ = float(placement.sine), scale_ = float(placement.scale);
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 own(0);
        own[axis] = 1;
        turn_[axis] = eye_.seen(placement.turned(own));
    }
    foot_ = eye_.seen(placement.translation_m - eye_.position_m);
}

// All vertices of a level.
void PlantPen::place(const ShapeLevel& level) {
    size_t count = level.x_m.size();
    if (x_.size() < count) x_.resize(count), y_.resize(count), nearness_.resize(count), behind_.resize(count), lit_.resize(count);
    is_lit_.assign(count, 0);
    const float *x_m = level.x_m.data(), *y_m = level.y_m.data(), *z_m = level.z_m.data();
    glm::mat3 turn = turn_;
    glm::vec3 foot = foot_;
    glm::vec2 middle = eye_.middle_px, size = eye_.middle_px * 2.0f;
    float near_m = eye_.near_m;
    int32_t *out_x = x_.data(), *out_y = y_.data();
    float* nearness = nearness_.data();
    uint8_t* behind = behind_.data();
    for (size_t v = 0; v < count; ++v) {
        float right = turn[0].x * x_m[v] + turn[1].x * y_m[v] + turn[2].x * z_m[v] + foot.x;
        float up = turn[0].y * x_m[v] + turn[1].y * y_m[v] + turn[2].y * z_m[v] + foot.y;
        float depth = turn[0].z * x_m[v] + turn[1].z * y_m[v] + turn[2].z * z_m[v] + foot.z;
        bool is_near = !(depth >= near_m);
        nearness[v] = 1 / (is_near ? 1.0f : depth);
        right *= nearness[v], up *= nearness[v];
        bool is_far = !(std::abs(right) <= kFarthest_px) | !(std::abs(up) <= kFarthest_px) | is_near;
        float x = middle.x + (is_far ? 0.0f : right), y = middle.y - (is_far ? 0.0f : up);
        float fx = x * kCornerSteps + 0.5f, fy = y * kCornerSteps + 0.5f;
        auto ix = int32_t(fx), iy = int32_t(fy);
        out_x[v] = ix - (float(ix) > fx), out_y[v] = iy - (float(iy) > fy);
        unsigned sides =
            unsigned(x < 0) * kLeft + unsigned(x > size.x) * kRight + unsigned(y < 0) * kAbove + unsigned(y > size.y) * kBelow;
        behind[v] = uint8_t(is_near ? unsigned(kNear) : is_far ? unsigned(kFar) : sides);
    }
}

void PlantPen::draw(const PlantShape& shape, const PlantList& list, const discrete::Item& item, Canvas& canvas) {
    const ShapeLevel& level = shape.levels[item.level];
    fill_.begin(canvas, list.is_fading ? float(item.share) : 1);
    stand(list.places.placements[item.instance]);
    place(level);
    if (item.run_count == 0)
        for (const discrete::Draw& draw : level.draws)
            draw_run(level, shape.skins[draw.surface], draw.first_index, draw.index_count);
    for (uint32_t r = item.first_run; r < item.first_run + item.run_count; ++r) {
        const discrete::TriangleRun& run = list.listed.frame.runs[r];
        const discrete::Draw& draw = level.draws[run.draw];
        draw_run(level, shape.skins[draw.surface], draw.first_index + run.first_index, run.index_count);
    }
}

void PlantPen::draw_run(const ShapeLevel& level, const Skin& skin, uint32_t first_index, uint32_t index_count) {
    for (uint32_t i = first_index; i < first_index + index_count; i += 3) {
        const uint32_t* corners = level.indices.data() + i;
        uint8_t a = behind_[corners[0]], b = behind_[corners[1]], c = behind_[corners[2]];
        if (a & b & c) continue;
        if ((a | b | c) & (kNear | kFar))
            draw_cut(level, skin, i);
        else
            draw_triangle(level, skin, i);
    }
}

void PlantPen::draw_triangle(const ShapeLevel& level, const Skin& skin, uint32_t index) {
    const uint32_t* v = level.indices.data() + index;
    PixelBox box = fill_.box_of(x_[v[0]], y_[v[0]], x_[v[1]], y_[v[1]], x_[v[2]], y_[v[2]]);
    if (box.is_empty()) return;
    Filled triangle;
    for (size_t k = 0; k < 3; ++k) {
        const auto& uv = level.uvs[v[k]];
        triangle.corners[k] = Corner{x_[v[k]], y_[v[k]], nearness_[v[k]], uv[0], uv[1]};
    }
    triangle.area = area_of(triangle.corners[0], triangle.corners[1], triangle.corners[2]);
    if (triangle.area == 0) return;
    bool sees_front = triangle.area < 0;  // downwards turns the other way
    if (sees_front) std::swap(triangle.corners[1], triangle.corners[2]), triangle.area = -triangle.area;
    fill_.draw(skin, triangle, box, [&](Filled& filled) {
        int second = sees_front ? 2 : 1;
        filled.corners[0].colour = colour(level, skin, index, 0, sees_front);
        filled.corners[1].colour = colour(level, skin, index, second, sees_front);
        filled.corners[2].colour = colour(level, skin, index, 3 - second, sees_front);
    });
}

// One that reaches behind the eye, or far beyond the picture.
void PlantPen::draw_cut(const ShapeLevel& level, const Skin& skin, uint32_t index) {
    const uint32_t* v = level.indices.data() + index;
    Polygon polygon;
    polygon.count = 3;
    for (size_t k = 0; k < 3; ++k) polygon.corners[k] = CutCorner{seen(level, v[k]), level.uvs[v[k]]};
    auto& at = polygon.corners;
    bool sees_front = glm::dot(at[0].seen, glm::cross(at[1].seen, at[2].seen)) > 0;
    for (int k = 0; k < 3; ++k) at[size_t(k)].colour = colour(level, skin, index, k, sees_front);
    float near_m = eye_.near_m;
    polygon = cut(polygon, [&](const glm::vec3& p) { return p.z - near_m; });
    polygon = cut(polygon, [](const glm::vec3& p) { return kFarthest_px * p.z - p.x; });
    polygon = cut(polygon, [](const glm::vec3& p) { return kFarthest_px * p.z + p.x; });
    polygon = cut(polygon, [](const glm::vec3& p) { return kFarthest_px * p.z - p.y; });
    polygon = cut(polygon, [](const glm::vec3& p) { return kFarthest_px * p.z + p.y; });
    auto corner = [&](int k) {
        const CutCorner& from = polygon.corners[size_t(k)];
        Corner made = corner_at(from.seen, from.uv);
        made.colour = from.colour;
        return made;
    };
    for (int k = 2; k < polygon.count; ++k) {
        Filled triangle{{corner(0), corner(k - 1), corner(k)}, 0};
        auto& [a, b, c] = triangle.corners;
        triangle.area = area_of(a, b, c);
        if (triangle.area == 0) continue;
        if (triangle.area < 0) std::swap(b, c), triangle.area = -triangle.area;
        PixelBox box = fill_.box_of(a.x, a.y, b.x, b.y, c.x, c.y);
        if (!box.is_empty()) fill_.draw(skin, triangle, box, [](Filled&) {});
    }
}

Corner PlantPen::corner_at(const glm::vec3& seen, const std::array<float, 2>& uv) const {
    Corner made;
    made.nearness = 1 / seen.z, made.u = uv[0], made.v = uv[1];
    made.x = int32_t(std::floor((eye_.middle_px.x + seen.x * made.nearness) * kCornerSteps + 0.5f));
    made.y = int32_t(std::floor((eye_.middle_px.y - seen.y * made.nearness) * kCornerSteps + 0.5f));
    return made;
}

glm::vec3 PlantPen::seen(const ShapeLevel& level, uint32_t vertex) const {
    glm::vec3 own(level.x_m[vertex], level.y_m[vertex], level.z_m[vertex]);
    return turn_ * own + foot_;
}

glm::vec3 PlantPen::stood(const glm::vec3& own) const {
    return {cosine_ * own.x - sine_ * own.y, sine_ * own.x + cosine_ * own.y, own.z};
}

// Points to where its corners are counter-clockwise from.
glm::vec3 PlantPen::face(const ShapeLevel& level, uint32_t index) const {
    const uint32_t* v = level.indices.data() + index;
    auto at = [&](uint32_t k) { return glm::vec3(level.x_m[v[k]], level.y_m[v[k]], level.z_m[v[k]]); };
    glm::vec3 normal = glm::cross(at(1) - at(0), at(2) - at(0));
    float length = glm::length(normal);
    return length > 0 ? stood(normal / length) : glm::vec3(0, 0, 1);
}

// What a vertex sends on the side of a normal, tinted.
Four PlantPen::sent(const ShapeLevel& level, uint32_t vertex, const glm::vec3& normal) const {
    const auto& tint = level.tints[vertex];
    Four tinted{tint[0], tint[1], tint[2], tint[3]};
    if (!light_.is_lit) return tinted;
    constexpr float kLast = kCanopySteps - 1;
    float height_m = scale_ * level.z_m[vertex], top_m = float(std::max(light_.canopy.top_m, 1e-6));
    float place = std::clamp(height_m / top_m, 0.0f, 1.0f) * kLast;
    auto below = size_t(place);
    glm::vec2 open = glm::mix(light_.canopy.open[below], light_.canopy.open[std::min<size_t>(below + 1, kCanopySteps - 1)],
                              place - float(below));
    const BakedLight& of = light_.light;
    glm::vec3 light = (of.sky * (0.5f + 0.5f * normal.z) + of.ground * (0.5f - 0.5f * normal.z)) * open.y;
    light += of.sun * (std::max(0.0f, glm::dot(normal, light_.to_sun)) * open.x);
    return tinted * four(light, 1);
}

const PlantPen::Lit& PlantPen::lit(const ShapeLevel& level, uint32_t vertex) {
    Lit& made = lit_[vertex];
    if (is_lit_[vertex]) return made;
    is_lit_[vertex] = 1;
    const auto& n = level.normals[vertex];
    glm::vec3 normal = stood({n[0], n[1], n[2]});
    made.front = sent(level, vertex, normal), made.back = sent(level, vertex, -normal);
    return made;
}

// What a triangle's corner sends to the eye, which sees the side from which it is counter-clockwise, or the other.
Four PlantPen::colour(const ShapeLevel& level, const Skin& skin, uint32_t index, int corner, bool sees_front) {
    uint32_t vertex = level.indices[index + uint32_t(corner)];
    Four seen{}, unseen{};
    if (level.normals.empty()) {
        glm::vec3 normal = sees_front ? face(level, index) : -face(level, index);
        seen = sent(level, vertex, normal), unseen = sent(level, vertex, -normal);
    } else {
        const Lit& light = lit(level, vertex);
        bool is_own = bool(level.sides[index / 3] >> corner & 1) == sees_front;
        seen = is_own ? light.front : light.back, unseen = is_own ? light.back : light.front;
    }
    if (!skin.is_two_sided || !light_.is_lit) return seen;
    float through = light_.light.transmission;
    return seen + unseen * Four{through, through, through, 0};
}

}  // namespace overlook::wang_ldi
