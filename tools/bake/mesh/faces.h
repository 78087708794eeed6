// Faces with all that belongs to them, and their edges.
#pragma once

#include <span>
#include <vector>

#include "tools/bake/mesh.h"

namespace overlook::mesh {

// Halfedge 3 f + k goes from corner k of face f to the next one.
constexpr uint32_t next_halfedge(uint32_t h) {
    return h % 3 == 2 ? h - 2 : h + 1;
}
constexpr uint32_t previous_halfedge(uint32_t h) {
    return h % 3 == 0 ? h + 2 : h - 1;
}
inline uint32_t start_of(std::span<const Corners> faces, uint32_t h) {
    return faces[h / 3][h % 3];
}
inline uint32_t end_of(std::span<const Corners> faces, uint32_t h) {
    return start_of(faces, next_halfedge(h));
}

// Halfedges that join the same two positions, whichever way they go: group i is halfedges[begin[i] .. begin[i + 1]), rising.
struct EdgeGroups {
    std::vector<uint32_t> halfedges;
    std::vector<uint32_t> begin{0};

    size_t size() const { return begin.size() - 1; }
    std::span<const uint32_t> group(size_t i) const { return std::span(halfedges).subspan(begin[i], begin[i + 1] - begin[i]); }
};

// Groups the halfedges of faces [F] with indices below position_count. Faces of different layers ([F]; or empty: all of one)
// share no group. O(F + P) but for positions of very many faces.
EdgeGroups group_edges(std::span<const Corners> faces, size_t position_count, std::span<const uint8_t> layer);

// Drops the faces whose mark is 0, with all that belongs to them. keep: [F].
void keep_faces(Mesh& mesh, std::span<const uint8_t> keep);
// Turns a face round: corners 1 and 2 change places.
void flip_face(Mesh& mesh, size_t face);
// Drops positions that no face uses, keeping the order of the others. Returns how many.
size_t drop_unused_positions(Mesh& mesh);

// Every face's corners in each of the mesh's per-corner arrays.
template <class Do>
void for_each_corner_array(Mesh& mesh, const Do& act) {
    for (std::vector<Corners>* array : {&mesh.faces, &mesh.face_normals, &mesh.face_uvs, &mesh.face_uvs2, &mesh.face_colours})
        if (!array->empty()) act(*array);
}

}  // namespace overlook::mesh
