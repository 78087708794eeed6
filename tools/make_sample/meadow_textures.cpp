// Pictures on the skins of grass, dandelions and buttercups.
#include <algorithm>
#include <array>
#include <cmath>

#include "tools/make_sample/noise.h"
#include "tools/make_sample/plant_textures.h"

namespace overlook::sample {
namespace {

glm::dvec3 rgb(double r, double g, double b) {
    return glm::dvec3(r, g, b) / 255.0;
}

double line(double off, double half_width) {
    return 1 - smooth_step(0.4 * half_width, half_width, std::abs(off));
}

// How far inside a lobe that starts at `foot` and runs along a direction a place is; below 0 outside. Teeth at its end.
double inside_lobe(const glm::dvec2& at, const glm::dvec2& foot, double angle, double length, double half_width) {
    glm::dvec2 along(std::sin(angle), std::cos(angle)), from = at - foot;
    double on = glm::dot(from, along) / length, off = std::abs(from.x * along.y - from.y * along.x);
    if (on < 0) return -glm::length(from);
    if (on > 1) return -0.1;
    double width = half_width * std::pow(on, 0.7) * std::sqrt(std::max(0.0, 1 - on)) * 2.2;
    return width * (1 - 0.35 * std::fmod(4.2 * on, 1.0)) - off;
}

}  // namespace

Paint blade_paint(uint64_t seed) {
    return [=](double u, double v) {
        auto number = std::min(uint32_t(u * kBladeStrips), kBladeStrips - 1);
        double across = u * kBladeStrips - number;
        static const std::array<std::array<glm::dvec3, 3>, kBladeStrips> kColours{
            {{rgb(142, 150, 84), rgb(84, 120, 38), rgb(110, 144, 50)},
             {rgb(128, 138, 70), rgb(70, 108, 34), rgb(96, 132, 44)},
             {rgb(150, 156, 92), rgb(98, 134, 44), rgb(124, 152, 60)},
             {rgb(120, 130, 70), rgb(64, 98, 40), rgb(84, 118, 46)},
             {rgb(146, 150, 80), rgb(90, 128, 36), rgb(150, 158, 70)},
             {rgb(150, 150, 84), rgb(122, 136, 52), rgb(184, 168, 92)},
             {rgb(170, 158, 104), rgb(188, 170, 108), rgb(206, 188, 128)},
             {rgb(150, 138, 90), rgb(168, 150, 104), rgb(190, 168, 124)}}};
        const auto& [foot, middle, tip] = kColours[number];
        double streak = gradient_noise(seed + number, 9 * across, 3 * v);
        glm::dvec3 colour = glm::mix(foot, middle, smooth_step(0, 0.25, v));
        colour = glm::mix(colour, tip, smooth_step(0.55, 1, v + 0.1 * streak));
        return glm::dvec4(colour * (1 + 0.18 * streak + 0.12 * line(across - 0.5, 0.12)), 1);
    };
}

Paint toothed_leaf_paint(uint64_t seed) {
    return [=](double u, double v) {
        double off = std::abs(u - 0.5), rough = fractal_noise(seed, 7 * u, 18 * v, 3);
        glm::dvec3 colour = glm::mix(rgb(66, 102, 34), rgb(94, 130, 46), std::clamp(0.5 + 0.8 * rough, 0.0, 1.0));
        double place = 9 * v - 1.6 * off, vein = line(place - std::round(place), 0.10) * (1 - 2 * off);
        colour = glm::mix(colour, rgb(132, 156, 76), 0.5 * vein);
        glm::dvec3 rib = glm::mix(rgb(150, 96, 92), rgb(150, 168, 100), smooth_step(0, 0.35, v));
        return glm::dvec4(glm::mix(colour, rib, line(off, 0.07 * (1.2 - v))), 1);
    };
}

Paint ligule_paint(uint64_t seed) {
    return [=](double u, double v) {
        double streak = gradient_noise(seed, 8 * u, 2 * v);
        glm::dvec3 colour = glm::mix(rgb(206, 150, 8), rgb(250, 200, 14), smooth_step(0.1, 0.55, v));
        colour = glm::mix(colour, rgb(254, 220, 44), smooth_step(0.6, 1, v));
        return glm::dvec4(colour * (1 + 0.12 * streak), 1);
    };
}

Paint parachute_paint(uint64_t seed) {
    return [=](double u, double v) {
        glm::dvec2 from(u - 0.5, v - 0.5);
        double radius = glm::length(from), angle = std::atan2(from.y, from.x);
        constexpr int kHairs = 22;
        double place = angle / 6.283185307179586 * kHairs;
        double number = std::floor(place + 0.5);
        double reach = 0.42 + 0.06 * unit_from_hash(hash_of(seed, uint64_t(int64_t(number) + kHairs) % kHairs, 0));
        double off = std::abs(place - number) / kHairs * 6.283185307179586 * radius;
        double inside = std::max(0.013 - off, 0.035 - radius);
        if (radius > reach) inside = -1;
        return glm::dvec4(rgb(226, 222, 210) * (0.9 + 0.1 * smooth_step(0, 0.4, radius)),
                          std::clamp(0.5 + inside * 64, 0.0, 1.0));
    };
}

Paint buttercup_petal_paint(uint64_t seed) {
    return [=](double u, double v) {
        double streak = gradient_noise(seed, 16 * u, 2 * v) + 0.5 * gradient_noise(seed + 1, 35 * u, 3 * v);
        glm::dvec3 colour = glm::mix(rgb(196, 176, 20), rgb(244, 196, 6), smooth_step(0.02, 0.3, v));
        colour = glm::mix(colour, rgb(255, 218, 22), smooth_step(0.35, 0.95, v));
        return glm::dvec4(colour * (1 + 0.07 * streak), 1);
    };
}

Paint palmate_leaf_paint(uint64_t seed) {
    return [=](double u, double v) {
        glm::dvec2 at(u - 0.5, 1 - v);
        double inside = 0.014 - std::abs(at.x) - (at.y > 0.2 ? 1 : 0), rib = std::abs(at.x);
        for (int lobe = -3; lobe <= 3; ++lobe) {
            double angle = 0.52 * lobe, length = 0.74 - 0.055 * std::abs(lobe) * std::abs(lobe);
            double in = inside_lobe(at, {0, 0.18}, angle, length, 0.125);
            if (in > inside) inside = in, rib = std::abs(at.x * std::cos(angle) - (at.y - 0.18) * std::sin(angle));
        }
        double rough = fractal_noise(seed, 8 * u, 8 * v, 3);
        glm::dvec3 colour = glm::mix(rgb(62, 98, 34), rgb(92, 130, 50), std::clamp(0.5 + 0.8 * rough, 0.0, 1.0));
        colour = glm::mix(colour, rgb(136, 164, 88), 0.6 * line(rib, 0.013));
        return glm::dvec4(colour, std::clamp(0.5 + inside * 128, 0.0, 1.0));
    };
}

}  // namespace overlook::sample
