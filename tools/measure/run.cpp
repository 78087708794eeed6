#include "tools/measure/run.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <set>

#include "runtime/gl/timer.h"
#include "tools/measure/capture.h"
#include "tools/measure/judge.h"
#include "tools/measure/methods.h"
#include "tools/measure/numbers/frame_subset.h"
#include "tools/measure/reuse_truth.h"

namespace overlook::measure {
namespace {

// A run while it is under way.
struct Running {
    std::unique_ptr<Method> method;
    const gl::Target* target = nullptr;
    Frame before, now;
    std::vector<TemporalError> temporal;
};

uint32_t samples_of(const MethodSpec& spec) {
    return uint32_t(setting(spec, "samples"));
}

class Field {
  public:
    static Result<Field> make(World& world, const Course& course) {
        Field field;
        world.step_s = course.step_s;
        field.world_ = &world;
        const view::Camera& camera = course.cameras.front();
        if (Result<void> added = field.add_target(camera, 1); !added) return tl::unexpected(added.error());
        for (const MethodSpec& spec : course.specs) {
            if (Result<void> added = field.add_target(camera, samples_of(spec)); !added) return tl::unexpected(added.error());
        }
        for (const MethodSpec& spec : course.specs) field.add_run(spec, world);
        for (size_t i = 0; i < course.specs.size(); ++i) field.warm_up(i, world, camera);
        for (uint32_t frame = 0; frame < course.lead.size(); ++frame) {
            for (size_t i = 0; i < course.specs.size(); ++i) field.draw(i, course.lead[frame], frame);
        }
        field.lead_frames_ = uint32_t(course.lead.size());
        return field;
    }

    // Decides and draws one frame of one run; leaves the picture in its target.
    FrameRecord draw(size_t run, const view::Camera& camera, uint32_t frame) {
        Running& running = runs[run];
        FrameRecord record;
        record.frame = frame;
        world_->go_to(double(lead_frames_ + frame) * world_->step_s);
        gl::Timer deciding;
        running.method->decide(camera, lead_frames_ + frame);
        record.decide_ms = deciding.elapsed_ms();
        gl::Timer drawing;
        record.counters = running.method->draw(*running.target);
        record.draw_ms = drawing.finished_ms();
        return record;
    }

    // Measures what the frame that draw() left promises of each thing in it.
    void take_g(size_t run) {
        std::optional<Promises> promises = runs[run].method->promises();
        if (!promises) return;
        results[run].frames.back().numbers.g = results[run].g.add(promises->predicted_px, promises->measured_px);
    }

    // Takes the picture that draw() left.
    void capture(size_t run, const view::Camera& camera) {
        Running& running = runs[run];
        const gl::Target& middle = targets.at(1);
        if (running.target != &middle) running.method->draw(middle);
        running.now = captured(*running.target, middle, camera);
    }

    std::vector<Running> runs;
    std::vector<RunResult> results;
    std::map<uint32_t, gl::Target> targets;  // by samples a pixel

  private:
    Result<void> add_target(const view::Camera& camera, uint32_t samples) {
        if (targets.contains(samples)) return {};
        Result<gl::Target> target = gl::Target::make(camera.width_px, camera.height_px, samples);
        if (!target) return tl::unexpected(target.error());
        targets.emplace(samples, std::move(*target));
        return {};
    }

    void add_run(const MethodSpec& spec, World& world) {
        Running running;
        running.method = make_method(spec, world);
        running.target = &targets.at(samples_of(spec));
        runs.push_back(std::move(running));
        RunResult result;
        result.spec = spec;
        result.label = label_of(spec);
        results.push_back(std::move(result));
    }

    // With a method of its own, so that none begins the flight with a history.
    void warm_up(size_t run, World& world, const view::Camera& camera) {
        std::unique_ptr<Method> method = make_method(results[run].spec, world);
        method->decide(camera, 0);
        method->draw(*runs[run].target);
        runs[run].method->prepare(camera, *runs[run].target);
        glFinish();
    }

