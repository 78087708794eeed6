// bake-lod mesh: a mesh in, a hierarchy that many cameras refine at once out.
#pragma once

#include <string>

#include "runtime/command/command.h"
#include "tools/bake/mesh_provenance.h"

namespace overlook::bake_lod {

struct MeshArgs {
    std::string mesh;
    std::string output;
    std::string codec = caveclod::kDefaultCodec == caveclod::Codec::draco ? "draco" : "meshopt";
    std::string up = "auto";
    std::string seams = "strict";
    mesh::BakeChoices choices;
};

CLI::App* add_mesh_verb(CLI::App& app, MeshArgs& args, command::Common& common);
int bake_mesh(MeshArgs args, const command::Common& common);

}  // namespace overlook::bake_lod
