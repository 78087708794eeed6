#include "tools/bake/caveclod/cut.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace overlook::caveclod {
namespace {

std::span<const uint32_t> needs_of(const Hierarchy& h, uint32_t split) {
    return std::span(h.needs).subspan(h.need_begin[split], h.need_begin[split + 1] - h.need_begin[split]);
}

uint64_t added_count(const Hierarchy& h, uint32_t split) {
    return h.added_begin[split + 1] - h.added_begin[split];
}

// Applies a split after all that it needs; returns how many faces that adds.
uint64_t apply_with_needs(const Hierarchy& h, uint32_t split, Applied& applied) {
    std::vector<uint32_t> pending{split};
    uint64_t faces = 0;
    while (!pending.empty()) {
        uint32_t i = pending.back();
        pending.pop_back();
        if (applied[i] != 0) continue;
        applied[i] = 1;
        faces += added_count(h, i);
        for (uint32_t need : needs_of(h, i)) pending.push_back(need);
    }
    return faces;
}

}  // namespace

bool is_legal(const Hierarchy& h, const Applied& applied) {
    for (uint32_t i = 0; i < h.split_count(); ++i)
        if (applied[i] != 0)
            for (uint32_t need : needs_of(h, i))
                if (applied[need] == 0) return false;
    return true;
}

CutFaces faces_of(const Hierarchy& h, const Applied& applied) {
    std::vector<std::array<uint32_t, 3>> positions = h.face_positions, vertices(positions.size());
    std::vector<uint8_t> is_there(positions.size(), 0);
    std::fill_n(is_there.begin(), h.base_face_count, uint8_t(1));
    for (size_t f = 0; f < positions.size(); ++f)
        for (size_t c = 0; c < 3; ++c) vertices[f][c] = h.vertex_begin[positions[f][c]] + h.birth_wedge[3 * f + c];
    for (uint32_t i = 0; i < h.split_count(); ++i) {
        if (applied[i] == 0) continue;
        std::fill(is_there.begin() + h.added_begin[i], is_there.begin() + h.added_begin[i + 1], uint8_t(1));
        for (uint32_t m = h.moved_begin[i]; m < h.moved_begin[i + 1]; ++m) {
            uint32_t face = h.moved[m] / kCorners, corner = h.moved[m] % kCorners;
            positions[face][corner] = h.new_position(i);
            vertices[face][corner] = h.vertex_begin[h.new_position(i)] + h.moved_wedge[m];
        }
    }
    CutFaces cut;
    for (uint32_t f = 0; f < is_there.size(); ++f) {
        if (is_there[f] == 0) continue;
        cut.face.push_back(f);
        cut.positions.push_back(positions[f]);
        cut.vertices.push_back(vertices[f]);
    }
    return cut;
}

double stated_error_m(const Hierarchy& h, const Applied& applied) {
    double error_m = double(h.finest_error_m);
    for (uint32_t i = 0; i < h.split_count(); ++i)
        if (applied[i] == 0) error_m = std::max(error_m, double(h.error_m[i]));
    return error_m;
}

uint64_t face_count_at(const Hierarchy& h, double error_m) {
    uint64_t count = h.base_face_count;
    for (uint32_t i = 0; i < h.split_count(); ++i)
        if (double(h.error_m[i]) > error_m || double(h.finest_error_m) > error_m) count += added_count(h, i);
    return count;
}

Applied random_cut(const Hierarchy& h, uint64_t face_count, uint64_t seed) {
    std::mt19937_64 random(seed);
    auto share = [&] { return double(random() >> 11) * 0x1p-53; };
    Applied applied(h.split_count(), 0);
    if (applied.empty()) return applied;
    glm::dvec3 low(1e300), high(-1e300);
    for (const glm::vec3& p : h.positions_m) low = glm::min(low, glm::dvec3(p)), high = glm::max(high, glm::dvec3(p));
    glm::dvec3 centre(h.positions_m[random() % h.positions_m.size()]);
    double falls_m = glm::length(high - low) * std::exp(-5 * share()), unevenness = share();
    std::vector<std::pair<double, uint32_t>> order;
    for (uint32_t i = 0; i < h.split_count(); ++i) {
        double away = glm::length(glm::dvec3(h.positions_m[h.owner[i]]) - centre) / falls_m;
        double noise = 1 + 0.5 * unevenness * (share() - 0.5);
        order.emplace_back(-(double(h.error_m[i]) + 1e-30) * noise * std::exp(-4 * unevenness * away), i);
    }
    std::sort(order.begin(), order.end());
    uint64_t faces = h.base_face_count;
    for (auto [key, i] : order) {
        if (faces >= face_count) break;
        faces += apply_with_needs(h, i, applied);
    }
    return applied;
}

}  // namespace overlook::caveclod
