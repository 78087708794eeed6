#include "tools/make_sample/plant_textures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/bake/images.h"
#include "tools/make_sample/heart_leaf.h"
#include "tools/make_sample/noise.h"

namespace overlook::sample {
namespace {

glm::dvec3 rgb(double r, double g, double b) {
    return glm::dvec3(r, g, b) / 255.0;
}

// 1 on a line, 0 beyond its half width, soft between.
double line(double off, double half_width) {
    return 1 - smooth_step(0.4 * half_width, half_width, std::abs(off));
}

// Lighter on veins: how much of the vein's colour a place of a heart-shaped leaf has.
double heart_veins(uint64_t seed, const glm::dvec2& at) {
    double share = heart_share(at), most = line(at.x, 0.014 * (1.15 - at.y));
    glm::dvec2 from = heart_midrib(share);
    double reach = std::max(1e-6, glm::length(heart_rim(share) - from));
    double out = glm::length(glm::dvec2(std::abs(at.x), at.y) - from) / reach;
    double place = share * kHeartVeins - 0.35 * out * out;
    double off = (place - std::round(place)) * reach * 0.25;
    most = std::max(most, 0.8 * line(off, 0.011 * (1.1 - std::min(1.0, out))));
    return std::max(most, 0.22 * line(gradient_noise(seed, 42 * at.x, 42 * at.y), 0.12));
}

// Above 0 inside the rim with its teeth.
double inside_heart(const glm::dvec2& at) {
    glm::dvec2 from(std::abs(at.x), at.y - kHeartFoot);
    double tooth = std::fmod(heart_share(at) * kHeartTeeth, 1.0);
    return heart_radius(std::atan2(from.x, from.y)) * (1 - 0.06 * tooth) - glm::length(from);
}

glm::dvec4 heart_leaf_at(uint64_t seed, bool is_old, const glm::dvec2& at, double texel) {
    double inside = inside_heart(at), rough = fractal_noise(seed + 1, 9 * at.x, 9 * at.y, 4);
    glm::dvec3 colour = glm::mix(rgb(64, 98, 36), rgb(96, 130, 52), std::clamp(0.5 + 0.7 * rough, 0.0, 1.0));
    if (is_old) {
        double rim = 1 - smooth_step(0.02, 0.22, inside + 0.15 * rough);
        colour = glm::mix(colour, rgb(150, 142, 60), 0.45 + 0.55 * rim);
        double spots = smooth_step(0.28, 0.36, fractal_noise(seed + 2, 14 * at.x, 14 * at.y, 3));
        double brown = 1 - smooth_step(0, 0.05, inside + 0.1 * rough);
        colour = glm::mix(colour, rgb(104, 76, 40), std::max(0.7 * spots, brown));
    }
    colour = glm::mix(colour, is_old ? rgb(172, 164, 96) : rgb(150, 172, 92), 0.75 * heart_veins(seed, at));
    return {colour, std::clamp(0.5 + inside / texel, 0.0, 1.0)};
}

// Which strip of an atlas a place is in, and where in it.
struct Strip {
    uint32_t number;
    double across;
};
Strip strip_of(double u, uint32_t count) {
    auto number = std::min(uint32_t(u * count), count - 1);
    return {number, u * count - number};
}

}  // namespace

Result<mesh::Surface> painted(const std::string& name, Skin skin, uint32_t width, uint32_t height, const Paint& paint) {
    int channels = skin == Skin::masked ? 4 : 3;
    std::vector<uint8_t> pixels;
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x) {
            glm::dvec4 colour = paint((x + 0.5) / width, (y + 0.5) / height);
            for (int c = 0; c < channels; ++c) pixels.push_back(uint8_t(std::lround(255 * std::clamp(colour[c], 0.0, 1.0))));
        }
    auto png = png_bytes(width, height, channels, pixels);
    if (!png) return tl::unexpected(png.error());
    mesh::Surface surface;
    surface.name = name, surface.texture = name + ".png";
    surface.is_two_sided = skin != Skin::closed, surface.is_alpha_masked = skin == Skin::masked;
    const auto* bytes = reinterpret_cast<const uint8_t*>(png->data());
    surface.texture_bytes.assign(bytes, bytes + png->size());
    return surface;
}

