#include "tests/cli/inputs.h"

#include "tests/cli/run_command.h"

namespace overlook::cli {

std::string make_dem(const std::string& folder, uint32_t side, uint32_t voids) {
    expect_done(run({"make-sample", "dem", "-o", folder + "/sample", "--size", std::to_string(side), "--voids",
                     std::to_string(voids), "--quiet"}));
    return folder + "/sample/dem.tif";
}

void write_hgt(const std::string& path, uint32_t side, const std::function<int(uint32_t, uint32_t)>& height_m) {
    std::string bytes;
    bytes.reserve(size_t(side) * side * 2);
    for (uint32_t row = 0; row < side; ++row)
        for (uint32_t column = 0; column < side; ++column) {
            int height = height_m(column, row);
            bytes += char(height >> 8 & 0xff);
            bytes += char(height & 0xff);
        }
    write_text(path, bytes);
}

int hilly_m(uint32_t column, uint32_t row) {
    uint32_t mixed = (column * 2654435761u) ^ (row * 2246822519u);
    return 1000 + int((column / 8 * 37 + row / 8 * 91) % 700) + int(mixed >> 27);
}

std::string make_baked(const std::string& folder, uint32_t side, uint32_t voids) {
    std::string dem = make_dem(folder, side, voids), baked = folder + "/baked.ovl";
    expect_done(run({"bake-lod", "terrain", dem, "-o", baked, "--no-texture", "--quiet"}));
    return baked;
}

}  // namespace overlook::cli
