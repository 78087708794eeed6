#include "tools/bake/discrete/ladder.h"

#include <fmt/format.h>

#include <cmath>

namespace overlook::discrete {

double LadderView::focal_px() const {
    return height_px / 2 / std::tan(fov_y_deg * 0.017453292519943295 / 2);
}
double LadderView::distance_m(double error_m) const {
    return error_m * (focal_px() / error_px + 1);
}
double LadderView::vanishing_m(double radius_m) const {
    return 2 * radius_m * focal_px();
}

std::vector<Verdict> choose_rungs(std::span<const Candidate> candidates, double radius_m, const LadderOptions& options) {
    std::vector<Verdict> verdicts(candidates.size());
    double vanishing_m = options.view.vanishing_m(radius_m);
    std::vector<size_t> kept;
    for (size_t i = 0; i < candidates.size(); ++i) {
        Verdict& verdict = verdicts[i];
        verdict.from_m = options.view.distance_m(candidates[i].error_m);
        // What is off by as much and has less takes the place of the one before.
        if (kept.size() > 1 && candidates[i].error_m <= candidates[kept.back()].error_m) {
            verdicts[kept.back()] = {false, verdict.from_m, verdict.from_m, "the next one is as near with fewer triangles"};
            kept.pop_back();
        }
        if (!kept.empty()) {
            double saving = double(candidates[kept.back()].triangle_count) / double(candidates[i].triangle_count);
            if (saving < options.least_saving) {
                verdict.why =
                    fmt::format("has 1/{:.2f} of the triangles of the one before, 1/{:g} is asked", saving, options.least_saving);
                continue;
            }
            if (verdict.from_m >= vanishing_m) {
                verdict.why = fmt::format("would serve from {:.4g} m on, where all of it is less than a pixel", verdict.from_m);
                continue;
            }
            if (kept.size() == options.most_levels) {
                verdict.why = fmt::format("there are {} levels already", options.most_levels);
                continue;
            }
        }
        verdict.is_kept = true;
        kept.push_back(i);
    }
    for (size_t k = 0; k < kept.size(); ++k) {
        Verdict& verdict = verdicts[kept[k]];
        verdict.to_m = k + 1 < kept.size() ? verdicts[kept[k + 1]].from_m : vanishing_m;
        verdict.why = fmt::format("the choice from {:.4g} m to {:.4g} m", verdict.from_m, verdict.to_m);
    }
    return verdicts;
}

}  // namespace overlook::discrete
