#include "tools/bake/wang_ldi/perspective.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <new>

#include "formats/numbers.h"
#include "formats/parallel.h"
#include "runtime/view/picture_rays.h"
#include "runtime/wang_ldi/perspective_warp.h"
#include "runtime/wang_ldi/random.h"
#include "tools/bake/wang_ldi/assemble.h"
#include "tools/bake/wang_ldi/held_out.h"
#include "tools/bake/wang_ldi/picture_blocks.h"
#include "tools/bake/wang_ldi/shade_rays.h"

namespace overlook::wang_ldi {
namespace {

constexpr uint64_t kEyeStream = 71, kLightStream = 72, kJitterStream = 1000;  // of every eye its own
constexpr size_t kRaysAtOnce = 256 * rays::kPacket, kLitAtOnce = 256;
constexpr const char* kNoMemory = "there is not enough memory for the samples of a scene; ask for fewer eyes or pixels";

// All below count, by any thread; what runs out of memory in one is said by this one.
void in_parallel(size_t count, size_t grain, const std::function<void(size_t begin, size_t end)>& body) {
    std::atomic<bool> is_short = false;
    parallel_ranges(count, grain, [&](size_t begin, size_t end) {
        try {
            body(begin, end);
        } catch (const std::bad_alloc&) {
            is_short = true;
        }
    });
    if (is_short) throw std::bad_alloc();
}

// A place that is kept: a link of its pixel's list, from the nearest on.
struct Place {
    double depth_m = 0;
    uint32_t next = rays::kNone;
    HeldOut::Met met;
    rays::Hit hit;
    glm::vec3 seen_along{0};
};

class Collector {
  public:
    Collector(const TraceStage& stage, const PerspectiveView& view, const PerspectiveOptions& options)
        : stage_(stage),
          view_(view),
          options_(options),
          camera_(camera_of(view)),
          sight_(camera_),
          pixels_(pixels_by_block(view.width_px, view.height_px)),
          rays_(pixels_.size()),
          hits_(pixels_.size()),
          heads_(pixels_.size(), rays::kNone) {}

    bool is_full() const { return places_.size() > kMostPerspectiveSamples; }
    void see_from(uint32_t eye);
    void see_all_layers(const std::function<void(double)>& progress);
    PerspectiveMade take(const Models& models, const Light& light);

  private:
    glm::dvec3 eye_of(uint32_t eye) const;
    void keep(uint32_t pixel, double depth_m, const rays::Hit& hit, const glm::vec3& along, uint32_t eye);
    std::vector<glm::vec3> colours_of(const Models& models, const Light& light, const std::vector<uint32_t>& kept,
                                      PerspectiveLdi& image) const;

    const TraceStage& stage_;
    const PerspectiveView& view_;
    const PerspectiveOptions& options_;
    view::Camera camera_;
    view::PictureRays sight_;
    std::vector<uint32_t> pixels_;
    std::vector<rays::Ray> rays_;
    std::vector<rays::Hit> hits_;
    std::vector<uint32_t> heads_;  // [pixels] of places_
    std::vector<Place> places_;
    HeldOut held_out_;
    uint64_t ray_count_ = 0;
};

glm::dvec3 Collector::eye_of(uint32_t eye) const {
    if (eye == 0) return view_.position_m;
    std::array<double, 3> at = evenly_spread(hash_of(options_.seed, kEyeStream, 0, 0), eye - 1);
    return view_.position_m + options_.cell_m * (2.0 * glm::dvec3(at[0], at[1], at[2]) - 1.0);
}

// What other eyes see in a pixel before the place that the camera's own ray meets, or where that meets nothing, is not on that
// ray but beside it: it would hide what the camera sees, and is left out.
void Collector::keep(uint32_t pixel, double depth_m, const rays::Hit& hit, const glm::vec3& along, uint32_t eye) {
    uint32_t before = rays::kNone, at = heads_[pixel];
    while (at != rays::kNone && places_[at].depth_m * (1 + options_.merge_share) < depth_m) before = at, at = places_[at].next;
    if (at == rays::kNone || depth_m * (1 + options_.merge_share) < places_[at].depth_m) {
        if (before == rays::kNone && eye > 0) return held_out_.lose();
        auto added = uint32_t(places_.size());
        (before == rays::kNone ? heads_[pixel] : places_[before].next) = added;
        places_.push_back({depth_m, at, {}, hit, along});
        at = added;
    }
    held_out_.meet(places_[at].met, eye);
}

// The first surfaces along an eye's rays, where the camera sees them.
void Collector::see_from(uint32_t eye) {
    view::Camera from = camera_;
    from.position_m = eye_of(eye);
    view::PictureRays sight(from);
    parallel_ranges(pixels_.size(), kRaysAtOnce, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            uint32_t column = pixels_[i] % view_.width_px, row = pixels_[i] / view_.width_px;
            Random random(hash_of(options_.seed, kJitterStream + eye, column, row));
            glm::dvec2 in_pixel(0.5);
            if (eye > 0) in_pixel = {random.next_unit(), random.next_unit()};
            glm::vec3 along(sight.through(glm::dvec2(column, row) + in_pixel));
            rays_[i] = {glm::vec3(sight.eye_m), along, float(view_.near_m), float(view_.far_m)};
        }
        stage_.scene.first_hits(std::span(rays_).subspan(begin, end - begin), std::span(hits_).subspan(begin, end - begin));
    });
    ray_count_ += pixels_.size();
    for (size_t i = 0; i < pixels_.size() && !is_full(); ++i) {
        if (hits_[i].copy == rays::kNone) continue;
        glm::dvec3 at = glm::dvec3(rays_[i].from_m) + double(hits_[i].distance) * glm::dvec3(rays_[i].along);
        // The camera's own rays are through the middles of its pixels: rounding puts them in no other.
        glm::dvec3 seen = eye == 0 ? glm::dvec3(0, 0, hits_[i].distance) : sight_.seen(at);
        if (!(seen.z >= view_.near_m && seen.z <= view_.far_m)) continue;
        if (eye > 0 && !(seen.x >= 0 && seen.y >= 0 && seen.x < view_.width_px && seen.y < view_.height_px)) continue;
        uint32_t pixel = eye == 0 ? pixels_[i] : uint32_t(seen.y) * view_.width_px + uint32_t(seen.x);
        keep(pixel, seen.z, hits_[i], rays_[i].along, eye);
    }
}

