#include "runtime/player/headless.h"

#include <algorithm>

#include "runtime/gl/context.h"
#include "runtime/gl/png.h"
#include "runtime/player/report.h"
#include "runtime/view/flight.h"

namespace overlook::player {

Result<void> write_picture(const Plan& plan, const gl::Target& target, uint32_t frame, bool is_last) {
    const std::string& pattern = plan.options.image;
    if (pattern.empty() || (!is_last && !is_numbered(pattern))) return {};
    Result<std::string> path = image_path(pattern, frame);
    if (!path) return tl::unexpected(path.error());
    return write_png(*path, target.read());
}

Result<void> run_headless(Plan plan, const command::Common& common, Scene read_scene) {
    Result<gl::Context> context = gl::Context::headless();
    if (!context) return tl::unexpected(context.error());
    gl::ErrorCounter errors;
    Scene scene = std::move(read_scene);  // goes before the context
    choose_samples(plan, context->renderer().is_software, false);
    Result<gl::Target> target = gl::Target::make(plan.width_px, plan.height_px, plan.options.samples);
    if (!target) return tl::unexpected(target.error());
    if (Result<void> uploaded = scene.upload(); !uploaded) return uploaded;

    settle(plan, scene);
    uint32_t frame_count = std::max(1u, plan.options.frames);
    std::vector<FrameRecord> records;
    view::ErrorController controller(budget_of(plan.options, *plan.method, scene.subject().thing(), plan.options.error_px));
    command::Progress progress(common, "drawing");
    for (uint32_t frame = 0; frame < frame_count; ++frame) {
        view::Camera camera = view::camera_at(plan.flight, scene::frame_time_s(plan.flight, frame), plan.base);
        Result<FrameRecord> record =
            scene.draw(*target, camera,
                       {*plan.method, scene.subject().thing(), controller.error_px(), plan.options.morph, plan.options.rings,
                        plan.draw, plan.flight.step_s, plan.options.triangles, plan.options.frame_ms, plan.options.pipelined});
        if (!record) return tl::unexpected(record.error());
        if (record->stream) {
            for (const Error& fault : record->stream->faults) command::note(common, "player: " + fault.message);
        }
        records.push_back(*record);
        controller.frame_done(cost_of(plan.options, records.back()));
        if (Result<void> written = write_picture(plan, *target, frame, frame + 1 == frame_count); !written) return written;
        progress.set(double(frame + 1) / frame_count);
    }
    if (errors.count() > 0) return tl::unexpected(Error{Exit::our_bug, "OpenGL reports: " + errors.first()});
    return deliver_report(plan, common, context->renderer(), records);
}

}  // namespace overlook::player
