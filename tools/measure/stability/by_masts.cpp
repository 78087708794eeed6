// S10: thin masts and railings.
#include <algorithm>

#include "tools/measure/capture.h"
#include "tools/measure/numbers/masts.h"
#include "tools/measure/stability/stage.h"

namespace overlook::measure {
namespace {

// The frame just decided, as large as the target.
ImageRgb8 seen_finely(Method& method, const gl::Target& large) {
    method.draw(large);
    return large.read();
}

Result<Finding> watch_masts(Stage& stage, const MethodSpec& spec, const std::vector<view::Camera>& cameras) {
    uint32_t factor = mast_samples_a_side(stage.width_px, stage.height_px);
    Result<gl::Target> large = gl::Target::make(factor * stage.width_px, factor * stage.height_px, 1);
    if (!large) return tl::unexpected(large.error());
    std::unique_ptr<Method> method = stage.make(spec, stage.world), full = make_method(floor_spec(1), stage.world);
    double worst = -1, mast_px = 0, lost_px = 0;
    Finding finding;
    for (uint32_t frame = 0; frame < cameras.size(); ++frame) {
        method->decide(cameras[frame], frame);
        full->decide(cameras[frame], frame);
        ImageRgb8 test = seen_finely(*method, *large), reference = seen_finely(*full, *large);
        MastLoss loss = mast_loss(test, reference, factor);
        mast_px += loss.mast_px, lost_px += loss.lost_px;
        if (loss.mast_px == 0 || loss.lost_px / loss.mast_px <= worst) continue;
        worst = loss.lost_px / loss.mast_px;
        finding.worst = Shot{frame, box_filtered(test, factor), box_filtered(reference, factor)};
        std::vector<uint8_t>& pixels = finding.worst->test.pixels;
        for (size_t i = 0; i < loss.is_lost.size(); ++i)
            if (loss.is_lost[i]) pixels[3 * i] = 255, pixels[3 * i + 1] = 0, pixels[3 * i + 2] = 255;
    }
    if (worst < 0) return impossible("{}: no frame of this flight shows a mast; they are told by their red", label_of(spec));
    finding.figures["lost_mast_share"] = worst;
    finding.frames = uint32_t(cameras.size());
    finding.sentence = fmt::format(
        "In the worst frame {:.2f} % of the masts' area is lost (magenta), in all together {:.2f} % of {:.0f} pixels; by {}.",
        100 * worst, 100 * lost_px / mast_px, mast_px, mast_samples_sentence(stage.width_px, stage.height_px));
    return finding;
}

}  // namespace

Result<std::vector<Finding>> run_masts(Stage& stage, const Case&, const scene::Flight& flight,
                                       std::span<const MethodSpec> specs) {
    std::vector<view::Camera> cameras = cameras_of(stage, flight, Pick::in_row);
    std::vector<Finding> findings;
    for (const MethodSpec& spec : specs) {
        Result<Finding> finding = watch_masts(stage, spec, cameras);
        if (!finding) return tl::unexpected(finding.error());
        findings.push_back(std::move(*finding));
    }
    return findings;
}

}  // namespace overlook::measure
