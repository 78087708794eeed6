#include "tools/measure/paper/wang_ldi/verb.h"

#include <CLI/CLI.hpp>

#include "tools/measure/options.h"
#include "tools/measure/paper/leave.h"
#include "tools/measure/paper/wang_ldi/page.h"
#include "tools/measure/paper/wang_ldi/pictures.h"
#include "tools/measure/paper/wang_ldi/targets.h"
#include "tools/measure/paper/work.h"

namespace overlook::measure::paper::wang {
namespace {

Result<void> deliver(const Flown& flown, const RunSetup& setup, const PaperOptions& options, const command::Common& common) {
    Leavings leavings;
    leavings.tables = {{"sets.csv", sets_csv(flown)},
                       {"levels.csv", levels_csv(flown)},
                       {"planting.csv", planting_csv(flown)},
                       {"figure-2.csv", figure_2_csv(flown)},
                       {"fields.csv", fields_csv(flown)}};
    for (const Plants& plants : flown.plants) {
        add_pictures(leavings, plants.figure_2.pictures), add_pictures(leavings, plants.pictures);
        for (const FlownLand& land : plants.lands) add_pictures(leavings, land.pictures);
    }
    leavings.charts = charts_of(flown);
    leavings.page = [&](bool has_charts) {
        return wang_page_html({flown, setup, leavings.charts, has_charts, options.is_coarse});
    };
    for (const Target& target : targets_of(flown)) leavings.targets.push_back(target_line(target, target_columns()));
    return leave(leavings, options.out, common);
}

// Section 6 of each folder that has scenes.
Result<void> fly_fields(const std::vector<std::string>& folders, const FieldOptionsAsked& asked, Flown& flown,
                        gl::Renderer& renderer, command::Progress& progress, const command::Common& common) {
    std::vector<std::vector<Land>> all;
    size_t count = 0;
    for (const std::string& folder : folders) {
        Result<std::vector<Land>> lands = read_lands(folder);
        if (!lands) return tl::unexpected(lands.error());
        count += lands->size();
        all.push_back(std::move(*lands));
    }
    if (count == 0) return {};
    Result<gl::Context> context = gl::Context::headless();
    if (!context) return tl::unexpected(context.error());
    gl::ErrorCounter errors;
    renderer = context->renderer();
    std::vector<std::vector<Land>> lands = std::move(all);  // go before the context
    size_t place = 0;
    for (size_t p = 0; p < lands.size(); ++p)
        for (Land& land : lands[p]) {
            double share = 0.8 / double(count), from = 0.2 + share * double(place++);
            Part part(progress, common, flown.plants[p].name + " over " + land.name, from, from + share);
            if (Result<void> uploaded = upload(land.world); !uploaded) return uploaded;
            Result<FlownLand> done = fly_land(land, flown.plants[p].name, asked, renderer, part.done());
            if (!done) return tl::unexpected(done.error());
            flown.plants[p].lands.push_back(std::move(*done));
        }
    if (errors.count() > 0) return tl::unexpected(Error{Exit::our_bug, "OpenGL reports: " + errors.first()});
    return {};
}

}  // namespace

CLI::App* add_verb(CLI::App& app, PaperOptions& options) {
    CLI::App& verb = *app.add_subcommand("wang-ldi",
                                         "The paper on tiling layered depth images: its figures as pictures, tables, charts and "
                                         "a page; section 6 flown over the folders' scenes");
    verb.add_option(
            "folder", options.folders,
            "Baked plants, as make -C pipelines wang-ldi bakes them: paper.ovl, own.ovl, single.ovl, unlit.ovl, scene.ovl, "
            "own-scene.ovl, single-scene.ovl, what "
            "--json said of them, robinson.json, sheet and sheet-own; and, where they are there, one.ovl and eight.ovl, "
            "planting.json and valley.json with what these name; several")
        ->required()
        ->type_name("FOLDER");
    verb.add_option("--size", options.size, "Of the pictures of section 6's flights")->type_name("WxH")->capture_default_str();
    verb.add_flag("--coarse", options.is_coarse, "Say on the page that it was baked coarsely, without the paper's constants");
    verb.add_option("--judged-size", options.judged_size, "Of those that are held against their plants")
        ->type_name("WxH")
        ->capture_default_str();
    verb.add_option("--frames", options.fields.frames, "Of each of its flights")
        ->type_name("N")
        ->check(command::number_in(2, 10000))
        ->capture_default_str();
    verb.add_option("--judged-frames", options.fields.judged_frames, "Of those that are held against their plants")
        ->type_name("N")
        ->check(command::number_in(2, 1000))
        ->capture_default_str();
    verb.add_option("--out", options.out, "Folder for the page, tables and pictures; made if it is not there")
        ->type_name("DIR")
        ->required();
    return &verb;
}

Result<void> run_paper(const PaperOptions& options, const std::vector<std::string>& words, const command::Common& common) {
    FieldOptionsAsked fields = options.fields;
    if (auto size = parse_size(options.size, fields.width_px, fields.height_px); !size) return size;
    if (auto size = parse_size(options.judged_size, fields.judged_width_px, fields.judged_height_px); !size) return size;
    Result<std::vector<Subject>> subjects = read_each(options.folders, read_subject);
    if (!subjects) return tl::unexpected(subjects.error());
    if (Result<void> made = make_folders(options.out, {"images"}); !made) return made;
    command::Progress progress(common, "drawing");
    Flown flown;
    for (const Subject& subject : *subjects) {
        double share = 0.2 / double(subjects->size()), from = double(flown.plants.size()) * share;
        Part part(progress, common, subject.name, from, from + share);
        Result<Plants> plants = plants_of(subject, part.done());
        if (!plants) return tl::unexpected(plants.error());
        flown.plants.push_back(std::move(*plants));
    }
    gl::Renderer renderer{"the exact warper, one thread", "", false};
    if (auto done = fly_fields(options.folders, fields, flown, renderer, progress, common); !done) return done;
    RunSetup setup = setup_here(renderer, kWidth_px, kHeight_px, words);
    return deliver(flown, setup, options, common);
}

}  // namespace overlook::measure::paper::wang
