#include "formats/caveclod.h"
#include "formats/container.h"
#include "formats/discrete.h"
#include "formats/terrain.h"
#include "formats/wang_ground.h"
#include "tools/baked/verbs.h"

namespace overlook::baked {

int verify(const VerifyArgs& args, const command::Common& common) {
    const char* name = "baked verify";
    auto file = container::Reader::open(args.file);
    if (!file) return command::fail(name, file.error());
    for (const container::Section& section : file->sections())
        if (auto intact = file->check(section); !intact) return command::fail(name, intact.error());
    bool is_ground = file->kind() == wang_ldi::kKind;
    if (args.sources.empty() != is_ground) {
        const char* what =
            is_ground ? "is verified by itself; leave --source out" : "--source is required: what it was baked from";
        return command::fail(name, Error{Exit::bad_command, fmt::format("{}: {}", args.file, what)});
    }
    if (is_ground) return verify_ground(args, *file, common);
    if (file->kind() == discrete::kKind) return verify_discrete(args, *file, common);
    if (args.sources.size() > 1)
        return command::fail(
            name, Error{Exit::bad_command, fmt::format("{}: has one source, {} are given", args.file, args.sources.size())});
    return file->kind() == caveclod::kKind ? verify_mesh(args, *file, common) : verify_terrain(args, *file, common);
}

}  // namespace overlook::baked
