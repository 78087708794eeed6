#include "tools/make_sample/plant_shapes.h"

#include <algorithm>
#include <cmath>

namespace overlook::sample {
namespace {

// O. Rodrigues, 1840.
glm::dvec3 rotated(const glm::dvec3& v, const glm::dvec3& rotation_rad) {
    double angle = glm::length(rotation_rad);
    if (angle < 1e-12) return v;
    glm::dvec3 axis = rotation_rad / angle;
    return v * std::cos(angle) + glm::cross(axis, v) * std::sin(angle) + axis * (glm::dot(axis, v) * (1 - std::cos(angle)));
}

glm::dvec3 unit_or(const glm::dvec3& v, const glm::dvec3& other) {
    double length = glm::length(v);
    return length > 1e-14 ? v / length : other;
}

}  // namespace

Frame frame_of(const glm::dvec3& at_m, const glm::dvec3& along, const glm::dvec3& face) {
    glm::dvec3 a = glm::normalize(along);
    return {at_m, a, glm::normalize(face - a * glm::dot(a, face))};
}

Frame turned(const Frame& frame, const glm::dvec3& rotation_rad) {
    return frame_of(frame.at_m, rotated(frame.along, rotation_rad), rotated(frame.face, rotation_rad));
}

glm::dvec3 droop(const Frame& frame, double angle_rad) {
    return glm::cross(frame.along, glm::dvec3(0, 0, -1)) * angle_rad;
}

Spine::Spine(const Frame& from, double length_m, uint32_t steps, const Turn& turn) : frames_{from}, length_m_(length_m) {
    for (uint32_t i = 0; i < steps; ++i) {
        const Frame& last = frames_.back();
        Frame next = turned(last, turn((i + 0.5) / steps, last) / double(steps));
        next.at_m += (last.along + next.along) * (length_m / (2.0 * steps));
        frames_.push_back(next);
    }
}

Frame Spine::at(double share) const {
    double steps = double(frames_.size() - 1), place = std::clamp(share, 0.0, 1.0) * steps;
    auto i = std::min(size_t(place), frames_.size() - 2);
    const Frame &a = frames_[i], &b = frames_[i + 1];
    double t = place - double(i);
    Frame frame = frame_of(glm::mix(a.at_m, b.at_m, t), glm::mix(a.along, b.along, t), glm::mix(a.face, b.face, t));
    frame.at_m += frame.along * (length_m_ * (share - std::clamp(share, 0.0, 1.0)));
    return frame;
}

void PlantMaker::add_corner(const Place& place, const glm::dvec3& normal) {
    mesh_.positions_m.emplace_back(place.at_m), mesh_.normals.emplace_back(normal), mesh_.uvs.emplace_back(place.uv);
}

void PlantMaker::add_face(uint32_t surface, uint32_t a, uint32_t b, uint32_t c) {
    mesh_.face_source.push_back(uint32_t(mesh_.faces.size()));
    mesh_.faces.push_back({a, b, c}), mesh_.face_normals.push_back({a, b, c}), mesh_.face_uvs.push_back({a, b, c});
    mesh_.face_surface.push_back(surface);
}

uint32_t PlantMaker::add_grid(uint32_t surface, uint32_t rows, uint32_t columns, bool is_round, const Places& places) {
    uint32_t width = is_round ? columns : columns + 1;
    std::vector<Place> grid;
    for (uint32_t row = 0; row <= rows; ++row)
        for (uint32_t column = 0; column < width; ++column) grid.push_back(places(row, column));
    auto first = uint32_t(mesh_.positions_m.size());
    for (uint32_t row = 0; row <= rows; ++row)
        for (uint32_t column = 0; column < width; ++column) {
            uint32_t left = is_round ? (column + width - 1) % width : std::max(column, 1u) - 1;
            uint32_t right = is_round ? (column + 1) % width : std::min(column + 1, columns);
            glm::dvec3 across_m = grid[row * width + right].at_m - grid[row * width + left].at_m;
            glm::dvec3 along_m =
                grid[std::min(row + 1, rows) * width + column].at_m - grid[(std::max(row, 1u) - 1) * width + column].at_m;
            add_corner(grid[row * width + column], unit_or(glm::cross(across_m, along_m), {0, 0, 1}));
        }
    for (uint32_t row = 0; row < rows; ++row)
        for (uint32_t column = 0; column < columns; ++column) {
            uint32_t a = first + row * width + column, b = first + row * width + (column + 1) % width;
            add_face(surface, a, b, b + width);
            add_face(surface, a, b + width, a + width);
        }
    return first + rows * width;
}

void PlantMaker::add_sheet(uint32_t surface, uint32_t rows, uint32_t columns, const Places& places) {
    (void)add_grid(surface, rows, columns, false, places);
}

void PlantMaker::add_round(uint32_t surface, uint32_t rows, uint32_t sides, const Places& places) {
    (void)add_grid(surface, rows, sides, true, places);
}

void PlantMaker::add_round(uint32_t surface, uint32_t rows, uint32_t sides, const Places& places, const Place& tip) {
    uint32_t last = add_grid(surface, rows, sides, true, places);
    glm::dvec3 normal(0);
    for (uint32_t side = 0; side < sides; ++side) {
        glm::dvec3 a(mesh_.positions_m[last + side]), b(mesh_.positions_m[last + (side + 1) % sides]);
        normal += glm::cross(a - tip.at_m, b - tip.at_m);
    }
    auto middle = uint32_t(mesh_.positions_m.size());
    add_corner(tip, unit_or(normal, {0, 0, 1}));
    for (uint32_t side = 0; side < sides; ++side) add_face(surface, last + side, last + (side + 1) % sides, middle);
}

void PlantMaker::add_blade(uint32_t surface, const Spine& spine, const Blade& blade) {
    add_sheet(surface, blade.rows, blade.columns, [&](uint32_t row, uint32_t column) {
        double share = double(row) / blade.rows, across = 2.0 * column / blade.columns - 1;
        Frame frame = spine.at(share);
        double lift_m = blade.lift_m ? blade.lift_m(across, share) : 0;
        return Place{frame.at_m + frame.side() * (across * blade.half_width_m(share)) + frame.face * lift_m,
                     glm::mix(blade.uv_from, blade.uv_to, glm::dvec2(0.5 + 0.5 * across, share))};
    });
}

void PlantMaker::add_stalk(uint32_t surface, const Spine& spine, const Stalk& stalk) {
    auto place = [&](uint32_t row, uint32_t side) {
        double share = double(row) / stalk.rings, round = double(side) / stalk.sides, angle = kTurn_rad * round;
        Frame frame = spine.at(share);
        // Counter-clockwise seen from the end: side, then face turned away.
        glm::dvec3 out = std::cos(angle) * frame.side() - std::sin(angle) * frame.face;
        return Place{frame.at_m + out * stalk.radius_m(share),
                     glm::mix(stalk.uv_from, stalk.uv_to, glm::dvec2(1 - std::abs(2 * round - 1), share))};
    };
    if (!stalk.has_tip) return add_round(surface, stalk.rings, stalk.sides, place);
    Frame end = spine.at(1);
    add_round(surface, stalk.rings, stalk.sides, place,
              {end.at_m + end.along * (0.5 * stalk.radius_m(1)), glm::mix(stalk.uv_from, stalk.uv_to, glm::dvec2(0.5, 1))});
}

}  // namespace overlook::sample
