#include "formats/caveclod.h"
#include "formats/container.h"
#include "formats/terrain.h"
#include "tools/baked/verbs.h"

namespace overlook::baked {

int export_cut(const ExportArgs& args, const command::Common& common) {
    auto file = container::Reader::open(args.file);
    if (!file) return command::fail("baked export", file.error());
    return file->kind() == caveclod::kKind ? export_mesh(args, *file, common) : export_terrain(args, *file, common);
}

}  // namespace overlook::baked
