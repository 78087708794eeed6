#include "tools/measure/paper/caveclod/verb.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "formats/parallel.h"
#include "tools/measure/options.h"
#include "tools/measure/paper/caveclod/page.h"
#include "tools/measure/paper/caveclod/targets.h"
#include "tools/measure/paper/caveclod/views.h"
#include "tools/measure/paper/leave.h"
#include "tools/measure/paper/work.h"

namespace overlook::measure::paper::cameras {
namespace {

constexpr uint32_t kStrides[] = {2, 4};  // slower machines, for the share of operations that is saved there

struct Job {
    size_t subject = 0;
    Flying flying;
    Way way = Way::own;
    uint32_t cameras = 1;
};

std::vector<Job> jobs_of(const std::vector<Subject>& subjects, size_t canyon, const Flying& flying) {
    std::vector<Job> jobs;
    for (uint32_t cameras = kMostCameras; cameras >= 1; --cameras)  // the longest first
        for (size_t i = 0; i < subjects.size(); ++i)
            for (Way way : kWays) jobs.push_back({i, flying, way, cameras});
    for (uint32_t stride : kStrides)
        for (Way way : {Way::own, Way::shared}) {
            Flying slower = flying;
            slower.stride = stride;
            slower.frames = std::max(1u, flying.frames / stride);
            jobs.push_back({canyon, slower, way, kMostCameras});
        }
    return jobs;
}

// What is counted is the same whatever runs beside it.
void fly_all(const std::vector<Subject>& subjects, Flown& flown, const std::function<void(double)>& done) {
    std::vector<Job> jobs = jobs_of(subjects, flown.canyon, flown.flying);
    std::vector<Flyover> flyovers(jobs.size());
    size_t batch = std::max(1u, thread_count());
    for (size_t begin = 0; begin < jobs.size(); begin += batch) {
        parallel_ranges(std::min(batch, jobs.size() - begin), 1, [&](size_t k, size_t) {
            const Job& job = jobs[begin + k];
            flyovers[begin + k] = fly(subjects[job.subject], job.flying, job.way, job.cameras);
        });
        done(double(std::min(jobs.size(), begin + batch)) / double(jobs.size()));
    }
    for (size_t i = 0; i < jobs.size(); ++i) flown.subjects[jobs[i].subject].flyovers.push_back(std::move(flyovers[i]));
}

FlownSubject described(const Subject& subject, const Flying& flying) {
    FlownSubject flown;
    flown.name = subject.name;
    flown.split_count = subject.mesh().split_count();
    flown.face_count = subject.mesh().face_count();
    flown.memory = {subject.name, printed_of(subject.name), counted_of(subject)};
    flown.step_s = step_s(subject, flying);
    return flown;
}

size_t place_of(const std::vector<Subject>& subjects, std::string_view name, size_t otherwise) {
    auto found = std::find_if(subjects.begin(), subjects.end(), [&](const Subject& one) { return one.name == name; });
    return found == subjects.end() ? otherwise : size_t(found - subjects.begin());
}

Result<Flown> fly_section_4(std::vector<Subject>& subjects, const Flying& flying, const command::Common& common) {
    Flown flown;
    flown.flying = flying;
    flown.canyon = place_of(subjects, kCanyon.name, subjects.size() - 1);
    flown.lakes = place_of(subjects, kThreeLakes.name, 0);
    flown.flight_s = subjects[flown.canyon].frame_count() * subjects[flown.canyon].step_s();
    command::Progress progress(common, "flying");
    for (Subject& subject : subjects) {
        flown.subjects.push_back(described(subject, flying));
        Result<std::vector<Picture>> pictures = pictures_of(subject, flying);
        if (!pictures) return tl::unexpected(pictures.error());
        flown.subjects.back().pictures = std::move(*pictures);
    }
    {
        Part part(progress, common, "frame rates", 0, 0.2);
        Result<std::vector<Rate>> rates = frame_rates(subjects[flown.canyon], flying, part.done());
        if (!rates) return tl::unexpected(rates.error());
        flown.rates = std::move(*rates);
    }
    {
        Part part(progress, common, "times", 0.2, 0.3);
        flown.speed = measure_speed(subjects[flown.canyon], flying, part.done());
    }
    Part part(progress, common, "flyovers", 0.3, 1);
    fly_all(subjects, flown, part.done());
    return flown;
}

Result<void> deliver(const Flown& flown, const RunSetup& setup, const std::string& out, const command::Common& common) {
    std::vector<Table1Row> rows;
    for (const FlownSubject& subject : flown.subjects) rows.push_back(subject.memory);
    Leavings leavings;
    leavings.tables = {{"windows.csv", windows_csv(flown)},
                       {"flyovers.csv", flyovers_csv(flown)},
                       {"memory.csv", memory_csv(flown)},
                       {"frame_rates.csv", frame_rates_csv(flown)},
                       {"table1.csv", table1_csv(rows)}};
    for (const FlownSubject& subject : flown.subjects) add_pictures(leavings, subject.pictures);
    leavings.charts = charts_10_to_14(flown);
    leavings.page = [&](bool has_charts) { return caveclod_page_html({flown, setup, leavings.charts, has_charts}); };
    for (const Target& target : targets_of(flown)) leavings.targets.push_back(target_line(target, target_columns()));
    return leave(leavings, out, common);
}

}  // namespace

CLI::App* add_verb(CLI::App& app, PaperOptions& options) {
    CLI::App& verb = *app.add_subcommand(
        "caveclod",
        "Section 4 of the CAVECLOD paper: figures 1, 2 and 5 to 14 and table 1 as pictures, tables, charts and a page");
    verb.add_option("folder", options.folders,
                    "What make-sample three-lakes, cliff or canyon made, with what scene.json names baked into it; several")
        ->required()
        ->type_name("FOLDER");
    verb.add_option("--size", options.size, "Size of the screen that the cameras share, in pixels")
        ->type_name("WxH")
        ->capture_default_str();
    verb.add_option("--frames", options.frames, "Frames of the flights, in clips of 30 spread evenly over them")
        ->type_name("N")
        ->check(command::number_in(1, 1e6))
        ->capture_default_str();
    verb.add_flag("--whole", options.is_whole, "All frames of the flights: two minutes of the samples'")->excludes("--frames");
    verb.add_option("--error-px", options.error_px, "At which pixel error the methods are held beside each other")
        ->type_name("PIXELS")
        ->check(command::number_in(0.01, 1000))
        ->capture_default_str();
    verb.add_option("--out", options.out, "Folder for the page, tables and pictures; made if it is not there")
        ->type_name("DIR")
        ->required();
    return &verb;
}

Result<void> run_paper(const PaperOptions& options, const std::vector<std::string>& words, const command::Common& common) {
    Flying flying;
    if (Result<void> size = parse_size(options.size, flying.width_px, flying.height_px); !size) return size;
    if (flying.width_px < 2 || flying.height_px < 2)
        return bad_command("--size {}: quadrants want two pixels a side", options.size);
    Result<std::vector<Subject>> read = read_each(options.folders, read_subject);
    if (!read) return tl::unexpected(read.error());
    flying.settings.error_px = options.error_px;
    uint32_t all_frames = 0;
    for (const Subject& subject : *read) all_frames = std::max(all_frames, subject.frame_count());
    flying.frames = options.is_whole ? all_frames : std::min(all_frames, options.frames);
    if (Result<void> made = make_folders(options.out, {"images"}); !made) return made;

    Result<gl::Context> context = gl::Context::headless();
    if (!context) return tl::unexpected(context.error());
    gl::ErrorCounter errors;
    std::vector<Subject> subjects = std::move(*read);  // go before the context
    for (Subject& subject : subjects) {
        if (Result<void> uploaded = upload(subject); !uploaded) return uploaded;
    }
    Result<Flown> flown = fly_section_4(subjects, flying, common);
    if (!flown) return tl::unexpected(flown.error());
    if (errors.count() > 0) return tl::unexpected(Error{Exit::our_bug, "OpenGL reports: " + errors.first()});
    RunSetup setup = setup_here(context->renderer(), flying.width_px, flying.height_px, words);
    return deliver(*flown, setup, options.out, common);
}

}  // namespace overlook::measure::paper::cameras
