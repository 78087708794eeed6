#include "formats/caveclod.h"
#include "formats/container.h"
#include "formats/terrain.h"
#include "tools/baked/verbs.h"

namespace overlook::baked {

int verify(const VerifyArgs& args, const command::Common& common) {
    const char* name = "baked verify";
    auto file = container::Reader::open(args.file);
    if (!file) return command::fail(name, file.error());
    for (const container::Section& section : file->sections())
        if (auto intact = file->check(section); !intact) return command::fail(name, intact.error());
    return file->kind() == caveclod::kKind ? verify_mesh(args, *file, common) : verify_terrain(args, *file, common);
}

}  // namespace overlook::baked
