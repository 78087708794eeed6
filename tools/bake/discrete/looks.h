// What the surfaces of a thing look like at a place: their colours and pictures, decoded.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "formats/caveclod.h"
#include "formats/result.h"
#include "tools/bake/discrete/shape.h"
#include "tools/bake/images.h"

namespace overlook::discrete {

glm::dvec3 linear_of_srgb(const glm::dvec3& encoded);  // each 0..1
glm::dvec3 srgb_of_linear(const glm::dvec3& linear);

class Looks {
  public:
    // A picture that cannot be read is left out, and its surface keeps its colour, as where it is drawn. Fails where the library
    // of pictures cannot be opened (images.h).
    static Result<Looks> make(std::span<const caveclod::Surface> surfaces);

    // One more surface, white and alpha-masked, of a picture; returns its number.
    uint32_t add_picture(const PictureRgba8& picture, double cutoff);

    // Of a place on a face, by the weights of its corners: linear colour and opacity.
    glm::dvec4 at(const Shape& shape, size_t face, const glm::dvec3& weights) const;
    // Whether it is drawn there: not a hole of an alpha-masked surface.
    bool is_drawn(const Shape& shape, size_t face, const glm::dvec3& weights) const;

  private:
    struct Look {
        glm::dvec4 colour{1};  // linear
        int picture = -1;
        bool is_masked = false;
        double cutoff = 0;
    };
    double opacity_at(const PictureRgba8& picture, const glm::dvec2& uv) const;

    std::vector<Look> looks_;
    std::vector<PictureRgba8> pictures_;
};

}  // namespace overlook::discrete
