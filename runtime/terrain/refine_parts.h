// The parts that a cut is made in, by threads, and put together from.
#pragma once

#include <cstddef>

#include "runtime/terrain/refine.h"

namespace overlook::terrain {

inline constexpr size_t kPartsWanted = 256;

// Empties a part.
void start(Cut::Part& part);
// The first so many parts one after the other. sample_count: what indices of morphs begin at.
void join(size_t part_count, size_t sample_count, Cut& out);

}  // namespace overlook::terrain
