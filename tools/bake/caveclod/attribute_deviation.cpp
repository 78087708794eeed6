#include "tools/bake/caveclod/attribute_deviation.h"

#include <algorithm>
#include <cmath>

#include "tools/bake/caveclod/distances.h"

namespace overlook::caveclod {
namespace {

// Metres for each metre that the texture slides, and for each radian and each whole step of colour over a metre of width.
constexpr double kTexture = 0.5, kNormal = 1.0 / 16, kColour = 1.0 / 8;

glm::dvec3 colour_of(const RenderVertex& v) {
    return glm::dvec3(v.colour[0], v.colour[1], v.colour[2]) / 255.0;
}

// Metres of surface for each unit of texture coordinate; 0 where the texture has no area there.
double metres_per_uv(const RenderVertex& a, const RenderVertex& b, const RenderVertex& c, double area2_m2) {
    glm::dvec2 u(b.uv - a.uv), v(c.uv - a.uv);
    double uv2 = std::abs(u.x * v.y - u.y * v.x);
    return uv2 > 0 ? std::sqrt(area2_m2 / uv2) : 0;
}

}  // namespace

double attribute_deviation_m(const WorkingMesh& mesh, const Fan& fan, const TurnedVertices& turned, uint32_t place) {
    uint32_t corner = fan.corner[place];
    const RenderVertex& was = mesh.look(mesh.vertex(corner));
    const RenderVertex& a = mesh.look(turned[place]);
    const RenderVertex& b = mesh.look(mesh.vertex(next_corner(corner)));
    const RenderVertex& c = mesh.look(mesh.vertex(previous_corner(corner)));
    glm::dvec3 at_a = mesh.at(fan.kept), at_b = mesh.at(fan.link[place]), at_c = mesh.at(fan.link[place + 1]);
    glm::dvec3 w = weights_at(mesh.at(fan.gone), at_a, at_b, at_c);
    double area2_m2 = glm::length(glm::cross(at_b - at_a, at_c - at_a)), width_m = std::sqrt(area2_m2);
    glm::dvec3 normal = glm::dvec3(a.normal) * w.x + glm::dvec3(b.normal) * w.y + glm::dvec3(c.normal) * w.z;
    double length = glm::length(normal);
    double turn = length > 0 ? glm::length(normal / length - glm::dvec3(was.normal)) : 2;
    glm::dvec2 slide = glm::dvec2(a.uv) * w.x + glm::dvec2(b.uv) * w.y + glm::dvec2(c.uv) * w.z - glm::dvec2(was.uv);
    glm::dvec3 fade = colour_of(a) * w.x + colour_of(b) * w.y + colour_of(c) * w.z - colour_of(was);
    double texture_m = kTexture * glm::length(slide) * metres_per_uv(a, b, c, area2_m2);
    return std::max({texture_m, kNormal * turn * width_m, kColour * glm::length(fade) * width_m});
}

}  // namespace overlook::caveclod
