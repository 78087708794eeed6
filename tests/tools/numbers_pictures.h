// Frames and pictures whose numbers are known by hand, and an analytic landscape: a textured plane under a sky.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "tools/measure/numbers/picture.h"

namespace overlook::measure {

struct Picture {
    uint32_t width = 0, height = 0;
    std::vector<uint8_t> rgb;

    operator RgbView() const { return {width, height, rgb}; }
};

using Grey = std::function<int(uint32_t x, uint32_t y)>;

inline Picture grey_picture(uint32_t width, uint32_t height, const Grey& grey) {
    Picture picture{width, height, {}};
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x) picture.rgb.insert(picture.rgb.end(), 3, uint8_t(grey(x, y)));
    return picture;
}

inline Picture plain_picture(uint32_t width, uint32_t height, uint8_t r, uint8_t g, uint8_t b) {
    Picture picture{width, height, {}};
    for (size_t i = 0; i < size_t(width) * height; ++i) picture.rgb.insert(picture.rgb.end(), {r, g, b});
    return picture;
}

// Every channel of every pixel on its own, 0..255.
inline Picture noise_picture(uint32_t width, uint32_t height, uint32_t seed) {
    Picture picture{width, height, std::vector<uint8_t>(size_t(width) * height * 3)};
    for (uint8_t& value : picture.rgb) {
        seed = seed * 1664525u + 1013904223u;
        value = uint8_t(seed >> 24);
    }
    return picture;
}

// A frame of one thing (id 1) at 100 m where the function says so, background elsewhere; black.
inline Frame mask_frame(uint32_t width, uint32_t height, const std::function<bool(uint32_t x, uint32_t y)>& is_surface) {
    Frame frame;
    frame.width = frame.camera.width_px = width;
    frame.height = frame.camera.height_px = height;
    frame.rgb.resize(size_t(width) * height * 3);
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x) {
            frame.ids.push_back(is_surface(x, y) ? 1 : kBackground);
            frame.depth_m.push_back(is_surface(x, y) ? 100 : std::numeric_limits<float>::infinity());
        }
    return frame;
}

// What the plane z = 0 shows at a place: waves of 126 and 157 m, grey 28..228.
inline int ground_grey(double x_m, double y_m) {
    return int(std::lround(128 + 50 * std::sin(x_m * 0.05) + 50 * std::sin(y_m * 0.04 + 1)));
}

// The plane z = 0 (id 1) and a plain sky of grey 200 above the horizon, drawn exactly: one ray through each pixel's middle.
inline Frame plane_frame(const view::Camera& camera) {
    Frame frame;
    frame.width = camera.width_px;
    frame.height = camera.height_px;
    frame.camera = camera;
    view::Axes axes = view::axes_of(camera);
    double focal = view::focal_px(camera);
    for (uint32_t y = 0; y < frame.height; ++y)
        for (uint32_t x = 0; x < frame.width; ++x) {
            double right = (x + 0.5 - frame.width / 2.0) / focal, up = (frame.height / 2.0 - y - 0.5) / focal;
            glm::dvec3 ray = axes.forward + right * axes.right + up * axes.up;
            bool hits = ray.z < -1e-9;
            double depth_m = hits ? -camera.position_m.z / ray.z : std::numeric_limits<double>::infinity();
            glm::dvec3 place = hits ? camera.position_m + depth_m * ray : glm::dvec3(0);
            frame.ids.push_back(hits ? 1 : kBackground);
            frame.depth_m.push_back(float(depth_m));
            frame.rgb.insert(frame.rgb.end(), 3, uint8_t(hits ? ground_grey(place.x, place.y) : 200));
        }
    return frame;
}

}  // namespace overlook::measure