Paint heart_leaf_paint(uint64_t seed) {
    return [=](double u, double v) {
        Strip strip = strip_of(u, kLeafStates);
        return heart_leaf_at(seed + 10 * strip.number, strip.number == 1, {strip.across - 0.5, v}, 1.0 / 256);
    };
}

Paint ray_paint(uint64_t seed) {
    return [=](double u, double v) {
        Strip strip = strip_of(u, kRayStrips);
        glm::dvec3 foot = rgb(222, 128, 8), middle = rgb(246, 186, 18), tip = rgb(252, 204, 42);
        if (strip.number == 4 || strip.number == 5) foot = rgb(196, 96, 8), middle = rgb(238, 164, 14), tip = rgb(246, 182, 26);
        if (strip.number == 6) foot = rgb(150, 170, 50), middle = rgb(206, 196, 50), tip = rgb(196, 190, 60);
        if (strip.number == 7) foot = rgb(120, 84, 34), middle = rgb(176, 128, 48), tip = rgb(110, 74, 36);
        double streak = gradient_noise(seed + strip.number, 11 * strip.across, 2.5 * v) +
                        0.5 * gradient_noise(seed + 50 + strip.number, 27 * strip.across, 4 * v);
        glm::dvec3 colour = glm::mix(foot, middle, smooth_step(0, 0.45, v + 0.12 * streak));
        colour = glm::mix(colour, tip, smooth_step(0.45, 0.95, v));
        double pleat = line(std::abs(strip.across - 0.5) - 0.17, 0.07);
        return glm::dvec4(colour * (1 + 0.14 * streak - 0.10 * pleat), 1);
    };
}

Paint disc_paint(uint64_t seed) {
    return [=](double u, double v) {
        auto age = std::min(uint32_t(v * kDiscAges), kDiscAges - 1);
        double up = v * kDiscAges - age;
        // Buds in the middle, then a ring in flower that moves inwards with age, and behind it what has flowered.
        static constexpr std::array<double, kDiscAges> kRing{0.98, 0.82, 0.52, 0.0};
        glm::dvec3 bud = glm::mix(rgb(96, 104, 34), rgb(74, 58, 22), smooth_step(0.15, 0.7, u));
        glm::dvec3 open = rgb(206, 138, 22), gone = age == 3 ? rgb(58, 48, 42) : rgb(112, 66, 22);
        double ring = kRing[age];
        double rough = 0.5 + gradient_noise(seed, 60 * u, 7 * v);
        glm::dvec3 colour = glm::mix(bud, gone, smooth_step(ring - 0.02, ring + 0.14, u));
        if (age < 3)
            colour = glm::mix(colour, open, 0.9 * std::max(0.0, 1 - std::abs(u - ring) / 0.13) * smooth_step(0.2, 0.7, up));
        if (age == 3) colour = glm::mix(rgb(92, 66, 32), colour, smooth_step(0, 0.35, u));
        return glm::dvec4(colour * (0.38 + 0.62 * smooth_step(0, 0.8, up)) * (0.8 + 0.4 * rough), 1);
    };
}

Paint stalk_paint(uint64_t seed, const glm::dvec3& foot, const glm::dvec3& end) {
    return [=](double u, double v) {
        double streak = gradient_noise(seed, 14 * u, 5 * v) + 0.6 * gradient_noise(seed + 1, 31 * u, 40 * v);
        return glm::dvec4(glm::mix(foot, end, smooth_step(0, 0.9, v)) * (1 + 0.2 * streak), 1);
    };
}

}  // namespace overlook::sample
