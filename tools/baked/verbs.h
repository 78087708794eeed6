// The verbs of `baked`: each looks at a baked file and answers one question.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/container.h"
#include "runtime/command/command.h"

namespace overlook::baked {

struct InfoArgs {
    std::string file;
    std::string sheet;  // of ground: a folder for pictures of it; empty: none
};
struct VerifyArgs {
    std::string file;
    std::vector<std::string> sources;  // one; of levels made by hand, one for each; of ground none
    std::vector<double> error_m;       // terrain: tolerances of whole cuts to check; empty = 100, 50, 20, 5, 1
    uint32_t cuts = 200;               // mesh: how many random cuts to check
};
struct DiffArgs {
    std::string a, b;
};
struct ExportArgs {
    std::string file;
    double error_m = -1;
    int64_t level = -1;      // of a chain; -1: the coarsest within error_m. Of images; -1: none was given
    int64_t tile = -1;       // of images; -1: none was given
    int64_t direction = -1;  // likewise; -1: all
    bool is_alone = false;   // images without neighbours
    std::string output;
    std::string space = "local";
    std::string colour = "source";  // mesh: source, group, class
};

// Each returns the command's exit code, having printed its answer to stdout (as JSON with --json) and its talk to stderr.
int info(const InfoArgs& args, const command::Common& common);
int verify(const VerifyArgs& args, const command::Common& common);
int diff(const DiffArgs& args, const command::Common& common);
int export_cut(const ExportArgs& args, const command::Common& common);

// The same for one kind of file, which is open.
int verify_terrain(const VerifyArgs& args, const container::Reader& file, const command::Common& common);
int verify_mesh(const VerifyArgs& args, const container::Reader& file, const command::Common& common);
int verify_ground(const VerifyArgs& args, const container::Reader& file, const command::Common& common);
int verify_discrete(const VerifyArgs& args, const container::Reader& file, const command::Common& common);
int export_discrete(const ExportArgs& args, const container::Reader& file, const command::Common& common);
int export_terrain(const ExportArgs& args, const container::Reader& file, const command::Common& common);
int export_points(const ExportArgs& args, const container::Reader& file, const command::Common& common);
int export_mesh(const ExportArgs& args, const container::Reader& file, const command::Common& common);

}  // namespace overlook::baked
