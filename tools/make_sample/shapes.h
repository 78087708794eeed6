// Meshes put together from tubes, cards and boxes, with normals and texture coordinates at every corner.
#pragma once

#include <functional>

#include "tools/bake/mesh.h"

namespace overlook::sample {

class ShapeMaker {
  public:
    explicit ShapeMaker(std::vector<mesh::Surface> surfaces) { mesh_.surfaces = std::move(surfaces); }

    // A wall of rings x sides squares, closed round: at(share along it, angle in radians) is where it stands, counter-clockwise
    // seen from its end; with fans at its ends where has_ends. Normals are those of the wall, smooth.
    void add_tube(uint32_t surface, uint32_t rings, uint32_t sides, bool has_ends,
                  const std::function<glm::dvec3(double, double)>& at);
    // A round bar that becomes thinner or thicker.
    void add_bar(uint32_t surface, uint32_t rings, uint32_t sides, const glm::dvec3& from_m, const glm::dvec3& to_m,
                 double from_radius_m, double to_radius_m);
    // A square about middle_m, spanned by two half sides; its texture upright along the second.
    void add_card(uint32_t surface, const glm::dvec3& middle_m, const glm::dvec3& right_m, const glm::dvec3& up_m,
                  const glm::vec3& normal);
    // A parallelepiped about middle_m, spanned by three half sides (right-handed), each face of columns x rows squares.
    void add_box(uint32_t surface, const glm::dvec3& middle_m, const glm::dvec3& x_m, const glm::dvec3& y_m,
                 const glm::dvec3& z_m, uint32_t columns, uint32_t rows);

    const mesh::Mesh& mesh() const { return mesh_; }
    mesh::Mesh take() { return std::move(mesh_); }

  private:
    uint32_t add_position(const glm::dvec3& at_m);
    uint32_t add_normal(const glm::dvec3& normal);
    void add_face(uint32_t surface, const mesh::Corners& positions, const mesh::Corners& normals, const mesh::Corners& uvs);
    void add_fan(uint32_t surface, uint32_t first, uint32_t sides, bool is_end);

    mesh::Mesh mesh_;
};

// A direction at a right angle to `along` (of length 1).
glm::dvec3 side_of(const glm::dvec3& along);

}  // namespace overlook::sample