    World* world_ = nullptr;
    uint32_t lead_frames_ = 0;
};

// A run without one, which nothing compares, is its own.
void find_floors(std::vector<RunResult>& results) {
    for (RunResult& result : results) {
        MethodSpec floor = floor_spec(setting(result.spec, "samples"));
        auto found = std::find_if(results.begin(), results.end(), [&](const RunResult& one) { return one.spec == floor; });
        result.floor = size_t((found == results.end() ? results.begin() + (&result - results.data()) : found) - results.begin());
    }
}

// FLIP of a frame that may have been taken already.
void take_e(const Frame& test, const Frame& reference, FrameRecord& record, WorstFrame& worst) {
    if (!record.numbers.e_p99) judge_e(test, reference, record, worst);
}

// Measures the frames of all runs, as many as are compared. Frame 0 has none before it.
class Judge {
  public:
    Judge(World& world, ReferenceRenderer& reference, const Course& course, TimeSpent& spent)
        : world_(world), truth_(world), reference_(reference), course_(course), spent_(spent) {}

    // Once a frame, when all runs have drawn it and are captured.
    Result<void> judge(Field& field, uint32_t frame) {
        bool has_event = std::any_of(field.results.begin(), field.results.end(),
                                     [&](const RunResult& run) { return run.frames[frame].counters.event_count > 0; });
        bool is_pairs = course_.compared == Compared::pairs;
        if (course_.compared == Compared::steps) has_event = false;
        bool wants_e = frame % kFlipStep == 0 || has_event || had_event_;
        bool is_compared = !is_pairs || wants_e || frame % kFlipStep == 1;
        std::optional<Frame> truth;
        if (is_compared) {
            Result<Frame> drawn = referred(frame);
            if (!drawn) return tl::unexpected(drawn.error());
            truth = std::move(*drawn);
        }
        if (has_event && frame > 0 && !before_) {
            Result<Frame> drawn = referred(frame - 1);
            if (!drawn) return tl::unexpected(drawn.error());
            before_ = std::move(*drawn);
            for (size_t i = 0; i < field.runs.size(); ++i) {
                Result<void> judged = judge_one(field.results[i], field.runs[i].before, *before_, frame - 1);
                if (!judged) return judged;
            }
        }
        gl::Timer judging;
        if (truth) {
            if (Result<void> compared = compare(field, frame, *truth, wants_e, has_event); !compared) return compared;
        }
        for (Running& running : field.runs) std::swap(running.before, running.now);
        had_event_ = has_event;
        before_ = std::move(truth);
        spent_.numbers_ms += judging.elapsed_ms();
        return {};
    }

  private:
    static constexpr uint32_t kFlipStep = 10;

    // What moves by itself is where it is then.
    void go_to(uint32_t frame) { world_.go_to(double(course_.lead.size() + frame) * course_.step_s); }

    Result<Frame> referred(uint32_t frame) {
        gl::Timer referring;
        go_to(frame);
        Result<Frame> drawn = reference_.frame(course_.cameras[frame]);
        spent_.references_ms += referring.elapsed_ms();
        return drawn;
    }

    Result<void> judge_one(RunResult& result, const Frame& test, const Frame& truth, uint32_t frame) {
        FrameRecord& record = result.frames[frame];
        go_to(frame);
        auto around = [&](uint32_t margin_px) { return reference_.surroundings(course_.cameras[frame], margin_px); };
        HoleRule rule{promised_px(result.spec, record.counters), nullptr, world_.is_chain() || world_.is_planted()};
        return judge_picture(test, truth, rule, around, record.numbers);
    }

    Result<void> compare(Field& field, uint32_t frame, const Frame& truth, bool wants_e, bool has_event) {
        std::optional<Motion> motion;
        if (before_) motion = motion_between(*before_, truth);
        for (size_t i = 0; i < field.runs.size(); ++i) {
            Running& running = field.runs[i];
            RunResult& result = field.results[i];
            FrameRecord& record = result.frames[frame];
            if (Result<void> judged = judge_one(result, running.now, truth, frame); !judged) return judged;
            std::optional<Sources> sources = running.method->sources(field.targets.at(1));
            if (sources) {
                Result<Reuse> reuse = truth_.reuse(*sources, truth);
                if (!reuse) return tl::unexpected(reuse.error());
                record.numbers.ghost_share = reuse->errors.ghost_share;
                record.numbers.loss_share = reuse->errors.loss_share;
                record.numbers.near_share = reuse->near_share;
            }
            if (wants_e) take_e(running.now, truth, record, result.worst_e);
            if (has_event && before_) take_e(running.before, *before_, result.frames[frame - 1], result.worst_e);
            if (motion) {
                running.temporal.push_back(
                    judge_w(*motion, running.before, running.now, *before_, truth, record, result.worst_w));
            }
        }
        return {};
    }

