// The cases that are judged by pictures which should be the same.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "formats/container.h"
#include "runtime/view/flight.h"
#include "tools/measure/numbers/frame_subset.h"
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

// Of chains, which stand where their placements say: those are moved by move_m along x and y till it goes.
class MovedPlacements {
  public:
    MovedPlacements(World& world, double move_m) : world_(world) {
        for (ChainWorld& one : world_.chains) {
            home_.push_back(one.placements);
            for (discrete::Placement& each : one.placements) each.translation_m += glm::dvec3(move_m, move_m, 0);
        }
    }
    ~MovedPlacements() {
        for (size_t i = 0; i < world_.chains.size(); ++i) world_.chains[i].placements = std::move(home_[i]);
    }
    MovedPlacements(const MovedPlacements&) = delete;
    MovedPlacements& operator=(const MovedPlacements&) = delete;

  private:
    World& world_;
    std::vector<std::vector<discrete::Placement>> home_;
};

// Made where the world is moved by move_m, if it holds chains; of others, whose cameras are what moves, at home.
std::unique_ptr<Method> make_moved(Stage& stage, const MethodSpec& spec, double move_m) {
    MovedPlacements moved(stage.world, move_m);
    return stage.make(spec, stage.world);
}

// The camera of the thing's frame when both the world and the flight have moved by move_m along x and y.
view::Camera moved(const view::Camera& camera, scene::Transform transform, double move_m, bool holds_chains) {
    view::Camera outside = view::camera_out_of(transform, camera);
    outside.position_m.x += move_m;
    outside.position_m.y += move_m;
    if (!holds_chains) transform.translation_m[0] += move_m, transform.translation_m[1] += move_m;
    return view::camera_into(transform, outside);
}

std::string hash_of(const ImageRgb8& image) {
    return content_hash(std::as_bytes(std::span(image.pixels)));
}

// The flight in equally long parts, of each at most `most` frames (0 = all): the first ones, or spread over it.
std::vector<std::vector<view::Camera>> legs_of(const std::vector<view::Camera>& cameras, uint32_t count, uint32_t most,
                                               Pick pick) {
    std::vector<std::vector<view::Camera>> legs;
    uint32_t length = uint32_t(cameras.size()) / count;
    for (uint32_t leg = 0; leg < count; ++leg) {
        legs.emplace_back();
        uint32_t frames = most == 0 ? length : std::min(most, length);
        std::vector<uint32_t> taken = spread_frames(pick == Pick::in_row ? frames : length, frames);
        for (uint32_t frame : taken) legs.back().push_back(cameras[leg * length + frame]);
    }
    return legs;
}

}  // namespace

Result<Together> fly_together(const std::function<std::unique_ptr<Method>()>& make,
                              std::span<const std::vector<view::Camera>> legs, uint32_t samples) {
    size_t count = legs.size(), frames = legs.front().size();
    const view::Camera& first = legs.front().front();
    Result<gl::Target> target = gl::Target::make(first.width_px, first.height_px, samples);
    if (!target) return tl::unexpected(target.error());
    std::vector<std::unique_ptr<Method>> methods;
    for (size_t i = 0; i < count; ++i) methods.push_back(make());
    std::vector<std::vector<ImageRgb8>> at_once(count);
    for (uint32_t frame = 0; frame < frames; ++frame) {
        for (size_t i = 0; i < count; ++i) methods[i]->decide(legs[i][frame], frame);
        for (size_t i = 0; i < count; ++i) {
            size_t camera = (frame + i) % count;
            methods[camera]->draw(*target);
            at_once[camera].push_back(target->read());
        }
    }
    Together together;
    uint64_t most_changed = 0;
    for (size_t i = 0; i < count; ++i) {
        std::unique_ptr<Method> alone = make();
        bool differs = false;
        for (uint32_t frame = 0; frame < frames; ++frame) {
            alone->decide(legs[i][frame], frame);
            alone->draw(*target);
            ImageRgb8 picture = target->read();
            ++together.pictures;
            differs = differs || hash_of(picture) != hash_of(at_once[i][frame]);
            uint64_t changed = changed_pixels(picture, at_once[i][frame], 0);
            if (together.worst && changed <= most_changed) continue;
            most_changed = changed;
            together.worst = Shot{frame, std::move(at_once[i][frame]), std::move(picture)};
        }
        together.cameras_that_differ += differs ? 1 : 0;
    }
    return together;
}

