#include "tools/bake/wang_ldi/canvas.h"

#include <algorithm>
#include <cmath>

namespace overlook::wang_ldi {
namespace {

constexpr int kLarger = 3;

}  // namespace

Canvas::Canvas(uint32_t width_px, uint32_t height_px, const Colour& ground) : width_px_(width_px), height_px_(height_px) {
    large_.width = width_px * kLarger, large_.height = height_px * kLarger;
    large_.pixels.resize(size_t(large_.width) * large_.height * 3);
    clip_nothing();
    box(0, 0, width_px, height_px, ground);
}

void Canvas::clip(double low_x, double low_y, double high_x, double high_y) {
    clip_ = {low_x, low_y, high_x, high_y};
}
void Canvas::clip_nothing() {
    clip_ = {0, 0, double(width_px_), double(height_px_)};
}

template <typename Inside>
void Canvas::fill(double low_x, double low_y, double high_x, double high_y, const Colour& colour, Inside inside) {
    auto first = [](double low, double bound) { return int(std::floor(std::max(low, bound) * kLarger)); };
    auto last = [](double high, double bound, uint32_t size) {
        return std::min(int(size), int(std::ceil(std::min(high, bound) * kLarger)));
    };
    int begin_x = std::max(0, first(low_x, clip_[0])), end_x = last(high_x, clip_[2], large_.width);
    int begin_y = std::max(0, first(low_y, clip_[1])), end_y = last(high_y, clip_[3], large_.height);
    for (int y = begin_y; y < end_y; ++y)
        for (int x = begin_x; x < end_x; ++x) {
            double at_x = (x + 0.5) / kLarger, at_y = (y + 0.5) / kLarger;
            bool is_clipped = at_x < clip_[0] || at_y < clip_[1] || at_x >= clip_[2] || at_y >= clip_[3];
            if (is_clipped || !inside(at_x, at_y)) continue;
            uint8_t* pixel = &large_.pixels[(size_t(large_.height - 1 - uint32_t(y)) * large_.width + size_t(x)) * 3];
            std::copy(colour.begin(), colour.end(), pixel);
        }
}

void Canvas::box(double low_x, double low_y, double high_x, double high_y, const Colour& colour) {
    fill(low_x, low_y, high_x, high_y, colour,
         [&](double x, double y) { return x >= low_x && x < high_x && y >= low_y && y < high_y; });
}

void Canvas::frame(double low_x, double low_y, double high_x, double high_y, double width_px, const Colour& colour) {
    double half = width_px / 2;
    box(low_x - half, low_y - half, high_x + half, low_y + half, colour);
    box(low_x - half, high_y - half, high_x + half, high_y + half, colour);
    box(low_x - half, low_y - half, low_x + half, high_y + half, colour);
    box(high_x - half, low_y - half, high_x + half, high_y + half, colour);
}

void Canvas::triangle(const std::array<double, 2>& a, const std::array<double, 2>& b, const std::array<double, 2>& c,
                      const Colour& colour) {
    auto side = [](const auto& p, const auto& q, double x, double y) {
        return (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]);
    };
    fill(std::min({a[0], b[0], c[0]}), std::min({a[1], b[1], c[1]}), std::max({a[0], b[0], c[0]}), std::max({a[1], b[1], c[1]}),
         colour, [&](double x, double y) {
             double ab = side(a, b, x, y), bc = side(b, c, x, y), ca = side(c, a, x, y);
             return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
         });
}

void Canvas::disc(double x, double y, double radius_px, const Colour& colour) {
    fill(x - radius_px, y - radius_px, x + radius_px, y + radius_px, colour,
         [&](double at_x, double at_y) { return (at_x - x) * (at_x - x) + (at_y - y) * (at_y - y) <= radius_px * radius_px; });
}

ImageRgb8 Canvas::picture() const {
    ImageRgb8 picture{width_px_, height_px_, std::vector<uint8_t>(size_t(width_px_) * height_px_ * 3)};
    for (size_t y = 0; y < height_px_; ++y)
        for (size_t x = 0; x < width_px_; ++x)
            for (size_t c = 0; c < 3; ++c) {
                uint32_t sum = 0;
                for (size_t v = 0; v < kLarger; ++v)
                    for (size_t u = 0; u < kLarger; ++u)
                        sum += large_.pixels[((y * kLarger + v) * large_.width + x * kLarger + u) * 3 + c];
                picture.pixels[(y * width_px_ + x) * 3 + c] = uint8_t((sum + kLarger * kLarger / 2) / (kLarger * kLarger));
            }
    return picture;
}

Colour colour_of(uint32_t number) {
    double hue = std::fmod(number * 0.61803398875 + 0.02, 1.0) * 6, value = 0.92 - 0.18 * ((number / 5) % 3);
    Colour colour{};
    for (size_t c = 0; c < 3; ++c) {
        double k = std::fmod(5 - 2 * double(c) + hue, 6.0);
        double channel = value * (1 - 0.72 * std::clamp(std::min(k, 4 - k), 0.0, 1.0));
        colour[c] = uint8_t(255 * channel + 0.5);
    }
    return colour;
}

Colour lighter(const Colour& colour, double share) {
    Colour light{};
    for (size_t c = 0; c < 3; ++c) light[c] = uint8_t(colour[c] + (255 - colour[c]) * share + 0.5);
    return light;
}

}  // namespace overlook::wang_ldi
