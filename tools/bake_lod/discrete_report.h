// What bake-lod discrete says of what it has made.
#pragma once

#include "tools/bake_lod/discrete_verb.h"

namespace overlook::bake_lod {

struct DiscreteDone {
    std::vector<mesh::MeshReport> inputs;
    bool is_cut = true;  // from one mesh; else from levels made by hand
    discrete::MeshChainReport cut;
    std::vector<discrete::MeasuredLevel> measured;
    discrete::Chain chain;
    uint64_t bytes = 0;
    double read_s = 0, bake_s = 0;
};

// JSON on stdout, or lines on stderr; with --why a table on stdout of what was tried and which distances ask for each level.
void report_discrete(const DiscreteArgs& args, const DiscreteDone& done, const command::Common& common);

}  // namespace overlook::bake_lod
