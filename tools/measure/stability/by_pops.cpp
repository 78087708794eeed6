// The cases that are judged on pops beside the reference: S01, S09, S16.
#include <algorithm>

#include "tools/measure/figures.h"
#include "tools/measure/stability/stage.h"

namespace overlook::measure {
namespace {

std::string events_sentence(const RunResult& run) {
    std::string frames;
    for (const FrameRecord& record : run.frames) {
        if (record.counters.event_count > 0) frames += (frames.empty() ? "" : ", ") + std::to_string(record.frame);
    }
    return frames.empty() ? " No key took over." : " Keys took over in frames " + frames + ".";
}

// Every pixel where it was.
Motion standing_still(uint32_t width, uint32_t height) {
    Motion motion;
    motion.width = width;
    motion.height = height;
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x) {
            motion.x_px.push_back(float(x));
            motion.y_px.push_back(float(y));
        }
    motion.valid_count = motion.x_px.size();
    return motion;
}

// The greatest mean change of a tile, luma 0..1, when a frame is drawn with the triangles of the frame before instead of its own.
// A pop is such a change; what else W sees is there with triangles that never change as well.
Result<double> change_by_triangles(Stage& stage, const MethodSpec& spec, const std::vector<view::Camera>& cameras) {
    Result<gl::Target> target = gl::Target::make(stage.width_px, stage.height_px, samples_of(spec));
    if (!target) return tl::unexpected(target.error());
    Motion still = standing_still(stage.width_px, stage.height_px);
    auto drawn = [&](const terrain::Cut& cut, const view::Camera& camera) {
        stage.world.drawing->draw(*target, cut, camera, stage.world.look);
        return target->read();
    };
    terrain::Cut before, now;
    double greatest = 0;
    for (const view::Camera& camera : cameras) {
        stage.world.refiner->cut_by_pixels(camera, setting(spec, "error-px"), now, morph_of(spec));
        if (!before.indices.empty()) {
            ImageRgb8 held = drawn(before, camera), own = drawn(now, camera);
            RgbView held_view{held.width, held.height, held.pixels}, own_view{own.width, own.height, own.pixels};
            TemporalError change = temporal_error(still, held_view, own_view, held_view, held_view);
            for (float tile : change.tiles) greatest = std::max(greatest, double(tile));
        }
        std::swap(before, now);
    }
    return greatest;
}

}  // namespace

Result<std::vector<Finding>> run_dolly(Stage& stage, const Case&, const scene::Flight& flight,
                                       std::span<const MethodSpec> specs) {
    std::vector<view::Camera> cameras = cameras_of(stage, flight, Pick::in_row);
    Result<CourseResult> course = fly(stage, cameras, flight.step_s, specs);
    if (!course) return tl::unexpected(course.error());
    std::vector<Finding> findings;
    for (size_t i = 0; i < specs.size(); ++i) {
        const RunResult& run = course->runs[i];
        Finding finding;
        finding.figures["pop_index"] = run.pop.index;
        finding.frames = uint32_t(cameras.size());
        finding.worst = shown(run.worst_w);
        finding.sentence = fmt::format(
            "The greatest unrest above full geometry's is {:.4f} luma, in frame {}, tile {}, {}; median {:.4f}, "
            "full geometry's {:.4f}.",
            run.pop.excess, run.pop.frame, run.pop.tile_column, run.pop.tile_row, run.pop.method_median, run.pop.floor_median);
        if (is_image(specs[i])) {
            finding.sentence += events_sentence(run);
        } else if (stage.world.terrain != nullptr) {
            Result<double> change = change_by_triangles(stage, specs[i], cameras);
            if (!change) return tl::unexpected(change.error());
            finding.figures["change_by_triangles"] = *change;
            finding.sentence +=
                fmt::format(" New triangles alone, under a camera held still, change no tile by more than {:.5f} luma.", *change);
        }
        findings.push_back(std::move(finding));
    }
    return findings;
}

Result<std::vector<Finding>> run_dropping(Stage& stage, const Case& each, const scene::Flight& flight,
                                          std::span<const MethodSpec> specs) {
    std::vector<view::Camera> whole = cameras_of(stage, flight, Pick::in_row), kept;
    for (size_t i = 0; i < whole.size(); ++i) {
        if ((i + 1) % each.settings.drop_every != 0) kept.push_back(whole[i]);
    }
    Result<CourseResult> undropped = fly(stage, whole, flight.step_s, specs);
    if (!undropped) return tl::unexpected(undropped.error());
    Result<CourseResult> dropped = fly(stage, kept, flight.step_s, specs);
    if (!dropped) return tl::unexpected(dropped.error());
    std::vector<Finding> findings;
    for (size_t i = 0; i < specs.size(); ++i) {
        const RunResult& run = dropped->runs[i];
        Finding finding;
        finding.figures["pop_index_ratio"] = run.pop.index / undropped->runs[i].pop.index;
        finding.frames = uint32_t(kept.size());
        finding.worst = shown(run.worst_w);
        finding.sentence = fmt::format("Pop index {:.3f} with {} of {} frames dropped, {:.3f} with none.", run.pop.index,
                                       whole.size() - kept.size(), whole.size(), undropped->runs[i].pop.index);
        findings.push_back(std::move(finding));
    }
    return findings;
}

}  // namespace overlook::measure
