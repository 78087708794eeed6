// bake-wang-ldi: plants and how they are to stand in, ground of Wang tiles out.

#include <CLI/CLI.hpp>
#include <filesystem>

#include "formats/container.h"
#include "tools/bake_wang_ldi/ground.h"

using namespace overlook;

namespace {

constexpr const char* kName = "bake-wang-ldi";

Result<uint64_t> write_file(const bake_wang_ldi::GroundArgs& args, const bake_wang_ldi::GroundDone& done) {
    auto provenance = bake_wang_ldi::provenance_of(args, done);
    if (!provenance) return tl::unexpected(provenance.error());
    auto writer = container::Writer::create(args.output, wang_ldi::kKind);
    if (!writer) return tl::unexpected(writer.error());
    if (auto written = wang_ldi::write(*writer, done.ground); !written) return tl::unexpected(written.error());
    if (auto added = writer->add_provenance(*provenance); !added) return tl::unexpected(added.error());
    return writer->commit();
}

int bake(const bake_wang_ldi::GroundArgs& args, const command::Common& common) {
    std::error_code is_no_file;
    if (std::filesystem::equivalent(args.recipe, args.output, is_no_file))
        return command::fail(
            kName,
            Error{Exit::bad_command, fmt::format("{}: is read and would be overwritten; give another --output", args.output)});
    auto done = bake_wang_ldi::make_ground(args, common);
    if (!done) return command::fail(kName, done.error());
    auto bytes = write_file(args, *done);
    if (!bytes) return command::fail(kName, bytes.error());
    bake_wang_ldi::report_ground(args, *done, *bytes, common);
    return int(Exit::done);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Bakes plants into ground of Wang tiles: a few plots that cover any terrain without repeating.", kName);
    command::Common common;
    bake_wang_ldi::GroundArgs args;
    bake_wang_ldi::add_ground_options(app, args);
    command::add_common(app, common, command::Uses::seed);
    return command::run(app, common, argc, argv, [&] {
        args.has_seed = app.count("--seed") > 0;
        return bake(args, common);
    });
}
