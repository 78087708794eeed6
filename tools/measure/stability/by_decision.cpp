// The cases that are judged on what is decided: which vertices, at which error, promised how well.
#include <algorithm>
#include <cmath>

#include "tools/measure/honesty/terrain_honesty.h"
#include "tools/measure/numbers/honesty_tally.h"
#include "tools/measure/stability/stage.h"
#include "tools/measure/stability/surface.h"

namespace overlook::measure {
namespace {

constexpr double kSeen_px = 0.1;     // a vertex that comes or goes by less does not switch anything
constexpr uint32_t kMostSlopes = 8;  // frames; every sample of each is measured

struct Switching {
    uint64_t came_or_went = 0, switches = 0, while_still = 0;
    double greatest_px = 0;
    uint32_t greatest_frame = 0;
};

bool stands_still(const view::Camera& a, const view::Camera& b) {
    return a.position_m == b.position_m && a.heading_deg == b.heading_deg && a.pitch_deg == b.pitch_deg;
}

// Of two frames after each other: the vertices of one that the other lacks, and how far the surface there moved at once.
void compare(const Surface& here, const Surface& there, const view::Camera& camera, uint32_t frame, bool is_still,
             Switching& all) {
    for (uint32_t sample : here.vertices()) {
        if (there.is_vertex(sample)) continue;
        double jump_px = here.distance_px(sample, there.height_m(sample), camera);
        if (std::isnan(jump_px)) continue;
        ++all.came_or_went;
        if (is_still) ++all.while_still;
        if (jump_px > kSeen_px) ++all.switches;
        if (jump_px <= all.greatest_px) continue;
        all.greatest_px = jump_px;
        all.greatest_frame = frame;
    }
}

Switching switching_of(const Stage& stage, const MethodSpec& spec, const std::vector<view::Camera>& cameras, double step_s) {
    const terrain::Terrain& terrain = *stage.world.terrain;
    Switching all;
    Surface before(terrain), now(terrain);
    terrain::Cut cut;
    for (uint32_t frame = 0; frame < cameras.size(); ++frame) {
        stage.world.refiner->cut_by_pixels(cameras[frame], setting(spec, "error-px"), cut, morph_of(spec));
        now.take(cut);
        // Frames whose step from the one before ends after the first second.
        if (frame > 0 && (frame - 1) * step_s >= 1) {
            bool is_still = stands_still(cameras[frame - 1], cameras[frame]);
            compare(now, before, cameras[frame], frame, is_still, all);
            compare(before, now, cameras[frame], frame, is_still, all);
        }
        std::swap(before, now);
    }
    return all;
}

// What switches in a method that shows pictures again: one picture takes over from another.
Result<Finding> key_switches(const Stage& stage, const MethodSpec& spec, const std::vector<view::Camera>& cameras,
                             double step_s) {
    Result<gl::Target> target = gl::Target::make(stage.width_px, stage.height_px, samples_of(spec));
    if (!target) return tl::unexpected(target.error());
    std::unique_ptr<Method> method = stage.make(spec, stage.world);
    uint64_t switches = 0, while_still = 0, first_second = 0;
    uint32_t last = 0;
    for (uint32_t frame = 0; frame < cameras.size(); ++frame) {
        method->decide(cameras[frame], frame);
        uint64_t events = method->draw(*target).event_count;
        if (events == 0) continue;
        last = frame;
        bool is_after = frame > 0 && (frame - 1) * step_s >= 1;
        (is_after ? switches : first_second) += events;
        if (is_after && stands_still(cameras[frame - 1], cameras[frame])) while_still += events;
    }
    Finding finding;
    finding.figures["switches_after_first_second"] = double(switches);
    finding.frames = uint32_t(cameras.size());
    finding.sentence = fmt::format(
        "Keys took over {} times in the first second and {} times after it, {} of these while the "
        "camera stood still; the last one in frame {}.",
        first_second, switches, while_still, last);
    Result<Shot> shot = shot_of(stage, spec, cameras[last], last);
    if (!shot) return tl::unexpected(shot.error());
    finding.worst = std::move(*shot);
    return finding;
}

// What switches in a mesh: splits and collapses, and levels exchanged for the whole of it or of an instance.
Result<Finding> operations_at_rest(const Stage& stage, const MethodSpec& spec, const std::vector<view::Camera>& cameras,
                                   double step_s) {
    Result<gl::Target> target = gl::Target::make(stage.width_px, stage.height_px, samples_of(spec));
    if (!target) return tl::unexpected(target.error());
    std::unique_ptr<Method> method = stage.make(spec, stage.world);
    uint64_t switches = 0, while_still = 0, first_second = 0;
    uint32_t last = 0;
    for (uint32_t frame = 0; frame < cameras.size(); ++frame) {
        method->decide(cameras[frame], frame);
        Counters counters = method->draw(*target);
        uint64_t changes = counters.operation_count + counters.event_count;
        if (changes == 0) continue;
        last = frame;
        bool is_after = frame > 0 && (frame - 1) * step_s >= 1;
        (is_after ? switches : first_second) += changes;
        if (is_after && stands_still(cameras[frame - 1], cameras[frame])) while_still += changes;
    }
    Finding finding;
    finding.figures["switches_after_first_second"] = double(switches);
    finding.frames = uint32_t(cameras.size());
    finding.sentence = fmt::format(
        "{} {} in the first second and {} after it, {} of these while the camera stood still; the last one in "
        "frame {}.",
        stage.world.is_planted() ? "tiles that were shown by another image at once"
        : stage.world.is_chain() ? "changes of level"
                                 : "splits and collapses",
        first_second, switches, while_still, last);
    Result<Shot> shot = shot_of(stage, spec, cameras[last], last);
    if (!shot) return tl::unexpected(shot.error());
    finding.worst = std::move(*shot);
    return finding;
}

}  // namespace

Result<std::vector<Finding>> run_jitter(Stage& stage, const Case&, const scene::Flight& flight,
                                        std::span<const MethodSpec> specs) {
    std::vector<view::Camera> cameras = cameras_of(stage, flight, Pick::all);
    std::vector<Finding> findings;
    for (const MethodSpec& spec : specs) {
        if (!is_cut(stage, spec)) {
            Result<Finding> finding = is_image(spec) && !stage.world.is_mesh()
                                          ? key_switches(stage, spec, cameras, flight.step_s)
                                          : operations_at_rest(stage, spec, cameras, flight.step_s);
            if (!finding) return tl::unexpected(finding.error());
            findings.push_back(std::move(*finding));
            continue;
        }
        Switching all = switching_of(stage, spec, cameras, flight.step_s);
        Finding finding;
        finding.figures["switches_after_first_second"] = double(all.switches);
        finding.frames = uint32_t(cameras.size());
        finding.sentence = fmt::format(
            "{} vertices came or went, {} of them while the camera stood still; {} moved the surface at once by more "
            "than {} px, the worst by {:.3f} px.",
            all.came_or_went, all.while_still, all.switches, kSeen_px, all.greatest_px);
        Result<Shot> shot = shot_of(stage, spec, cameras[all.greatest_frame], all.greatest_frame);
        if (!shot) return tl::unexpected(shot.error());
        finding.worst = std::move(*shot);
        findings.push_back(std::move(finding));
    }
    return findings;
}

Result<std::vector<Finding>> run_slopes(Stage& stage, const Case&, const scene::Flight& flight,
                                        std::span<const MethodSpec> specs) {
    Stage few = stage;
    few.frames = stage.frames == 0 ? kMostSlopes : std::min(stage.frames, kMostSlopes);
    std::vector<view::Camera> cameras = cameras_of(few, flight, Pick::spread);
    std::vector<Finding> findings;
    for (const MethodSpec& spec : specs) {
        if (stage.world.is_planted()) {
            Result<Finding> shear = planted_shear(stage, spec, flight);
            if (!shear) return tl::unexpected(shear.error());
            findings.push_back(std::move(*shear));
            continue;
        }
        if (is_image(spec)) {
            Result<Finding> shear = shear_of(stage, spec, flight);
            if (!shear) return tl::unexpected(shear.error());
            findings.push_back(std::move(*shear));
            continue;
        }
        Finding finding;
        HonestyTally tally;
        uint32_t worst_frame = 0;
        double worst_px = -1;
        std::unique_ptr<Method> method = stage.make(spec, stage.world);
        for (uint32_t frame = 0; frame < cameras.size(); ++frame) {
            method->decide(cameras[frame], frame);
            std::optional<Promises> promises = method->promises();
            if (!promises) return impossible("{}: promises nothing of what it draws", label_of(spec));
            double most_px = tally.add(promises->predicted_px, promises->measured_px).measured_max_px;
            if (most_px > worst_px) worst_frame = frame;
            worst_px = std::max(worst_px, most_px);
        }
        const Honesty& honesty = tally.all();
        finding.figures["honesty"] = honesty.ratio_max;
        finding.frames = uint32_t(cameras.size());
        finding.sentence = fmt::format(
            "Of {} triangles seen {} do worse than they promise; the worst is {:.3f} px off, {:.3f} px promised at most.",
            honesty.count, honesty.above_prediction, honesty.measured_max_px, honesty.predicted_max_px);
        Result<Shot> shot = shot_of(stage, spec, cameras[worst_frame], worst_frame);
        if (!shot) return tl::unexpected(shot.error());
        finding.worst = std::move(*shot);
        findings.push_back(std::move(finding));
    }
    return findings;
}

}  // namespace overlook::measure
