// What the methods that draw by turns do with one thing changed: each remedy of fsi switched off alone, without reprojection,
// with 16-bit ids and depths as the authors had them.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "tools/measure/paper/fsi/film.h"

namespace overlook::measure::paper::fsi {

struct Variation {
    std::string_view name;  // as it stands on the page: "fsi@search=0"
    size_t way = kOwn;
    std::string_view setting;  // "@search=0"; empty: nothing changed
    std::string_view purpose;  // what is left out
    bool is_remedy = false;    // one of runtime/discrete/settings.h's Remedies
};
std::span<const Variation> variations();

// A film of all of them.
Script script_of_variations(const std::string& name, const std::string& chain, const Stand& stand);

// What changes against the way as it is: "W entering 0.8 to 6.1, pop index x 1.4"; of numbers what changes by a twentieth and
// could be seen; "nothing that could be measured here".
std::string change_of(const Seen& whole, const Seen& without);

}  // namespace overlook::measure::paper::fsi
