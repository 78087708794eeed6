#include "tools/measure/paper/fsi/fly.h"

#include "runtime/discrete/poses.h"
#include "tools/measure/paper/fsi/pictures.h"
#include "tools/measure/paper/fsi/variations.h"
#include "tools/measure/paper/work.h"

namespace overlook::measure::paper::fsi {
namespace {

constexpr size_t kLeastForMany = 1000;

// How far off the coarser level of a film is, in its pixels: SIMPLE's levels differ by their whole size.
double film_error_px(const std::string& name) {
    return name == "simple" ? 8 : 2;
}

// A scene's levels, and what is filmed of them.
struct Job {
    enum class What { ways, variations, optimised } what = What::ways;
    const Subject* subject = nullptr;
    const World* world = nullptr;
    std::string chain;
};

std::vector<Job> jobs_of(const std::vector<Subject>& subjects) {
    std::vector<Job> jobs;
    for (const Subject& subject : subjects) {
        jobs.push_back({Job::What::ways, &subject, &subject.world, ""});
        if (subject.by_hand) jobs.push_back({Job::What::ways, &subject, &*subject.by_hand, "by hand"});
        if (subject.optimised) jobs.push_back({Job::What::optimised, &subject, &*subject.optimised, "optimised visibility"});
        // Of the first, and of what moves.
        bool is_varied = &subject == &subjects.front() || discrete::is_animated(*things_of(subject.world).chain);
        if (is_varied) jobs.push_back({Job::What::variations, &subject, &subject.world, ""});
    }
    return jobs;
}

Script script_of(const Job& job, const Stand& stand) {
    if (job.what == Job::What::variations) return script_of_variations(job.subject->name, job.chain, stand);
    Script script{job.subject->name, job.chain, stand, {}};
    for (const Way& way : kWays) {
        // Ways with a visibility, and what they are held against.
        bool is_of_it = way.name == kWays[kPaper].name || way.name == kWays[kOwn].name || way.name == kWays[kSwitch].name;
        if (job.what == Job::What::optimised && !is_of_it) continue;
        Take take{std::string(way.name), {}};
        take.run.spec = spec_of(way, settings_of(stand, way));
        script.takes.push_back(std::move(take));
    }
    return script;
}

Result<void> do_job(const Job& job, const gl::Renderer& renderer, Flown& flown, const std::function<void(double)>& done) {
    Stand stand = stand_of(*things_of(*job.world).chain, film_error_px(job.subject->name));
    Script script = script_of(job, stand);
    Result<World> world = film_world(*job.world, stand);
    if (!world) return tl::unexpected(world.error());
    if (job.what == Job::What::ways) {
        Result<ImageRgb8> sequence = sequence_of(*world, script);
        if (!sequence) return tl::unexpected(sequence.error());
        std::string name = "sequence-" + job.subject->name + (job.chain.empty() ? "" : "-by-hand");
        std::string caption = title_of(job.subject->name) + (job.chain.empty() ? "" : ", levels by hand");
        flown.sequences.push_back({0, name, caption, std::move(*sequence)});
    }
    Result<Film> film = shoot(*world, script, renderer, done);
    if (!film) return tl::unexpected(film.error());
    (job.what == Job::What::ways         ? flown.films
     : job.what == Job::What::variations ? flown.varied
                                         : flown.optimised)
        .push_back(std::move(*film));
    return {};
}

Result<void> time_all(const std::vector<Subject>& subjects, Flown& flown) {
    for (const Subject& subject : subjects) {
        Stand stand = stand_of(*things_of(subject.world).chain, film_error_px(subject.name));
        Result<std::vector<Combining>> times = time_combining(subject.world, stand, subject.name, kAsked_px);
        if (!times) return tl::unexpected(times.error());
        flown.combining.insert(flown.combining.end(), times->begin(), times->end());
        Result<std::vector<Drawback>> drawbacks = drawbacks_of(subject.by_hand ? *subject.by_hand : subject.world);
        if (!drawbacks) return tl::unexpected(drawbacks.error());
        flown.drawbacks.emplace_back(subject.name, std::move(*drawbacks));
    }
    return {};
}

}  // namespace

Result<Flown> fly_all(std::vector<Subject>& subjects, uint32_t frames, bool flies_many, const gl::Renderer& renderer,
                      const command::Common& common) {
    Flown flown;
    flown.frames = frames;
    command::Progress progress(common, "flying");
    Result<std::vector<Picture>> pictures = pictures_of(subjects);
    if (!pictures) return tl::unexpected(pictures.error());
    flown.pictures = std::move(*pictures);
    {
        Part part(progress, common, "viewport sizes", 0.02, 0.5);
        for (size_t i = 0; i < subjects.size(); ++i) {
            flown.scenes.push_back(subjects[i].name);
            auto share_done = [&, done = part.done()](double share) { done((double(i) + share) / double(subjects.size())); };
            Result<std::vector<Point>> points = fly_sizes(subjects[i], renderer, frames, share_done);
            if (!points) return tl::unexpected(points.error());
            flown.points.insert(flown.points.end(), points->begin(), points->end());
        }
    }
    for (const Subject& subject : subjects) {
        // SIMPLE's few stand where the paper has them.
        if ((renderer.is_software && !flies_many) || things_of(subject.world).placements.size() < kLeastForMany) continue;
        Part part(progress, common, "100,000 of " + subject.name, 0.5, 0.5);
        Result<std::vector<Point>> points = fly_many(subject, renderer, frames);
        if (!points) return tl::unexpected(points.error());
        flown.points.insert(flown.points.end(), points->begin(), points->end());
    }
    if (Result<void> timed = time_all(subjects, flown); !timed) return tl::unexpected(timed.error());
    std::vector<Job> jobs = jobs_of(subjects);
    for (size_t i = 0; i < jobs.size(); ++i) {
        Part part(progress, common, "a film of " + jobs[i].subject->name, 0.5 + 0.5 * double(i) / double(jobs.size()),
                  0.5 + 0.5 * double(i + 1) / double(jobs.size()));
        if (Result<void> filmed = do_job(jobs[i], renderer, flown, part.done()); !filmed) return tl::unexpected(filmed.error());
    }
    return flown;
}

}  // namespace overlook::measure::paper::fsi
