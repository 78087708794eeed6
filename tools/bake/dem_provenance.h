// What decides the bytes of a baked terrain, as words in its provenance: written by bake-lod, read back by whoever proves the
// file against its source.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "formats/container.h"
#include "tools/bake/dem.h"
#include "tools/bake/terrain.h"

namespace overlook::dem {

// "window" = "0,0,1025,1025" and so on; an option that was not given is left out.
std::vector<std::pair<std::string, std::string>> options_in_words(const Options& options, const terrain::BakeOptions& bake);

// The options for reading the source again exactly as it was baked. Fails with Exit::bad_input if the words (which come from a
// file) make no sense.
Result<Options> options_from_words(const container::Provenance& provenance);

// "X,Y,W,H" as a window. Fails with Exit::bad_command: "--window 1,2: four whole numbers are wanted: X,Y,W,H in samples".
Result<Window> parse_window(const std::string& text);

}  // namespace overlook::dem
