// Between the two files of an OBJ: its faces and its materials.
#pragma once

#include <string>
#include <unordered_map>

#include "tools/bake/mesh/soup.h"

namespace overlook::mesh {

using MaterialLibrary = std::unordered_map<std::string, Surface>;

// Adds the materials of an MTL file's text; of two of one name the first counts. What it does not know it goes over: the text
// cannot be wrong. `texture` of each is the reference as written.
void read_mtl(std::span<const uint8_t> text, MaterialLibrary& materials);

}  // namespace overlook::mesh
