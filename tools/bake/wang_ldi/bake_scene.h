// A ground of tiles as one perspective image, and pictures of it from eyes at its place and away from it.
//
// Based on: J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth Images, 2000, section 2 and figure 2 (one layered depth
// image of the whole scene, seen from its own place and from elsewhere).
#pragma once

#include <functional>

#include "formats/wang_ground.h"
#include "formats/wang_scene.h"
#include "tools/bake/wang_ldi/perspective.h"

namespace overlook::wang_ldi {

// How far from the image's own eye pictures are made, on the ground.
inline constexpr double kPictureDistances_m[] = {0.25, 0.5, 1, 2, 4, 8};

struct SceneBake {
    uint32_t side_tiles = 40;  // of the ground, a square
    PerspectiveView view;      // its place is from the ground's middle; far_m 0: as far as the ground's farthest corner
    PerspectiveOptions image;
    uint32_t directions = 2;  // pictures at each distance: to the right of where the camera looks, then clockwise, evenly
    Light light;              // of the image; pictures keep what is glossy as their own eyes see it
    bool has_gloss = true;
    uint64_t memory_bytes = uint64_t(4) << 30;  // for rays
    rays::Instructions instructions = rays::Instructions::best;
};

struct SceneMade {
    Scene scene;
    uint64_t objects = 0;
    PerspectiveMade image;  // without the image itself, which is in the scene
    double image_s = 0, pictures_s = 0;
};

// Fails as tile_square, Scene::build and perspective_of, and with Exit::bad_command: "--scene-camera: the eye stands outside of
// the ground, which is 174 m wide".
Result<SceneMade> bake_scene(const PlantedTiles& ground, const Models& models, const SceneBake& bake,
                             const std::function<void(double)>& progress);

}  // namespace overlook::wang_ldi
