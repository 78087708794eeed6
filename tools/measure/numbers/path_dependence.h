// H: does a picture depend on the way on which its pose was reached?
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "tools/measure/numbers/picture.h"

namespace overlook::measure {

// Mean over pixels and channels of |I_f - I_b|, grey levels 0..255, of one pose reached forwards and backwards.
double path_difference_grey(const RgbView& forwards, const RgbView& backwards);

struct Switches {
    size_t count = 0;              // over all things
    size_t greatest_of_thing = 0;  // most of one thing
    size_t last_frame = 0;         // frame of the last one; 0 without any
};

// choices: [frames, things] row-major, what each thing is drawn as (a level, a method: any number). A switch is a choice unlike
// the frame before's; those in frames before first_frame do not count. thing_count divides choices.size() (asserted).
Switches switches_of(std::span<const uint32_t> choices, size_t thing_count, size_t first_frame = 1);

}  // namespace overlook::measure
