#include "tools/bake/caveclod/groups.h"

#include <algorithm>
#include <numeric>

#include "formats/parallel.h"
#include "tools/bake/caveclod/corner_normals.h"
#include "tools/bake/caveclod/disjoint_sets.h"
#include "tools/bake/caveclod/mesh_edges.h"
#include "tools/bake/caveclod/packing.h"
#include "tools/bake/caveclod/position_kinds.h"

namespace overlook::caveclod {
namespace {

// What a corner looks like: equal or not, nothing between.
struct Look {
    glm::vec3 normal;
    glm::vec2 uv, uv2;
    std::array<uint8_t, 4> colour;
    bool operator==(const Look&) const = default;
};

class Looks {
  public:
    Looks(const mesh::Mesh& mesh, const MeshEdges& edges, const GroupOptions& options)
        : mesh_(mesh),
          normals_(corner_normals(mesh, edges, options.crease_deg, options.weld_normals_deg)),
          has_uv_(!options.ignores_uv && !mesh.face_uvs.empty()),
          has_uv2_(!options.ignores_uv && !mesh.face_uvs2.empty()) {}

    Look at(uint32_t corner) const {
        Look look{normals_[corner], glm::vec2(0), glm::vec2(0), {255, 255, 255, 255}};
        if (has_uv_) look.uv = picked(mesh_.uvs, mesh_.face_uvs, corner);
        if (has_uv2_) look.uv2 = picked(mesh_.uvs2, mesh_.face_uvs2, corner);
        if (mesh_.face_colours.empty()) return look;
        uint32_t index = value_at(mesh_.face_colours, corner);
        if (index != mesh::kNone) look.colour = mesh_.colours[index];
        return look;
    }
    bool has_uv2() const { return has_uv2_; }

  private:
    static glm::vec2 picked(const std::vector<glm::vec2>& pool, Corners indices, uint32_t corner) {
        uint32_t index = value_at(indices, corner);
        return index == mesh::kNone ? glm::vec2(0) : pool[index] + glm::vec2(0);  // -0 becomes 0
    }

