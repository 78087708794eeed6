// A cut that depends on the camera alone.
#include <algorithm>
#include <bit>

#include "runtime/caveclod/refine.h"
#include "runtime/caveclod/refine_frame.h"
#include "runtime/caveclod/screen_test.h"

namespace overlook::caveclod {

// Splits are asked for by their spheres, which need not hold those of what needs them: one that nobody would split any more may
// stay, because another that is wanted stands on it. A fresh refinement would never have come to that one. So all that is applied is
// asked anew, coarse to fine, and whatever is not wanted is undone with all that stands on it.
void Refinement::undo_unwanted(Frame& frame) {
    Bits kept(applied_.size(), 0);
    std::vector<uint32_t> unwanted;
    for (size_t word = 0; word < applied_.size(); ++word) {
        for (uint64_t left = applied_[word]; left != 0; left &= left - 1) {
            uint32_t split = uint32_t(64 * word) + uint32_t(std::countr_zero(left));
            mesh_.decode_needs(split, needs_);
            bool stands = std::all_of(needs_.begin(), needs_.end(), [&](uint32_t need) { return has(kept, need); });
            bool is_kept = stands && split < mesh_.split_limit() && frame.test(split).must_split;
            frame.report.evaluated_count += stands;
            if (is_kept)
                put(kept, split, true);
            else
                unwanted.push_back(split);
        }
    }
    for (; !unwanted.empty() && frame.operations_left > 0; --frame.operations_left) {
        ++frame.report.collapse_count;
        undo(frame, unwanted.back());
        unwanted.pop_back();
    }
    splits_.clear(), collapses_.clear(), reserve_.clear();
}

}  // namespace overlook::caveclod
