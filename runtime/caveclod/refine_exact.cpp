// A cut that depends on the camera alone.
#include <bit>

#include "runtime/caveclod/refine.h"
#include "runtime/caveclod/refine_frame.h"

namespace overlook::caveclod {

// Splits are asked for by their spheres, which need not hold those of what needs them: one that nobody would split any more may
// stay, because another that is wanted stands on it. A fresh refinement would never have come to that one. So all that is applied
// is asked anew, coarse to fine, and whatever is not wanted is undone with all that stands on it. What is left is wanted, and
// need not be asked a second time.
void Refinement::undo_unwanted(Frame& frame) {
    Bits falls(applied_.size(), 0);  // with what it needs
    std::vector<uint32_t> unwanted;
    for (size_t word = 0; word < applied_.size(); ++word) {
        for (uint64_t left = applied_[word]; left != 0; left &= left - 1) {
            uint32_t split = uint32_t(64 * word) + uint32_t(std::countr_zero(left));
            bool stands = !has(falls, split);
            frame.report.evaluated_count += stands;
            bool may_stay = stands && split < mesh_.split_limit();
            if (may_stay && (frame.test.is_surely_split(frame.test.sphere(split)) || frame.test(split).must_split)) continue;
            unwanted.push_back(split);
            mesh_.decode_dependents(split, needs_);
            for (uint32_t dependent : needs_) put(falls, dependent, true);
        }
    }
    for (; !unwanted.empty() && frame.operations_left > 0; --frame.operations_left) {
        ++frame.report.collapse_count;
        take_back(unwanted.back());
        unwanted.pop_back();
    }
    splits_.clear(), collapses_.clear(), reserve_.clear();
    frame.asks_applied = !unwanted.empty() || frame.keeps_reserve || !glides_.is_empty();
}

}  // namespace overlook::caveclod
