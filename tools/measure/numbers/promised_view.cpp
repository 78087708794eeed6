#include "tools/measure/numbers/promised_view.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace overlook::measure {
namespace {

constexpr double kSlack_px = 1.5;
constexpr double kNearer = 0.99, kBehind = 1.01;

struct Pixel {
    int x = 0, y = 0;
};

bool is_in(const Frame& frame, Pixel at) {
    return at.x >= 0 && at.y >= 0 && at.x < int(frame.width) && at.y < int(frame.height);
}

// Of a frame's surface at a pixel; infinite for background.
float depth_at_m(const Frame& frame, Pixel at) {
    return frame.depth_m[size_t(at.y) * frame.width + size_t(at.x)];
}

// How the picture's rays and verticals lie.
struct Lens {
    explicit Lens(const Frame& frame)
        : axes(view::axes_of(frame.camera)),
          focal_px(view::focal_px(frame.camera)),
          middle_x(0.5 * frame.width - 0.5),
          middle_y(0.5 * frame.height - 0.5) {}

    double right_of(Pixel at) const { return (at.x - middle_x) / focal_px; }
    double up_of(Pixel at) const { return (middle_y - at.y) / focal_px; }
    // From the eye's vertical, for every metre of depth.
    double range_per_depth(Pixel at) const {
        glm::dvec3 ray = axes.forward + right_of(at) * axes.right + up_of(at) * axes.up;
        return std::hypot(ray.x, ray.y);
    }

    view::Axes axes;
    double focal_px, middle_x, middle_y;
};

// The way that a point shown at a pixel goes over the picture while it is raised: with right.z = 0, raising a point of depth D at
// tangents (r, u) by h moves it by focal h / (D + h forward.z) times (-r forward.z, up.z - u forward.z).
class Ascent {
  public:
    Ascent(const Lens& lens, Pixel from) : from_(from), focal_px_(lens.focal_px), forward_z_(lens.axes.forward.z) {
        right_ = -lens.right_of(from) * forward_z_;
        up_ = lens.axes.up.z - lens.up_of(from) * forward_z_;
        speed_ = std::hypot(right_, up_);
    }

    // Straight below the eye no direction is up, and none leads out of the pixel.
    bool has_direction() const { return speed_ > 0; }
    bool goes_up_or_down() const { return std::abs(up_) >= std::abs(right_); }
    Pixel after(double way_px) const {
        return {int(std::lround(from_.x + way_px * right_ / speed_)), int(std::lround(from_.y - way_px * up_ / speed_))};
    }
    // Its depth then, as a share of what it was; not above 0: so far it never comes, having reached the zenith before.
    double depth_share_after(double way_px) const {
        double rest = focal_px_ * speed_ - way_px * forward_z_;
        return rest > 0 ? focal_px_ * speed_ / rest : 0;
    }

  private:
    Pixel from_;
    double focal_px_, forward_z_, right_ = 0, up_ = 0, speed_ = 0;
};

}  // namespace

bool is_within_promise(const Frame& test, const Frame& wide_reference, int margin_px, double promised_px, int x, int y) {
    Lens lens(test);
    Pixel from{x, y};
    Ascent ascent(lens, from);
    if (!(promised_px > 0) || !ascent.has_direction()) return false;
    double shown_m = double(depth_at_m(test, from));
    double range_m = shown_m * lens.range_per_depth(from);

    auto comes_before_reference = [&](Pixel at, double depth_m) {
        Pixel wide{at.x + margin_px, at.y + margin_px};
        if (!is_in(wide_reference, wide)) return false;
        double reference_m = double(depth_at_m(wide_reference, wide));
        return std::isinf(reference_m) || depth_m <= kBehind * reference_m;
    };
    auto is_nearer = [&](Pixel at) {
        return is_in(test, at) && double(depth_at_m(test, at)) * lens.range_per_depth(at) < kNearer * range_m;
    };
    for (double way_px = 1; way_px <= promised_px + kSlack_px; ++way_px) {
        Pixel middle = ascent.after(way_px);
        double share = ascent.depth_share_after(way_px);
        if (share <= 0) return false;
        int dx = ascent.goes_up_or_down() ? 1 : 0, dy = 1 - dx;
        std::array<Pixel, 3> abreast = {middle, Pixel{middle.x - dx, middle.y - dy}, Pixel{middle.x + dx, middle.y + dy}};
        if (is_nearer(middle)) return false;
        if (std::any_of(abreast.begin(), abreast.end(), [&](Pixel at) { return comes_before_reference(at, share * shown_m); }))
            return true;
    }
    return false;
}

}  // namespace overlook::measure
