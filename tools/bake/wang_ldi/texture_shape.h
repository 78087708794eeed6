// How high a directional texture's boxes have to be for it to cover as much of near pictures as of far ones.
//
// Sight lines of far eyes are flatter and meet what stands out; those of nearer ones come deeper, where more stands. A box that
// is as high as all that is seen, and as opaque as its mean, shows too little to near eyes and too much to far ones.
#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <span>

#include "tools/bake/wang_ldi/sample.h"
#include "tools/bake/wang_ldi/textures_opacity.h"

namespace overlook::wang_ldi {

// Of a box: where it stands about the mean height of what is seen in it, and half how high it is, in standard deviations.
struct BoxShape {
    double raised = 0, half_height = 1.7320508075688772;  // of what is as dense everywhere
};
// Sight lines that reach a tile by how far their eyes are, in classes of equal ratio.
class LinesByDistance {
  public:
    static constexpr size_t kClasses = 4;
    explicit LinesByDistance(const Wedge& wedge);

    // shown: what share of such a line ends in the tile.
    void add(const glm::vec3& from_m, double shown);
    // Root mean square over the classes of how far the share shown is off that of `truth`, of which it is a share; of classes
    // that both know.
    double off(const LinesByDistance& truth) const;

  private:
    glm::dvec2 middle_m_;
    std::array<double, kClasses - 1> ends_squared_m_{};
    std::array<double, kClasses> lines_{}, shown_{};
};

// The shape that brings the texture's coverage nearest to `truth`; another than that of what is as dense everywhere only if that
// is worth half a percent of it. made(shape): the texture's colours and heights with it; its opacities are chosen here, of the
// finest picture, by some of the lines. shown: as choose_opacity. Same arguments, same shape.
BoxShape chosen_shape(const TextureSet& set, const Wedge& wedge, std::span<const Line> lines, std::span<const double> shown,
                      const LinesByDistance& truth, const std::function<DirectionalTexture(const BoxShape&)>& made);

}  // namespace overlook::wang_ldi
