// The six drawbacks that the paper's section 1 finds in blending, each as a case with a number, of blend, fsi:paper and fsi.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "tools/measure/paper/fsi/subject.h"

namespace overlook::measure::paper::fsi {

constexpr std::array<std::string_view, 3> kDrawnWays = {"blend", "fsi:paper", "fsi"};

struct Drawback {
    int number = 0;                         // 1..6
    std::string what, unit;                 // of the paper, and what is counted
    std::array<double, 3> of_way{0, 0, 0};  // of kDrawnWays
};

// One thing, or a row of them, a quarter of the way from level 1 to level 0, 256 x 256 pixels, one sample each, the eye at rest:
//   1 triangles, times those of the finer level alone
//   2 fragments shaded as part of the thing, times those of the finer level alone (less what the combination shades; where the
//     renderer counts fragments)
//   3 draw calls more than at rest
//   4 of the pixels in which one of the two levels alone is seen, those that show a mixture of it and what lies behind: outlines
//   that
//     are translucent and should not be
//   5 of the thing's pixels, those that change when the triangles of each level are drawn in the opposite order
//   6 of the coarsest level twice, in other triangles and another colour: of its pixels, those that change by more than 8 of 255
//   when the eye
//     moves by a hundredth of a pixel
// scene: whose things have levels of different outline. Fails with Exit::impossible (targets).
Result<std::vector<Drawback>> drawbacks_of(const World& scene);

}  // namespace overlook::measure::paper::fsi
