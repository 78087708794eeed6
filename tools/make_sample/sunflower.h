// Sunflowers: bent stems, heart-shaped leaves, heads whose florets stand as H. Vogel, A better way to construct the sunflower
// head, 1979, says: the n-th at n golden angles and a distance that grows as the square root of n.
#pragma once

#include "formats/result.h"
#include "tools/bake/mesh.h"
#include "tools/make_sample/plant_shapes.h"

namespace overlook::sample {

constexpr int kSunflowers = 11;
constexpr size_t kSunflowerTriangles = 35'000;  // of each, within 500

// What each surface of a sunflower is, by its number.
enum SunflowerSurface : uint32_t { kStem, kHeartLeaves, kRays, kDisc };
// The surfaces with their pictures; leaves as cards have a mask. Fails as png_bytes does.
Result<std::vector<mesh::Surface>> sunflower_surfaces(uint64_t seed, bool has_leaf_cards);

// How a sunflower is.
struct Sunflower {
    double height_m = 2;  // of its highest point, about
    double tilt_rad = 1;  // of its head from upright
    double age = 0.5;     // 0: a bud that opens, 0.5: in flower, 1: withered, its fruits ripe
    double disc_radius_m = 0.085;
    uint32_t leaf_count = 15;
    bool has_leaf_cards = false;  // leaves are curved cards with a mask, not cut out of triangles
};
// The model of a number, 0..kSunflowers - 1: heights of 1.5..2.3 m, ages and tilts spread over all they may be.
Sunflower sunflower_of(uint64_t seed, int number);

constexpr double kFieldTurn_rad = 0.6981317007977318;  // 40 degrees
// Its foot at the origin. Turned by 0 to kFieldTurn_rad, counter-clockwise seen from above, heads look south, as in a field. Same
// traits and seed, same mesh.
mesh::Mesh sunflower_mesh(const Sunflower& sunflower, uint64_t seed, const std::vector<mesh::Surface>& surfaces);

// Parts: the head on the end of the stem, `neck`, of a radius; its disc florets are as many as fill up to kSunflowerTriangles.
void add_head(PlantMaker& maker, const Sunflower& sunflower, const Frame& neck, double neck_radius_m, Dice& dice);
// Leaves on their stalks along the stem.
void add_heart_leaves(PlantMaker& maker, const Sunflower& sunflower, const Spine& stem, Dice& dice);

}  // namespace overlook::sample
