// read_terrain FILE.ovl ERROR_M: a baked terrain's size, and how many triangles keep it within ERROR_M metres.
// A program outside Overlook that uses its formats and its deciding halves as libraries.
#include <cstdio>
#include <cstdlib>

#include "formats/terrain.h"
#include "runtime/terrain/refine.h"

int main(int argc, char** argv) {
    using namespace overlook;
    char* end = nullptr;
    double error_m = argc == 3 ? std::strtod(argv[2], &end) : -1;
    if (argc != 3 || *end != '\0' || !(error_m >= 0)) {
        std::fprintf(stderr, "usage: read_terrain FILE.ovl ERROR_M\n");
        return int(Exit::bad_command);
    }

    Result<terrain::Terrain> terrain = terrain::read(argv[1]);
    if (!terrain) {
        std::fprintf(stderr, "read_terrain: %s\n", terrain.error().message.c_str());
        return int(terrain.error().exit);
    }

    terrain::Refiner refiner(*terrain);
    terrain::Cut cut;
    refiner.cut_by_metres(error_m, cut);

    std::printf("samples: %u x %u\n", terrain->shape.width, terrain->shape.height);
    std::printf("cell_m: %g x %g\n", terrain->frame.metres_per_column, terrain->frame.metres_per_row);
    std::printf("height_m: %g .. %g\n", refiner.lowest_m(), refiner.highest_m());
    std::printf("triangles within %g m: %llu\n", error_m, static_cast<unsigned long long>(cut.triangle_count()));
    return int(Exit::done);
}
