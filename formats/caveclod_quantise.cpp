// What a baker does to a hierarchy before it is written: canonical faces, whole steps, rounded errors.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "formats/caveclod_codes.h"

namespace overlook::caveclod {
namespace {

// A face that split `i` added, so that its owner's corner comes first. Returns how many corners it was turned by.
uint32_t turn_to_owner(Hierarchy& hierarchy, uint32_t face, uint32_t owner) {
    auto& positions = hierarchy.face_positions[face];
    uint32_t turn = positions[1] == owner ? 1 : positions[2] == owner ? 2 : 0;
    std::rotate(positions.begin(), positions.begin() + turn, positions.end());
    auto wedges = hierarchy.birth_wedge.begin() + 3 * ptrdiff_t(face);
    std::rotate(wedges, wedges + turn, wedges + 3);
    return turn;
}

void swap_faces(Hierarchy& hierarchy, uint32_t a, uint32_t b) {
    std::swap(hierarchy.face_positions[a], hierarchy.face_positions[b]);
    std::swap(hierarchy.face_group[a], hierarchy.face_group[b]);
    std::swap_ranges(hierarchy.birth_wedge.begin() + 3 * ptrdiff_t(a), hierarchy.birth_wedge.begin() + 3 * ptrdiff_t(a) + 3,
                     hierarchy.birth_wedge.begin() + 3 * ptrdiff_t(b));
}

void sort_moved(Hierarchy& hierarchy, uint32_t begin, uint32_t end) {
    struct Move {
        uint32_t corner;
        uint16_t wedge, back_wedge;
    };
    std::vector<Move> row;
    for (uint32_t k = begin; k < end; ++k)
        row.push_back({hierarchy.moved[k], hierarchy.moved_wedge[k], hierarchy.moved_back_wedge[k]});
    std::sort(row.begin(), row.end(), [](const Move& a, const Move& b) { return a.corner < b.corner; });
    for (uint32_t k = begin; k < end; ++k) {
        const Move& move = row[k - begin];
        hierarchy.moved[k] = move.corner, hierarchy.moved_wedge[k] = move.wedge;
        hierarchy.moved_back_wedge[k] = move.back_wedge;
    }
}

// The least step of `bits` bits over `extent` whose whole multiples, as many as 2^bits, are exact in a float's 24.
double step_of(double extent, uint32_t bits) {
    if (!(extent > 0)) return 1;
    int exponent = 0;
    double mantissa = std::frexp(extent / most_steps(bits), &exponent);
    double kept = std::ldexp(1.0, int(24 - bits));
    return std::ldexp(std::ceil(mantissa * kept) / kept, exponent);
}

double quantise_positions(Hierarchy& hierarchy, uint32_t bits) {
    glm::vec3 low(std::numeric_limits<float>::max()), high(-std::numeric_limits<float>::max());
    for (const glm::vec3& p : hierarchy.positions_m) low = glm::min(low, p), high = glm::max(high, p);
    glm::dvec3 size = glm::dvec3(high) - glm::dvec3(low);
    Grid& grid = hierarchy.grid;
    grid.position_bits = bits;
    grid.position_step_m = step_of(std::max({size.x, size.y, size.z}), bits);
    double greatest_squared = 0;
    for (glm::vec3& p : hierarchy.positions_m) {
        glm::dvec3 exact = glm::dvec3(p) - glm::dvec3(low);
        GridPosition steps;
        for (int axis = 0; axis < 3; ++axis)
            steps.at[size_t(axis)] = std::clamp(int32_t(std::lround(exact[axis] / grid.position_step_m)), 0, most_steps(bits));
        p = position_of_steps(grid, steps);
        glm::dvec3 away = glm::dvec3(p) - exact;
        greatest_squared = std::max(greatest_squared, glm::dot(away, away));
    }
    hierarchy.origin_m += glm::dvec3(low);
    return std::sqrt(greatest_squared);
}

void fit_uv_grid(Hierarchy& hierarchy, uint32_t bits) {
    glm::dvec2 low(std::numeric_limits<double>::max()), high(-std::numeric_limits<double>::max());
    for (const RenderVertex& vertex : hierarchy.vertices)
        low = glm::min(low, glm::dvec2(vertex.uv)), high = glm::max(high, glm::dvec2(vertex.uv));
    Grid& grid = hierarchy.grid;
    grid.uv_bits = bits;
    grid.uv_low = low;
    double range = std::max(high.x - low.x, high.y - low.y);
    grid.uv_step = range > 0 ? range / most_steps(bits) : 1;
}

}  // namespace

void canonicalise(Hierarchy& hierarchy) {
    std::vector<uint8_t> turns(hierarchy.face_positions.size(), 0);
    std::vector<uint32_t> renamed(hierarchy.face_positions.size());
    for (uint32_t face = 0; face < renamed.size(); ++face) renamed[face] = face;
    for (uint32_t i = 0; i < hierarchy.split_count(); ++i) {
        uint32_t begin = hierarchy.added_begin[i], end = hierarchy.added_begin[i + 1];
        for (uint32_t face = begin; face < end; ++face) turns[face] = uint8_t(turn_to_owner(hierarchy, face, hierarchy.owner[i]));
        if (end - begin == 2 && hierarchy.face_positions[begin][1] == hierarchy.new_position(i) &&
            hierarchy.face_positions[begin + 1][2] == hierarchy.new_position(i)) {
            swap_faces(hierarchy, begin, begin + 1);
            std::swap(renamed[begin], renamed[begin + 1]);
        }
    }
    for (uint32_t& corner : hierarchy.moved) {
        uint32_t face = corner / kCorners, c = (corner % kCorners + 3 - turns[face]) % 3;
        corner = renamed[face] * kCorners + c;
    }
    for (uint32_t i = 0; i < hierarchy.split_count(); ++i)
        sort_moved(hierarchy, hierarchy.moved_begin[i], hierarchy.moved_begin[i + 1]);
}

Quantised quantise(Hierarchy& hierarchy, const Precision& precision) {
    Quantised changed;
    if (!(hierarchy.grid.position_step_m > 0)) changed.position_m = quantise_positions(hierarchy, precision.position_bits);
    Grid& grid = hierarchy.grid;
    grid.normal_bits = precision.normal_bits;
    fit_uv_grid(hierarchy, precision.uv_bits);
    for (RenderVertex& vertex : hierarchy.vertices) {
        RenderVertex exact = vertex;
        vertex = vertex_of_steps(grid, hierarchy.attributes, exact.position, steps_of_vertex(grid, exact));
        glm::dvec3 from(exact.normal), to(vertex.normal);
        double angle_rad = std::atan2(glm::length(glm::cross(from, to)), glm::dot(from, to));
        if (hierarchy.attributes.normals) changed.normal_deg = std::max(changed.normal_deg, angle_rad * 180 / std::numbers::pi);
        glm::dvec2 uv_away = glm::abs(glm::dvec2(vertex.uv) - glm::dvec2(exact.uv));
        if (hierarchy.attributes.uvs) changed.uv = std::max({changed.uv, uv_away.x, uv_away.y});
    }
    return changed;
}

void round_errors(Hierarchy& hierarchy) {
    hierarchy.finest_error_m = error_of_code(code_of_error(hierarchy.finest_error_m));
    for (uint32_t i = hierarchy.split_count(); i-- > 0;) {
        float& own = hierarchy.error_m[i];
        own = error_of_code(code_of_error(std::max(own, hierarchy.finest_error_m)));
        for (uint32_t k = hierarchy.need_begin[i]; k < hierarchy.need_begin[i + 1]; ++k) {
            float& needed = hierarchy.error_m[hierarchy.needs[k]];
            needed = std::max(needed, own);
        }
    }
}

}  // namespace overlook::caveclod
