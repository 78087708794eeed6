// Which levels a chain has: a rung stays only if some distance of the view asks for it and it is much cheaper than the one
// before.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace overlook::discrete {

// The view that levels are chosen for.
struct LadderView {
    double height_px = 1080, fov_y_deg = 60;  // of the picture
    double error_px = 1;                      // what may be displaced in it
    double focal_px() const;
    // From this distance on something that is off by error_m is off by error_px at most, in the middle of the picture; measured
    // to the nearest point of the thing.
    double distance_m(double error_m) const;
    // From here on all of a sphere is less than a pixel.
    double vanishing_m(double radius_m) const;
};

struct LadderOptions {
    double factor = 2;             // in triangles, between candidates; above 1
    double least_saving = 1.4;     // a rung has at most a this-th of the triangles of the one before
    uint32_t most_levels = 16;     // 1..kMostLevels
    uint64_t least_triangles = 8;  // coarser candidates are not tried
    LadderView view;
};

// A candidate, finest first.
struct Candidate {
    uint64_t triangle_count = 0;
    double error_m = 0;
};
struct Verdict {
    bool is_kept = false;
    double from_m = 0,
           to_m = 0;  // kept: the distances that ask for it; to_m of the coarsest: where the thing is less than a pixel
    std::string why;  // a sentence
};
// [candidates] The first always stays: nothing else is right near by. Errors ascend.
std::vector<Verdict> choose_rungs(std::span<const Candidate> candidates, double radius_m, const LadderOptions& options);

}  // namespace overlook::discrete
