#include "tools/measure/paper/lod_sprite/fly.h"

#include <algorithm>
#include <cmath>

#include "runtime/view/flight.h"
#include "tools/measure/figures.h"
#include "tools/measure/methods.h"

namespace overlook::measure::paper::sprite {
namespace {

view::Camera camera_at(const Flying& flying, double time_s) {
    view::Camera base = flying.world.base;
    base.width_px = flying.width_px;
    base.height_px = flying.height_px;
    return view::camera_into(flying.world.transform, view::camera_at(flying.flight, time_s, base));
}

// Keys that are drawn beside the picture are counted when they are begun, those that are the picture when they are made.
uint32_t key_frames(const RunResult& run) {
    auto count = [&](auto is_key) { return uint32_t(std::count_if(run.frames.begin(), run.frames.end(), is_key)); };
    uint32_t beside = count([](const FrameRecord& frame) { return frame.counters.key_pixel_count > 0; });
    return beside > 0 ? beside : count([](const FrameRecord& frame) { return frame.counters.event_count > 0; });
}

// The last of some frames of one method under a still camera.
Result<ViewPicture> still(const Flying& flying, const MethodSpec& spec, const view::Camera& camera, uint32_t frames) {
    Result<gl::Target> target = gl::Target::make(flying.width_px, flying.height_px, uint32_t(setting(spec, "samples")));
    if (!target) return tl::unexpected(target.error());
    std::unique_ptr<Method> method = make_method(spec, flying.world);
    ViewPicture picture;
    picture.family = family_of(spec);
    for (uint32_t frame = 0; frame < frames; ++frame) {
        method->decide(camera, frame);
        picture.triangle_count = method->draw(*target).triangle_count;
    }
    picture.image = target->read();
    return picture;
}

}  // namespace

double step_s(const Flying& flying, uint32_t frames) {
    return flying.flight.keys.back().time_s / (frames - 1);
}

std::vector<view::Camera> cameras_of(const Flying& flying, uint32_t frames) {
    std::vector<view::Camera> cameras;
    for (uint32_t frame = 0; frame < frames; ++frame) cameras.push_back(camera_at(flying, frame * step_s(flying, frames)));
    return cameras;
}

Result<CourseResult> fly_beside(const Flying& flying, const Cast& cast, const std::function<void(double)>& done) {
    Course course{{cast.high, cast.low}, cameras_of(flying, flying.frames), step_s(flying, flying.frames), Compared::pairs};
    course.specs.insert(course.specs.end(), cast.sprites.begin(), cast.sprites.end());
    add_floors(course.specs);
    return run_course(flying.world, course, flying.renderer, flying.cache_folder, done);
}

double mean_ms(const RunResult& run) {
    double sum_ms = 0;
    for (const FrameRecord& frame : run.frames) sum_ms += frame.frame_ms();
    return sum_ms / double(run.frames.size());
}

Swept swept_from(const RunResult& run, const RunResult* high, double threshold_px) {
    return {family_of(run.spec), threshold_px, uint32_t(run.frames.size()),
            key_frames(run),     mean_ms(run), high ? mean_ms(*high) : 0};
}

Result<std::vector<Swept>> fly_thresholds(const Flying& flying, const Cast& cast, std::span<const double> thresholds_px,
                                          const std::function<void(double)>& done) {
    Course course{{cast.high}, cameras_of(flying, flying.frames), step_s(flying, flying.frames), Compared::none};
    for (const MethodSpec& sprite : cast.sprites) {
        for (double threshold_px : thresholds_px) course.specs.push_back(at_threshold(sprite, threshold_px));
    }
    Result<CourseResult> flown = run_course(flying.world, course, flying.renderer, "", done);
    if (!flown) return tl::unexpected(flown.error());
    std::vector<Swept> swept;
    for (size_t i = 1; i < flown->runs.size(); ++i)
        swept.push_back(swept_from(flown->runs[i], &flown->runs[0], thresholds_px[(i - 1) % thresholds_px.size()]));
    return swept;
}

Result<std::vector<Swept>> fly_frame_counts(const Flying& flying, const Cast& cast, std::span<const uint32_t> counts,
                                            const std::function<void(double)>& done) {
    uint32_t all = 0, flown_frames = 0;
    for (uint32_t count : counts) all += count;
    std::vector<Swept> swept;
    for (uint32_t count : counts) {
        Course course{cast.sprites, cameras_of(flying, count), step_s(flying, count), Compared::none};
        auto part_done = [&](double share) { done((flown_frames + share * count) / all); };
        Result<CourseResult> flown = run_course(flying.world, course, flying.renderer, "", part_done);
        if (!flown) return tl::unexpected(flown.error());
        for (const RunResult& run : flown->runs) swept.push_back(swept_from(run, nullptr, kThreshold_px));
        flown_frames += count;
    }
    return swept;
}

Result<ViewPictures> draw_view(const Flying& flying, const Cast& cast, const PlanView& view) {
    view::Camera camera = camera_at(flying, view.time_s);
    ViewPictures pictures{view, {}, {}, {}};
    Result<ViewPicture> low = still(flying, cast.low, camera, 1), high = still(flying, cast.high, camera, 1);
    if (!low) return tl::unexpected(low.error());
    if (!high) return tl::unexpected(high.error());
    pictures.low = std::move(*low);
    pictures.high = std::move(*high);
    for (const MethodSpec& spec : cast.sprites) {
        Result<ViewPicture> sprite = still(flying, spec, camera, kStillFrames);
        if (!sprite) return tl::unexpected(sprite.error());
        pictures.sprites.push_back(std::move(*sprite));
    }
    return pictures;
}

std::vector<PathPoint> path_of(const Flying& flying, uint32_t frames) {
    const terrain::Terrain& terrain = *flying.world.terrain;
    std::vector<PathPoint> path;
    for (const view::Camera& camera : cameras_of(flying, frames)) {
        PathPoint point{camera.position_m.x, camera.position_m.y, camera.position_m.z, 0, 0, false};
        double column = std::round(point.east_m / terrain.frame.metres_per_column);
        double row = std::round(-point.north_m / terrain.frame.metres_per_row);
        double last_column = terrain.shape.width - 1.0, last_row = terrain.shape.height - 1.0;
        point.is_over_terrain = column >= 0 && row >= 0 && column <= last_column && row <= last_row;
        uint32_t at_column = uint32_t(std::clamp(column, 0.0, last_column)), at_row = uint32_t(std::clamp(row, 0.0, last_row));
        if (!terrain.is_void(at_column, at_row)) point.ground_m = terrain.height_m(at_column, at_row);
        if (!path.empty()) {
            const PathPoint& before = path.back();
            point.flown_m = before.flown_m + std::hypot(point.east_m - before.east_m, point.north_m - before.north_m,
                                                        point.height_m - before.height_m);
        }
        path.push_back(point);
    }
    return path;
}

}  // namespace overlook::measure::paper::sprite
