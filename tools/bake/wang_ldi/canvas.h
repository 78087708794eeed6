// A small picture to draw plain shapes on, smoothed by drawing it larger.
#pragma once

#include <array>
#include <cstdint>

#include "formats/image.h"

namespace overlook::wang_ldi {

using Colour = std::array<uint8_t, 3>;

// x to the right, y up, in pixels of the picture, whatever it is drawn at.
class Canvas {
  public:
    Canvas(uint32_t width_px, uint32_t height_px, const Colour& ground = {255, 255, 255});

    void box(double low_x, double low_y, double high_x, double high_y, const Colour& colour);
    void frame(double low_x, double low_y, double high_x, double high_y, double width_px, const Colour& colour);
    void triangle(const std::array<double, 2>& a, const std::array<double, 2>& b, const std::array<double, 2>& c,
                  const Colour& colour);
    void disc(double x, double y, double radius_px, const Colour& colour);
    // Nothing is drawn outside of it until it is set anew.
    void clip(double low_x, double low_y, double high_x, double high_y);
    void clip_nothing();

    ImageRgb8 picture() const;

  private:
    template <typename Inside>
    void fill(double low_x, double low_y, double high_x, double high_y, const Colour& colour, Inside inside);

    uint32_t width_px_, height_px_;
    ImageRgb8 large_;
    std::array<double, 4> clip_;
};

// Far apart for neighbouring numbers: hues by the golden angle.
Colour colour_of(uint32_t number);
Colour lighter(const Colour& colour, double share);

}  // namespace overlook::wang_ldi
