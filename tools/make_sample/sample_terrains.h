// make-sample three-lakes, cliff, canyon: the three terrains on which section 4 of the CAVECLOD paper is run anew.
#pragma once

#include <cstdint>
#include <string>

#include "formats/result.h"
#include "tools/make_sample/mesh_sample.h"

namespace overlook::sample {

// What the paper says of a terrain (section 4.1; the columns and rows of the Canyon follow from its polygons and its 1:2 shape).
struct PaperTerrain {
    const char* name;
    uint32_t columns, rows;  // of positions
    double width_m, height_m;
    uint32_t texture_count, packed_count;
    // Share of the index array in use. From table 1: (bytes - 44 n - 12 p - 2 s e) / 32 render vertices, over s e entries.
    double dense_population;
    uint32_t vertex_count() const { return uint32_t(dense_population * packed_count * columns * rows + 0.5); }
};
constexpr PaperTerrain kThreeLakes = {"three-lakes", 201, 201, 70'000, 70'000, 9, 5, 42'732.0 / (5 * 40'401)};
constexpr PaperTerrain kCliff = {"cliff", 232, 233, 70'000, 70'000, 5, 4, 55'838.0 / (4 * 54'056)};
constexpr PaperTerrain kCanyon = {"canyon", 373, 171, 245'000, 122'000, 1, 1, 1};

// A range with snow on it before a plain with three lakes. Nine textures: three kinds of water, sand, meadow, forest, heath,
// rock, snow; in one place five of them meet. Each of the three: the same for the same seed. Fails with Exit::impossible where no
// variant of the seed needs exactly as many packed ids as the paper's terrain ("three-lakes: seed 7 makes no ground that needs 5
// ids; take another seed").
Result<MeshSample> three_lakes(uint64_t seed);

// High ground that ends in a cliff, rock over scree, before lower hills. Normals break along the cliff's rim, where rock lies on
// both sides. Five textures: meadow above, forest, rock, scree, fields below.
Result<MeshSample> cliff(uint64_t seed);

// A plateau cut by a river. source: a folder that holds elevation_1200_8bit.png and colour_1024.png, the Grand Canyon (a square
// of 122 km; the half to its west, which those pictures lack, is their mirror image; a grey step is 15 m), or empty: a canyon is
// made. Fails further as read_number_raster and read_image_rgb8, and where a picture is no square ("... is 1200 x 900; a square
// is wanted").
Result<MeshSample> canyon(uint64_t seed, const std::string& source);

}  // namespace overlook::sample
