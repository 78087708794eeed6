#include "tools/bake/caveclod/spatial_order.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace overlook::caveclod {
namespace {

// 21 bits, each followed by two zeros.
uint64_t spread(uint64_t bits) {
    bits = (bits | bits << 32) & 0x1f00000000ffffu;
    bits = (bits | bits << 16) & 0x1f0000ff0000ffu;
    bits = (bits | bits << 8) & 0x100f00f00f00f00fu;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3u;
    return (bits | bits << 2) & 0x1249249249249249u;
}

}  // namespace

std::vector<uint32_t> order_along_curve(std::span<const glm::vec3> positions_m) {
    glm::dvec3 low(std::numeric_limits<double>::max()), high(-low);
    for (const glm::vec3& p : positions_m) low = glm::min(low, glm::dvec3(p)), high = glm::max(high, glm::dvec3(p));
    double size = std::max({high.x - low.x, high.y - low.y, high.z - low.z}), scale = size > 0 ? 2097151 / size : 0;
    std::vector<std::pair<uint64_t, uint32_t>> keys;
    keys.reserve(positions_m.size());
    for (uint32_t p = 0; p < positions_m.size(); ++p) {
        glm::dvec3 at = (glm::dvec3(positions_m[p]) - low) * scale;
        keys.emplace_back(spread(uint64_t(at.x)) | spread(uint64_t(at.y)) << 1 | spread(uint64_t(at.z)) << 2, p);
    }
    std::sort(keys.begin(), keys.end());
    std::vector<uint32_t> order;
    order.reserve(keys.size());
    for (auto [key, p] : keys) order.push_back(p);
    return order;
}

std::vector<uint32_t> order_by_least_corner(std::span<const mesh::Corners> faces, std::span<const uint32_t> rank) {
    std::vector<uint32_t> begin(rank.size() + 1, 0), order(faces.size());
    auto least = [&](const mesh::Corners& f) { return std::min({rank[f[0]], rank[f[1]], rank[f[2]]}); };
    for (const mesh::Corners& f : faces) ++begin[least(f) + 1];
    for (size_t p = 1; p < begin.size(); ++p) begin[p] += begin[p - 1];
    for (uint32_t f = 0; f < faces.size(); ++f) order[begin[least(faces[f])]++] = f;
    return order;
}

}  // namespace overlook::caveclod
