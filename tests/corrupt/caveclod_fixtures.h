// Small baked meshes in pieces: whole ones, and for every rule of the mesh's sections files that break it alone.
#pragma once

#include <string>
#include <vector>

#include "formats/caveclod_layout.h"
#include "tests/corrupt/container_fixtures.h"

namespace overlook::caveclod::fixtures {

using container::fixtures::Bytes;
using container::fixtures::Fixture;

// A hexagon of 2 m round a middle that is 1 m high, whose one split takes that from a corner: the worked example of
// formats/spec/caveclod.md.
Hierarchy hexagon();

// A file in pieces that can be broken one by one, and put together with right checksums.
struct Parts {
    Bytes info, surfaces;
    std::vector<Rows> blocks;            // the base first
    std::vector<uint32_t> split_counts;  // of each
    std::vector<uint32_t> rest_errors;
    Codec codec = Codec::draco;
    uint32_t directory_codec = 0, blocks_codec = 0;

    static Parts of(const Hierarchy& hierarchy, Codec codec = Codec::draco);
    Bytes stored(size_t block) const;
    Bytes directory(const std::vector<Bytes>& stored) const;
    Bytes file() const;
    Bytes file_of(const std::vector<Bytes>& stored, const Bytes& directory) const;
};

std::vector<Fixture> whole_files();
std::vector<Fixture> corrupt_files();

}  // namespace overlook::caveclod::fixtures
