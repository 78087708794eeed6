#include "runtime/view/camera.h"

#include <charconv>
#include <cmath>
#include <numbers>
#include <vector>

#include "formats/steady_math.h"

namespace overlook::view {
namespace {

double radians(double degrees) {
    return degrees * std::numbers::pi / 180;
}

// "1,2.5,-3" as numbers; false at the first thing that is none.
bool parse_numbers(std::string_view text, std::vector<double>& numbers) {
    const char* at = text.data();
    const char* end = at + text.size();
    while (true) {
        double value = 0;
        auto [after, problem] = std::from_chars(at, end, value);
        if (problem != std::errc() || !std::isfinite(value)) return false;
        numbers.push_back(value);
        if (after == end) return true;
        if (*after != ',') return false;
        at = after + 1;
    }
}

}  // namespace

std::array<glm::dvec3, 4> sides_of(const Camera& camera) {
    Axes axes = axes_of(camera);
    double focal = focal_px(camera), tangent_x = camera.width_px / (2 * focal), tangent_y = camera.height_px / (2 * focal);
    return {axes.forward * tangent_x + axes.right, axes.forward * tangent_x - axes.right, axes.forward * tangent_y + axes.up,
            axes.forward * tangent_y - axes.up};
}

Axes axes_of(const Camera& camera) {
    steady::SinCos heading = steady::sin_cos(radians(camera.heading_deg)), pitch = steady::sin_cos(radians(camera.pitch_deg));
    Axes axes;
    axes.right = {heading.cos, -heading.sin, 0};
    axes.forward = {heading.sin * pitch.cos, heading.cos * pitch.cos, pitch.sin};
    axes.up = glm::cross(axes.right, axes.forward);
    return axes;
}

double focal_px(const Camera& camera) {
    return camera.height_px / (2 * steady::tan(radians(camera.fov_y_deg) / 2));
}

double corner_secant(const Camera& camera) {
    double focal = focal_px(camera);
    double tangent_x = camera.width_px / (2 * focal), tangent_y = camera.height_px / (2 * focal);
    return std::sqrt(1 + tangent_x * tangent_x + tangent_y * tangent_y);
}

glm::mat4 projection(const Camera& camera) {
    double focal = focal_px(camera);
    glm::mat4 matrix(0);
    matrix[0][0] = float(2 * focal / camera.width_px);
    matrix[1][1] = float(2 * focal / camera.height_px);
    matrix[2][3] = -1;                    // clip w = depth in front of the eye
    matrix[3][2] = float(camera.near_m);  // depth buffer = near / depth
    return matrix;
}

glm::mat4 rotation(const Camera& camera) {
    Axes axes = axes_of(camera);
    glm::mat4 matrix(1);
    for (int i = 0; i < 3; ++i) {
        matrix[i][0] = float(axes.right[i]);
        matrix[i][1] = float(axes.up[i]);
        matrix[i][2] = float(-axes.forward[i]);
    }
    return matrix;
}

PartMap part_map(const Camera& camera, const Part& part) {
    glm::dvec2 picture{camera.width_px, camera.height_px}, size{part.width_px, part.height_px};
    glm::dvec2 first{part.left_px, double(camera.height_px) - part.top_px - part.height_px};  // its lower left corner, from there
    return {picture / size, (picture - 2.0 * first - size) / size};
}

Result<Camera> parse_camera(std::string_view text) {
    std::vector<double> numbers;
    if (!parse_numbers(text, numbers) || numbers.size() < 5 || numbers.size() > 6)
        return bad_command("--camera {}: five or six numbers are wanted: x,y,z,heading,pitch[,fov_y] in metres and degrees",
                           text);
    Camera camera;
    camera.position_m = {numbers[0], numbers[1], numbers[2]};
    camera.heading_deg = numbers[3];
    camera.pitch_deg = numbers[4];
    if (numbers.size() == 6) camera.fov_y_deg = numbers[5];
    if (std::abs(camera.pitch_deg) > 90)
        return bad_command("--camera {}: pitch {} is outside -90..90 degrees", text, camera.pitch_deg);
    if (camera.fov_y_deg < 1 || camera.fov_y_deg > 170)
        return bad_command("--camera {}: field of view {} is outside 1..170 degrees", text, camera.fov_y_deg);
    return camera;
}

}  // namespace overlook::view
