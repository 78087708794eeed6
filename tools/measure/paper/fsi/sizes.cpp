#include "tools/measure/paper/fsi/sizes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "tools/measure/figures.h"

namespace overlook::measure::paper::fsi {
namespace {

constexpr double kLateError_px = 0.25;  // what nobody sees, at any size

double odd_even_of(const RunResult& run) {
    double sum = 0;
    for (size_t i = 1; i < run.frames.size(); ++i) {
        double before = double(run.frames[i - 1].counters.triangle_count), now = double(run.frames[i].counters.triangle_count);
        sum += std::abs(now - before) / std::max({before, now, 1.0});
    }
    return run.frames.size() < 2 ? 0 : sum / double(run.frames.size() - 1);
}

Point point_of(const RunResult& run) {
    Point point;
    point.frames = uint32_t(run.frames.size());
    Percentiles ms = percentiles_of(run, "frame_ms");
    point.p50_ms = ms.p50, point.max_ms = ms.max, point.decide_p50_ms = percentiles_of(run, "decide_ms").p50;
    point.triangles = mean_of(run, "triangles").value_or(0), point.draw_calls = mean_of(run, "draw_calls").value_or(0);
    point.fading = mean_of(run, "transitions").value_or(0);
    point.odd_even = odd_even_of(run);
    for (const FrameRecord& frame : run.frames) {
        point.resident_bytes = std::max(point.resident_bytes, frame.counters.resident_bytes);
        point.state_bytes = std::max(point.state_bytes, frame.counters.camera_bytes);
    }
    return point;
}

// The scene's chains, shaded by more lights.
Result<World> heavy_world(const World& scene) {
    World world;
    world.name = scene.name, world.base = scene.base, world.step_s = scene.step_s;
    for (const ChainWorld& one : scene.chains) {
        ChainWorld& copy = world.chains.emplace_back(chain_world(*one.chain, {}));
        copy.placements = one.placements;
    }
    if (Result<void> uploaded = upload(world, kHeavyRounds); !uploaded) return tl::unexpected(uploaded.error());
    return world;
}

// What the scene holds, again and again: field beside field, to both sides of the first and beyond it, kMany things and no more.
Result<World> many_world(const World& scene) {
    const ChainWorld& things = things_of(scene);
    glm::dvec3 low_m = things.placements.front().translation_m, high_m = low_m;
    for (const discrete::Placement& one : things.placements)
        low_m = glm::min(low_m, one.translation_m), high_m = glm::max(high_m, one.translation_m);
    auto count = uint32_t(things.placements.size());
    uint32_t fields = (kMany + count - 1) / count, columns = uint32_t(std::ceil(std::sqrt(double(fields))));
    // As far from field to field as from one thing to the next.
    glm::dvec3 step_m = (high_m - low_m) * (1 + 1 / std::sqrt(double(count)));
    World world;
    world.name = scene.name, world.base = scene.base, world.step_s = scene.step_s;
    for (const ChainWorld& one : scene.chains) {
        ChainWorld& copy = world.chains.emplace_back(chain_world(*one.chain, {}));
        copy.placements.clear();
        for (uint32_t field = 0; field < fields; ++field)
            for (discrete::Placement placement : one.placements) {
                if (&one == &things && copy.placements.size() == kMany) break;
                placement.translation_m.x += (double(field % columns) - columns / 2) * step_m.x;
                placement.translation_m.y += double(field / columns) * step_m.y;
                copy.placements.push_back(placement);
            }
    }
    if (Result<void> uploaded = upload(world); !uploaded) return tl::unexpected(uploaded.error());
    return world;
}

// Frames of the flight's middle at one size, by some ways in turns.
Course course_of(const Subject& subject, std::span<const Way> ways, uint32_t frames, uint32_t side_px) {
    Course course;
    for (const Way& way : ways) course.specs.push_back(spec_of(way, settings_at(asked_of(subject.name), side_px, way)));
    course.cameras = cameras_of(subject, frames + 1, side_px, side_px);
    course.lead = {course.cameras.front()};  // changes begin after it
    course.cameras.erase(course.cameras.begin());
    course.step_s = subject.flight.step_s;
    course.compared = Compared::none;
    return course;
}

void add_points(const CourseResult& result, const Subject& subject, const std::string& chain, std::span<const Way> ways,
                uint32_t side_px, std::vector<Point>& points) {
    for (size_t i = 0; i < ways.size(); ++i) {
        Point point = point_of(result.runs[i]);
        point.scene = subject.name, point.chain = chain, point.method = ways[i].name, point.side_px = side_px;
        points.push_back(std::move(point));
    }
}

}  // namespace

Asked asked_of(const std::string& name) {
    if (name == "simple") return {8, 1};
    if (name == "trees") return {8, 4};
    return {};
}

std::string settings_at(const Asked& asked, uint32_t side_px, const Way& way) {
    double error_px = (way.name == kWays[kLate].name ? kLateError_px : 1.0) * asked.error_px * side_px / kAsked_px;
    return fmt::format("@error-px={}@samples=1", error_px);
}

Result<std::vector<Point>> fly_sizes(Subject& subject, const gl::Renderer& renderer, uint32_t frames,
                                     const std::function<void(double)>& done) {
    struct Part {
        std::string chain;
        World* world;
        std::vector<Way> ways;
    };
    Result<World> heavy = heavy_world(subject.world);
    if (!heavy) return tl::unexpected(heavy.error());
    std::vector<Part> parts = {{"", &subject.world, {kWays.begin(), kWays.end()}},
                               {kHeavy, &*heavy, {kWays[kSwitch], kWays[kBlend], kWays[kPaper], kWays[kOwn]}}};
    if (subject.by_hand) parts.push_back({"by hand", &*subject.by_hand, {kWays[kSwitch], kWays[kPaper]}});
    uint32_t count = std::max(2u, frames / asked_of(subject.name).frames_share);
    std::vector<Point> points;
    double runs = double(parts.size() * std::size(kSides_px)), flown = 0;
    for (const Part& part : parts)
        for (uint32_t side_px : kSides_px) {
            Course course = course_of(subject, part.ways, count, side_px);
            Result<CourseResult> result =
                run_course(*part.world, course, renderer, "", [&](double share) { done((flown + share) / runs); });
            if (!result) return tl::unexpected(result.error());
            flown += 1;
            add_points(*result, subject, part.chain, part.ways, side_px, points);
        }
    return points;
}

Result<std::vector<Point>> fly_many(const Subject& subject, const gl::Renderer& renderer, uint32_t frames) {
    Result<World> many = many_world(subject.world);
    if (!many) return tl::unexpected(many.error());
    const std::array<Way, 2> ways = {kWays[kSwitch], kWays[kOwn]};
    Result<CourseResult> result = run_course(*many, course_of(subject, ways, frames, kAsked_px), renderer, "", [](double) {});
    if (!result) return tl::unexpected(result.error());
    std::vector<Point> points;
    add_points(*result, subject, kManyChain, ways, kAsked_px, points);
    return points;
}

const Point* find(const std::vector<Point>& points, const std::string& scene, const std::string& chain, std::string_view method,
                  uint32_t side_px) {
    auto found = std::find_if(points.begin(), points.end(), [&](const Point& one) {
        return one.scene == scene && one.chain == chain && one.method == method && one.side_px == side_px;
    });
    return found == points.end() ? nullptr : &*found;
}

std::string sizes_csv(const std::vector<Point>& points) {
    std::string csv =
        "scene,chain,method,side_px,frames,frame_ms_p50,frame_ms_max,decide_ms_p50,triangles,draw_calls,fading,"
        "odd_even_share,resident_bytes,state_bytes\n";
    for (const Point& p : points)
        csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", p.scene, p.chain, p.method, p.side_px, p.frames,
                           p.p50_ms, p.max_ms, p.decide_p50_ms, p.triangles, p.draw_calls, p.fading, p.odd_even, p.resident_bytes,
                           p.state_bytes);
    return csv;
}

}  // namespace overlook::measure::paper::fsi
