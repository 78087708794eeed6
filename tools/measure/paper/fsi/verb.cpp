#include "tools/measure/paper/fsi/verb.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "formats/atomic_file.h"
#include "runtime/gl/png.h"
#include "tools/measure/paper/fsi/page.h"
#include "tools/measure/paper/fsi/targets.h"
#include "tools/measure/paper/work.h"

namespace overlook::measure::paper::fsi {
namespace {

// How far off the coarser level of a film is, in its pixels: SIMPLE's levels differ by their whole size.
double film_error_px(const std::string& name) {
    return name == "simple" ? 8 : 2;
}

Script script_of(const Subject& subject, const std::string& chain, const World& world) {
    Script script{subject.name, chain, stand_of(*things_of(world).chain, film_error_px(subject.name)), {}};
    for (const Way& way : kWays) {
        Take take{std::string(way.name), {}};
        take.run.spec = spec_of(way, settings_of(script.stand, way));
        script.takes.push_back(std::move(take));
    }
    return script;
}

Result<void> shoot_all(std::vector<Subject>& subjects, const gl::Renderer& renderer, Flown& flown,
                       const std::function<void(double)>& done) {
    struct Job {
        const Subject* subject;
        std::string chain;
        const World* world;
    };
    std::vector<Job> jobs;
    for (const Subject& subject : subjects) {
        jobs.push_back({&subject, "", &subject.world});
        if (subject.by_hand) jobs.push_back({&subject, "by hand", &*subject.by_hand});
    }
    for (size_t i = 0; i < jobs.size(); ++i) {
        const Job& job = jobs[i];
        Result<Film> film = shoot(*job.world, script_of(*job.subject, job.chain, *job.world), renderer,
                                  [&](double share) { done((double(i) + share) / double(jobs.size())); });
        if (!film) return tl::unexpected(film.error());
        flown.films.push_back(std::move(*film));
    }
    return {};
}

Result<Flown> fly_all(std::vector<Subject>& subjects, const PaperOptions& options, const gl::Renderer& renderer,
                      const command::Common& common) {
    Flown flown;
    flown.frames = options.frames;
    command::Progress progress(common, "flying");
    {
        Part part(progress, common, "viewport sizes", 0, 0.5);
        for (size_t i = 0; i < subjects.size(); ++i) {
            flown.scenes.push_back(subjects[i].name);
            auto share_done = [&, done = part.done()](double share) { done((double(i) + share) / double(subjects.size())); };
            Result<std::vector<Point>> points = fly_sizes(subjects[i], renderer, options.frames, share_done);
            if (!points) return tl::unexpected(points.error());
            flown.points.insert(flown.points.end(), points->begin(), points->end());
        }
    }
    Part part(progress, common, "films", 0.5, 1);
    if (Result<void> shot = shoot_all(subjects, renderer, flown, part.done()); !shot) return tl::unexpected(shot.error());
    return flown;
}

Result<void> write_tables(const Flown& flown, const std::string& out) {
    const std::pair<const char*, std::string> tables[] = {
        {"sizes.csv", sizes_csv(flown.points)}, {"films.csv", films_csv(flown.films)}, {"ramps.csv", ramps_csv()}};
    for (const auto& [name, text] : tables) {
        if (Result<void> written = write_file(out + "/" + name, std::string_view(text)); !written) return written;
    }
    return {};
}

Result<void> deliver(const Flown& flown, const RunSetup& setup, const std::string& out, const command::Common& common) {
    if (Result<void> written = write_tables(flown, out); !written) return written;
    for (const Picture& picture : flown.pictures) {
        Result<void> written = write_png(out + "/images/" + picture.name + ".png", picture.image);
        if (!written) return written;
    }
    std::vector<Chart> charts = charts_of(flown);
    Result<bool> drawn = draw_charts(charts, out);
    if (!drawn) return tl::unexpected(drawn.error());
    if (!*drawn) command::note(common, "reproduce: gnuplot is not installed; the charts are left out");
    std::string page = fsi_page_html({flown, setup, charts, *drawn});
    if (Result<void> written = write_file(out + "/index.html", std::string_view(page)); !written) return written;
    for (const Target& target : targets_of(flown)) command::note(common, "reproduce: " + target_line(target, target_columns()));
    command::note(common, fmt::format("reproduce: the page: {}/index.html", out));
    return {};
}

Result<std::vector<Subject>> read_subjects(const std::vector<std::string>& folders) {
    std::vector<Subject> subjects;
    for (const std::string& folder : folders) {
        Result<Subject> subject = read_subject(folder);
        if (!subject) return tl::unexpected(subject.error());
        bool is_taken =
            std::any_of(subjects.begin(), subjects.end(), [&](const Subject& one) { return one.name == subject->name; });
        if (is_taken)
            return bad_command("{}: another folder is called {} too; give each a name of its own", folder, subject->name);
        subjects.push_back(std::move(*subject));
    }
    return subjects;
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
    verb.add_option("--out", options.out, "Folder for the page, tables and pictures; made if it is not there")
        ->type_name("DIR")
        ->required();
    return &verb;
}

Result<void> run_paper(const PaperOptions& options, const std::vector<std::string>& words, const command::Common& common) {
    Result<std::vector<Subject>> read = read_subjects(options.folders);
    if (!read) return tl::unexpected(read.error());
    if (Result<void> made = make_folders(options.out, {"images"}); !made) return made;

    Result<gl::Context> context = gl::Context::headless();
    if (!context) return tl::unexpected(context.error());
    gl::ErrorCounter errors;
    std::vector<Subject> subjects = std::move(*read);  // go before the context
    for (Subject& subject : subjects) {
        if (Result<void> uploaded = upload(subject); !uploaded) return uploaded;
    }
    Result<Flown> flown = fly_all(subjects, options, context->renderer(), common);
    if (!flown) return tl::unexpected(flown.error());
    if (errors.count() > 0) return tl::unexpected(Error{Exit::our_bug, "OpenGL reports: " + errors.first()});
    RunSetup setup = setup_here(context->renderer(), kAsked_px, kAsked_px, words);
    return deliver(*flown, setup, options.out, common);
}

}  // namespace overlook::measure::paper::fsi
