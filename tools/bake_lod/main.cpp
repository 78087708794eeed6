// bake-lod: levels of detail with certified errors, from elevation models and meshes.

#include <CLI/CLI.hpp>

#include "tools/bake_lod/discrete_verb.h"
#include "tools/bake_lod/mesh_verb.h"
#include "tools/bake_lod/terrain_verb.h"

using namespace overlook;

int main(int argc, char** argv) {
    CLI::App app("Bakes levels of detail with certified errors into .ovl files.", "bake-lod");
    app.require_subcommand(1);
    command::Common common;
    bake_lod::TerrainArgs terrain;
    bake_lod::MeshArgs mesh;
    bake_lod::DiscreteArgs discrete;
    CLI::App* terrain_verb = bake_lod::add_terrain_verb(app, terrain, common);
    CLI::App* mesh_verb = bake_lod::add_mesh_verb(app, mesh, common);
    CLI::App* discrete_verb = bake_lod::add_discrete_verb(app, discrete, common);
    return command::run(app, common, argc, argv, [&] {
        if (terrain_verb->parsed()) return bake_lod::bake_terrain(terrain, common);
        if (discrete_verb->parsed()) return bake_lod::bake_discrete(discrete, common);
        return mesh_verb->parsed() ? bake_lod::bake_mesh(mesh, common) : int(Exit::our_bug);
    });
}
