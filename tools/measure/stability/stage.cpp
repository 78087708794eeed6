#include "tools/measure/stability/stage.h"

#include <algorithm>
#include <limits>

#include "runtime/view/flight.h"
#include "tools/measure/honesty/terrain_honesty.h"

namespace overlook::measure {

bool is_image(const MethodSpec& spec) {
    return spec.name == "lod-sprite";
}

bool has_history(const MethodSpec& spec) {
    return is_image(spec) || spec.name == "caveclod" || is_of_chains_alone(spec);
}

Pick pick_of(std::span<const MethodSpec> specs, Pick of_geometry) {
    return std::any_of(specs.begin(), specs.end(), has_history) ? Pick::in_row : of_geometry;
}

std::vector<view::Camera> cameras_of(const Stage& stage, const scene::Flight& flight, Pick pick) {
    uint32_t whole = scene::frame_count(flight);
    bool takes_all = pick == Pick::all || stage.frames == 0 || stage.frames >= whole;
    uint32_t count = takes_all ? whole : stage.frames;
    view::Camera base = stage.world.base;
    base.width_px = stage.width_px;
    base.height_px = stage.height_px;
    std::vector<view::Camera> cameras;
    for (uint32_t i = 0; i < count; ++i) {
        uint64_t frame = i;
        if (!takes_all && pick == Pick::spread && count > 1) frame = uint64_t(i) * (whole - 1) / (count - 1);
        view::Camera camera = view::camera_at(flight, scene::frame_time_s(flight, frame), base);
        cameras.push_back(stage.world.local(camera));
    }
    return cameras;
}

uint32_t samples_of(const MethodSpec& spec) {
    return uint32_t(setting(spec, "samples"));
}

Result<ImageRgb8> draw_once(Method& method, const view::Camera& camera, uint32_t frame, uint32_t samples) {
    Result<gl::Target> target = gl::Target::make(camera.width_px, camera.height_px, samples);
    if (!target) return tl::unexpected(target.error());
    method.decide(camera, frame);
    method.draw(*target);
    return target->read();
}

Result<Shot> shot_of(const Stage& stage, const MethodSpec& spec, const view::Camera& camera, uint32_t frame) {
    Result<ImageRgb8> test = draw_once(*stage.make(spec, stage.world), camera, frame, samples_of(spec));
    if (!test) return tl::unexpected(test.error());
    Result<ReferenceRenderer> renderer =
        ReferenceRenderer::make(stage.world, stage.renderer, camera.width_px, camera.height_px, stage.cache_folder);
    if (!renderer) return tl::unexpected(renderer.error());
    Result<Frame> reference = renderer->frame(camera);
    if (!reference) return tl::unexpected(reference.error());
    return Shot{frame, std::move(*test), {reference->width, reference->height, std::move(reference->rgb)}};
}

Displacement displacement_of(const Stage& stage, const MethodSpec& spec, const view::Camera& camera, double unsure_m) {
    terrain::Cut cut;
    stage.world.refiner->cut_by_pixels(camera, setting(spec, "error-px"), cut, morph_of(spec));
    std::vector<float> measured_px;
    measure_triangles(*stage.world.terrain, cut, camera, measured_px, unsure_m);
    float greatest = 0;
    for (float each : measured_px) greatest = std::max(greatest, each);
    return {double(greatest), cut.predicted_error_px};
}

double displacement_of(Method& method) {
    std::optional<Promises> promises = method.promises();
    if (!promises) return std::numeric_limits<double>::infinity();
    return promises->measured_px.empty() ? 0 : double(promises->measured_px.front());
}

Result<CourseResult> fly(Stage& stage, std::vector<view::Camera> cameras, double step_s, std::span<const MethodSpec> specs) {
    Course course{{specs.begin(), specs.end()}, std::move(cameras), step_s};
    add_floors(course.specs);
    return run_course(stage.world, course, stage.renderer, stage.cache_folder, [](double) {});
}

std::optional<Shot> shown(const WorstFrame& worst) {
    if (!worst.is_there) return std::nullopt;
    return Shot{worst.frame, worst.test, worst.reference};
}

bool is_cut(const Stage& stage, const MethodSpec& spec) {
    return stage.world.terrain != nullptr && !is_image(spec);
}

}  // namespace overlook::measure
