// What a collapse is expected to cost, before anything is measured.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/bake/caveclod/collapse_rules.h"
#include "tools/bake/caveclod/working_mesh.h"

namespace overlook::caveclod {

// Sum of weighted squared distances to planes (M. Garland, P. Heckbert, Surface Simplification Using Quadric Error Metrics,
// 1997).
struct Quadric {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0, x = 0, y = 0, z = 0, one = 0, weight = 0;

    void add_plane(const glm::dvec3& unit_normal, double offset, double plane_weight);
    void add(const Quadric& other);
    double at(const glm::dvec3& p) const;  // weight * mean squared distance
};

// [P] of the faces round each position by area, and of planes upright on its feature edges.
std::vector<Quadric> make_quadrics(const WorkingMesh& mesh);

// Faces that were refused for looking away from their source: that never changes, so no collapse that would make one again is
// worth measuring. By the position that would go.
class RefusedFaces {
  public:
    explicit RefusedFaces(size_t position_count) : first_(position_count, kNone) {}
    // Face `place` of the fan.
    void add(const Fan& fan, uint32_t place);
    bool has_one_of(const Fan& fan) const;

  private:
    struct Refused {
        uint32_t kept = kNone, second = kNone, third = kNone, next = kNone;
    };
    std::vector<uint32_t> first_;  // [P]
    std::vector<Refused> faces_;
};

// Where a position would best go.
struct Candidate {
    double cost_m = 0;
    uint32_t kept = kNone;   // none is allowed
    double bare_cost_m = 0;  // without what its seams shift
};

// The allowed collapse of `position` of least cost: the mean square of the kept position's distances to the planes of what has
// gone into `position`, and the square of the mean signed offset of the new faces (the volume they lose or win, over their area);
// never less than its seams shift. Only those whose bare cost is above `above_m` are looked at: what lies below was refused.
Candidate find_candidate(const WorkingMesh& mesh, std::span<const Quadric> quadrics, const RefusedFaces& refused,
                         uint32_t position, double above_m = -1);

// The same, of all its edges, allowed or not: never dearer than find_candidate's, and several times faster found. None where the
// position may not go at all.
Candidate guess_candidate(const WorkingMesh& mesh, std::span<const Quadric> quadrics, uint32_t position);

}  // namespace overlook::caveclod
