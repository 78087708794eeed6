// bake-lod: levels of detail with certified errors, from elevation models.

#include "tools/bake_lod/terrain_verb.h"

using namespace overlook;

int main(int argc, char** argv) {
    CLI::App app("Bakes levels of detail with certified errors into .ovl files.", "bake-lod");
    app.require_subcommand(1);
    command::Common common;
    bake_lod::TerrainArgs terrain;
    CLI::App* terrain_verb = bake_lod::add_terrain_verb(app, terrain, common);
    return command::run(app, common, argc, argv,
                        [&] { return terrain_verb->parsed() ? bake_lod::bake_terrain(terrain, common) : int(Exit::our_bug); });
}