void Collector::see_all_layers(const std::function<void(double)>& progress) {
    constexpr size_t kAtOnce = 16384;
    std::vector<std::vector<rays::Hit>> found(kAtOnce);
    for (size_t first = 0; first < pixels_.size() && !is_full(); first += kAtOnce) {
        size_t count = std::min(kAtOnce, pixels_.size() - first);
        in_parallel(count, 64, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) {
                uint32_t pixel = pixels_[first + i];
                glm::vec3 along(sight_.through_pixel(pixel % view_.width_px, pixel / view_.width_px));
                rays_[first + i] = {glm::vec3(sight_.eye_m), along, float(view_.near_m), float(view_.far_m)};
                found[i] = stage_.scene.all_hits(rays_[first + i]);
            }
        });
        for (size_t i = 0; i < count; ++i)
            for (const rays::Hit& hit : found[i]) keep(pixels_[first + i], double(hit.distance), hit, rays_[first + i].along, 0);
        ray_count_ += count;
        progress(double(first + count) / double(pixels_.size()));
    }
}

// Each sample's colour, and its normal into the image. What is in a pixel and a step of depth has the same light whatever the
// image.
std::vector<glm::vec3> Collector::colours_of(const Models& models, const Light& light, const std::vector<uint32_t>& kept,
                                             PerspectiveLdi& image) const {
    std::vector<glm::vec3> colours(kept.size());
    std::vector<uint32_t> pixel_of(kept.size());
    for (uint32_t p = 0; p + 1 < image.first.size(); ++p)
        std::fill(pixel_of.begin() + image.first[p], pixel_of.begin() + image.first[p + 1], p);
    in_parallel(kept.size(), kLitAtOnce, [&](size_t begin, size_t end) {
        ShadowRays rays;
        for (size_t s = begin; s < end; ++s) {
            const Place& place = places_[kept[s]];
            Point point = point_of(models, stage_.copies, place.hit, place.seen_along);
            point.to_eye = glm::normalize(glm::vec3(view_.position_m) - point.at_m);
            uint64_t seed = hash_of(options_.seed, kLightStream, pixel_of[s], image.depths[s]);
            colours[s] = options_.is_unlit ? point.albedo : lit(stage_.scene, point, light, seed, rays);
            if (!image.normals.empty()) image.normals[s] = code_of_normal(point.normal);
        }
    });
    return colours;
}

PerspectiveMade Collector::take(const Models& models, const Light& light) {
    PerspectiveMade made;
    PerspectiveLdi& image = made.image;
    bool is_picture = options_.eyes == 1 && options_.layers == Layers::seen;
    image.view = view_, image.is_unlit = options_.is_unlit;
    if (options_.eyes > 1 && options_.layers == Layers::seen)  // else nothing is known of other eyes
        image.cell_m = options_.cell_m, image.unseen_share = float(held_out_.unseen_share());
    std::vector<uint32_t> kept;
    image.first = {0};
    for (uint32_t head : heads_) {
        uint32_t first = image.first.back();
        for (uint32_t at = head; at != rays::kNone; at = places_[at].next) {
            uint16_t code = code_of_depth(view_, places_[at].depth_m);
            bool is_there = image.depths.size() > first && image.depths.back() >= code;
            if (is_there || image.depths.size() - first == 65535) continue;
            image.depths.push_back(code), kept.push_back(at);
        }
        image.first.push_back(uint32_t(image.depths.size()));
    }
    image.normals.resize(is_picture ? 0 : kept.size());
    std::vector<glm::vec3> colours = colours_of(models, light, kept, image);
    for (const glm::vec3& colour : colours)
        image.colours.push_back({srgb_from_linear(colour.r), srgb_from_linear(colour.g), srgb_from_linear(colour.b)});
    made.rays = ray_count_, made.hits = held_out_.hits();
    return made;
}

}  // namespace

Result<PerspectiveMade> perspective_of(const Models& models, const TraceStage& stage, const PerspectiveView& view,
                                       const PerspectiveOptions& options, const Light& light,
                                       const std::function<void(double)>& progress) {
    constexpr double kSeeing = 0.4;  // of the time, the rest is light
    try {
        Collector collector(stage, view, options);
        if (options.layers == Layers::all) collector.see_all_layers([&](double share) { progress(kSeeing * share); });
        for (uint32_t eye = 0; eye < options.eyes && options.layers == Layers::seen && !collector.is_full(); ++eye) {
            collector.see_from(eye);
            progress(kSeeing * (eye + 1) / options.eyes);
        }
        if (collector.is_full())
            return impossible(
                "a scene's image has more than {} samples; ask for fewer pixels, fewer eyes or a greater --scene-merge",
                with_commas(kMostPerspectiveSamples));
        PerspectiveMade made = collector.take(models, light);
        progress(1);
        return made;
    } catch (const std::bad_alloc&) {
        return tl::unexpected(Error{Exit::impossible, kNoMemory});
    }
}

}  // namespace overlook::wang_ldi
