#include "tools/make_sample/ground_textures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "formats/parallel.h"
#include "tools/bake/relief_colour.h"
#include "tools/make_sample/noise.h"

namespace overlook::sample {
namespace {

using relief::Colour;

Colour blend(const Colour& a, const Colour& b, double share) {
    double t = std::clamp(share, 0.0, 1.0);
    return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

Colour srgb(uint8_t red, uint8_t green, uint8_t blue) {
    return relief::linear_from_srgb(red, green, blue);
}

// Noise over the texture, u and v in 0..1: features a share 1 / `features` of its side wide.
struct Pattern {
    uint64_t seed;
    double u, v;

    double at(uint64_t layer, uint32_t features) const {
        return tiled_noise(seed + 31 * layer, u * features, v * features, features);
    }
    double rough(uint64_t layer, uint32_t features, int octaves) const {
        double sum = 0, amplitude = 1;
        for (int octave = 0; octave < octaves; ++octave, amplitude /= 2)
            sum += amplitude * at(layer + uint64_t(octave), features << octave);
        return sum;
    }
    // Crests where the noise crosses zero, 0..1.
    double crests(uint64_t layer, uint32_t features, int octaves) const {
        return 1 - std::min(1.0, 1.7 * std::abs(rough(layer, features, octaves)));
    }
};

Colour water(const Pattern& p, const Colour& deep, const Colour& light) {
    double swell = 0.5 + 0.5 * p.rough(1, 6, 4), ripple = p.crests(9, 40, 2);
    return blend(deep, light, 0.55 * swell + 0.25 * ripple * ripple);
}

Colour sand(const Pattern& p) {
    double dunes = p.crests(1, 24, 3);
    Colour colour = blend(srgb(188, 168, 126), srgb(222, 206, 168), dunes);
    return blend(colour, srgb(150, 134, 102), 0.5 * smooth_step(0.1, 0.6, p.rough(11, 7, 4)));
}

Colour meadow(const Pattern& p) {
    Colour colour = blend(srgb(96, 122, 62), srgb(134, 148, 84), 0.5 + 0.6 * p.rough(1, 8, 5));
    double groves = smooth_step(0.22, 0.34, p.rough(17, 14, 4));
    return blend(colour, srgb(58, 82, 46), 0.8 * groves);
}

Colour forest(const Pattern& p) {
    double crowns = p.rough(1, 96, 2), stands = 0.5 + 0.5 * p.rough(7, 7, 4);
    Colour colour = blend(srgb(36, 58, 36), srgb(72, 96, 50), 0.35 + 0.9 * crowns + 0.4 * (stands - 0.5));
    double clearings = smooth_step(0.42, 0.52, p.rough(19, 12, 3));
    return blend(colour, srgb(112, 126, 70), 0.8 * clearings);
}

Colour heath(const Pattern& p) {
    Colour colour = blend(srgb(116, 112, 70), srgb(138, 124, 92), 0.5 + 0.7 * p.rough(1, 10, 5));
    colour = blend(colour, srgb(120, 84, 92), 0.6 * smooth_step(0.05, 0.45, p.rough(13, 9, 4)));
    return blend(colour, srgb(142, 138, 128), 0.7 * smooth_step(0.35, 0.5, p.rough(23, 26, 3)));
}

Colour rock(const Pattern& p) {
    double ribs = p.crests(1, 9, 5), grain = p.rough(11, 48, 3);
    Colour colour = blend(srgb(84, 80, 76), srgb(150, 142, 130), 0.15 + 0.75 * ribs * ribs + 0.35 * grain);
    return blend(colour, srgb(122, 104, 84), 0.5 * smooth_step(0.0, 0.5, p.rough(29, 6, 3)));
}

Colour snow(const Pattern& p) {
    double hollows = p.crests(1, 8, 4);
    Colour colour = blend(srgb(244, 247, 252), srgb(204, 216, 232), 0.75 * hollows * hollows);
    return blend(colour, srgb(128, 122, 116), 0.85 * smooth_step(0.40, 0.50, p.rough(15, 22, 4)));
}

Colour scree(const Pattern& p) {
    Colour colour = blend(srgb(140, 128, 108), srgb(176, 164, 142), 0.5 + 0.6 * p.rough(1, 64, 3));
    colour = blend(colour, srgb(106, 98, 84), 0.6 * smooth_step(0.05, 0.4, p.rough(13, 12, 4)));
    return blend(colour, srgb(108, 122, 74), 0.6 * smooth_step(0.2, 0.4, p.rough(21, 9, 4)));
}

// Parcels of 16 x 16, cut anew in strips, each with its crop, hedges between.
Colour fields(const Pattern& p) {
    constexpr std::array<std::array<uint8_t, 3>, 5> kCrops = {
        {{148, 152, 84}, {122, 140, 74}, {172, 160, 96}, {104, 128, 66}, {150, 128, 92}}};
    double u = p.u + 0.012 * p.rough(3, 6, 2), v = p.v + 0.012 * p.rough(5, 6, 2);
    u -= std::floor(u);
    v -= std::floor(v);
    uint32_t row = std::min(uint32_t(v * 16), 15u);
    double shifted = u * 16 + 8 * unit_from_hash(hash_of(p.seed, row, 1));
    uint32_t column = uint32_t(shifted) % 16;
    const auto& crop = kCrops[hash_of(p.seed, row, column + 2) % kCrops.size()];
    Colour colour = srgb(crop[0], crop[1], crop[2]);
    double x = shifted - std::floor(shifted), y = v * 16 - row, edge = std::min({x, 1 - x, y, 1 - y});
    colour = blend(colour, srgb(70, 92, 50), 0.7 * (1 - smooth_step(0.02, 0.07, edge)));
    return blend(colour, srgb(54, 78, 44), 0.85 * smooth_step(0.34, 0.42, p.rough(17, 8, 4)));
}

Colour colour_of(GroundKind kind, const Pattern& p) {
    switch (kind) {
        case GroundKind::deep_water:
            return water(p, srgb(22, 58, 88), srgb(44, 92, 122));
        case GroundKind::clear_water:
            return water(p, srgb(38, 112, 124), srgb(84, 160, 160));
        case GroundKind::moor_water:
            return water(p, srgb(38, 50, 46), srgb(72, 82, 70));
        case GroundKind::sand:
            return sand(p);
        case GroundKind::meadow:
            return meadow(p);
        case GroundKind::forest:
            return forest(p);
        case GroundKind::heath:
            return heath(p);
        case GroundKind::rock:
            return rock(p);
        case GroundKind::snow:
            return snow(p);
        case GroundKind::scree:
            return scree(p);
        case GroundKind::fields:
            return fields(p);
    }
    return {};
}

}  // namespace

std::string_view name_of(GroundKind kind) {
    constexpr std::array<std::string_view, 11> kNames = {"deep-water", "clear-water", "moor-water", "sand",  "meadow", "forest",
                                                         "heath",      "rock",        "snow",       "scree", "fields"};
    return kNames[size_t(kind)];
}

ImageRgb8 ground_texture(GroundKind kind, uint32_t side_px, uint64_t seed) {
    ImageRgb8 image{side_px, side_px, std::vector<uint8_t>(size_t(side_px) * side_px * 3)};
    parallel_ranges(side_px, 16, [&](size_t begin, size_t end) {
        for (size_t row = begin; row < end; ++row)
            for (uint32_t column = 0; column < side_px; ++column) {
                Pattern pattern{hash_of(seed, 77, uint64_t(kind)), (column + 0.5) / side_px, (double(row) + 0.5) / side_px};
                Colour colour = colour_of(kind, pattern);
                uint8_t* pixel = &image.pixels[3 * (row * side_px + column)];
                for (size_t c = 0; c < 3; ++c) pixel[c] = relief::srgb_from_linear(colour[c]);
            }
    });
    return image;
}

}  // namespace overlook::sample
