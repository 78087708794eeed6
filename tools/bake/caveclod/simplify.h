// From a mesh to the hierarchy of its collapses, with a proven error for each.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "formats/caveclod.h"
#include "formats/result.h"
#include "tools/bake/caveclod/collapse_rules.h"
#include "tools/bake/caveclod/groups.h"
#include "tools/bake/caveclod/seam_error.h"
#include "tools/bake/mesh.h"

namespace overlook::caveclod {

struct SimplifyOptions {
    uint64_t least_face_count = 0;  // stops at so many; 0: when nothing more may be collapsed
    SeamBudget seams;
    // Collapses that thin what is thin beside the mesh are stated at several times what they take (thickness.h), so that masts
    // and railings are kept until they are a fraction of a pixel wide. The bound holds as before, but is no longer tight there.
    bool keeps_thin = false;
};

// One face corner that a collapse turns, or the corner at the gone position of a face that goes (then `to_vertex` is kNobody's).
struct Turn {
    uint32_t corner = 0, from_vertex = 0, to_vertex = 0;
};

// The collapses in the order in which they were made, as rows.
struct CollapseLog {
    std::vector<uint32_t> gone, kept;     // [S] positions
    std::vector<float> error_m;           // [S] each collapse's own, rounded up
    std::vector<uint32_t> turn_begin{0};  // [S + 1]
    std::vector<Turn> turns;
};

struct SimplifyReport {
    uint64_t pass_count = 0, collapse_count = 0, postponed_count = 0, refused_count = 0;
    uint32_t depth = 0;  // of the longest chain of splits that need one another
    uint64_t need_count = 0;
    HindranceCounts hindrances{};    // positions of the coarsest cut by what keeps them
    std::vector<float> own_error_m;  // [S] what each split's collapse was measured at; the hierarchy's error_m is never less
    double greatest_error_m = 0;
    SeamError seam_error;  // the worst of any face that a cut can hold
    double greatest_seam_shift_m = 0;
    uint64_t carried_count = 0;  // corners that took attributes along
    double topology_s = 0, candidates_s = 0, selection_s = 0, measuring_s = 0, applying_s = 0, rows_s = 0;
};

// Collapses all that the rules allow, cheapest first, in passes of collapses that do not touch one another, so that the splits'
// needs are shallow and a pass can be shared by threads.
//
// mesh, groups: of the same mesh, as find_groups gives them; every promise of Mesh kept. The hierarchy has positions, splits with
// errors and needs, faces and render vertices; formats/caveclod.h's complete() fills the rest. error_m is the greatest distance
// that SurfaceMap moves a point of the source over all that the split touches, rounded up and saturated over needs: an upper
// bound of the two-sided distance, whatever else is drawn. Where seams move, it is never less than how far a corner's attributes
// have been carried from where the source has them; where thin things are kept, never less than kThinningWeight times what is
// taken of one. Positions are the mesh's own; quantising them afterwards adds what it moves (add_displacement). Same mesh, same
// hierarchy, for any number of threads. O(F log F) and about 900 bytes a face. Fails with Exit::bad_input where the mesh is not a
// surface: "face 12 cannot be added: an edge of it has two faces already, or the faces at a corner are no fan". `progress` is
// called with the share done, 0..1, from this thread.
Result<Hierarchy> build_hierarchy(
    const mesh::Mesh& mesh, const Groups& groups, const SimplifyOptions& options, SimplifyReport* report = nullptr,
    const std::function<void(double)>& progress = [](double) {});

// Where positions have moved by at most displacement_m since the errors were measured: every point of every face has moved by no
// more, so all errors, and that of the finest cut, grow by it.
void add_displacement(Hierarchy& hierarchy, double displacement_m);

}  // namespace overlook::caveclod
