#include "tools/bake/discrete/pieces.h"

#include <algorithm>
#include <limits>

#include "tools/bake/caveclod/disjoint_sets.h"
#include "tools/bake/mesh/faces.h"

namespace overlook::discrete {
namespace {

struct Component {
    uint64_t triangle_count = 0;
    bool is_thin = true;
    glm::dvec3 low_m{std::numeric_limits<double>::max()}, high_m{std::numeric_limits<double>::lowest()};

    void include(const glm::dvec3& at_m) { low_m = glm::min(low_m, at_m), high_m = glm::max(high_m, at_m); }
    double size_m() const { return glm::length(high_m - low_m); }
};

bool is_thin(const mesh::Surface& surface) {
    return surface.is_alpha_masked || surface.is_two_sided;
}

}  // namespace

mesh::Mesh part_of(const mesh::Mesh& mesh, const std::vector<uint8_t>& takes) {
    mesh::Mesh part = mesh;
    mesh::keep_faces(part, takes);
    std::vector<uint32_t> number(mesh.positions_m.size(), mesh::kNone), first_of_class(mesh.positions_m.size(), mesh::kNone);
    for (const mesh::Corners& face : part.faces)
        for (uint32_t p : face) number[p] = 0;
    std::vector<uint32_t> link;
    uint32_t count = 0;
    for (uint32_t p = 0; p < number.size(); ++p) {
        if (number[p] == mesh::kNone) continue;
        number[p] = count++;
        uint32_t& first = first_of_class[mesh.link.empty() ? p : mesh.link[p]];
        if (first == mesh::kNone) first = number[p];
        link.push_back(first);
    }
    (void)mesh::drop_unused_positions(part);
    if (!mesh.link.empty()) part.link = std::move(link);
    return part;
}

std::vector<uint8_t> find_cards(const mesh::Mesh& mesh, const CardOptions& options) {
    caveclod::DisjointSets sets(mesh.positions_m.size());
    for (const mesh::Corners& face : mesh.faces) sets.unite(face[0], face[1]), sets.unite(face[0], face[2]);
    for (uint32_t p = 0; p < mesh.link.size(); ++p) sets.unite(p, mesh.link[p]);
    std::vector<Component> components(mesh.positions_m.size());
    Component whole;
    for (size_t f = 0; f < mesh.faces.size(); ++f) {
        Component& component = components[sets.find(mesh.faces[f][0])];
        ++component.triangle_count;
        component.is_thin = component.is_thin && is_thin(mesh.surfaces[mesh.face_surface[f]]);
        for (size_t c = 0; c < 3; ++c)
            component.include(glm::dvec3(corner_m(mesh, f, c))), whole.include(glm::dvec3(corner_m(mesh, f, c)));
    }
    auto is_card = [&](const Component& c) {
        return c.triangle_count > 0 && c.is_thin && c.triangle_count <= options.most_triangles &&
               c.size_m() <= options.most_share_of_size * whole.size_m();
    };
    std::vector<uint8_t> marks(mesh.faces.size(), 0);
    if (uint64_t(std::count_if(components.begin(), components.end(), is_card)) < options.least_count) return marks;
    for (size_t f = 0; f < marks.size(); ++f) marks[f] = is_card(components[sets.find(mesh.faces[f][0])]);
    return marks;
}

}  // namespace overlook::discrete
