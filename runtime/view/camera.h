// A pinhole camera in the local metric frame of a scene: x right, y up the raster (north), z height, metres.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string_view>

#include "formats/result.h"

namespace overlook::view {

// A rectangle of a camera's picture, in its pixels from the left and the top; it may reach beyond the picture.
struct Part {
    uint32_t left_px = 0, top_px = 0, width_px = 0, height_px = 0;
};

struct Camera {
    glm::dvec3 position_m{0};
    double heading_deg = 0;  // clockwise from +y (north)
    double pitch_deg = 0;    // up positive, -90..90
    double fov_y_deg = 60;   // full vertical angle, 1..170
    uint32_t width_px = 1280;
    uint32_t height_px = 720;
    double near_m = 1;
};

// Right, up and forward unit vectors; the same bits on every processor, as focal_px().
struct Axes {
    glm::dvec3 right, up, forward;
};
Axes axes_of(const Camera& camera);

// Left, right, bottom and top: what lies within the picture's four sides has a product of at least 0 with each of these, from the
// camera's place.
std::array<glm::dvec3, 4> sides_of(const Camera& camera);

// Pixels per unit of tangent: height_px / (2 tan(fov_y / 2)).
double focal_px(const Camera& camera);

// Secant of the angle between the axis and a corner of the image.
double corner_secant(const Camera& camera);

// Camera-relative projection with reversed depth (near = 1, infinity = 0); multiply positions minus position_m.
glm::mat4 projection(const Camera& camera);
glm::mat4 rotation(const Camera& camera);

// What brings a part of the picture to the whole of a viewport: x, y of normalised device coordinates become scale * (x, y) +
// shift. Exactly 1 and 0 for the part that is the whole picture.
struct PartMap {
    glm::dvec2 scale{1}, shift{0};
};
PartMap part_map(const Camera& camera, const Part& part);

// "x,y,z,heading,pitch[,fov_y]" in metres and degrees. Fails with Exit::bad_command.
Result<Camera> parse_camera(std::string_view text);

}  // namespace overlook::view
