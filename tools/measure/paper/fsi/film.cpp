#include "tools/measure/paper/fsi/film.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "tools/measure/figures.h"
#include "tools/measure/methods.h"
#include "tools/measure/numbers/percentiles.h"
#include "tools/measure/paper/fsi/easel.h"
#include "tools/measure/paper/fsi/subject.h"

namespace overlook::measure::paper::fsi {
namespace {

constexpr double kNearest = 4;       // radii of the thing, from the eye to the arc
constexpr double kHalfArc_deg = 28;  // from its middle
constexpr double kApart = 1.2;       // diameters, from one to the next
constexpr uint32_t kMostOnArc = 7;
constexpr double kBehind = 1.5;      // times the arc's distance
constexpr double kPace = 1.0 / 400;  // of the arc's distance, a frame, forward and to the right each
constexpr double kYaw_deg = 0.1;     // a frame

double film_focal_px() {
    return kFilmHeight_px / (2 * std::tan(kFilmFov_deg * std::numbers::pi / 360));
}

scene::Transform standing(const discrete::Chain& chain, double up_m, double distance_m, double angle_deg) {
    double angle = angle_deg * std::numbers::pi / 180;
    scene::Transform one;
    // The middle of the thing, not its foot, is so far away, whichever way it is turned.
    one.rotation_z_deg = std::fmod(angle_deg * 7.3, 360);
    double turn = one.rotation_z_deg * std::numbers::pi / 180, c = std::cos(turn), s = std::sin(turn);
    const glm::dvec3& middle = chain.middle_m;
    one.translation_m = {distance_m * std::sin(angle) - (c * middle.x - s * middle.y),
                         distance_m * std::cos(angle) - (s * middle.x + c * middle.y), up_m};
    return one;
}

// up_m: above the ground.
std::vector<scene::Instance> standing(const discrete::Chain& chain, double up_m, const Stand& stand) {
    std::vector<scene::Instance> all;
    auto add = [&](uint32_t count, double distance_m) {
        for (uint32_t i = 0; i < count; ++i) {
            double share = count == 1 ? 0.5 : double(i) / (count - 1);
            all.push_back({standing(chain, up_m, distance_m, kHalfArc_deg * (2 * share - 1))});
        }
    };
    add(stand.count, stand.distance_m);
    add(stand.count + 1, kBehind * stand.distance_m);
    return all;
}

// Frames from `first` to before `end`.
struct Span {
    uint32_t first = 0, end = 0;
    bool holds(uint32_t frame) const { return frame >= first && frame < end; }
};

// Pop index of some frames alone, by the median of all.
double pop_within(const RunResult& run, std::span<const TemporalError> base, Span frames) {
    std::vector<TemporalError> errors(base.begin(), base.end());
    for (size_t i = 0; i < errors.size(); ++i)
        if (frames.holds(errors[i].frame)) errors[i] = run.temporal[i];
    return pop_index(errors, base).index;
}

// The greatest that is there without a change in each frame and tile: either level at rest, or the floor, whose mean it has.
std::vector<TemporalError> unrest_at_rest(const Film& film) {
    std::vector<TemporalError> base = film.floor.temporal;
    for (const RunResult& level : film.standing)
        for (size_t i = 0; i < base.size(); ++i)
            for (size_t tile = 0; tile < base[i].tiles.size(); ++tile)
                base[i].tiles[tile] = std::max(base[i].tiles[tile], level.temporal[i].tiles[tile]);
    return base;
}

double w_of(const RunResult& run, uint32_t frame) {
    return *run.frames[frame].numbers.w;
}

double median_w(const RunResult& run, Span frames) {
    std::vector<double> w;
    for (uint32_t frame = frames.first; frame < frames.end; ++frame) w.push_back(w_of(run, frame));
    return std::max(1e-9, percentile(std::span<const double>(w), 0.5));
}

double summed_w(const RunResult& run, Span frames) {
    double sum = 0;
    for (uint32_t frame = frames.first; frame < frames.end; ++frame) sum += w_of(run, frame);
    return std::max(1e-9, sum);
}

// Half as wide and as high.
ImageRgb8 middle_of(const ImageRgb8& image) {
    ImageRgb8 middle{image.width / 2, image.height / 2, {}};
    for (uint32_t y = 0; y < middle.height; ++y) {
        auto from = image.pixels.begin() + std::ptrdiff_t(3) * ((y + image.height / 4) * image.width + image.width / 4);
        middle.pixels.insert(middle.pixels.end(), from, from + std::ptrdiff_t(3) * middle.width);
    }
    return middle;
}

double excess(const Take& take, const RunResult& floor, uint32_t frame) {
    return 1000 * (w_of(take.run, frame) - w_of(floor, frame));
}

// The time of a change that fades: its first frame to the first after it, of every way.
constexpr Span kUnderWay = {kBefore, kBefore + kFading + 1};

// end: the first frame after the take's last that is under way.
void hold_against_rest(const Film& film, const Take& take, uint32_t end, Seen& seen) {
    std::vector<TemporalError> base = unrest_at_rest(film);
    Span entering{kBefore, kBefore + 2}, leaving{std::max(end, kBefore + 1) - 1, end + 1};
    seen.entering_pop = pop_within(take.run, base, entering);
    seen.leaving_pop = pop_within(take.run, base, leaving);
    for (const RunResult& level : film.standing)
        for (Span frames : {entering, leaving})
            seen.standing_pop = std::max(seen.standing_pop, pop_within(level, film.floor.temporal, frames));
    const RunResult& at_once = film.takes.front().run;
    seen.rest_ratio = 0;
    for (Span frames : {Span{1, kBefore}, Span{kUnderWay.end, kFilmFrames}})
        seen.rest_ratio = std::max(seen.rest_ratio, median_w(take.run, frames) / median_w(at_once, frames));
    seen.change_ratio = summed_w(take.run, kUnderWay) / summed_w(at_once, kUnderWay);
}

}  // namespace

Stand stand_of(const discrete::Chain& chain, double error_px) {
    assert(chain.levels.size() >= 2);
    double nearest_m = kNearest * chain.radius_m;
    Stand stand;
    for (uint32_t change = 0; change + 1 < chain.levels.size(); ++change) {
        stand.change = change;
        stand.distance_m = double(chain.levels[change + 1].error_m) * film_focal_px() / error_px;
        if (stand.distance_m >= nearest_m) break;
    }
    if (stand.distance_m < nearest_m) stand.change = 0, stand.distance_m = nearest_m;
    double step = kApart * 2 * chain.radius_m / stand.distance_m, arc = 2 * kHalfArc_deg * std::numbers::pi / 180;
    stand.count = std::clamp(uint32_t(arc / step) + 1, 1u, kMostOnArc);
    return stand;
}

std::string settings_of(const Stand& stand, const Way& way) {
    if (way.name == kWays[kLate].name) return "";
    return fmt::format("@by=distance@distance-m={}@refine-share=1@coarsen-share=0.99", first_distance_m(stand));
}

std::string settings_of_standing(const Stand& stand, bool is_finer) {
    constexpr double kFarther = 1.2, kNearer = 0.8;  // well off the arc, and those behind keep what they have: 1.5 is between
    static_assert(kBehind > kFarther && kBehind < 2 * kNearer);
    return fmt::format("@by=distance@distance-m={}@refine-share=1@coarsen-share=0.99",
                       (is_finer ? kFarther : kNearer) * first_distance_m(stand));
}

double first_distance_m(const Stand& stand) {
    // Level l does from this times 2^(l - 1) on.
    return stand.distance_m / std::exp2(double(stand.change));
}

std::vector<view::Camera> film_cameras(const Stand& stand, const view::Camera& base) {
    std::vector<view::Camera> cameras;
    for (uint32_t frame = 0; frame < kFilmFrames; ++frame) {
        double beyond = double(frame) - (kBefore - 0.5);  // frames from the arc's middle: passed between two frames
        view::Camera camera = base;
        camera.position_m = base.position_m + beyond * kPace * stand.distance_m * glm::dvec3(1, 1, 0);
        camera.heading_deg = beyond * kYaw_deg;
        cameras.push_back(camera);
    }
    return cameras;
}

Result<World> film_world(const World& scene, const Stand& stand) {
    World world;
    world.name = scene.name;
    world.base.width_px = kFilmWidth_px, world.base.height_px = kFilmHeight_px;
    world.base.fov_y_deg = kFilmFov_deg, world.base.near_m = 0.05;
    const ChainWorld& things = things_of(scene);
    for (const ChainWorld& one : scene.chains) {
        ChainWorld& copy = world.chains.emplace_back(chain_world(*one.chain, {}));
        copy.placements = one.placements;
    }
    double up_m = things.placements.front().translation_m.z;
    world.chains[size_t(&things - scene.chains.data())] = chain_world(*things.chain, standing(*things.chain, up_m, stand));
    world.base.position_m.z = up_m + things.chain->middle_m.z;
    if (Result<void> uploaded = upload(world); !uploaded) return tl::unexpected(uploaded.error());
    return world;
}

Result<Film> shoot(World& world, const Script& script, const gl::Renderer& renderer, const std::function<void(double)>& done) {
    Course course;
    for (const Take& take : script.takes) course.specs.push_back(take.run.spec);
    for (bool is_finer : {false, true})
        course.specs.push_back(spec_of(kWays[kSwitch], settings_of_standing(script.stand, is_finer)));
    add_floors(course.specs);
    course.cameras = film_cameras(script.stand, world.base);
    course.step_s = kFilmStep_s;
    course.compared = Compared::steps;
    Result<CourseResult> flown = run_course(world, course, renderer, "", done);
    if (!flown) return tl::unexpected(flown.error());
    Film film{script.name, script.chain, script.stand, {}, {}, {}};
    film.floor = flown->runs[flown->runs[0].floor];
    for (size_t i = 0; i < film.standing.size(); ++i) film.standing[i] = std::move(flown->runs[script.takes.size() + i]);
    for (size_t i = 0; i < script.takes.size(); ++i) film.takes.push_back({script.takes[i].name, std::move(flown->runs[i])});
    return film;
}

Result<ImageRgb8> sequence_of(World& world, const Script& script) {
    std::vector<view::Camera> cameras = film_cameras(script.stand, world.base);
    std::vector<std::vector<ImageRgb8>> rows;
    world.step_s = kFilmStep_s;
    for (const Take& take : script.takes) {
        auto samples = uint32_t(setting(take.run.spec, "samples"));
        Result<gl::Target> target = gl::Target::make(kFilmWidth_px, kFilmHeight_px, samples);
        if (!target) return tl::unexpected(target.error());
        std::unique_ptr<Method> method = make_method(take.run.spec, world);
        rows.emplace_back();
        for (uint32_t frame = 0; frame < kFilmFrames; ++frame) {
            world.go_to(frame * kFilmStep_s);
            method->decide(cameras[frame], frame);
            method->draw(*target);
            bool is_shown = std::find(std::begin(kSequenceFrames), std::end(kSequenceFrames), frame) != std::end(kSequenceFrames);
            if (is_shown) rows.back().push_back(middle_of(target->read()));
        }
    }
    return montage(rows);
}

Seen seen_of(const Film& film, const Take& take) {
    const RunResult& run = take.run;
    Seen seen;
    uint32_t end = kBefore;  // of the last frame that differs from the one before because of the change
    for (uint32_t frame = kBefore; frame < kFilmFrames; ++frame)
        if (run.frames[frame].counters.transition_count > 0) end = frame + 1;
    seen.entering_w = excess(take, film.floor, kBefore);
    seen.leaving_w = excess(take, film.floor, end);
    double before = double(run.frames[kBefore].counters.triangle_count), sum = 0;
    for (uint32_t frame = kBefore; frame <= end; ++frame) {
        seen.greatest_w = std::max(seen.greatest_w, excess(take, film.floor, frame));
        seen.integrated_w += excess(take, film.floor, frame);
    }
    for (uint32_t frame = kBefore; frame < kBefore + kFading; ++frame) {
        double triangles = double(run.frames[frame].counters.triangle_count);
        sum += triangles;
        if (run.frames[frame].counters.transition_count > 0)
            seen.odd_even = std::max(seen.odd_even, std::abs(triangles - before) / std::max(triangles, before));
        before = triangles;
    }
    seen.triangles = sum / kFading;
    double median = median_w(run, kUnderWay), greatest = 0;
    for (uint32_t frame = kUnderWay.first; frame < kUnderWay.end; ++frame) greatest = std::max(greatest, w_of(run, frame));
    seen.end_ratio = std::max(w_of(run, kBefore), w_of(run, end)) / median;
    seen.greatest_ratio = greatest / median;
    seen.median_w = 1000 * percentiles_of(run, "w_luma").p50;
    hold_against_rest(film, take, end, seen);
    seen.pop = run.pop.index;
    seen.buffer_bytes =
        double(run.frames.back().counters.resident_bytes) - double(film.takes.front().run.frames.back().counters.resident_bytes);
    return seen;
}

std::string films_csv(const std::vector<Film>& films) {
    std::string csv =
        "scene,chain,method,from_level,to_level,distance_m,instances,entering_w_1000,leaving_w_1000,greatest_w_1000,"
        "integrated_w_1000,median_w_1000,entering_pop,leaving_pop,pop,standing_pop,rest_ratio,change_ratio,end_ratio,greatest_"
        "ratio,triangles,odd_even_share,buffer_"
        "bytes\n";
    for (const Film& film : films)
        for (const Take& take : film.takes) {
            Seen s = seen_of(film, take);
            csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", film.name, film.chain,
                               take.name, film.stand.change + 1, film.stand.change, film.stand.distance_m, film.stand.count,
                               s.entering_w, s.leaving_w, s.greatest_w, s.integrated_w, s.median_w, s.entering_pop, s.leaving_pop,
                               s.pop, s.standing_pop, s.rest_ratio, s.change_ratio, s.end_ratio, s.greatest_ratio, s.triangles,
                               s.odd_even, s.buffer_bytes);
        }
    return csv;
}

}  // namespace overlook::measure::paper::fsi
