// A small set of layered depth images in pieces: whole ones, and for every rule of their sections files that break it alone.
#pragma once

#include <string>
#include <vector>

#include "formats/wang_ldi_layout.h"
#include "tests/corrupt/container_fixtures.h"

namespace overlook::wang_ldi::image_fixtures {

using container::fixtures::Bytes;
using container::fixtures::Fixture;

// One tile of 2 m, two levels of 2 and 1 pixels a side, one direction, with normals and splats: the worked example of
// formats/spec/wang_ldi.md.
ImageSet post();
// The same, stored predicted and grouped.
ImageSet grouped_post();
// A post of three samples in the south-west pixel of level 0, one sample in the north-east; at level 1 two samples.
std::vector<Ldi> images_of_post();

// A file in pieces that can be broken one by one, and put together with right checksums.
struct Pieces {
    Bytes directory, images;
    uint32_t directory_codec = 0, image_flags = 3;
    std::string without;  // a section's tag that is left out; empty: none

    // raw: of each image, in the order of index_of; counts as the images state them.
    static Pieces of(const ImageSet& set, const std::vector<Ldi>& ldis);
    static Pieces of_raw(const ImageSet& set, const std::vector<Ldi>& ldis, const std::vector<Bytes>& raw);
    Bytes file() const;
};

std::vector<Fixture> whole_files();
std::vector<Fixture> corrupt_files();

}  // namespace overlook::wang_ldi::image_fixtures
