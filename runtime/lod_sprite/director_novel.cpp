#include "runtime/lod_sprite/director.h"

#include <algorithm>
#include <cmath>

namespace overlook::lod_sprite {
namespace {

constexpr double kLeastShown = 0.02;  // of the frame, nor one that has so little
constexpr double kFillWeight = 1.0 / 1024;

// Does a key's camera see all that another does from a depth on? Four rays at that depth, and where they go, decide: what lies
// between is between them.
bool sees_all(const view::Camera& key, const view::Camera& camera, double from_m) {
    Link link = link_of(key, camera);
    view::Axes axes = view::axes_of(camera);
    double focal_px = view::focal_px(camera), x = camera.width_px / (2 * focal_px), y = camera.height_px / (2 * focal_px);
    auto is_inside = [&](const glm::dvec3& at) {
        constexpr double kRounding = 1 + 1e-9;
        return at.z > 0 && std::abs(at.x) <= kRounding * link.tangents.x * at.z &&
               std::abs(at.y) <= kRounding * link.tangents.y * at.z;
    };
    for (double right : {-x, x})
        for (double up : {-y, y}) {
            glm::dvec3 ray = link.key_from_world * (axes.forward + right * axes.right + up * axes.up);
            if (!is_inside(ray) || !is_inside(link.eye_m + from_m * ray)) return false;
        }
    return true;
}

}  // namespace

// Of the picture, where the surface's own colours are seen: where no key that is looked into shows what is there, or where a key
// fades in over none.
view::PictureMask Director::open_parts() const {
    std::vector<uint8_t> is_open = open_beside_nearer(current_shown_, novel_.near_depth_m);
    if (has_before()) {
        std::vector<uint8_t> other = open_beside_nearer(shown(*before_), novel_.near_depth_m);
        for (size_t i = 0; i < is_open.size(); ++i) is_open[i] = (is_open[i] || fade_left_ > 0) && other[i];
    }
    return {current_shown_.columns, current_shown_.rows, is_open};
}

// What keys shown again need not keep, a frame's own geometry need not either.
double Director::fine_error_px() const {
    return std::max(settings_.error_px, std::min(settings_.key_error_px, settings_.low_error_px));
}

bool Director::shows_key() const {
    return current_ && current_reuse_.lost_share() <= kMostLost && current_shown_.surface_share >= kLeastShown;
}

// As things are now; made again, coarser, where a budget does not allow so many triangles.
void Director::cut_coarse() {
    constexpr int kMostTries = 4;
    bool has_key = shows_key(), fits = false;
    bool is_coarse = has_key && (fade_left_ == 0 || has_before());  // else a key fades in over what there is without it
    novel_.near_depth_m = 0;
    novel_.finer_outside.reset();
    novel_.finer_in = {};
    if (has_key && settings_.draws_near) {
        novel_.near_depth_m = track_.speed_m() * life_frames_ / (settings_.most_grown - 1);
    }
    if (has_key) {
        const view::Camera& asked = slots_[fade_left_ > 0 && has_before() ? *before_ : *current_].key.camera;
        if (!sees_all(asked, camera_, std::max(novel_.near_depth_m, camera_.near_m))) novel_.finer_outside = asked;
        if (settings_.closes_open) novel_.finer_in = open_parts();
    }
    for (int tries = 0; tries < kMostTries && !fits; ++tries) {
        double coarser = spending_.coarser(is_coarse);
        novel_.near_error_px = fine_error_px() * coarser;
        novel_.low_error_px = is_coarse ? settings_.low_error_px * coarser : novel_.near_error_px;
        novel_.cut =
            geometry_.cut_coarse(camera_, {novel_.low_error_px, settings_.morph, novel_.near_depth_m, novel_.near_error_px,
                                           novel_.finer_outside, novel_.finer_in, settings_.keeps_outlines});
        fits = spending_.coarse_done(is_coarse, novel_.cut.triangle_count);
    }
}

const Novel& Director::novel() {
    is_begun_ = false;
    ++age_frames_;
    novel_.keys.clear();
    novel_.own_weight = 0;
    has_drawn_ = true;
    novel_.rekeyed = took_over_;
    // Within a budget the cut is there, unless another key has taken over since.
    if (!is_cut_) cut_coarse();
    is_cut_ = false;
    novel_.near_triangle_count = geometry_.put_near_first(camera_, novel_.near_depth_m);
    bool has_key = shows_key();
    novel_.error_p99_px = has_key ? current_reuse_.drawn_p99_px : novel_.near_error_px;
    novel_.error_max_px = has_key ? current_reuse_.drawn_max_px : novel_.near_error_px;
    if (novel_.near_error_px > fine_error_px() && novel_.near_triangle_count > 0) {
        novel_.error_p99_px = std::max(novel_.error_p99_px, novel_.near_error_px);
        novel_.error_max_px = std::max(novel_.error_max_px, novel_.near_error_px);
    }
    novel_.lost_share = has_key ? current_reuse_.lost_share() : 1;
    novel_.is_fine = !has_key;
    if (has_key) {
        double fade = settings_.fade_frames > 0 ? double(fade_left_) / settings_.fade_frames : 0;
        novel_.keys.push_back({*current_, std::max(1 - fade, kFillWeight)});
        if (has_before()) novel_.keys.push_back({*before_, std::max(fade, kFillWeight)});
        novel_.own_weight = fade;
        if (fade_left_ > 0) --fade_left_;
    }
    return novel_;
}

}  // namespace overlook::lod_sprite
