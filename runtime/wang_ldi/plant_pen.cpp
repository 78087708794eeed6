#include "runtime/wang_ldi/plant_pen.h"

#include <algorithm>
#include <cmath>

#include "runtime/wang_ldi/plant_cut.h"

namespace overlook::wang_ldi {
namespace {

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
    glm::mat3 rows = glm::transpose(turn_);  // right, up, forward of its own axes
    glm::vec2 middle = eye_.middle_px;
    constexpr float kMore_px = 1;
    auto side = [&](int axis, float sign, float px) {
        return Side{sign * rows[axis] + px * rows[2], sign * foot_[axis] + px * foot_.z};
    };
    float far_m = glm::length(foot_) * 1e-5f;  // what rounding may be off
    sides_ = {side(0, 1, middle.x - float(left_) + kMore_px), side(0, -1, float(right_) - middle.x + kMore_px),
              side(1, -1, middle.y + kMore_px), side(1, 1, middle.y + kMore_px), Side{rows[2], foot_.z - eye_.near_m}};
    for (Side& one : sides_) one.offset += far_m;
}

void PlantPen::draw(const PlantShape& shape, uint32_t level, const discrete::Placement& placement, const Door& door) {
    level_ = &shape.levels[level];
    fill_.begin(*canvas_, left_, right_, door);
    stand(placement);
    if (!may_be_seen(level_->all) || is_hidden(level_->all)) return;
    for (const ShapeBunch& bunch : level_->bunches)
        if (may_be_seen(bunch) && !is_hidden(bunch)) draw_bunch(shape.skins[bunch.skin], bunch);
}

bool PlantPen::may_be_seen(const ShapeBunch& bunch) const {
    for (const Side& side : sides_)
        if (glm::dot(side.along, bunch.middle_m) + glm::dot(glm::abs(side.along), bunch.half_m) + side.offset < 0) return false;
    return true;
}

// By what is drawn already, as boxes. All of it may be seen.
bool PlantPen::is_hidden(const ShapeBunch& bunch) const {
    constexpr float kLess = 1 - 1e-4f, kMost_px = 1e6f;
    glm::vec3 middle = turn_ * bunch.middle_m + foot_, half(0);
    for (int axis = 0; axis < 3; ++axis) half += glm::abs(turn_[axis]) * bunch.half_m[axis];
    float nearest_m = (middle.z - half.z) * kLess, farthest_m = middle.z + half.z;
    if (nearest_m < eye_.near_m) return false;
    auto greatest = [&](float across) { return across / (across > 0 ? nearest_m : farthest_m); };
    auto pixel = [&](float at_px) { return int(std::floor(held(at_px, kMost_px))); };
    glm::vec2 at = eye_.middle_px;
    PixelBox box = fill_.columns();
    box.left = std::max(box.left, pixel(at.x - greatest(half.x - middle.x)) - 1);
    box.right = std::min(box.right, pixel(at.x + greatest(half.x + middle.x)) + 2);
    box.top = std::max(box.top, pixel(at.y - greatest(half.y + middle.y)) - 1);
    box.bottom = std::min(box.bottom, pixel(at.y + greatest(half.y - middle.y)) + 2);
    return !fill_.is_open(box, nearest_m);
}

void PlantPen::draw_bunch(const Skin& skin, const ShapeBunch& bunch) {
    PlacedVertices placed = place(bunch);
    SiftFrame frame{left_, right_, int32_t(canvas_->height_px()), canvas_->stride(), canvas_->row(0)};
    uint32_t count = loops_.sift(frame, placed, level_->indices.data() + bunch.first_index, bunch.index_count / 3, kept_.data());
    for (uint32_t n = 0; n < count; ++n) {
        uint32_t index = bunch.first_index + 3u * (kept_[n] & ~kIsCut);
        if (kept_[n] & kIsCut)
            draw_cut(skin, index);
        else
            draw_triangle(skin, index);
    }
}

// All its vertices.
PlacedVertices PlantPen::place(const ShapeBunch& bunch) {
    first_vertex_ = bunch.first_vertex;
    VertexFrame frame{};
    float* rows[3] = {frame.right, frame.up, frame.forward};
    for (int row = 0; row < 3; ++row) {
        for (int axis = 0; axis < 3; ++axis) rows[row][axis] = turn_[axis][row];
        rows[row][3] = foot_[row];
    }
    for (int k = 0; k < 2; ++k) frame.middle_px[k] = eye_.middle_px[k], frame.size_px[k] = 2 * eye_.middle_px[k];
    frame.near_m = eye_.near_m;
    PlacedVertices placed{x_.data(), y_.data(), nearness_.data(), behind_.data()};
    loops_.place(frame, level_->x_m.data() + first_vertex_, level_->y_m.data() + first_vertex_,
                 level_->z_m.data() + first_vertex_, bunch.vertex_count, placed);
    std::fill_n(is_lit_.begin(), bunch.vertex_count, uint8_t(0));
    return placed;
}

void PlantPen::draw_triangle(const Skin& skin, uint32_t index) {
    const uint16_t* v = level_->indices.data() + index;
    PixelBox box = fill_.box_of(x_[v[0]], y_[v[0]], x_[v[1]], y_[v[1]], x_[v[2]], y_[v[2]]);
    Filled triangle;
    auto stand_at = [&](size_t corner, uint16_t vertex) {
        triangle.corners[corner].x = x_[vertex], triangle.corners[corner].y = y_[vertex];
        triangle.corners[corner].nearness = nearness_[vertex];
    };
    stand_at(0, v[0]), stand_at(1, v[1]), stand_at(2, v[2]);
    triangle.area = area_of(triangle.corners[0], triangle.corners[1], triangle.corners[2]);
    bool sees_front = triangle.area < 0;  // downwards turns the other way
    if (sees_front) stand_at(1, v[2]), stand_at(2, v[1]), triangle.area = -triangle.area;
    if (triangle.area == 0 || box.is_empty()) return;
    fill_.draw(skin, triangle, box, [&](Filled& filled) {
        int second = sees_front ? 2 : 1;
        for (auto [at, from] : {std::pair(0, 0), {1, second}, {2, 3 - second}}) {
            Corner& corner = filled.corners[size_t(at)];
            corner.colour = colour(skin, index, from, sees_front);
            corner.u = level_->uvs[first_vertex_ + v[from]][0], corner.v = level_->uvs[first_vertex_ + v[from]][1];
        }
    });
}

// One that reaches behind the eye, or far beyond the picture.
void PlantPen::draw_cut(const Skin& skin, uint32_t index) {
    const uint16_t* v = level_->indices.data() + index;
    Polygon polygon;
    polygon.count = 3;
    for (size_t k = 0; k < 3; ++k) polygon.corners[k] = CutCorner{turn_ * own_m(v[k]) + foot_, level_->uvs[first_vertex_ + v[k]]};
    auto& at = polygon.corners;
    bool sees_front = glm::dot(at[0].seen, glm::cross(at[1].seen, at[2].seen)) > 0;
    for (int k = 0; k < 3; ++k) at[size_t(k)].colour = colour(skin, index, k, sees_front);
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
    made.nearness = 1 / std::max(eye_.near_m, seen.z), made.u = uv[0], made.v = uv[1];
    float right = held(seen.x * made.nearness, kFarthest_px), up = held(seen.y * made.nearness, kFarthest_px);
    made.x = int32_t(std::floor((eye_.middle_px.x + right) * kCornerSteps + 0.5f));
    made.y = int32_t(std::floor((eye_.middle_px.y - up) * kCornerSteps + 0.5f));
    return made;
}

glm::vec3 PlantPen::own_m(uint32_t vertex) const {
    size_t v = first_vertex_ + vertex;
    return {level_->x_m[v], level_->y_m[v], level_->z_m[v]};
}

glm::vec3 PlantPen::stood(const glm::vec3& own) const {
    return {cosine_ * own.x - sine_ * own.y, sine_ * own.x + cosine_ * own.y, own.z};
}

// Points to where its corners are counter-clockwise from.
glm::vec3 PlantPen::face(uint32_t index) const {
    const uint16_t* v = level_->indices.data() + index;
    glm::vec3 first_m = own_m(v[0]), normal = glm::cross(own_m(v[1]) - first_m, own_m(v[2]) - first_m);
    float length = glm::length(normal);
    return length > 0 ? stood(normal / length) : glm::vec3(0, 0, 1);
}

// What a vertex sends on the side of a normal, tinted.
Four PlantPen::sent(uint32_t vertex, const glm::vec3& normal) const {
    const auto& tint = level_->tints[first_vertex_ + vertex];
    Four tinted{tint[0], tint[1], tint[2], tint[3]};
    if (!light_.is_lit) return tinted;
    constexpr float kLast = kCanopySteps - 1;
    float height_m = scale_ * level_->z_m[first_vertex_ + vertex], top_m = float(std::max(light_.canopy.top_m, 1e-6));
    float place = std::max(0.0f, held(height_m / top_m, 1)) * kLast;
    auto below = size_t(place);
    glm::vec2 open = glm::mix(light_.canopy.open[below], light_.canopy.open[std::min<size_t>(below + 1, kCanopySteps - 1)],
                              place - float(below));
    const BakedLight& of = light_.light;
    glm::vec3 light = (of.sky * (0.5f + 0.5f * normal.z) + of.ground * (0.5f - 0.5f * normal.z)) * open.y;
    light += of.sun * (std::max(0.0f, glm::dot(normal, light_.to_sun)) * open.x);
    return tinted * four(light, 1);
}

const PlantPen::Lit& PlantPen::lit(uint32_t vertex) {
    Lit& made = lit_[vertex];
    if (is_lit_[vertex]) return made;
    is_lit_[vertex] = 1;
    const auto& n = level_->normals[first_vertex_ + vertex];
    glm::vec3 normal = stood({n[0], n[1], n[2]});
    made.front = sent(vertex, normal), made.back = sent(vertex, -normal);
    return made;
}

// What a triangle's corner sends to the eye, which sees the side from which it is counter-clockwise, or the other.
Four PlantPen::colour(const Skin& skin, uint32_t index, int corner, bool sees_front) {
    uint32_t vertex = level_->indices[index + uint32_t(corner)];
    Four seen{}, unseen{};
    if (level_->normals.empty()) {
        glm::vec3 normal = sees_front ? face(index) : -face(index);
        seen = sent(vertex, normal), unseen = sent(vertex, -normal);
    } else {
        const Lit& light = lit(vertex);
        bool is_own = bool(level_->sides[index / 3] >> corner & 1) == sees_front;
        seen = is_own ? light.front : light.back, unseen = is_own ? light.back : light.front;
    }
    if (!skin.is_two_sided || !light_.is_lit) return seen;
    float through = light_.light.transmission;
    return seen + unseen * Four{through, through, through, 0};
}

}  // namespace overlook::wang_ldi
