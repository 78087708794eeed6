// baked: looks at a baked file, re-proves its promises, compares two, exports a cut.

#include "tools/baked/verbs.h"

using namespace overlook;

int main(int argc, char** argv) {
    CLI::App app("Looks at baked files (.ovl), re-proves their promises, compares them, exports cuts of them.", "baked");
    app.require_subcommand(1);
    command::Common common;
    baked::InfoArgs info;
    baked::VerifyArgs verify;
    baked::DiffArgs diff;
    baked::ExportArgs cut;

    CLI::App* info_verb = app.add_subcommand("info", "What is in a file: its sections, its promises, where it came from");
    info_verb->add_option("FILE", info.file, "A baked file")->required();

    CLI::App* verify_verb = app.add_subcommand(
        "verify",
        "Re-proves every promise of a baked terrain against the elevation model that it was baked from; exit 1 if one is broken");
    verify_verb->add_option("FILE", verify.file, "A baked file")->required();
    verify_verb->add_option("--source", verify.source, "The elevation model it was baked from")->required();
    verify_verb
        ->add_option("--error-m", verify.error_m,
                     "Tolerances in metres at which a whole cut is checked; may be repeated (default 100, 50, 20, 5, 1)")
        ->check(command::number_in(0.0, 1e6));

    CLI::App* diff_verb = app.add_subcommand("diff", "Compares two baked files; exit 1 if they differ");
    diff_verb->add_option("A", diff.a, "A baked file")->required();
    diff_verb->add_option("B", diff.b, "Another")->required();

    CLI::App* export_verb = app.add_subcommand("export", "Writes the triangles of one cut as a mesh (.ply, .glb)");
    export_verb->add_option("FILE", cut.file, "A baked file")->required();
    export_verb
        ->add_option("--error-m", cut.error_m, "Greatest vertical distance in metres between the mesh and any sample it covers")
        ->required()
        ->check(command::number_in(0.0, 1e6));
    export_verb->add_option("-o,--output", cut.output, "The mesh: .ply or .glb")->required();
    export_verb
        ->add_option("--space", cut.space,
                     "local: x right, y up the raster, z height, in metres. raster: x = column, y = row of the source (north "
                     "first), z = metres, for checking")
        ->check(CLI::IsMember({"local", "raster"}))
        ->capture_default_str();

    for (CLI::App* verb : {info_verb, verify_verb, diff_verb, export_verb}) command::add_common(*verb, common);
    return command::run(app, common, argc, argv, [&] {
        if (info_verb->parsed()) return baked::info(info, common);
        if (verify_verb->parsed()) return baked::verify(verify, common);
        if (diff_verb->parsed()) return baked::diff(diff, common);
        return baked::export_cut(cut, common);
    });
}
