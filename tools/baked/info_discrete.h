// What `baked info` says of a chain of levels.
#pragma once

#include <string>

#include "formats/discrete.h"

namespace overlook::baked {

// As JSON.
std::string chain_json(const discrete::Chain& chain);
// As lines on stdout.
void print_chain(const discrete::Chain& chain);

}  // namespace overlook::baked
