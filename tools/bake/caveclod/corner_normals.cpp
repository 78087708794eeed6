#include "tools/bake/caveclod/corner_normals.h"

#include <cmath>

#include "formats/parallel.h"
#include "tools/bake/caveclod/disjoint_sets.h"

namespace overlook::caveclod {
namespace {

constexpr size_t kGrain = 1 << 13;

glm::dvec3 position(const mesh::Mesh& mesh, uint32_t corner) {
    return glm::dvec3(mesh.positions_m[value_at(mesh.faces, corner)]);
}

// Zero stays zero.
glm::dvec3 unit(const glm::dvec3& v) {
    double length = std::sqrt(glm::dot(v, v));
    return length > 0 && std::isfinite(length) ? v / length : glm::dvec3(0);
}

glm::dvec3 face_normal(const mesh::Mesh& mesh, uint32_t face) {
    glm::dvec3 a = position(mesh, 3 * face);
    return unit(glm::cross(position(mesh, 3 * face + 1) - a, position(mesh, 3 * face + 2) - a));
}

// The file's own normals of length 1; zero where it has none to use.
std::vector<glm::vec3> own_normals(const mesh::Mesh& mesh) {
    std::vector<glm::vec3> normals(mesh.faces.size() * 3, glm::vec3(0));
    if (mesh.face_normals.empty()) return normals;
    parallel_ranges(normals.size(), kGrain, [&](size_t begin, size_t end) {
        for (size_t corner = begin; corner < end; ++corner) {
            uint32_t index = value_at(mesh.face_normals, uint32_t(corner));
            if (index == mesh::kNone) continue;
            glm::vec3 stored = mesh.normals[index] + glm::vec3(0);  // -0 becomes 0
            glm::dvec3 exact(stored);
            bool is_unit = std::abs(glm::dot(exact, exact) - 1) <= 2e-6;
            normals[corner] = is_unit ? stored : glm::vec3(unit(exact));
        }
    });
    return normals;
}

bool is_set(const glm::vec3& normal) {
    return normal != glm::vec3(0);
}

// Calls join(corner, corner beside it at the same position) at both ends of every edge between two faces.
template <class Join>
void for_neighbours(const MeshEdges& edges, const Join& join) {
    for (uint32_t edge = 0; edge < edges.twin.size(); ++edge) {
        uint32_t twin = edges.twin[edge];
        if (twin == kNoTwin || twin < edge) continue;
        join(edge, next_corner(twin));
        join(next_corner(edge), twin);
    }
}

// (a x b) / (|a|^2 |b|^2) of the two edges at the corner.
glm::dvec3 weighted_normal(const mesh::Mesh& mesh, uint32_t corner) {
    glm::dvec3 here = position(mesh, corner);
    glm::dvec3 a = position(mesh, next_corner(corner)) - here, b = position(mesh, next_corner(next_corner(corner))) - here;
    double scale = glm::dot(a, a) * glm::dot(b, b);
    return scale > 0 ? glm::cross(a, b) / scale : glm::dvec3(0);
}

void make_missing(const mesh::Mesh& mesh, const MeshEdges& edges, double crease_deg, std::vector<glm::vec3>& normals) {
    std::vector<glm::dvec3> of_faces(mesh.faces.size());
    parallel_ranges(of_faces.size(), kGrain, [&](size_t begin, size_t end) {
        for (size_t face = begin; face < end; ++face) of_faces[face] = face_normal(mesh, uint32_t(face));
    });

    DisjointSets fans(normals.size());
    double least_cosine = crease_deg >= 180 ? -2 : std::cos(crease_deg * 3.14159265358979323846 / 180) - 1e-9;
    for_neighbours(edges, [&](uint32_t a, uint32_t b) {
        bool is_smooth = glm::dot(of_faces[face_of(a)], of_faces[face_of(b)]) >= least_cosine;
        if (is_smooth && !is_set(normals[a]) && !is_set(normals[b])) fans.unite(a, b);
    });

    std::vector<glm::dvec3> sums(normals.size(), glm::dvec3(0));
    for (uint32_t corner = 0; corner < normals.size(); ++corner)
        if (!is_set(normals[corner])) sums[fans.find(corner)] += weighted_normal(mesh, corner);
    for (uint32_t corner = 0; corner < normals.size(); ++corner) {
        if (is_set(normals[corner])) continue;
        glm::vec3 made(unit(sums[fans.find(corner)]));
        if (!is_set(made)) made = glm::vec3(of_faces[face_of(corner)]);
        normals[corner] = is_set(made) ? made + glm::vec3(0) : glm::vec3(0, 0, 1);
    }
}

void weld(const MeshEdges& edges, double weld_deg, std::vector<glm::vec3>& normals) {
    double least_cosine = std::cos(weld_deg * 3.14159265358979323846 / 180) - 1e-9;
    auto is_near = [&](const glm::dvec3& a, const glm::dvec3& b) { return glm::dot(unit(a), unit(b)) >= least_cosine; };
    DisjointSets fans(normals.size());
    for_neighbours(edges, [&](uint32_t a, uint32_t b) {
        if (is_near(normals[a], normals[b])) fans.unite(a, b);
    });

    std::vector<glm::dvec3> sums(normals.size(), glm::dvec3(0));
    std::vector<uint8_t> is_mixed(normals.size(), 0), turns_too_far(normals.size(), 0);
    for (uint32_t corner = 0; corner < normals.size(); ++corner) {
        uint32_t fan = fans.find(corner);
        sums[fan] += glm::dvec3(normals[corner]);
        if (normals[corner] != normals[fan]) is_mixed[fan] = 1;
    }
    for (uint32_t corner = 0; corner < normals.size(); ++corner)
        if (!is_near(sums[fans.find(corner)], normals[corner])) turns_too_far[fans.find(corner)] = 1;
    for (uint32_t corner = 0; corner < normals.size(); ++corner) {
        uint32_t fan = fans.find(corner);
        if (is_mixed[fan] && !turns_too_far[fan]) normals[corner] = glm::vec3(unit(sums[fan])) + glm::vec3(0);
    }
}

}  // namespace

std::vector<glm::vec3> corner_normals(const mesh::Mesh& mesh, const MeshEdges& edges, double crease_deg, double weld_deg) {
    std::vector<glm::vec3> normals = own_normals(mesh);
    make_missing(mesh, edges, crease_deg, normals);
    if (weld_deg > 0) weld(edges, weld_deg, normals);
    return normals;
}

}  // namespace overlook::caveclod
