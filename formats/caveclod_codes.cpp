#include "formats/caveclod_codes.h"

#include <algorithm>
#include <cmath>

#include "formats/caveclod_octahedral.h"

namespace overlook::caveclod {
namespace {

// 2^(k/8), rounded up: products of these and powers of two are exact.
constexpr std::array<float, 8> kEighths = {1.0f,       1.0905077f, 1.1892072f, 1.2968396f,
                                           1.4142137f, 1.5422109f, 1.6817930f, 1.8340081f};

int32_t rounded_mean(int64_t sum, int64_t count) {
    int64_t twice = 2 * sum + count;  // floor((2 sum + count) / (2 count)), for sums of either sign
    int64_t quotient = twice / (2 * count);
    return int32_t(twice % (2 * count) < 0 ? quotient - 1 : quotient);
}

}  // namespace

float error_of_code(uint32_t code) {
    return code == 0 ? 0 : std::ldexp(kEighths[(code - 1) % 8], int((code - 1) / 8) - 60);
}

uint32_t code_of_error(float error_m) {
    if (!(error_m > 0)) return 0;
    uint32_t low = 1, high = kErrorCodeMax;
    while (low < high) {
        uint32_t middle = (low + high) / 2;
        if (error_of_code(middle) < error_m)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

GridPosition steps_of_position(const Grid& grid, const glm::vec3& position_m) {
    GridPosition steps;
    for (int axis = 0; axis < 3; ++axis)
        steps.at[size_t(axis)] = int32_t(std::lround(std::clamp(double(position_m[axis]) / grid.position_step_m, -1e9, 1e9)));
    return steps;
}

glm::vec3 position_of_steps(const Grid& grid, const GridPosition& steps) {
    return glm::vec3(glm::dvec3(steps.at[0], steps.at[1], steps.at[2]) * grid.position_step_m);
}

Steps steps_of_vertex(const Grid& grid, const RenderVertex& vertex) {
    Steps steps;
    glm::dvec2 normal = octahedral_of(glm::dvec3(vertex.normal));
    double half = most_steps(grid.normal_bits) / 2;  // whole steps either side, so that the axes are exact
    for (int axis = 0; axis < 2; ++axis) {
        steps.normal[size_t(axis)] = int32_t(std::lround(normal[axis] * half));
        double uv = grid.uv_step > 0 ? (double(vertex.uv[axis]) - grid.uv_low[axis]) / grid.uv_step : 0;
        steps.uv[size_t(axis)] = int32_t(std::lround(std::clamp(uv, -1e9, 1e9)));
    }
    for (size_t i = 0; i < 4; ++i) steps.colour[i] = vertex.colour[i];
    return steps;
}

RenderVertex vertex_of_steps(const Grid& grid, const Attributes& attributes, uint32_t position, const Steps& steps) {
    RenderVertex vertex;
    vertex.position = position;
    if (attributes.normals) {
        double half = most_steps(grid.normal_bits) / 2;
        vertex.normal = glm::vec3(vector_of_octahedral(glm::dvec2(steps.normal[0], steps.normal[1]) / half)) + 0.0f;
    }
    if (attributes.uvs) vertex.uv = glm::vec2(grid.uv_low + glm::dvec2(steps.uv[0], steps.uv[1]) * grid.uv_step);
    if (attributes.colours)
        for (size_t i = 0; i < 4; ++i) vertex.colour[i] = uint8_t(steps.colour[i]);
    return vertex;
}

uint32_t in_arc(std::span<const StarCorner> star, uint32_t begin, uint32_t i) {
    uint32_t at = begin + i;
    if (at < star.size() && star[at].fan == star[begin].fan) return at;
    uint32_t first = begin, last = begin;
    while (first > 0 && star[first - 1].fan == star[begin].fan) --first;
    while (last + 1 < star.size() && star[last + 1].fan == star[begin].fan) ++last;
    return first + (at - last - 1);
}

bool is_arc(std::span<const StarCorner> star, uint32_t begin, uint32_t length) {
    if (length == 0) return begin == 0;
    if (begin >= star.size()) return false;
    uint32_t first = begin, end = begin;
    while (first > 0 && star[first - 1].fan == star[begin].fan) --first;
    while (end < star.size() && star[end].fan == star[begin].fan) ++end;
    bool is_open = star[first].begins_open || star[end - 1].ends_open;
    return length <= (is_open ? end - begin : end - first);
}

Added expected_faces(const MeshState& state, const Hierarchy& hierarchy, std::span<const StarCorner> star, uint32_t begin,
                     uint32_t length, std::span<const uint16_t> new_wedges) {
    Added added;
    if (length == 0) return added;
    auto add = [&](const StarCorner& at, bool third_is_last, uint16_t new_wedge) {
        uint32_t face = at.corner / kCorners, c = at.corner % kCorners;
        uint32_t third = face * kCorners + (c + (third_is_last ? 2 : 1)) % 3;
        added.faces[added.count++] = {state.position(third),
                                      third_is_last,
                                      hierarchy.face_group[face],
                                      {state.wedge(at.corner), new_wedge, state.wedge(third)}};
    };
    const StarCorner &first = star[begin], &last = star[in_arc(star, begin, length - 1)];
    if (!first.begins_open) add(first, false, new_wedges.front());
    if (!last.ends_open) add(last, true, new_wedges[length - 1]);
    return added;
}

GridPosition expected_position(std::span<const GridPosition> positions, uint32_t owner, std::span<const StarCorner> moved) {
    GridPosition expected;
    for (size_t axis = 0; axis < 3; ++axis) {
        int64_t sum = 2 * int64_t(positions[owner].at[axis]);
        for (const StarCorner& at : moved) sum += int64_t(positions[at.next].at[axis]) + positions[at.previous].at[axis];
        expected.at[axis] = rounded_mean(sum, 2 + 2 * int64_t(moved.size()));
    }
    return expected;
}

Steps expected_vertex(const MeshState& state, const Hierarchy& hierarchy, std::span<const Steps> vertices,
                      std::span<const StarCorner> moved, std::span<const uint16_t> new_wedges, uint16_t wedge) {
    std::array<int64_t, 8> sums{};
    int64_t count = 0;
    for (size_t i = 0; i < moved.size(); ++i) {
        if (new_wedges[i] != wedge) continue;
        uint32_t face = moved[i].corner / kCorners;
        for (uint32_t c = 0; c < 3; ++c) {
            const Steps& at = vertices[hierarchy.vertex_begin[state.positions(face)[c]] + state.wedge(face * kCorners + c)];
            for (size_t k = 0; k < 2; ++k) sums[k] += at.normal[k], sums[2 + k] += at.uv[k];
            for (size_t k = 0; k < 4; ++k) sums[4 + k] += at.colour[k];
        }
        count += 3;
    }
    if (count == 0) return vertices.empty() ? Steps{} : vertices.back();
    Steps expected;
    for (size_t k = 0; k < 2; ++k)
        expected.normal[k] = rounded_mean(sums[k], count), expected.uv[k] = rounded_mean(sums[2 + k], count);
    for (size_t k = 0; k < 4; ++k) expected.colour[k] = rounded_mean(sums[4 + k], count);
    return expected;
}

void touched_needs(const MeshState& state, const Hierarchy& hierarchy, uint32_t owner, std::span<const uint32_t> moved,
                   const Added& added, std::vector<uint32_t>& needs) {
    needs.clear();
    auto need_creator = [&](uint32_t position) {
        if (position >= hierarchy.base_position_count) needs.push_back(position - hierarchy.base_position_count);
    };
    need_creator(owner);
    for (uint32_t i = 0; i < added.count; ++i) need_creator(added.faces[i].third);
    for (uint32_t corner : moved)
        if (uint32_t split = state.touched_by(corner / kCorners); split != MeshState::kNone) needs.push_back(split);
    std::sort(needs.begin(), needs.end());
    needs.erase(std::unique(needs.begin(), needs.end()), needs.end());
    // From the finest down: what a kept one needs directly goes.
    for (size_t k = needs.size(); k-- > 1;) {
        auto row =
            std::span(hierarchy.needs)
                .subspan(hierarchy.need_begin[needs[k]], hierarchy.need_begin[needs[k] + 1] - hierarchy.need_begin[needs[k]]);
        size_t kept = 0;
        for (size_t j = 0; j < k; ++j)
            if (!std::binary_search(row.begin(), row.end(), needs[j])) needs[kept++] = needs[j];
        needs.erase(needs.begin() + ptrdiff_t(kept), needs.begin() + ptrdiff_t(k));
        k = kept;
        if (k == 0) break;
    }
}

}  // namespace overlook::caveclod