    World& world_;
    ReuseTruth truth_;
    ReferenceRenderer& reference_;
    const Course& course_;
    TimeSpent& spent_;
    std::optional<Frame> before_;  // the reference's, where it was compared
    bool had_event_ = false;
};

// Frame by frame as when it is compared, without references, reading back and floors.
Result<CourseResult> run_uncompared(World& world, const Course& course, const std::function<void(double)>& done) {
    Result<Field> field = Field::make(world, course);
    if (!field) return tl::unexpected(field.error());
    find_floors(field->results);
    for (uint32_t frame = 0; frame < course.cameras.size(); ++frame) {
        for (size_t i = 0; i < course.specs.size(); ++i) {
            size_t run = (frame + i) % course.specs.size();
            field->results[run].frames.push_back(field->draw(run, course.cameras[frame], frame));
        }
        done(double(frame + 1) / double(course.cameras.size()));
    }
    return CourseResult{std::move(field->results), 0, 0, 0, {}};
}

void take_pop_indices(Field& field) {
    for (size_t i = 0; i < field.runs.size(); ++i) {
        field.results[i].pop = pop_index(field.runs[i].temporal, field.runs[field.results[i].floor].temporal);
    }
    for (size_t i = 0; i < field.runs.size(); ++i) field.results[i].temporal = std::move(field.runs[i].temporal);
}

}  // namespace

void add_floors(std::vector<MethodSpec>& specs) {
    for (size_t i = 0, count = specs.size(); i < count; ++i) {
        MethodSpec floor = floor_spec(setting(specs[i], "samples"));
        if (std::find(specs.begin(), specs.end(), floor) == specs.end()) specs.push_back(floor);
    }
}

Result<CourseResult> run_course(World& world, const Course& course, const gl::Renderer& renderer, const std::string& cache_folder,
                                const std::function<void(double)>& done) {
    if (course.compared == Compared::none) return run_uncompared(world, course, done);
    const view::Camera& first = course.cameras.front();
    Result<ReferenceRenderer> reference = ReferenceRenderer::make(world, renderer, first.width_px, first.height_px, cache_folder);
    if (!reference) return tl::unexpected(reference.error());
    Result<Field> field = Field::make(world, course);
    if (!field) return tl::unexpected(field.error());
    find_floors(field->results);

    std::vector<uint32_t> g_chosen = spread_frames(uint32_t(course.cameras.size()), kMostHonestyFrames);
    std::set<uint32_t> g_frames(g_chosen.begin(), g_chosen.end());
    TimeSpent spent;
    Judge judge(world, *reference, course, spent);
    for (uint32_t frame = 0; frame < course.cameras.size(); ++frame) {
        const view::Camera& camera = course.cameras[frame];
        for (size_t i = 0; i < course.specs.size(); ++i) {
            size_t run = (frame + i) % course.specs.size();
            gl::Timer flying;
            field->results[run].frames.push_back(field->draw(run, camera, frame));
            field->capture(run, camera);
            spent.methods_ms += flying.elapsed_ms();
            gl::Timer promising;
            if (g_frames.contains(frame)) field->take_g(run);
            spent.promises_ms += promising.elapsed_ms();
        }
        if (Result<void> judged = judge.judge(*field, frame); !judged) return tl::unexpected(judged.error());
        done(double(frame + 1) / double(course.cameras.size()));
    }
    take_pop_indices(*field);
    return CourseResult{std::move(field->results), reference->drawn_count(), reference->kept_count(), reference->damaged_count(),
                        spent};
}

Result<CourseResult> run_by_wall_clock(World& world, const Course& course, const std::function<void(double)>& done) {
    Result<Field> field = Field::make(world, course);
    if (!field) return tl::unexpected(field.error());
    find_floors(field->results);
    double last_frame = double(course.cameras.size() - 1);
    for (size_t run = 0; run < course.specs.size(); ++run) {
        gl::Timer clock;
        for (double at = 0; at <= last_frame; at = clock.elapsed_ms() / 1000 / course.step_s) {
            uint32_t frame = uint32_t(at);
            field->results[run].frames.push_back(field->draw(run, course.cameras[frame], frame));
        }
        done(double(run + 1) / double(course.specs.size()));
    }
    return CourseResult{std::move(field->results), 0, 0, 0, {}};
}

}  // namespace overlook::measure
