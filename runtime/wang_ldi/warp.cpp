#include "runtime/wang_ldi/warp.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace overlook::wang_ldi {
namespace {

constexpr int kMostSplat_px = 64;

// A tile's frame as the camera sees it: a place is corner + x * east + y * north + z * up in (right, up, forward) of the camera,
// right and up times the focal length.
struct Seen {
    glm::vec3 corner, east, north, up;
    glm::vec2 middle_px;

    Seen(const view::Camera& camera, const Drawn& drawn, double low_m) {
        view::Axes axes = view::axes_of(camera);
        double focal = view::focal_px(camera);
        auto from = [&](const glm::dvec3& v) {
            return glm::vec3(focal * glm::dot(axes.right, v), focal * glm::dot(axes.up, v), glm::dot(axes.forward, v));
        };
        corner = from(drawn.origin_m + glm::dvec3(0, 0, low_m) - camera.position_m);
        east = from({1, 0, drawn.slope.x}), north = from({0, 1, drawn.slope.y}), up = from({0, 0, 1});
        middle_px = glm::vec2(camera.width_px, camera.height_px) * 0.5f;
    }
};

// The i-th of 0 .. count - 1 when those below `eye` come first, ascending, then those above it, descending, then it itself. A ray
// from within `eye` passes any two in this order turned round, so nothing hides what comes after it.
int towards(int i, int eye, int count) {
    if (eye < 0) return count - 1 - i;
    if (eye >= count || i < eye) return i;
    return i < count - 1 ? count - 1 - (i - eye) : eye;
}
int square_of(double at) {
    return int(std::clamp(std::floor(at), -1.0, 1e9));
}

template <Hiding hiding>
class Painter {
  public:
    Painter(const view::Camera& camera, const ImageSet& set, const Drawn& drawn, Warped& picture)
        : ldi_(*drawn.ldi), picture_(picture), seen_(camera, drawn, set.low_m), near_m_(float(camera.near_m)) {
        const Level& level = set.levels[drawn.level];
        pixel_m_ = set.tile_m / level.side_px, step_m_ = level.height_step_m;
        splat_ =
            float(view::focal_px(camera) * pixel_m_) * drawn.splat_scale * (ldi_.splats.empty() ? level.splat_px : 1.0f / 16);
        glm::dvec3 eye = camera.position_m - drawn.origin_m;
        eye_column_ = square_of(eye.x / pixel_m_), eye_row_ = square_of(eye.y / pixel_m_);
        eye_height_m_ = eye.z - set.low_m, slope_ = drawn.slope;
        for (const auto& colour : ldi_.palette)
            palette_.push_back(uint32_t(colour[0]) | uint32_t(colour[1]) << 8 | uint32_t(colour[2]) << 16 | 0xff000000u);
    }

    void run() {
        auto side = int(ldi_.side_px);
        for (int j = 0; j < side; ++j)
            for (int i = 0, row = towards(j, eye_row_, side); i < side; ++i) draw_pixel(towards(i, eye_column_, side), row);
    }

  private:
    void draw_pixel(int column, int row) {
        size_t pixel = size_t(row) * ldi_.side_px + size_t(column);
        uint32_t first = ldi_.first[pixel], end = ldi_.first[pixel + 1];
        if (first == end) return;
        double x = (column + 0.5) * pixel_m_, y = (row + 0.5) * pixel_m_;
        glm::vec3 foot = seen_.corner + float(x) * seen_.east + float(y) * seen_.north;
        double eye_step = (eye_height_m_ - slope_.x * x - slope_.y * y) / double(step_m_);
        uint32_t s = first;
        for (; s < end && double(ldi_.heights[s]) < eye_step; ++s) draw_sample(s, foot);
        for (uint32_t above = end; above > s; --above) draw_sample(above - 1, foot);
    }

    void draw_sample(uint32_t s, const glm::vec3& foot) {
        glm::vec3 at = foot + (float(ldi_.heights[s]) * step_m_) * seen_.up;
        if (!(at.z >= near_m_)) return;
        float x = seen_.middle_px.x + at.x / at.z, y = seen_.middle_px.y - at.y / at.z;
        float wide = splat_ * (ldi_.splats.empty() ? 1.0f : float(ldi_.splats[s])) / at.z;
        int side = std::clamp(int(std::min(wide, 1e4f) + 0.5f), 1, kMostSplat_px);
        float half = 0.5f * float(side - 1);
        if (!(std::abs(x) < 1e6f && std::abs(y) < 1e6f)) return;
        int left = int(std::floor(x - half)), top = int(std::floor(y - half));
        fill(left, top, side, at.z, palette_[ldi_.colours[s]]);
    }

    void fill(int left, int top, int side, float depth_m, uint32_t colour) {
        int right = std::min(left + side, int(picture_.width_px)), bottom = std::min(top + side, int(picture_.height_px));
        for (int y = std::max(top, 0); y < bottom; ++y)
            for (int x = std::max(left, 0); x < right; ++x) {
                size_t p = size_t(y) * picture_.width_px + size_t(x);
                if (hiding == Hiding::by_depth && !(depth_m < picture_.depth_m[p])) continue;
                picture_.colours[p] = colour, picture_.depth_m[p] = depth_m;
            }
    }

    const Ldi& ldi_;
    Warped& picture_;
    Seen seen_;
    float near_m_, step_m_ = 0, splat_ = 0;
    double pixel_m_ = 0, eye_height_m_ = 0;
    int eye_column_ = 0, eye_row_ = 0;
    glm::dvec2 slope_{0};
    std::vector<uint32_t> palette_;
};

}  // namespace

void Warped::clear(uint32_t width, uint32_t height) {
    width_px = width, height_px = height;
    colours.assign(size_t(width) * height, 0);
    depth_m.assign(size_t(width) * height, std::numeric_limits<float>::infinity());
}

void warp(const view::Camera& camera, const ImageSet& set, std::span<const Drawn> back_to_front, Hiding hiding, Warped& picture) {
    for (const Drawn& drawn : back_to_front) {
        if (hiding == Hiding::by_order)
            Painter<Hiding::by_order>(camera, set, drawn, picture).run();
        else
            Painter<Hiding::by_depth>(camera, set, drawn, picture).run();
    }
}

void order_of_tiles(const glm::dvec3& eye_m, double tile_m, std::span<Drawn> tiles) {
    // How many tiles off the eye's own row or column; equal ones on both sides of the eye hide nothing of each other.
    auto off = [&](double origin, double eye) { return std::abs(std::floor((eye - origin) / tile_m)); };
    std::stable_sort(tiles.begin(), tiles.end(), [&](const Drawn& a, const Drawn& b) {
        auto key = [&](const Drawn& drawn) { return std::pair(off(drawn.origin_m.y, eye_m.y), off(drawn.origin_m.x, eye_m.x)); };
        return key(a) > key(b);
    });
}

}  // namespace overlook::wang_ldi
