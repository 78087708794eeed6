// Should a split be applied, or undone, for one camera?
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "formats/caveclod.h"
#include "runtime/caveclod/mesh.h"
#include "runtime/caveclod/settings.h"
#include "runtime/view/camera.h"
#include "runtime/view/pixel_detail.h"
#include "runtime/view/pixel_error.h"

namespace overlook::caveclod {

// Everything is taken from a split's sphere and cone, which hold all that it and whatever needs it touch: what is not wanted of a
// split need not be asked of those. Wanting to split and wanting to collapse leave a band between them in which nothing changes:
// in pixels, in the frame's borders (H. Hoppe 1997, view frustum and surface orientation), and in how far a cone turns away.
// finer: parts of the picture that keep another error, less than the settings'; none where it is null.
class ScreenTest {
  public:
    ScreenTest(const Mesh& mesh, const view::Camera& camera, const Settings& settings, const view::FinerParts* finer = nullptr)
        : mesh_(mesh),
          bound_(camera),
          eye_m_(camera.position_m),
          split_px_(settings.error_px),
          silhouette_px_(settings.silhouette_error_px > 0 ? settings.silhouette_error_px : settings.error_px),
          collapse_share_(settings.collapse_share),
          enter_share_(settings.glide_s > 0 ? kGlideEnter : 1),
          tests_cones_(settings.culls_back_faces || silhouette_px_ < split_px_),
          culls_back_faces_(settings.culls_back_faces),
          finer_(finer != nullptr && !finer->is_empty() ? finer : nullptr) {
        focal_px_ = view::focal_px(camera), corner_secant_ = view::corner_secant(camera), near_m_ = camera.near_m;
        keep_reach_ = (focal_px_ / (settings.error_px * settings.collapse_share) + 1) * (1 - kRounding);
        double half_y = camera.fov_y_deg * std::numbers::pi / 360;
        double half_x = std::atan(std::tan(half_y) * camera.width_px / camera.height_px);
        double guard = settings.guard_deg * std::numbers::pi / 180;
        narrow_ = {Side(half_x + guard), Side(half_y + guard)};
        wide_ = {Side(half_x + 1.5 * guard), Side(half_y + 1.5 * guard)};
        if (tests_cones_) {
            for (size_t i = 0; i < 256; ++i)
                sines_[i] = std::sin(double(i) * std::numbers::pi / 255),
                cosines_[i] = std::cos(double(i) * std::numbers::pi / 255);
        }
    }

    struct Answer {
        double error_px = 0;       // 0 where nothing is to be seen
        double seen_error_px = 0;  // the same, 0 also where the guard sector alone is wide enough to keep it
        // must_split: more than what was asked for. wants_split: what may glide begins before.
        bool must_split = false, wants_split = false, wants_collapse = true;
    };
    // What nothing that is left unsplit may exceed, wherever it is.
    double least_limit_px() const { return finer_ != nullptr ? std::min(silhouette_px_, finer_->error_px()) : silhouette_px_; }

    Answer operator()(uint32_t split) const {
        const Bounds& bounds = mesh_.bounds(split);
        glm::dvec3 from_eye = mesh_.middle_m(split) - eye_m_;
        double radius_m = mesh_.radius_m(split);
        view::SphereErrorBound::Place place = bound_.place_of(from_eye);
        if (!wide_.holds(place, radius_m)) return {};
        Answer answer;
        answer.error_px = bound_(place, radius_m, mesh_.error_m(split));
        double limit_px = split_px_, keep_px = split_px_;
        bool is_hidden = false;
        if (tests_cones_) {
            Facing tight = facing(bounds.cone, 0, from_eye, radius_m), loose = facing(bounds.cone, 3, from_eye, radius_m);
            if (culls_back_faces_ && loose == Facing::away) return {};
            is_hidden = culls_back_faces_ && tight == Facing::away;
            if (tight == Facing::both) limit_px = silhouette_px_;
            if (loose == Facing::both) keep_px = silhouette_px_;
        }
        if (finer_ != nullptr && answer.error_px > finer_->error_px() * collapse_share_ && finer_->touch(place, radius_m)) {
            limit_px = std::min(limit_px, finer_->error_px());
            keep_px = std::min(keep_px, finer_->error_px());
        }
        bool is_seen = !is_hidden && narrow_.holds(place, radius_m);
        answer.seen_error_px = is_seen ? answer.error_px : 0;
        answer.must_split = is_seen && answer.error_px > limit_px;
        answer.wants_split = is_seen && answer.error_px > limit_px * enter_share_;
        answer.wants_collapse = answer.error_px <= keep_px * collapse_share_;
        return answer;
    }

    // How far what lies in a sphere of the world is displaced by what lies within error_m of it; 0 out of view.
    double seen_px(const glm::dvec3& middle_m, double radius_m, double error_m) const {
        view::SphereErrorBound::Place place = bound_.place_of(middle_m - eye_m_);
        return narrow_.holds(place, radius_m + error_m) ? bound_(place, radius_m, error_m) : 0;
    }

