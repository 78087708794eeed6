#include "tools/measure/numbers/path_dependence.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <vector>

namespace overlook::measure {

double path_difference_grey(const RgbView& forwards, const RgbView& backwards) {
    assert(forwards.width == backwards.width && forwards.height == backwards.height);
    uint64_t sum = 0;
    for (size_t i = 0; i < forwards.rgb.size(); ++i) sum += uint64_t(std::abs(int(forwards.rgb[i]) - int(backwards.rgb[i])));
    return double(sum) / double(forwards.rgb.size());
}

Switches switches_of(std::span<const uint32_t> choices, size_t thing_count, size_t first_frame) {
    assert(thing_count > 0 && choices.size() % thing_count == 0);
    Switches switches;
    std::vector<size_t> of_thing(thing_count);
    for (size_t frame = std::max<size_t>(1, first_frame); frame < choices.size() / thing_count; ++frame)
        for (size_t thing = 0; thing < thing_count; ++thing) {
            size_t at = frame * thing_count + thing;
            if (choices[at] == choices[at - thing_count]) continue;
            ++switches.count;
            ++of_thing[thing];
            switches.last_frame = frame;
        }
    switches.greatest_of_thing = *std::max_element(of_thing.begin(), of_thing.end());
    return switches;
}

}  // namespace overlook::measure
