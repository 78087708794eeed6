// A scene, a rectangle of ground covered with Wang tiles, as one perspective layered depth image; and pictures of it by rays,
// which are such images of one layer.
//
// Based on: J. Shade, S. Gortler, L. He, R. Szeliski, Layered Depth Images, 1998 (a layered depth image of a whole scene); J.
// Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth Images, 2000, section 2 and figure 2 (which it is the baseline of).
// Different: pixels hold any number of layers as compressed rows; depths have steps of equal ratio.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "formats/container.h"
#include "formats/result.h"

namespace overlook::wang_ldi {

constexpr uint32_t kMostSceneTiles = 1024;          // along a side
constexpr uint32_t kMostPerspectiveSide_px = 4096;  // of a picture
constexpr uint32_t kMostPerspectiveSamples = 1u << 25, kMostScenePictures = 4096;
constexpr uint64_t kMostSceneBytes = uint64_t(1) << 28;  // of a section, before compression

// The camera of a picture: view::Camera, and how far it sees. In the scene's frame: x east and y north from its south-west
// corner, z up, metres.
struct PerspectiveView {
    glm::dvec3 position_m{0};
    double heading_deg = 0, pitch_deg = 0, fov_y_deg = 60;
    uint32_t width_px = 0, height_px = 0;
    double near_m = 0.1, far_m = 100;  // along the camera's axis

    bool operator==(const PerspectiveView&) const = default;
};

// Depths along the camera's axis as 65,536 steps of equal ratio, from near_m to far_m.
double depth_of_code(const PerspectiveView& view, uint16_t code);
uint16_t code_of_depth(const PerspectiveView& view, double depth_m);  // the nearest one

// Pixel (column, row) holds samples [first[p], first[p + 1]) with p = row * width_px + column, row 0 at the top, from the nearest
// on, each on the ray through the pixel's middle.
struct PerspectiveLdi {
    PerspectiveView view;
    double cell_m = 0;             // eyes that it is made for are so far off its own at most, along each axis of the scene
    bool is_unlit = false;         // colours are the surfaces' own
    float unseen_share = 0;        // of what these eyes see, how much is not in here: as estimated; 0 for a picture
    std::vector<uint32_t> first;   // [width_px * height_px + 1], ascending from 0
    std::vector<uint16_t> depths;  // codes, ascending within a pixel, none twice
    std::vector<std::array<uint8_t, 3>> colours;  // sRGB-encoded
    std::vector<std::array<int8_t, 2>> normals;   // octahedral, -127..127; or none at all

    uint32_t sample_count() const { return uint32_t(depths.size()); }
    bool operator==(const PerspectiveLdi&) const = default;
};

// Samples in the pixel that has most. O(pixels).
inline uint32_t most_layers(const PerspectiveLdi& image) {
    uint32_t most = 0;
    for (size_t p = 0; p + 1 < image.first.size(); ++p) most = std::max(most, image.first[p + 1] - image.first[p]);
    return most;
}

struct Scene {
    uint32_t columns = 0, rows = 0;
    std::vector<uint8_t> tiles;  // [rows, columns], south first, from the west: of the file's set
    PerspectiveLdi image;
    std::vector<PerspectiveLdi> pictures;  // by rays, from eyes about the image's own

    bool operator==(const Scene&) const = default;
};

// Adds the sections WSCN and WSCP. tile_count: of the file's set. Exit::our_bug if the scene breaks a rule: "a scene to write has
// ...".
Result<void> write_scene(container::Writer& writer, const Scene& scene, uint32_t tile_count);

bool has_scene(const container::Reader& file);
// The file may be hostile; every failure of form is Exit::bad_input and names file, rule and place: "scene.ovl: V7: picture 3:
// pixel 20 has a sample at step 9 behind one at step 12". A file without the sections breaks V1. Exit::impossible if there is not
// so much memory.
Result<Scene> read_scene(const container::Reader& file, uint32_t tile_count);
// What the image takes in the file, with the tiling; 0 where there is none.
uint64_t stored_bytes_of_scene_image(const container::Reader& file);

// What each rule of these sections says, as container::rule_text.
std::string_view scene_rule_text(int rule);
int scene_rule_count();

}  // namespace overlook::wang_ldi
