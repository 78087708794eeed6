// Elevation models and baked files to try commands on.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace overlook::cli {

// `make-sample dem` into FOLDER/sample; returns the path of its dem.tif.
std::string make_dem(const std::string& folder, uint32_t side, uint32_t voids = 0);

// An .hgt file of side x side samples, 1201 or 3601 for one that Overlook reads.
void write_hgt(const std::string& path, uint32_t side, const std::function<int(uint32_t column, uint32_t row)>& height_m);

// Hills that no short description holds.
int hilly_m(uint32_t column, uint32_t row);

// make_dem and `bake-lod terrain` of it without a picture; returns the path of the .ovl.
std::string make_baked(const std::string& folder, uint32_t side, uint32_t voids = 0);

}  // namespace overlook::cli