Result<std::vector<Finding>> run_cameras(Stage& stage, const Case& each, const scene::Flight& flight,
                                         std::span<const MethodSpec> specs) {
    constexpr uint32_t kFewest = 2, kFewestWithKeys = 24;  // frames: so many until keys are there and take over
    uint32_t count = each.settings.cameras, fewest = is_image(specs.front()) ? kFewestWithKeys : kFewest;
    uint32_t most = stage.frames == 0 ? 0 : std::max(fewest, stage.frames / count);
    std::vector<std::vector<view::Camera>> legs =
        legs_of(cameras_of(stage, flight, Pick::all), count, most, pick_of(specs, Pick::spread));
    std::vector<Finding> findings;
    for (const MethodSpec& spec : specs) {
        Result<Together> together = fly_together([&] { return stage.make(spec, stage.world); }, legs, samples_of(spec));
        if (!together) return tl::unexpected(together.error());
        Finding finding;
        finding.figures["cameras_that_differ"] = together->cameras_that_differ;
        finding.frames = together->pictures;
        finding.worst = std::move(together->worst);
        finding.sentence = fmt::format(
            "{} cameras over one world, frame by frame in turn: of {} the pictures are not those of flying "
            "alone.",
            count, together->cameras_that_differ == 0 ? "none" : std::to_string(together->cameras_that_differ));
        findings.push_back(std::move(finding));
    }
    return findings;
}

Result<std::vector<Finding>> run_moved_world(Stage& stage, const Case& each, const scene::Flight& flight,
                                             std::span<const MethodSpec> specs) {
    std::vector<view::Camera> cameras = cameras_of(stage, flight, pick_of(specs, Pick::spread));
    std::vector<Finding> findings;
    for (const MethodSpec& spec : specs) {
        Finding finding;
        double worst = 0;
        for (double move_m : each.settings.world_moves_m) {
            std::unique_ptr<Method> at_home = stage.make(spec, stage.world), far_away = make_moved(stage, spec, move_m);
            double worst_here = 0;
            for (uint32_t frame = 0; frame < cameras.size(); ++frame) {
                Result<ImageRgb8> home = draw_once(*at_home, cameras[frame], frame, samples_of(spec));
                if (!home) return tl::unexpected(home.error());
                view::Camera camera = moved(cameras[frame], stage.world.transform, move_m, stage.world.is_chain());
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

namespace {

// Levels of chains by distance, which no size changes: a change of level on its way is no stale picture.
MethodSpec size_blind(MethodSpec spec) {
    if (!is_of_chains_alone(spec)) return spec;
    for (auto& [name, value] : spec.settings)
        if (name == "by") value = double(discrete::Criterion::distance);
    return spec;
}

view::Camera sized(view::Camera camera, const Stage& stage, double share) {
    camera.width_px = uint32_t(std::max(1.0, std::round(stage.width_px * share)));
    camera.height_px = uint32_t(std::max(1.0, std::round(stage.height_px * share)));
    return camera;
}

}  // namespace

Result<std::vector<Finding>> run_resize(Stage& stage, const Case& each, const scene::Flight& flight,
                                        std::span<const MethodSpec> specs) {
    constexpr uint32_t kSettled = 2;  // frames after a resize
    const std::vector<double>& shares = each.settings.resize_shares;
    std::vector<view::Camera> cameras = cameras_of(stage, flight, Pick::all);
    std::vector<Finding> findings;
    for (const MethodSpec& asked : specs) {
        MethodSpec spec = size_blind(asked);
        Finding finding;
        std::unique_ptr<Method> method = stage.make(spec, stage.world);
        uint64_t stale = 0, same_hashes = 0;
        for (size_t i = 0; i < shares.size(); ++i) {
            size_t begin = (i + 1) * (cameras.size() - kSettled - 1) / (shares.size() + 1);
            // In the size before, so that each share is a change.
            view::Camera earlier = sized(cameras[begin - (begin > 0 ? 1 : 0)], stage, i > 0 ? shares[i - 1] : 1);
            Result<ImageRgb8> before = draw_once(*method, earlier, uint32_t(begin), samples_of(spec));
            if (!before) return tl::unexpected(before.error());
            std::unique_ptr<Method> starting;
            Result<ImageRgb8> fresh = *before;
            for (uint32_t after = 0; after <= kSettled; ++after) {
                view::Camera camera = sized(cameras[begin + after], stage, shares[i]);
                Result<ImageRgb8> picture = draw_once(*method, camera, uint32_t(begin) + after, samples_of(spec));
                if (!picture) return tl::unexpected(picture.error());
                // A method with history starts afresh where the size changed, and flies the same frames.
                if (has_history(spec) || after == kSettled) {
                    if (!has_history(spec) || after == 0) starting = stage.make(spec, stage.world);
                    fresh = draw_once(*starting, camera, after, samples_of(spec));
                }
                if (after < kSettled) continue;
                if (!fresh) return tl::unexpected(fresh.error());
                stale += changed_pixels(*picture, *fresh, 0);
                same_hashes += hash_of(*picture) == hash_of(*fresh) ? 1 : 0;
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
    std::vector<view::Camera> cameras = cameras_of(stage, flight, pick_of(specs, Pick::spread));
    std::vector<Finding> findings;
    for (const MethodSpec& spec : specs) {
        Finding finding;
        std::unique_ptr<Method> method = stage.make(spec, stage.world);
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
