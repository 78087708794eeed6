#include "tools/measure/paper/wang_ldi/verb.h"

#include <CLI/CLI.hpp>

#include "tools/measure/paper/leave.h"
#include "tools/measure/paper/wang_ldi/page.h"
#include "tools/measure/paper/wang_ldi/pictures.h"
#include "tools/measure/paper/wang_ldi/targets.h"
#include "tools/measure/paper/work.h"

namespace overlook::measure::paper::wang {
namespace {

Result<void> deliver(const Flown& flown, const RunSetup& setup, const std::string& out, const command::Common& common) {
    Leavings leavings;
    leavings.tables = {{"sets.csv", sets_csv(flown)},
                       {"levels.csv", levels_csv(flown)},
                       {"planting.csv", planting_csv(flown)},
                       {"one-ldi.csv", one_ldi_csv(flown)}};
    for (const Plants& plants : flown.plants) add_pictures(leavings, plants.pictures);
    leavings.charts = charts_of(flown);
    leavings.page = [&](bool has_charts) { return wang_page_html({flown, setup, leavings.charts, has_charts}); };
    for (const Target& target : targets_of(flown)) leavings.targets.push_back(target_line(target, target_columns()));
    return leave(leavings, out, common);
}

}  // namespace

CLI::App* add_verb(CLI::App& app, PaperOptions& options) {
    CLI::App& verb = *app.add_subcommand(
        "wang-ldi", "The paper on tiling layered depth images: figures 2 to 9, 11 and 12 as pictures, tables, charts and a page");
    verb.add_option("folder", options.folders,
                    "Baked plants, as make -C pipelines wang-ldi bakes them: paper.ovl, own.ovl, single.ovl, unlit.ovl, what "
                    "--json said of them, robinson.json, sheet and sheet-own; several")
        ->required()
        ->type_name("FOLDER");
    verb.add_option("--out", options.out, "Folder for the page, tables and pictures; made if it is not there")
        ->type_name("DIR")
        ->required();
    return &verb;
}

Result<void> run_paper(const PaperOptions& options, const std::vector<std::string>& words, const command::Common& common) {
    Result<std::vector<Subject>> subjects = read_each(options.folders, read_subject);
    if (!subjects) return tl::unexpected(subjects.error());
    if (Result<void> made = make_folders(options.out, {"images"}); !made) return made;
    command::Progress progress(common, "drawing");
    Flown flown;
    for (const Subject& subject : *subjects) {
        double share = 1 / double(subjects->size()), from = double(flown.plants.size()) * share;
        Part part(progress, common, subject.name, from, from + share);
        Result<Plants> plants = plants_of(subject, part.done());
        if (!plants) return tl::unexpected(plants.error());
        flown.plants.push_back(std::move(*plants));
    }
    RunSetup setup = setup_here({"the exact warper, one thread", "", false}, kWidth_px, kHeight_px, words);
    return deliver(flown, setup, options.out, common);
}

}  // namespace overlook::measure::paper::wang
