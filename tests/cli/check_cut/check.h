// Is a mesh a sound cut of a raster within a tolerance?
#pragma once

#include <cstdint>
#include <string>

#include "tests/cli/check_cut/files.h"

namespace check_cut {

struct Report {
    uint64_t triangles = 0;
    uint64_t samples_covered = 0;
    uint64_t valid_samples_uncovered = 0;  // counted, not wrong by itself
    double greatest_deviation_m = 0;
    // All below must be 0.
    uint64_t misplaced_corners = 0;  // not on a sample of the raster
    uint64_t turned_triangles = 0;   // without area, or seen from below
    uint64_t samples_beyond_tolerance = 0;
    uint64_t voids_covered = 0;          // pairs of a triangle and a void sample inside it or on its border
    uint64_t wrongly_covered_cells = 0;  // finest triangles of three valid samples not covered exactly once, and others covered
    uint64_t open_interior_edges =
        0;  // of one triangle, neither on the raster's border nor a side of a finest triangle with a void corner
    uint64_t overused_edges = 0;        // of more than two triangles, or twice in the same direction
    uint64_t wrong_boundary_steps = 0;  // where the mesh's boundary is not that of the finest triangles of three valid samples

    bool is_sound() const {
        return misplaced_corners + turned_triangles + samples_beyond_tolerance + voids_covered + wrongly_covered_cells +
                   open_interior_edges + overused_edges + wrong_boundary_steps ==
               0;
    }
};

// Goes over every sample, every finest triangle and every edge. The finest triangulation cuts each cell of four samples by the
// diagonal through its corner whose column and row are both odd.
Report check(const Mesh& mesh, const Raster& raster, double tolerance_m);

// One line of JSON.
std::string to_json(const Report& report);

}  // namespace check_cut
