#include "formats/caveclod.h"
#include "formats/container.h"
#include "formats/discrete.h"
#include "formats/terrain.h"
#include "formats/wang_ground.h"
#include "tools/baked/verbs.h"

namespace overlook::baked {

int export_cut(const ExportArgs& args, const command::Common& common) {
    auto file = container::Reader::open(args.file);
    if (!file) return command::fail("baked export", file.error());
    if (file->kind() == wang_ldi::kKind) return export_points(args, *file, common);
    if (args.tile >= 0 || args.direction >= 0 || args.is_alone)
        return command::fail(
            "baked export",
            Error{Exit::bad_command, fmt::format("{}: has no tiles; leave --tile, --direction and --alone out", args.file)});
    if (file->kind() == discrete::kKind) return export_discrete(args, *file, common);
    if (args.error_m < 0) return command::fail("baked export", Error{Exit::bad_command, "--error-m is required"});
    if (args.level >= 0)
        return command::fail("baked export",
                             Error{Exit::bad_command, fmt::format("{}: has no levels; leave --level out", args.file)});
    return file->kind() == caveclod::kKind ? export_mesh(args, *file, common) : export_terrain(args, *file, common);
}

}  // namespace overlook::baked