    // Without root or division, for the many that change nothing.
    //
    // With d the distance of a sphere's middle, the least depth is at least (d - r) / secant and the widest secant at most the
    // corner's: the error is within limit_px if d >= r + e * secant * (1 + f * secant / limit_px). reach_of() is that factor of
    // e, made once for many splits; it serves for what wants to be split if limit_px is at most least_split_px().
    double reach_of(double limit_px) const {
        if (!(limit_px > 0)) return std::numeric_limits<double>::infinity();
        return corner_secant_ * (1 + focal_px_ * corner_secant_ / limit_px) * (1 + kRounding);
    }
    double least_split_px() const { return std::min(split_px_, least_limit_px()) * enter_share_; }
    // What the shorter ways read of a split, once for all of them.
    struct Sphere {
        glm::dvec3 from_eye_m;
        double radius_m, error_m;
    };
    Sphere sphere(uint32_t split) const { return {mesh_.middle_m(split) - eye_m_, mesh_.radius_m(split), mesh_.error_m(split)}; }
    bool is_within(const Sphere& of, double reach) const {
        double far_m = of.radius_m + (of.error_m > 0 ? of.error_m * reach : 0);
        return glm::dot(of.from_eye_m, of.from_eye_m) >= far_m * far_m;
    }
    // Whether what is seen of it is within limit_px: nothing is out of the narrow sector, and with z the depth of a sphere's
    // nearest point and s how far its middle is from the axis, the least depth is at least z and the widest tangent at most (s +
    // r) / z.
    bool is_seen_within(const Sphere& of, double limit_px) const {
        view::SphereErrorBound::Place place = bound_.place_of(of.from_eye_m);
        if (of.error_m <= 0 || !narrow_.holds(place, of.radius_m)) return true;
        double depth_m = place.forward - of.radius_m, rest_m = depth_m - of.error_m;
        if (rest_m <= 0) return false;
        // At least (s + r)^2, without the root.
        double across = place.right * place.right + place.up * place.up +
                        (2 * (std::abs(place.right) + std::abs(place.up)) + of.radius_m) * of.radius_m;
        double square = depth_m * depth_m, error_f = focal_px_ * of.error_m, limit = limit_px * rest_m;
        double secant = std::min(corner_secant_ * corner_secant_ * square, square + across);  // squared, times z^2
        return error_f * error_f * secant * (1 + kRounding) <= limit * limit * square;
    }
    // With P what is kept, collapse_share * error_px: a secant is at least 1, so that what is applied in the wide sector stays if
    // its least depth is at most f * e / P + e. Answers false as well where it cannot tell.
    bool is_kept(const Sphere& of) const { return !tests_cones_ && is_larger(of, wide_); }
    // The same of what must be split, where no band lies between. Behind the eye a sphere may reach the narrow sector's planes
    // and not the wide one's.
    bool is_surely_split(const Sphere& of) const {
        return collapse_share_ == 1 && !culls_back_faces_ && is_larger(of, narrow_) &&
               wide_.holds(bound_.place_of(of.from_eye_m), of.radius_m);
    }

  private:
    static constexpr double kRounding = 1e-9;  // what the shorter way may round otherwise

    // A pair of planes through the eye, at an angle to either side of the axis; none from 90 degrees on.
    struct Side {
        double sine = 1, cosine = 0;
        Side() = default;
        explicit Side(double angle_rad) {
            if (angle_rad < std::numbers::pi / 2 - 0.01) sine = std::sin(angle_rad), cosine = std::cos(angle_rad);
        }
        bool holds(double across, double forward, double radius_m) const {
            return cosine == 0 || std::abs(across) * cosine - forward * sine <= radius_m;
        }
    };
    struct Sector {
        Side x, y;
        bool holds(const view::SphereErrorBound::Place& place, double radius_m) const {
            return x.holds(place.right, place.forward, radius_m) && y.holds(place.up, place.forward, radius_m);
        }
    };

    // Whether it surely has more than collapse_share * error_px in a sector.
    bool is_larger(const Sphere& of, const Sector& sector) const {
        double reach_m = of.error_m * keep_reach_, near_enough_m = of.radius_m + reach_m * corner_secant_ * (1 - kRounding);
        if (reach_m <= near_m_ || glm::dot(of.from_eye_m, of.from_eye_m) > near_enough_m * near_enough_m) return false;
        view::SphereErrorBound::Place place = bound_.place_of(of.from_eye_m);
        return place.forward - of.radius_m <= reach_m && sector.holds(place, of.radius_m);
    }

    enum class Facing { towards, both, away };
    // Of all normals in a cone, widened by `more` of its 255 steps, at all places of a sphere.
    Facing facing(const NormalCone& cone, uint32_t more, const glm::dvec3& from_eye_m, double radius_m) const {
        uint32_t half = cone.half_angle + more;
        double distance_m = glm::length(from_eye_m);
        if (half >= 127 || distance_m <= radius_m) return Facing::both;
        double sine = radius_m / distance_m, cosine = std::sqrt(1 - sine * sine);
        if (cosines_[half] * cosine - sines_[half] * sine <= 0) return Facing::both;  // together 90 degrees or more
        double limit = (sines_[half] * cosine + cosines_[half] * sine) * distance_m;
        double along = glm::dot(axis_of(cone), from_eye_m);
        return along > limit ? Facing::away : along < -limit ? Facing::towards : Facing::both;
    }

    const Mesh& mesh_;
    view::SphereErrorBound bound_;
    glm::dvec3 eye_m_;
    double split_px_, silhouette_px_, collapse_share_, enter_share_;
    bool tests_cones_, culls_back_faces_;
    const view::FinerParts* finer_;
    double focal_px_ = 1, corner_secant_ = 1, near_m_ = 1, keep_reach_ = 0;
    Sector narrow_, wide_;
    std::array<double, 256> sines_{}, cosines_{};
};

}  // namespace overlook::caveclod
