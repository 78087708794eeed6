// A volume for one change of levels that lets the picture change as little and as evenly as it can.
#pragma once

#include "formats/discrete.h"

namespace overlook::discrete {

// Of the change between `fine` and the next level. What the two levels share is drawn by both and hardly changes; the picture
// changes where one stands out of the other. There the new level grows out of the old one's surface, near before far, and the old
// one draws back the same way, so that each place changes once and next to what has changed before; and values are dealt out so
// that each moment of the change brings as much of it as any other. Points of both levels are measured against the other level;
// O(n log n) of some 130,000 of them.
//
// The paper (Scherzer and Wimmer 2008, section 5) leaves "the automatic generation of an optimized visibility texture" open.
Visibility optimised_visibility(const Chain& chain, size_t fine);

}  // namespace overlook::discrete
