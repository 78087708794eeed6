// Small grounds of Wang tiles in pieces: whole ones, and for every rule of their sections files that break it alone.
#pragma once

#include <string>
#include <vector>

#include "formats/wang_layout.h"
#include "tests/corrupt/container_fixtures.h"

namespace overlook::wang_ldi::fixtures {

using container::fixtures::Bytes;
using container::fixtures::Fixture;

// Two tiles of 4 m with a tulip at every corner, one on the edges of one colour and one inside: the worked example of
// formats/spec/wang_tiles.md.
PlantedTiles tulips();

// A file in pieces that can be broken one by one, and put together with right checksums.
struct Pieces {
    Bytes tiles, planting;
    std::string without;  // a section's tag that is left out; empty: none

    static Pieces of(const PlantedTiles& ground);
    Bytes file() const;
};

std::vector<Fixture> whole_files();
std::vector<Fixture> corrupt_files();

}  // namespace overlook::wang_ldi::fixtures
