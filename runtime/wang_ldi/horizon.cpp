#include "runtime/wang_ldi/horizon.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "formats/parallel.h"

namespace overlook::wang_ldi {
namespace {

constexpr double kNearest_m = 8, kStep = 1.04;  // from one way to the next
constexpr double kSector_px = 10;
constexpr double kLeastForward = 0.2, kWidestBearing = 4;
constexpr size_t kWaysAtOnce = 8, kMostWays = 1200, kMostSectors = 1024;
// Of a splat: its sides are rounded, its place is, and a pixel is taken for its middle.
constexpr double kMargin_px = 2;

constexpr float kNothing = -std::numeric_limits<float>::infinity();

// A little less, so that it is no more than the double was.
float rounded_down(double value) {
    auto rounded = float(value);
    return double(rounded) <= value ? rounded : std::nextafter(rounded, kNothing);
}

bool is_same_view(const view::Camera& a, const view::Camera& b) {
    return a.position_m == b.position_m && a.heading_deg == b.heading_deg && a.pitch_deg == b.pitch_deg &&
           a.fov_y_deg == b.fov_y_deg && a.width_px == b.width_px && a.height_px == b.height_px;
}

}  // namespace

Horizon::Horizon(const Ground& ground, const view::Camera& camera)
    : ground_(&ground), camera_(camera), eye_m_(camera.position_m), eye_high_m_(camera.position_m.z) {
    view::Axes axes = view::axes_of(camera);
    focal_px_ = view::focal_px(camera), right_ = glm::dvec2(axes.right), forward_ = {-right_.y, right_.x};
    double half_wide = camera.width_px / (2 * focal_px_), half_high = camera.height_px / (2 * focal_px_);
    double level = glm::dot(glm::dvec2(axes.forward), forward_), upright = glm::dot(glm::dvec2(axes.up), forward_);
    // Of the pixel whose way forward is the least of its depth.
    double least = level - half_high * std::abs(upright);
    if (ground.is_plain() || !(least > kLeastForward)) return;
    depth_most_ = 1 / least, bearing_most_ = (half_wide + 2 * kMargin_px / focal_px_) / least;
    slant_ = 1 + bearing_most_ * std::abs(upright);
    const Rect& extent = ground.extent();
    if (!(bearing_most_ < kWidestBearing) || !extent.contains({eye_m_, eye_m_})) return;
    if (!(ground.height_m(eye_m_) < eye_high_m_)) return;
    double farthest_m = 0;
    for (double x : {extent.low_m.x, extent.high_m.x})
        for (double y : {extent.low_m.y, extent.high_m.y})
            farthest_m = std::max(farthest_m, glm::dot(glm::dvec2(x, y) - eye_m_, forward_));
    for (double way_m = kNearest_m; way_m < farthest_m && ways_m_.size() < kMostWays; way_m *= kStep) ways_m_.push_back(way_m);
    if (ways_m_.empty()) return;
    sectors_ = std::clamp(size_t(camera.width_px / kSector_px), size_t(1), kMostSectors);
    rises_.assign(sectors_ * ways_m_.size(), kNothing);
    parallel_ranges(sectors_, 4, [&](size_t begin, size_t end) {
        for (size_t sector = begin; sector < end; ++sector) look_along(ground, sector);
    });
}

bool Horizon::is_of(const Ground& ground, const view::Camera& camera) const {
    return ground_ == &ground && is_same_view(camera_, camera);
}

// Up to where there is ground throughout, from the eye on, so that no line of sight passes below it unseen.
void Horizon::look_along(const Ground& ground, size_t sector) {
    size_t ways = ways_m_.size();
    float* rises = rises_.data() + sector * ways;
    glm::dvec2 left = forward_ + bearing(sector) * right_, right = forward_ + bearing(sector + 1) * right_;
    auto end_at = [&](size_t way, float rise) { std::fill(rises + way, rises + ways, rise); };
    Ground::Asked asked;
    float rise = kNothing;
    for (size_t way = 0; way < ways;) {
        size_t last = std::min(way + kWaysAtOnce, ways) - 1;
        double from_m = way > 0 ? ways_m_[way - 1] : 0, to_m = ways_m_[last];
        glm::dvec2 corners[4] = {eye_m_ + from_m * left, eye_m_ + from_m * right, eye_m_ + to_m * left, eye_m_ + to_m * right};
        Rect rect{corners[0], corners[0]};
        for (const glm::dvec2& corner : corners) rect = {glm::min(rect.low_m, corner), glm::max(rect.high_m, corner)};
        GroundRange range = ground.bound(rect);
        if (!range.is_whole) return end_at(way, rise);
        double up_m = range.high_m - eye_high_m_, most = up_m / ways_m_[up_m > 0 ? way : last];
        if (most <= double(rise)) {
            for (; way <= last; ++way) rises[way] = rise;
            continue;
        }
        for (; way <= last; ++way) {
            double lowest_m = ground.lowest_m(eye_m_ + ways_m_[way] * left, eye_m_ + ways_m_[way] * right, asked);
            rise = std::max(rise, rounded_down((lowest_m - eye_high_m_) / ways_m_[way]));
            rises[way] = rise;
        }
    }
}

// A line of sight of the box's sectors that rises no more than the horizon before it met the ground there. Pixels are as far
// apart as depth_most_ and slant_ say along bearings, and by their own depth along rises.
bool Horizon::hides(const Rect& rect, double high_m, double wide_m, double error_px) const {
    if (rises_.empty()) return false;
    double nearest_m = INFINITY, farthest_m = 0, least = INFINITY, most = -INFINITY;
    for (double x : {rect.low_m.x, rect.high_m.x})
        for (double y : {rect.low_m.y, rect.high_m.y}) {
            glm::dvec2 away(x - eye_m_.x, y - eye_m_.y);
            double forward_m = glm::dot(away, forward_);
            if (!(forward_m >= ways_m_.front())) return false;
            double bearing = glm::dot(away, right_) / forward_m;
            nearest_m = std::min(nearest_m, forward_m), farthest_m = std::max(farthest_m, forward_m);
            least = std::min(least, bearing), most = std::max(most, bearing);
        }
    // A splat is as deep as its middle throughout, so that with a camera that looks down its rim lies nearer along the ground.
    nearest_m -= wide_m / 2;
    if (!(nearest_m >= ways_m_.front())) return false;
    double aside = slant_ * (2 * kMargin_px * depth_most_ / focal_px_ + wide_m / nearest_m);
    least -= aside, most += aside;
    if (!(most > -bearing_most_ && least < bearing_most_)) return false;
    double up_m = high_m - eye_high_m_, rise = up_m / (up_m > 0 ? nearest_m : farthest_m);
    auto way = size_t(std::upper_bound(ways_m_.begin(), ways_m_.end(), nearest_m) - ways_m_.begin()) - 1;
    auto sector_at = [&](double bearing) {
        double place = std::floor((bearing / bearing_most_ + 1) / 2 * double(sectors_));
        return size_t(std::clamp(place, 0.0, double(sectors_ - 1)));
    };
    for (size_t sector = sector_at(least), last = sector_at(most); sector <= last; ++sector) {
        auto horizon = double(rises_[sector * ways_m_.size() + way]);
        if (!(rise < horizon)) return false;
        double square = 1 + std::max(rise * rise, horizon * horizon);  // of the depth for the way forward, at most
        double margin = (error_px + kMargin_px) * square / focal_px_ + wide_m * std::sqrt(square) / (2 * nearest_m);
        if (rise + margin > horizon) return false;
    }
    return true;
}

}  // namespace overlook::wang_ldi
