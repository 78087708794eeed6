// Names that people type, compared.
#pragma once

#include <cstddef>
#include <string_view>

namespace overlook {

// The number of letters to change, drop or add to turn a into b (Levenshtein 1966). O(a * b) time.
size_t edit_distance(std::string_view a, std::string_view b);

}  // namespace overlook
