// Repair as a list of passes, and the laws that it keeps.

#include "tools/bake/mesh_repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "tools/bake/mesh/exact.h"
#include "tools/bake/mesh/faces.h"
#include "tools/bake/mesh/sheets.h"

namespace overlook::mesh {
namespace {

uint32_t root_of(std::vector<uint32_t>& parent, uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
}

std::string fault_of_indices(const Mesh& mesh) {
    const auto is_sized = [&](const std::vector<Corners>& corners) {
        return corners.empty() || corners.size() == mesh.faces.size();
    };
    if (!is_sized(mesh.face_normals) || !is_sized(mesh.face_uvs) || !is_sized(mesh.face_uvs2) || !is_sized(mesh.face_colours))
        return "an array by corner has not as many rows as there are faces";
    if (mesh.face_surface.size() != mesh.faces.size() || mesh.face_source.size() != mesh.faces.size())
        return "an array by face has not as many rows as there are faces";
    const auto fault = [](const std::vector<Corners>& corners, size_t count, bool may_be_none, const char* what) {
        for (size_t f = 0; f < corners.size(); ++f)
            for (const uint32_t i : corners[f])
                if (i >= count && !(may_be_none && i == kNone)) return fmt::format("face {} has {} {} of {}", f, what, i, count);
        return std::string();
    };
    for (const std::string& text :
         {fault(mesh.faces, mesh.positions_m.size(), false, "position"),
          fault(mesh.face_normals, mesh.normals.size(), true, "normal"), fault(mesh.face_uvs, mesh.uvs.size(), true, "uv"),
          fault(mesh.face_uvs2, mesh.uvs2.size(), true, "second uv"),
          fault(mesh.face_colours, mesh.colours.size(), true, "colour")})
        if (!text.empty()) return text;
    for (size_t f = 0; f < mesh.faces.size(); ++f) {
        if (mesh.face_surface[f] >= mesh.surfaces.size()) return fmt::format("face {} has surface {}", f, mesh.face_surface[f]);
        if (f > 0 && mesh.face_source[f] <= mesh.face_source[f - 1]) return fmt::format("face_source does not rise at {}", f);
    }
    return "";
}

std::string fault_of_edges(const Mesh& mesh) {
    const EdgeGroups groups = group_edges(mesh.faces, mesh.positions_m.size(), {});
    for (size_t i = 0; i < groups.size(); ++i) {
        const auto group = groups.group(i);
        const uint32_t a = start_of(mesh.faces, group[0]), b = end_of(mesh.faces, group[0]);
        if (group.size() > 2) return fmt::format("edge {}-{} has {} faces", a, b, group.size());
        if (group.size() == 2 && start_of(mesh.faces, group[1]) == a)
            return fmt::format("the two faces of edge {}-{} do not agree", a, b);
        if (group.size() == 2) {
            Corners f = mesh.faces[group[0] / 3], g = mesh.faces[group[1] / 3];
            std::sort(f.begin(), f.end()), std::sort(g.begin(), g.end());
            if (f == g) return fmt::format("faces {} and {} have the same positions", group[0] / 3, group[1] / 3);
        }
    }
    return "";
}

// Corners at each position, joined over edges, are one set.
std::string fault_of_fans(const Mesh& mesh) {
    const EdgeGroups groups = group_edges(mesh.faces, mesh.positions_m.size(), {});
    std::vector<uint32_t> fans(mesh.positions_m.size(), 0);
    for (const Corners& face : mesh.faces)
        for (const uint32_t p : face) ++fans[p];
    for (size_t p = 0; p < fans.size(); ++p)
        if (fans[p] == 0) return fmt::format("position {} is used by no face", p);
    // A set of n corners joined by n - 1 (open) or n (closed) pairs: count sets by union.
    std::vector<uint32_t> parent(3 * mesh.faces.size());
    for (uint32_t c = 0; c < parent.size(); ++c) parent[c] = c;
    const auto unite = [&](uint32_t a, uint32_t b) {
        a = root_of(parent, a), b = root_of(parent, b);
        if (a == b) return;
        parent[std::max(a, b)] = std::min(a, b);
        --fans[start_of(mesh.faces, a)];
    };
    for (size_t i = 0; i < groups.size(); ++i) {
        const auto group = groups.group(i);
        if (group.size() != 2) continue;
        unite(group[0], next_halfedge(group[1]));
        unite(group[1], next_halfedge(group[0]));
    }
    for (size_t p = 0; p < fans.size(); ++p)
        if (fans[p] != 1) return fmt::format("the faces at position {} form {} fans", p, fans[p]);
    return "";
}

}  // namespace

void repair(Mesh& mesh, MeshReport& report) {
    const std::vector<uint32_t> other_side = drop_bad_faces(mesh, report);
    report.unused_position_count += drop_unused_positions(mesh);
    cut(mesh, orient(mesh, other_side, report), report);

    report.face_count = mesh.faces.size();
    report.position_count = mesh.positions_m.size();
    std::sort(report.dropped.begin(), report.dropped.end(),
              [](const DroppedFace& a, const DroppedFace& b) { return a.source < b.source; });
    assert(report.triangle_count == report.face_count + report.dropped.size());
}

std::string first_fault(const Mesh& mesh) {
    if (mesh.surfaces.empty()) return "there is no surface";
    if (std::string fault = fault_of_indices(mesh); !fault.empty()) return fault;
    for (size_t f = 0; f < mesh.faces.size(); ++f)
        if (are_on_one_line(corner_m(mesh, f, 0), corner_m(mesh, f, 1), corner_m(mesh, f, 2)))
            return fmt::format("face {} has no area", f);
    if (std::string fault = fault_of_edges(mesh); !fault.empty()) return fault;
    if (std::string fault = fault_of_fans(mesh); !fault.empty()) return fault;
    if (!mesh.link.empty() && mesh.link.size() != mesh.positions_m.size()) return "link has not as many rows as positions";
    for (size_t p = 0; p < mesh.link.size(); ++p)
        if (mesh.link[p] > p || mesh.link[mesh.link[p]] != mesh.link[p] || mesh.positions_m[mesh.link[p]] != mesh.positions_m[p])
            return fmt::format("position {} is linked to {}", p, mesh.link[p]);
    return "";
}

}  // namespace overlook::mesh
