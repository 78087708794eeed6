#include "tools/measure/paper/fsi/verb.h"

#include <CLI/CLI.hpp>

#include "tools/measure/paper/fsi/fly.h"
#include "tools/measure/paper/fsi/page.h"
#include "tools/measure/paper/fsi/targets.h"
#include "tools/measure/paper/leave.h"
#include "tools/measure/paper/work.h"

namespace overlook::measure::paper::fsi {
namespace {

Result<void> deliver(const Flown& flown, const RunSetup& setup, const std::string& out, const command::Common& common) {
    Leavings leavings;
    leavings.tables = {{"sizes.csv", sizes_csv(flown.points)},
                       {"films.csv", films_csv(flown.films)},
                       {"variations.csv", films_csv(flown.varied)},
                       {"optimised.csv", films_csv(flown.optimised)},
                       {"combining.csv", combining_csv(flown.combining)},
                       {"ramps.csv", ramps_csv()}};
    add_pictures(leavings, flown.pictures);
    add_pictures(leavings, flown.sequences);
    leavings.charts = charts_of(flown);
    leavings.page = [&](bool has_charts) { return fsi_page_html({flown, setup, leavings.charts, has_charts}); };
    for (const Target& target : targets_of(flown)) leavings.targets.push_back(target_line(target, target_columns()));
    return leave(leavings, out, common);
}

}  // namespace

CLI::App* add_verb(CLI::App& app, PaperOptions& options) {
    CLI::App& verb = *app.add_subcommand(
        "fsi", "Section 4 of the paper on frame-sequential interpolation: figures 1 to 8 as pictures, tables, charts and a page");
    verb.add_option("folder", options.folders,
                    "What make-sample trees, windmills or simple made, with what its scene.json names (and "
                    "scene-by-hand.json and scene-optimised.json, where there are any) baked into it; several")
        ->required()
        ->type_name("FOLDER");
    verb.add_option("--frames", options.frames, "Frames of figure 8, of each scene, method and size; of TREES a quarter")
        ->type_name("N")
        ->check(command::number_in(2, 10000))
        ->capture_default_str();
    verb.add_flag("--many", options.flies_many,
                  "Fly 100,000 trees and windmills too where OpenGL is software (a graphics card always does)");
    verb.add_option("--out", options.out, "Folder for the page, tables and pictures; made if it is not there")
        ->type_name("DIR")
        ->required();
    return &verb;
}

Result<void> run_paper(const PaperOptions& options, const std::vector<std::string>& words, const command::Common& common) {
    Result<std::vector<Subject>> read = read_each(options.folders, read_subject);
    if (!read) return tl::unexpected(read.error());
    if (Result<void> made = make_folders(options.out, {"images"}); !made) return made;

    Result<gl::Context> context = gl::Context::headless();
    if (!context) return tl::unexpected(context.error());
    gl::ErrorCounter errors;
    std::vector<Subject> subjects = std::move(*read);  // go before the context
    for (Subject& subject : subjects) {
        if (Result<void> uploaded = upload(subject); !uploaded) return uploaded;
    }
    Result<Flown> flown = fly_all(subjects, options.frames, options.flies_many, context->renderer(), common);
    if (!flown) return tl::unexpected(flown.error());
    if (errors.count() > 0) return tl::unexpected(Error{Exit::our_bug, "OpenGL reports: " + errors.first()});
    RunSetup setup = setup_here(context->renderer(), kAsked_px, kAsked_px, words);
    return deliver(*flown, setup, options.out, common);
}

}  // namespace overlook::measure::paper::fsi
