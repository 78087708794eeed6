// The choice of a stochastic set among all balanced ones.
#pragma once

#include "tools/bake/wang_ldi/tile_sets.h"

namespace overlook::wang_ldi {

// The set with the least score_of, of those there are (2 x 2 colours) or of options.candidates at random. options: checked.
TileSet search_set(const SetOptions& options, SearchReport& report);

}  // namespace overlook::wang_ldi
