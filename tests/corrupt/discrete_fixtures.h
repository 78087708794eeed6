// Small chains of levels in pieces: whole ones, and for every rule of their sections files that break it alone.
#pragma once

#include <string>
#include <vector>

#include "formats/discrete_layout.h"
#include "tests/corrupt/container_fixtures.h"

namespace overlook::discrete::fixtures {

using container::fixtures::Bytes;
using container::fixtures::Fixture;

// A pyramid of 4 m and, coarser, its front alone, with a vane that turns once in 4 s: the worked example of
// formats/spec/discrete.md.
Chain pyramid();

// The same with a level of billboards instead of the coarser one.
Chain boards();

// A file in pieces that can be broken one by one, and put together with right checksums.
struct Pieces {
    Bytes info, levels, geometry, surfaces, parts, visibility;
    uint32_t levels_codec = 0;
    std::string without;  // a section's tag that is left out; empty: none

    static Pieces of(const Chain& chain);
    // Levels and geometry anew.
    void lay_out(const std::vector<Level>& all);
    Bytes file() const;
};

std::vector<Fixture> whole_files();
std::vector<Fixture> corrupt_files();

}  // namespace overlook::discrete::fixtures
