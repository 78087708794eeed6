// Sections of the paper's page: what remedies buy; ghosts and losses against parallax.
#pragma once

#include <string>
#include <vector>

#include "tools/measure/paper/lod_sprite/held_keys.h"
#include "tools/measure/paper/lod_sprite/remedies.h"

namespace overlook::measure::paper::sprite {

// Empty where nothing was flown.
std::string remedies_html(const RemedyTable& table);
std::string held_keys_html(const std::vector<HeldRun>& runs, bool has_charts);

}  // namespace overlook::measure::paper::sprite
