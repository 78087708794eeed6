// baked: looks at a baked file, re-proves its promises, compares two, exports a cut.

#include <CLI/CLI.hpp>

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
    info_verb->add_option("--sheet", info.sheet,
                          "Of ground of Wang tiles: a folder for pictures of the set, its tilings, its planting and its images");

    CLI::App* verify_verb = app.add_subcommand(
        "verify",
        "Re-proves a file's promises against the elevation model or the mesh that it was baked from, or those of ground of Wang "
        "tiles by itself; exit 1 if one is broken");
    verify_verb->add_option("FILE", verify.file, "A baked file")->required();
    verify_verb->add_option(
        "--source", verify.sources,
        "The elevation model or the mesh it was baked from; of levels made by hand all, finest first; of ground "
        "of Wang tiles none");
    verify_verb
        ->add_option("--error-m", verify.error_m,
                     "Of a terrain: tolerances in metres at which a whole cut is checked; may be repeated (default 100, 50, 20, "
                     "5, 1)")
        ->check(command::number_in(0.0, 1e6));
    verify_verb->add_option("--cuts", verify.cuts, "Of a mesh: how many random legal cuts are measured (--seed chooses which)")
        ->check(CLI::Range(1, 1000000))
        ->capture_default_str();

    CLI::App* diff_verb = app.add_subcommand("diff", "Compares two baked files; exit 1 if they differ");
    diff_verb->add_option("A", diff.a, "A baked file")->required();
    diff_verb->add_option("B", diff.b, "Another")->required();

    CLI::App* export_verb = app.add_subcommand(
        "export", "Writes the triangles of one cut as a mesh (.ply, .glb), or the samples of one image as points (.ply)");
    export_verb->add_option("FILE", cut.file, "A baked file")->required();
    export_verb
        ->add_option("--error-m", cut.error_m,
                     "Greatest distance in metres between the cut and its source (of a terrain: vertical, to any sample; of a "
                     "chain of levels: to level 0)")
        ->check(command::number_in(0.0, 1e6));
    export_verb->add_option("--level", cut.level, "Of a chain of levels, or of images: which, 0 is the finest")
        ->check(CLI::Range(0, 31));
    export_verb->add_option("--tile", cut.tile, "Of images of Wang tiles: of which tile, from 0 on; its samples become points")
        ->check(CLI::Range(0, 65535));
    export_verb
        ->add_option("--direction", cut.direction,
                     "Of images: for eyes of which direction, 0 is north, clockwise; without it those of all directions, each "
                     "place once")
        ->check(CLI::Range(0, 63));
    export_verb->add_flag("--alone", cut.is_alone, "Of images: those sampled without neighbours");
    export_verb->add_option("-o,--output", cut.output, "The mesh: .ply or .glb; points: .ply")->required();
    export_verb
        ->add_option("--space", cut.space,
                     "local: x right, y up the raster, z height, in metres. raster: x = column, y = row of the source (north "
                     "first), z = metres, for checking")
        ->check(CLI::IsMember({"local", "raster"}))
        ->capture_default_str();
    export_verb
        ->add_option(
            "--colour", cut.colour,
            "Of a mesh. source: its own colours. group: one for each surface group. id: one for each packed id of groups. "
            "class: free green, sharp yellow, rigid red")
        ->check(CLI::IsMember({"source", "group", "id", "class"}))
        ->capture_default_str();

    for (CLI::App* verb : {info_verb, diff_verb, export_verb}) command::add_common(*verb, common);
    command::add_common(*verify_verb, common, command::Uses::seed);
    return command::run(app, common, argc, argv, [&] {
        if (info_verb->parsed()) return baked::info(info, common);
        if (verify_verb->parsed()) return baked::verify(verify, common);
        if (diff_verb->parsed()) return baked::diff(diff, common);
        return baked::export_cut(cut, common);
    });
}
