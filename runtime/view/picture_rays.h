// The rays through the pixels of a camera's picture, and back.
#pragma once

#include "runtime/view/camera.h"

namespace overlook::view {

// A camera, asked for its axes once. Places in the picture are pixels from its left and its top: (column + 0.5, row + 0.5) is the
// middle of a pixel.
struct PictureRays {
    explicit PictureRays(const Camera& camera)
        : eye_m(camera.position_m),
          axes(axes_of(camera)),
          focal(focal_px(camera)),
          middle_px(glm::dvec2(camera.width_px, camera.height_px) * 0.5) {}

    // From the eye; its part along the camera's axis is 1, so that what lies t times along it is t deep.
    glm::dvec3 through(const glm::dvec2& at_px) const {
        return axes.forward + axes.right * ((at_px.x - middle_px.x) / focal) + axes.up * ((middle_px.y - at_px.y) / focal);
    }
    glm::dvec3 through_pixel(uint32_t column, uint32_t row) const { return through({column + 0.5, row + 0.5}); }

    // Where in the picture a place is seen, then how deep it is; that has to be more than 0.
    glm::dvec3 seen(const glm::dvec3& at_m) const {
        glm::dvec3 from = at_m - eye_m;
        double depth_m = glm::dot(axes.forward, from);
        return {middle_px.x + focal * glm::dot(axes.right, from) / depth_m,
                middle_px.y - focal * glm::dot(axes.up, from) / depth_m, depth_m};
    }

    glm::dvec3 eye_m;
    Axes axes;
    double focal;
    glm::dvec2 middle_px;
};

}  // namespace overlook::view