    const mesh::Mesh& mesh_;
    std::vector<glm::vec3> normals_;
    bool has_uv_, has_uv2_;
};

// [3F] 1 on edges where both faces have one surface and, at both ends, one look.
std::vector<uint8_t> find_smooth_edges(const mesh::Mesh& mesh, const MeshEdges& edges, const Looks& looks) {
    std::vector<uint8_t> is_smooth(edges.twin.size(), 0);
    parallel_ranges(is_smooth.size(), 1 << 14, [&](size_t begin, size_t end) {
        for (uint32_t edge = uint32_t(begin); edge < end; ++edge) {
            uint32_t twin = edges.twin[edge];
            if (twin == kNoTwin || mesh.face_surface[face_of(edge)] != mesh.face_surface[face_of(twin)]) continue;
            is_smooth[edge] = looks.at(edge) == looks.at(next_corner(twin)) && looks.at(next_corner(edge)) == looks.at(twin);
        }
    });
    return is_smooth;
}

void number_groups(const mesh::Mesh& mesh, const MeshEdges& edges, std::span<const uint8_t> is_smooth, Groups& groups) {
    DisjointSets regions(mesh.faces.size());
    for (uint32_t edge = 0; edge < is_smooth.size(); ++edge)
        if (is_smooth[edge]) regions.unite(face_of(edge), face_of(edges.twin[edge]));
    groups.face_group.resize(mesh.faces.size());
    for (uint32_t face = 0; face < mesh.faces.size(); ++face) {
        uint32_t first = regions.find(face);
        if (first == face) {
            groups.face_group[face] = uint32_t(groups.group_surface.size());
            groups.group_surface.push_back(mesh.face_surface[face]);
        } else {
            groups.face_group[face] = groups.face_group[first];
        }
    }
}

// A vertex for each fan of corners that are joined over smooth edges, in the rows of their positions.
void make_vertices(const mesh::Mesh& mesh, const MeshEdges& edges, std::span<const uint8_t> is_smooth, const Looks& looks,
                   Groups& groups) {
    DisjointSets fans(is_smooth.size());
    for (uint32_t edge = 0; edge < is_smooth.size(); ++edge)
        if (is_smooth[edge]) fans.unite(edge, next_corner(edges.twin[edge]));

    groups.vertex_begin.assign(mesh.positions_m.size() + 1, 0);
    for (uint32_t corner = 0; corner < is_smooth.size(); ++corner)
        if (fans.find(corner) == corner) ++groups.vertex_begin[value_at(mesh.faces, corner) + 1];
    for (size_t i = 0; i < mesh.positions_m.size(); ++i) {
        groups.most_vertices = std::max(groups.most_vertices, groups.vertex_begin[i + 1]);
        groups.vertex_begin[i + 1] += groups.vertex_begin[i];
    }

    std::vector<uint32_t> cursor(groups.vertex_begin.begin(), groups.vertex_begin.end() - 1);
    groups.vertices.resize(groups.vertex_begin.back());
    groups.vertex_group.resize(groups.vertices.size());
    if (looks.has_uv2()) groups.vertex_uv2.resize(groups.vertices.size());
    groups.face_vertices.resize(mesh.faces.size());
    for (uint32_t corner = 0; corner < is_smooth.size(); ++corner) {
        uint32_t& vertex = groups.face_vertices[face_of(corner)][corner % 3];
        uint32_t first = fans.find(corner), position = value_at(mesh.faces, corner);
        vertex = first == corner ? cursor[position]++ : value_at(groups.face_vertices, first);
        if (first != corner) continue;
        Look look = looks.at(corner);
        groups.vertices[vertex] = {position, look.normal, look.uv, look.colour};
        groups.vertex_group[vertex] = groups.face_group[face_of(corner)];
        if (looks.has_uv2()) groups.vertex_uv2[vertex] = look.uv2;
    }
}

// The groups at each position, each once; counts positions at which one of them has vertices that differ.
GroupsAtPositions gather_groups(Groups& groups) {
    GroupsAtPositions at;
    at.begin.assign(groups.vertex_begin.size(), 0);
    at.groups.reserve(groups.vertices.size());
    std::vector<uint32_t> row;
    for (size_t position = 0; position + 1 < groups.vertex_begin.size(); ++position) {
        uint32_t begin = groups.vertex_begin[position], end = groups.vertex_begin[position + 1];
        row.resize(end - begin);
        std::iota(row.begin(), row.end(), begin);
        std::sort(row.begin(), row.end(), [&](uint32_t a, uint32_t b) {
            return groups.vertex_group[a] != groups.vertex_group[b] ? groups.vertex_group[a] < groups.vertex_group[b] : a < b;
        });
        bool is_ambiguous = false;
        for (size_t i = 0; i < row.size(); ++i) {
            bool is_new = i == 0 || groups.vertex_group[row[i]] != groups.vertex_group[row[i - 1]];
            if (is_new) at.groups.push_back(groups.vertex_group[row[i]]);
            if (is_new) continue;
            is_ambiguous |= !(groups.vertices[row[i]] == groups.vertices[row[i - 1]]);
            if (!groups.vertex_uv2.empty()) is_ambiguous |= groups.vertex_uv2[row[i]] != groups.vertex_uv2[row[i - 1]];
        }
        groups.ambiguous_count += is_ambiguous;
        at.begin[position + 1] = uint32_t(at.groups.size());
    }
    return at;
}

void fill_figures(const GroupsAtPositions& at, Groups& groups) {
    uint64_t position_count = groups.kind.size(), dense_count = groups.packed_count * position_count;
    groups.dense_bytes = 4 * dense_count;
    groups.dense_population = dense_count > 0 ? double(at.groups.size()) / double(dense_count) : 0;
    groups.rows_bytes = 4 * (position_count + 1) + 4 * groups.vertices.size();
}

Result<Packing> pack(Groups& groups) {
    GroupsAtPositions at = gather_groups(groups);
    Result<Packing> packing = pack_groups(at, uint32_t(groups.group_surface.size()));
    if (!packing) return packing;
    groups.packed_count = packing->count;
    groups.clique_bound = packing->clique_bound;
    fill_figures(at, groups);
    return packing;
}

uint64_t count_fixed_faces(Corners faces, const Groups& groups) {
    auto is_rigid = [&](uint32_t position) { return groups.kind[position] == PositionKind::rigid; };
    return uint64_t(std::count_if(faces.begin(), faces.end(), [&](const std::array<uint32_t, 3>& corners) {
        return is_rigid(corners[0]) && is_rigid(corners[1]) && is_rigid(corners[2]);
    }));
}

}  // namespace

Result<Groups> find_groups(const mesh::Mesh& mesh, const GroupOptions& options) {
    uint32_t position_count = uint32_t(mesh.positions_m.size());
    MeshEdges edges = edges_of(mesh.faces, position_count);
    Looks looks(mesh, edges, options);
    std::vector<uint8_t> is_smooth = find_smooth_edges(mesh, edges, looks);

    Groups groups;
    number_groups(mesh, edges, is_smooth, groups);
    classify_positions(mesh.faces, edges, is_smooth, mesh.link, position_count, groups);
    make_vertices(mesh, edges, is_smooth, looks, groups);

    // Each fills fields of its own, and reads none of the others'.
    Result<Packing> packing;
    parallel_ranges(3, 1, [&](size_t part, size_t) {
        if (part == 0) packing = pack(groups);
        if (part == 1) groups.floor_face_estimate = least_face_count(mesh.faces, edges, groups);
        if (part == 2) groups.budgeted_floor_face_estimate = least_face_count(mesh.faces, edges, with_borders_alone(groups));
    });
    if (!packing) return tl::unexpected(packing.error());
    groups.group_packed = std::move(packing->packed);
    groups.fixed_face_count = count_fixed_faces(mesh.faces, groups);
    return groups;
}

}  // namespace overlook::caveclod
