// Small baked terrains made without the writer: whole ones, and for every rule of the terrain's sections files that break it
// alone.
#pragma once

#include <string>
#include <vector>

#include "formats/terrain.h"
#include "tests/corrupt/container_fixtures.h"

namespace overlook::terrain::fixtures {

using container::fixtures::Bytes;
using container::fixtures::Fixture;

// 3 x 3 samples, of which a plane misses the one in the middle by 6 m: the worked example of formats/spec/terrain.md.
Terrain hill();

// All its sections in a file, each block in a zstd frame that no version of the library makes otherwise.
Bytes file_of(const Terrain& terrain);

std::vector<Fixture> whole_files();
std::vector<Fixture> corrupt_files();

// The rows of the document's block ```hexdump, * for repeated ones, as bytes.
Bytes bytes_of_hexdump(const std::string& document);

}  // namespace overlook::terrain::fixtures
