// bake-lod terrain: an elevation model in, a quadtree with certified errors out.
#pragma once

#include <string>

#include "runtime/command/command.h"
#include "tools/bake/dem.h"
#include "tools/bake/terrain.h"

namespace overlook::bake_lod {

struct TerrainArgs {
    std::string dem;
    std::string output;
    std::string window;
    std::string texture;  // a picture over the whole raster; empty = shaded relief
    bool no_texture = false;
    bool is_streamed = false;  // with tiles
    dem::Options dem_options;
    terrain::BakeOptions bake;
};

CLI::App* add_terrain_verb(CLI::App& app, TerrainArgs& args, command::Common& common);
int bake_terrain(TerrainArgs args, const command::Common& common);

}  // namespace overlook::bake_lod
