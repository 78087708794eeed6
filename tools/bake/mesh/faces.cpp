// Faces and edges by counting sorts.

#include "tools/bake/mesh/faces.h"

#include <algorithm>
#include <cassert>

namespace overlook::mesh {
namespace {

struct Entry {
    uint64_t key;  // layer, then the larger position
    uint32_t halfedge;
};

}  // namespace

EdgeGroups group_edges(std::span<const Corners> faces, size_t position_count, std::span<const uint8_t> layer) {
    const uint32_t halfedge_count = uint32_t(3 * faces.size());
    std::vector<uint32_t> begin(position_count + 1, 0);
    const auto lower = [&](uint32_t h) { return std::min(start_of(faces, h), end_of(faces, h)); };
    for (uint32_t h = 0; h < halfedge_count; ++h) ++begin[lower(h) + 1];
    for (size_t p = 0; p < position_count; ++p) begin[p + 1] += begin[p];

    std::vector<Entry> entries(halfedge_count);
    std::vector<uint32_t> at(begin.begin(), begin.end() - 1);
    for (uint32_t h = 0; h < halfedge_count; ++h) {
        const uint64_t upper = std::max(start_of(faces, h), end_of(faces, h));
        entries[at[lower(h)]++] = {(layer.empty() ? 0 : uint64_t(layer[h / 3]) << 32) | upper, h};
    }

    EdgeGroups groups;
    groups.halfedges.reserve(halfedge_count);
    groups.begin.reserve(halfedge_count / 2 + 1);
    for (size_t p = 0; p < position_count; ++p) {
        const auto first = entries.begin() + begin[p], last = entries.begin() + begin[p + 1];
        std::sort(first, last,
                  [](const Entry& a, const Entry& b) { return a.key != b.key ? a.key < b.key : a.halfedge < b.halfedge; });
        for (auto entry = first; entry != last; ++entry) {
            if (entry != first && entry[-1].key != entry->key) groups.begin.push_back(uint32_t(groups.halfedges.size()));
            groups.halfedges.push_back(entry->halfedge);
        }
        if (first != last) groups.begin.push_back(uint32_t(groups.halfedges.size()));
    }
    return groups;
}

void keep_faces(Mesh& mesh, std::span<const uint8_t> keep) {
    assert(keep.size() == mesh.faces.size());
    const auto compact = [&](auto& array) {
        size_t kept = 0;
        for (size_t i = 0; i < array.size(); ++i)
            if (keep[i]) array[kept++] = array[i];
        array.resize(kept);
    };
    for_each_corner_array(mesh, compact);
    compact(mesh.face_surface);
    compact(mesh.face_source);
}

void flip_face(Mesh& mesh, size_t face) {
    for_each_corner_array(mesh, [&](std::vector<Corners>& array) { std::swap(array[face][1], array[face][2]); });
}

size_t drop_unused_positions(Mesh& mesh) {
    std::vector<uint32_t> number(mesh.positions_m.size(), kNone);
    for (const Corners& face : mesh.faces)
        for (const uint32_t p : face) number[p] = 0;
    uint32_t kept = 0;
    for (size_t p = 0; p < number.size(); ++p) {
        if (number[p] == kNone) continue;
        mesh.positions_m[kept] = mesh.positions_m[p];
        number[p] = kept++;
    }
    const size_t dropped = mesh.positions_m.size() - kept;
    mesh.positions_m.resize(kept);
    for (Corners& face : mesh.faces)
        for (uint32_t& p : face) p = number[p];
    return dropped;
}

}  // namespace overlook::mesh
