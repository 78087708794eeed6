// What decides the bytes of a baked mesh, as words in its provenance: written by bake-lod, read back by whoever proves the file
// against its source.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "formats/container.h"
#include "tools/bake/caveclod/bake.h"
#include "tools/bake/mesh_input.h"

namespace overlook::mesh {

struct BakeChoices {
    Options input;
    caveclod::BakeOptions bake;
};

// "crease-deg" = "40" and so on; what stands at its default is left out.
std::vector<std::pair<std::string, std::string>> options_in_words(const BakeChoices& choices);

// The choices with which the source was baked. Fails with Exit::bad_input if the words (which come from a file) make no sense:
// "its provenance has a crease-deg of "wide"".
Result<BakeChoices> choices_from_words(const container::Provenance& provenance);

}  // namespace overlook::mesh
