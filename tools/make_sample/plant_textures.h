// Pictures on the skins of plants. Colours are sRGB's, 0..1.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <string>

#include "formats/result.h"
#include "tools/bake/mesh.h"

namespace overlook::sample {

// Colour and opacity at a place of the picture, 0..1 from its left and from its top.
using Paint = std::function<glm::dvec4(double u, double v)>;

// What a surface of a plant is; its picture is NAME.png, with opacity only where it is masked.
enum class Skin { closed, two_sided, masked };
// Fails as png_bytes does.
Result<mesh::Surface> painted(const std::string& name, Skin skin, uint32_t width, uint32_t height, const Paint& paint);

// Two heart-shaped leaves beside one another, a fresh one and one that yellows from its rim. v runs along the midrib.
constexpr uint32_t kLeafStates = 2;
Paint heart_leaf_paint(uint64_t seed);
// Eight ray florets beside one another, foot above: 0..3 yellow, 4 and 5 deeper, 6 still green, 7 withered.
constexpr uint32_t kRayStrips = 8;
Paint ray_paint(uint64_t seed);
// Disc florets: u from the disc's middle to its rim; below one another four ages, each from a floret's foot to its top.
constexpr uint32_t kDiscAges = 4;
Paint disc_paint(uint64_t seed);
// A stalk with streaks along it, from its foot to its end.
Paint stalk_paint(uint64_t seed, const glm::dvec3& foot, const glm::dvec3& end);
// Eight blades of grass beside one another, foot above: 0..4 green, 5 yellowing, 6 straw, 7 an ear's chaff.
constexpr uint32_t kBladeStrips = 8;
Paint blade_paint(uint64_t seed);
// A dandelion's leaf with its pale midrib, foot above.
Paint toothed_leaf_paint(uint64_t seed);
// A floret of a dandelion from its green tube to its tip.
Paint ligule_paint(uint64_t seed);
// The parachute of a dandelion's fruit: hairs about the middle, all else transparent.
Paint parachute_paint(uint64_t seed);
// Buttercups: a glossy petal, foot above; and a palmate leaf with narrow lobes, its foot below, all else transparent.
Paint buttercup_petal_paint(uint64_t seed);
Paint palmate_leaf_paint(uint64_t seed);

}  // namespace overlook::sample
