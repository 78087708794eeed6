// The cases that are judged by pictures which should be the same.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "formats/container.h"
#include "runtime/view/flight.h"
#include "tools/measure/numbers/path_dependence.h"
#include "tools/measure/stability/stage.h"

namespace overlook::measure {
namespace {

RgbView view_of(const ImageRgb8& image) {
    return {image.width, image.height, image.pixels};
}

// Pixels of which a channel differs by more than `least`, 0..1.
uint64_t changed_pixels(const ImageRgb8& a, const ImageRgb8& b, double least) {
    uint64_t count = 0;
    for (size_t i = 0; i < a.pixels.size(); i += 3) {
        int most = 0;
        for (size_t k = i; k < i + 3; ++k) most = std::max(most, std::abs(int(a.pixels[k]) - int(b.pixels[k])));
        count += most > least * 255 ? 1 : 0;
    }
    return count;
}

// The camera of the terrain's frame when both the world and the flight have moved by move_m along x and y.
view::Camera moved(const view::Camera& camera, scene::Transform transform, double move_m) {
    view::Camera outside = view::camera_out_of(transform, camera);
    outside.position_m.x += move_m;
    outside.position_m.y += move_m;
    transform.translation_m[0] += move_m;
    transform.translation_m[1] += move_m;
    return view::camera_into(transform, outside);
}

}  // namespace

Result<std::vector<Finding>> run_moved_world(Stage& stage, const Case& each, const scene::Flight& flight,
                                             std::span<const MethodSpec> specs) {
    std::vector<view::Camera> cameras = cameras_of(stage, flight, Pick::spread);
    std::vector<Finding> findings;
    for (const MethodSpec& spec : specs) {
        Finding finding;
        double worst = 0;
        for (double move_m : each.settings.world_moves_m) {
            std::unique_ptr<Method> at_home = make_method(spec, stage.world), far_away = make_method(spec, stage.world);
            double worst_here = 0;
            for (uint32_t frame = 0; frame < cameras.size(); ++frame) {
                Result<ImageRgb8> home = draw_once(*at_home, cameras[frame], frame, samples_of(spec));
                if (!home) return tl::unexpected(home.error());
                view::Camera camera = moved(cameras[frame], stage.world.transform, move_m);
                Result<ImageRgb8> away = draw_once(*far_away, camera, frame, samples_of(spec));
                if (!away) return tl::unexpected(away.error());
                uint64_t pixels = uint64_t(home->width) * home->height;
                double share = double(changed_pixels(*home, *away, each.settings.changed_pixel.value_or(0))) / double(pixels);
                if (!finding.worst || share > worst) finding.worst = Shot{frame, std::move(*away), std::move(*home)};
                worst = std::max(worst, share);
                worst_here = std::max(worst_here, share);
            }
            finding.sentence += fmt::format("{}Moved by {:g} m, at most {:.4f} % of a frame's pixels change.",
                                            finding.sentence.empty() ? "" : " ", move_m, 100 * worst_here);
        }
        finding.figures["changed_pixel_share"] = worst;
        finding.frames = uint32_t(cameras.size());
        findings.push_back(std::move(finding));
    }
    return findings;
}

Result<std::vector<Finding>> run_resize(Stage& stage, const Case& each, const scene::Flight& flight,
                                        std::span<const MethodSpec> specs) {
    constexpr uint32_t kSettled = 2;  // frames after a resize
    const std::vector<double>& shares = each.settings.resize_shares;
    std::vector<view::Camera> cameras = cameras_of(stage, flight, Pick::all);
    std::vector<Finding> findings;
    for (const MethodSpec& spec : specs) {
        Finding finding;
        std::unique_ptr<Method> method = make_method(spec, stage.world);
        uint64_t stale = 0, same_hashes = 0;
        for (size_t i = 0; i < shares.size(); ++i) {
            size_t begin = (i + 1) * (cameras.size() - kSettled - 1) / (shares.size() + 1);
            Result<ImageRgb8> before =
                draw_once(*method, cameras[begin - (begin > 0 ? 1 : 0)], uint32_t(begin), samples_of(spec));
            if (!before) return tl::unexpected(before.error());
            for (uint32_t after = 0; after <= kSettled; ++after) {
                view::Camera camera = cameras[begin + after];
                camera.width_px = uint32_t(std::max(1.0, std::round(stage.width_px * shares[i])));
                camera.height_px = uint32_t(std::max(1.0, std::round(stage.height_px * shares[i])));
                Result<ImageRgb8> picture = draw_once(*method, camera, uint32_t(begin) + after, samples_of(spec));
                if (!picture) return tl::unexpected(picture.error());
                if (after < kSettled) continue;
                Result<ImageRgb8> fresh = draw_once(*make_method(spec, stage.world), camera, 0, samples_of(spec));
                if (!fresh) return tl::unexpected(fresh.error());
                stale += changed_pixels(*picture, *fresh, 0);
                auto hash = [](const ImageRgb8& image) { return content_hash(std::as_bytes(std::span(image.pixels))); };
                same_hashes += hash(*picture) == hash(*fresh) ? 1 : 0;
                finding.worst = Shot{uint32_t(begin) + after, std::move(*picture), std::move(*fresh)};
            }
        }
        finding.figures["stale_pixels"] = double(stale);
        finding.frames = uint32_t(shares.size() * (kSettled + 2));
        finding.sentence = fmt::format("Two frames after each of {} resizes, {} pictures have the hash of a fresh start.",
                                       shares.size(), same_hashes);
        findings.push_back(std::move(finding));
    }
    return findings;
}

Result<std::vector<Finding>> run_back_and_forth(Stage& stage, const Case&, const scene::Flight& flight,
                                                std::span<const MethodSpec> specs) {
    std::vector<view::Camera> cameras = cameras_of(stage, flight, Pick::spread);
    std::vector<Finding> findings;
    for (const MethodSpec& spec : specs) {
        Finding finding;
        std::unique_ptr<Method> method = make_method(spec, stage.world);
        std::vector<ImageRgb8> forwards;
        uint32_t step = 0;
        for (const view::Camera& camera : cameras) {
            Result<ImageRgb8> picture = draw_once(*method, camera, step++, samples_of(spec));
            if (!picture) return tl::unexpected(picture.error());
            forwards.push_back(std::move(*picture));
        }
        double worst = 0;
        for (size_t i = cameras.size(); i-- > 0;) {
            Result<ImageRgb8> backwards = draw_once(*method, cameras[i], step++, samples_of(spec));
            if (!backwards) return tl::unexpected(backwards.error());
            double difference = path_difference_grey(view_of(forwards[i]), view_of(*backwards));
            if (!finding.worst || difference > worst) finding.worst = Shot{uint32_t(i), std::move(*backwards), forwards[i]};
            worst = std::max(worst, difference);
        }
        finding.figures["path_difference_grey"] = worst;
        finding.frames = step;
        finding.sentence =
            fmt::format("Reached forwards and backwards, a pose's pictures differ by {:g} grey levels at most.", worst);
        findings.push_back(std::move(finding));
    }
    return findings;
}

}  // namespace overlook::measure
