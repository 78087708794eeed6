// The cases that are judged on frames beside the reference.
#include <algorithm>

#include "tools/measure/capture.h"
#include "tools/measure/figures.h"
#include "tools/measure/stability/stage.h"

namespace overlook::measure {
namespace {

double greatest(const RunResult& run, std::string_view name) {
    return percentiles_of(run, name).max;
}

std::vector<double> promised_px(const RunResult& run) {
    return values_of(run, figure("predicted_error_px"));
}

// Flies the frames and counts holes; S03, S04, S06, S07 and S08 begin so.
Result<std::vector<Finding>> count_holes(Stage& stage, const std::vector<view::Camera>& cameras, double step_s,
                                         std::span<const MethodSpec> specs) {
    Result<CourseResult> course = fly(stage, cameras, step_s, specs);
    if (!course) return tl::unexpected(course.error());
    std::vector<Finding> findings;
    for (size_t i = 0; i < specs.size(); ++i) {
        const RunResult& run = course->runs[i];
        Finding finding;
        double holes = 0;
        for (double each : values_of(run, figure("hole_px"))) holes += each;
        finding.figures["hole_pixels"] = holes;
        finding.figures["silhouette_p95_px"] = greatest(run, "s_p95_px");
        finding.figures["silhouette_p95_of_geometry_px"] = greatest(course->runs[run.floor], "s_p95_px");
        finding.frames = uint32_t(cameras.size());
        finding.worst = shown(run.worst_e);
        finding.promised_px = promised_px(run);
        findings.push_back(std::move(finding));
    }
    return findings;
}

// How many frames at a place until the method promises what was asked of it, the first counting as 0; at most kLongestWait.
Result<uint32_t> frames_until_promised(Stage& stage, const MethodSpec& spec, Method& method, const view::Camera& camera,
                                       uint32_t& frame) {
    constexpr uint32_t kLongestWait = 60;
    Result<gl::Target> target = gl::Target::make(camera.width_px, camera.height_px, samples_of(spec));
    if (!target) return tl::unexpected(target.error());
    for (uint32_t waited = 0; waited < kLongestWait; ++waited) {
        method.decide(camera, frame++);
        if (method.draw(*target).predicted_error_px <= stage.asked_px) return waited;
    }
    return kLongestWait;
}

// The greatest displacement of each frame of a mesh, one after the other.
std::vector<double> displacements_in_row(Stage& stage, const MethodSpec& spec, const std::vector<view::Camera>& cameras) {
    std::unique_ptr<Method> method = stage.make(spec, stage.world);
    std::vector<double> displacements_px;
    for (uint32_t frame = 0; frame < cameras.size(); ++frame) {
        method->decide(cameras[frame], frame);
        displacements_px.push_back(displacement_of(*method));
    }
    return displacements_px;
}

// How many frames of a mesh after each arrival, the first counting as 0, until what was asked is kept; at most kLongestWait.
uint32_t frames_until_kept(Stage& stage, const MethodSpec& spec, const std::vector<view::Camera>& arrivals) {
    constexpr uint32_t kLongestWait = 60;
    std::unique_ptr<Method> method = stage.make(spec, stage.world);
    uint32_t frame = 0, longest = 0;
    for (const view::Camera& camera : arrivals) {
        for (uint32_t waited = 0; waited < kLongestWait; ++waited) {
            method->decide(camera, frame++);
            if (displacement_of(*method) <= stage.asked_px) break;
            longest = std::max(longest, waited + 1);
        }
    }
    return longest;
}

// Pixels of the frame in which the surface stands nearer than the near plane.
Result<uint64_t> pixels_cut(Stage& stage, const MethodSpec& spec, const view::Camera& camera) {
    constexpr double kNearer = 1.0 / 16;
    Result<gl::Target> target = gl::Target::make(camera.width_px, camera.height_px, 1);
    if (!target) return tl::unexpected(target.error());
    view::Camera closer = camera;
    closer.near_m *= kNearer;
    std::unique_ptr<Method> method = stage.make(spec, stage.world);
    method->decide(closer, 0);
    method->draw(*target);
    Frame frame = captured(*target, *target, closer);
    auto is_cut = [&](float depth_m) { return double(depth_m) < camera.near_m; };
    return uint64_t(std::count_if(frame.depth_m.begin(), frame.depth_m.end(), is_cut));
}

}  // namespace

Result<std::vector<Finding>> run_yaw(Stage& stage, const Case&, const scene::Flight& flight, std::span<const MethodSpec> specs) {
    std::vector<view::Camera> cameras = cameras_of(stage, flight, pick_of(specs, Pick::spread));
    Result<std::vector<Finding>> findings = count_holes(stage, cameras, flight.step_s, specs);
    if (!findings) return findings;
    for (size_t i = 0; i < specs.size(); ++i) {
        Finding& finding = (*findings)[i];
        double worst_px = 0, above = 0;
        bool is_measured = stage.world.terrain != nullptr && !is_image(specs[i]);
        std::vector<double> errors_px = finding.promised_px;
        if (stage.world.is_mesh()) {
            errors_px = displacements_in_row(stage, specs[i], cameras);
        } else if (is_measured) {
            errors_px.clear();
            for (const view::Camera& camera : cameras) errors_px.push_back(displacement_of(stage, specs[i], camera).measured_px);
        }
        for (double error_px : errors_px) {
            worst_px = std::max(worst_px, error_px);
            above += error_px > 2 * stage.asked_px ? 1 : 0;
        }
        finding.figures["frames_above_twice_asked_error"] = above;
        finding.sentence =
            stage.world.is_chain() ? fmt::format(
                                         "By its levels' proven bounds nothing is drawn farther than {:.3f} px from its "
                                         "place, {} px asked.",
                                         worst_px, stage.asked_px)
            : stage.world.is_planted()
                ? fmt::format(
                      "By its bounds nothing of terrain and planting is drawn farther than {:.3f} px from its place, {} px "
                      "asked.",
                      worst_px, stage.asked_px)
            : is_image(specs[i])
                ? fmt::format("It promises no worse than {:.3f} px for 99 % of a frame's pixels, {} px asked; not measured.",
                              worst_px, stage.asked_px)
                : fmt::format("No source sample is drawn farther than {:.3f} px from its place, {} px asked.", worst_px,
                              stage.asked_px);
    }
    return findings;
}

Result<std::vector<Finding>> run_teleports(Stage& stage, const Case&, const scene::Flight& flight,
                                           std::span<const MethodSpec> specs) {
    // One camera a key: the first frame after each teleport.
    std::vector<view::Camera> all = cameras_of(stage, flight, Pick::all), arrivals;
    for (const scene::Key& key : flight.keys) {
        arrivals.push_back(all[std::min(all.size() - 1, size_t(key.time_s / flight.step_s + 0.5))]);
    }
    Result<std::vector<Finding>> findings = count_holes(stage, arrivals, flight.step_s, specs);
    if (!findings) return findings;
    for (size_t i = 0; i < specs.size(); ++i) {
        Finding& finding = (*findings)[i];
        if (stage.world.is_mesh()) {
            uint32_t longest = frames_until_kept(stage, specs[i], arrivals);
            finding.figures["frames_until_error_met"] = longest;
            finding.sentence = fmt::format(
                "After a teleport it takes {} frames at most until nothing is drawn farther than {} px from its place, measured.",
                longest, stage.asked_px);
            continue;
        }
        if (is_image(specs[i]) || stage.world.is_chain() || stage.world.is_planted()) {
            std::unique_ptr<Method> method = stage.make(specs[i], stage.world);
            uint32_t frame = 0, longest = 0;
            for (const view::Camera& camera : arrivals) {
                Result<uint32_t> waited = frames_until_promised(stage, specs[i], *method, camera, frame);
                if (!waited) return tl::unexpected(waited.error());
                longest = std::max(longest, *waited);
            }
            finding.figures["frames_until_error_met"] = longest;
            finding.sentence = fmt::format("After a teleport it takes {} frames at most until it promises {} px; not measured.",
                                           longest, stage.asked_px);
            continue;
        }
        // A cut depends on the camera alone, so that the frames after the first are the first again.
        double worst_px = 0;
        for (const view::Camera& camera : arrivals)
            worst_px = std::max(worst_px, displacement_of(stage, specs[i], camera).measured_px);
        finding.figures["frames_until_error_met"] = worst_px <= stage.asked_px ? 0 : double(all.size());
        finding.sentence = fmt::format(
            "In the very frames of arrival no source sample is drawn farther than {:.3f} px from its "
            "place, {} px asked.",
            worst_px, stage.asked_px);
    }
    return findings;
}

Result<std::vector<Finding>> run_skimming(Stage& stage, const Case&, const scene::Flight& flight,
                                          std::span<const MethodSpec> specs) {
    std::vector<view::Camera> cameras = cameras_of(stage, flight, pick_of(specs, Pick::spread));
    // The eye is 1.2 times as high above the ground as its near plane is away.
    Result<std::vector<Finding>> findings = count_holes(stage, cameras, flight.step_s, specs);
    if (!findings) return findings;
    for (size_t i = 0; i < specs.size(); ++i) {
        uint64_t cut_px = 0;
        for (const view::Camera& camera : cameras) {
            Result<uint64_t> in_frame = pixels_cut(stage, specs[i], camera);
            if (!in_frame) return tl::unexpected(in_frame.error());
            cut_px += *in_frame;
        }
        (*findings)[i].figures["near_plane_cuts"] = double(cut_px);
        (*findings)[i].sentence =
            fmt::format("Drawn again with a near plane 16 times as near, {} pixels show ground before the near plane of {} m.",
                        cut_px, cameras.front().near_m);
    }
    return findings;
}

Result<std::vector<Finding>> run_horizon(Stage& stage, const Case&, const scene::Flight& flight,
                                         std::span<const MethodSpec> specs) {
    Result<std::vector<Finding>> findings =
        count_holes(stage, cameras_of(stage, flight, pick_of(specs, Pick::spread)), flight.step_s, specs);
    if (!findings) return findings;
    for (Finding& finding : *findings) {
        finding.sentence = fmt::format(
            "In the worst frame 95 % of the outline stands within {:.2f} px of where it should; full geometry's, of as many "
            "samples a pixel, within {:.2f} px.",
            finding.figures["silhouette_p95_px"], finding.figures["silhouette_p95_of_geometry_px"]);
    }
    return findings;
}

Result<std::vector<Finding>> run_climb(Stage& stage, const Case&, const scene::Flight& flight,
                                       std::span<const MethodSpec> specs) {
    std::vector<view::Camera> cameras = cameras_of(stage, flight, pick_of(specs, Pick::spread));
    Result<std::vector<Finding>> findings = count_holes(stage, cameras, flight.step_s, specs);
    if (!findings) return findings;
    if (stage.world.is_planted()) {
        if (Result<void> said = say_fallbacks(stage, specs, cameras, *findings); !said) return tl::unexpected(said.error());
        return findings;
    }
    // A terrain is baked for every distance down to where its own heights are too coarse for the error asked: nearer, it falls
    // back to them. It says so by predicting more than was asked.
    double finest_m = stage.world.terrain->finest_error_m;
    for (size_t i = 0; i < specs.size(); ++i) {
        uint32_t fallbacks = 0, unsaid = 0;
        double worst_px = 0;
        for (size_t at = 0; at < cameras.size(); ++at) {
            // Keys show the fine cut; what the frame promises, the method says.
            Displacement frame = displacement_of(stage, specs[i], cameras[at], finest_m);
            if (is_image(specs[i])) frame.predicted_px = (*findings)[i].promised_px[at];
            worst_px = std::max(worst_px, frame.measured_px);
            if (frame.measured_px <= stage.asked_px) continue;
            ++fallbacks;
            if (frame.predicted_px <= stage.asked_px) ++unsaid;
        }
        Finding& finding = (*findings)[i];
        finding.figures["fallbacks_unsaid"] = unsaid;
        finding.sentence = fmt::format(
            "Its heights are within {:g} m of the source's; with the worst of them a point may stand {:.3f} px from its place, "
            "{} px "
            "asked. {} of {} frames cannot keep that, {} of them without saying so.",
            finest_m, worst_px, stage.asked_px, fallbacks, cameras.size(), unsaid);
    }
    return findings;
}

}  // namespace overlook::measure
