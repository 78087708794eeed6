// What it costs to move a seam: where a corner finds no render vertex of its own group, it carries its attributes along, and the
// seam goes with it.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "tools/bake/caveclod/collapse_rules.h"
#include "tools/bake/caveclod/working_mesh.h"

namespace overlook::caveclod {

// How wrong attributes may be in faces that a seam has moved over. Everywhere else corners are the source's own.
struct SeamBudget {
    bool moves = false;  // false: the strict rule, and nothing below counts
    double uv_texels = 1;
    double normal_deg = 10;
    std::vector<glm::dvec2> texture_px;  // [surfaces] width and height of each one's texture; kTextureSize_px where it is missing
};
constexpr double kTextureSize_px = 1024;  // of a surface without a texture

struct SeamError {
    double uv_texels = 0, normal_deg = 0;

    void include(const SeamError& other);
    bool is_within(const SeamBudget& budget) const;
};

// Between two looks of one surface: texture coordinates in texels of its texture, normals by their angle.
SeamError between(const RenderVertex& a, const RenderVertex& b, const glm::dvec2& texture_px);

// What is drawn at the point of a triangle that is nearest to p (in its plane, drawn into it).
RenderVertex interpolated(const glm::dvec3& p, const std::array<glm::dvec3, 3>& at,
                          const std::array<const RenderVertex*, 3>& looks);

// How far the attributes that the fan's turned corners carry are from where they belong: the distance between the kept position
// and the one that each was taken from, at the most; 0 where none is carried. Metres.
double seam_shift_m(const WorkingMesh& mesh, const Fan& fan, const TurnedVertices& turned);

// The error of the faces that the collapse turns and in which some corner carries its attributes: what is drawn under each source
// position of the face's own group that is placed in it (placed[i] in face places[i] of the fan), and under those positions that
// its corners' attributes were taken from, against the source's own render vertex there. Measured against the source each time,
// so nothing adds up: every version of a face that a cut can hold has been measured when it was made. Cost: linear in `placed`.
SeamError seam_error(const WorkingMesh& mesh, const Fan& fan, const TurnedVertices& turned, std::span<const uint32_t> placed,
                     std::span<const uint32_t> places, const SeamBudget& budget);

}  // namespace overlook::caveclod
