// bake-lod discrete: one mesh, or levels made by hand, into a chain of levels with proven errors.
#pragma once

#include <string>
#include <vector>

#include "runtime/command/command.h"
#include "tools/bake/discrete/from_levels.h"
#include "tools/bake/discrete/from_mesh.h"
#include "tools/bake/discrete/visibility.h"
#include "tools/bake/mesh_provenance.h"

namespace overlook::bake_lod {

struct DiscreteArgs {
    std::vector<std::string> meshes;
    std::string output;
    std::string up = "auto", seams = "budgeted", levels_from = "auto", foliage = "grow", visibility = "noise", impostors = "none";
    bool why = false;
    mesh::BakeChoices choices;
    discrete::LadderOptions ladder;
    double visibility_period_m = 1, plain_px = 0;
};

CLI::App* add_discrete_verb(CLI::App& app, DiscreteArgs& args, command::Common& common);
int bake_discrete(DiscreteArgs args, const command::Common& common);

}  // namespace overlook::bake_lod
