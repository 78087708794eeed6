// Layered depth images of Wang tiles: for each tile, level of detail and direction of view the samples of its surfaces that a
// viewer sees from there, in vertical columns over the tile, ready to be warped (runtime/wang_ldi).
//
// Based on: J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth Images, 2000, section 4; J. Shade, S. Gortler, L. He,
// R. Szeliski, Layered Depth Images, 1998. Different: columns hold any number of layers as compressed rows, colours stand in a
// palette of each image's own, a cell says from where it is right.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "formats/container.h"
#include "formats/result.h"

namespace overlook::wang_ldi {

constexpr uint32_t kMostImageTiles = 1 << 16, kMostLevels = 32, kMostDirections = 64, kMostContexts = 2, kMostLdis = 1 << 20;
constexpr uint32_t kMostSide_px = 4096;
constexpr uint32_t kMostSamples = 1u << 26;  // of one image
constexpr uint32_t kMostColours = 256;       // of one image

// Where eyes are for whom the images were sampled, in metres; elsewhere they show less than there is.
struct Cell {
    double eye_low_m = 0, eye_high_m = 0;  // above the tile's ground, z = 0
    double nearest_m = 0, farthest_m = 0;  // on the ground, from the eye to the tile's middle
    double focal_px = 0;                   // pixels per unit of tangent of the picture that was thought of
    double error_px = 0;                   // what directions and levels were chosen for
};

struct Level {
    uint32_t side_px = 0;     // pixels along each side of the tile
    float nearest_m = 0;      // for tiles whose middle is so far at least on the ground, up to the next level's
    float height_step_m = 0;  // of a sample's height
    float splat_px = 1;       // how wide a sample is drawn, in pixels of this level, where an image has no splats of its own

    bool operator==(const Level&) const = default;
};

// What all images of a file share. The tile's own frame: x east and y north from its south-west corner, both 0..tile_m; z up,
// 0 on the ground.
struct ImageSet {
    double tile_m = 0;
    double low_m = 0, high_m = 0;  // everything in a tile lies between
    Cell cell;
    uint32_t tile_count = 0;
    uint32_t direction_count = 0;
    uint32_t context_count = 1;  // 1: sampled among neighbours; 2: besides, alone, for the border of what is planted
    bool has_normals = false;    // colours are unlit, to be lit by these; else they are lit by sun and sky
    bool has_splats = false;     // each sample says how wide it is drawn
    bool is_grouped = false;     // how images are stored: predicted and grouped, in a sixth fewer bytes
    // For how far beyond its own distances and headings each image was sampled, where it gives way to others: shares of the
    // distance where its level begins or ends, and of the angle between two directions; 0..0.5.
    float level_fade = 0, direction_fade = 0;
    glm::dvec3 to_sun{0};       // of length 1, of lit colours; else 0
    std::vector<Level> levels;  // finest first

    uint64_t ldi_count() const { return uint64_t(context_count) * tile_count * levels.size() * direction_count; }
};

// Which image of a set. Direction d is for eyes that stand, seen from the tile's middle, at a heading of 360 d / direction_count
// degrees (clockwise from north) or up to half a step beside it.
struct Which {
    uint32_t context = 0, tile = 0, level = 0, direction = 0;
};
uint64_t index_of(const ImageSet& set, const Which& which);
Which which_of(const ImageSet& set, uint64_t index);

// The direction for an eye at `from_middle_m` (x, y) from the tile's middle: the one whose own vector to the eye has the greatest
// dot product with it (so the least with the vector from the viewer to the tile, as the paper says it).
uint32_t direction_for(const ImageSet& set, const glm::dvec2& from_middle_m);
// The level for a tile whose middle is so far away on the ground; the finest for any that is nearer.
uint32_t level_for(const ImageSet& set, double distance_m);

// The eyes that an image was sampled for, on the ground.
struct SampledFor {
    double nearest_m = 0, farthest_m = 0;        // from the tile's middle
    double heading_rad = 0, half_width_rad = 0;  // seen from there, clockwise from north, and so far to both sides
};
SampledFor sampled_for(const ImageSet& set, uint32_t level, uint32_t direction);
// Whether an eye at such a place from the tile's middle, so high above the ground, is one of them, but for rounding (1e-6).
bool is_sampled_for(const ImageSet& set, uint32_t level, uint32_t direction, const glm::dvec2& from_middle_m, double above_m);

// One image: an orthographic camera looks straight down on the tile. Pixel (column, row) is the square of tile_m / side_px from
// (column, row) of them on, row 0 in the south. Its samples are [first[p], first[p + 1]) with p = row * side_px + column, from
// the lowest up: whoever draws pixels by decreasing distance on the ground, and in each those from below and from above towards
// the height of the eye, draws back to front (L. McMillan, Computing visibility without depth, 1995).
struct Ldi {
    uint32_t side_px = 0;
    std::vector<uint32_t> first;                  // [side_px^2 + 1], ascending from 0
    std::vector<uint16_t> heights;                // steps above low_m, ascending within a pixel, none twice
    std::vector<uint8_t> colours;                 // of palette
    std::vector<std::array<int8_t, 2>> normals;   // octahedral, -127..127; none unless the set has them
    std::vector<uint8_t> splats;                  // sixteenths of a pixel of the level, > 0; none unless the set has them
    std::vector<std::array<uint8_t, 3>> palette;  // sRGB-encoded; 1..256, none if there is no sample
    float unseen_share = 0;  // of what the cell sees of the tile, how much is not in here: as estimated when sampling stopped

    uint32_t sample_count() const { return uint32_t(heights.size()); }
    bool operator==(const Ldi&) const = default;
};

// An image as it is stored: one zstd frame.
struct Packed {
    std::vector<std::byte> bytes;
    uint64_t checksum = 0;  // XXH3-64 of them
    uint32_t raw_bytes = 0, sample_count = 0, colour_count = 0;
    float unseen_share = 0;
};
// Exit::our_bug if the image breaks a rule: "an image to write has ...". Any thread; same image, same bytes.
Result<Packed> packed(const ImageSet& set, uint32_t level, const Ldi& ldi);

// Writes the sections WLDS and WLDI: begin, then add all images in the order of index_of, then end. The container's writer must
// outlive it and be left alone until the end. Exit::our_bug if the set breaks a rule or images are too few or too many.
class ImageWriter {
  public:
    static Result<ImageWriter> begin(container::Writer& writer, const ImageSet& set);
    Result<void> add(const Packed& ldi);
    Result<void> end();

  private:
    ImageWriter(container::Writer& writer, const ImageSet& set) : writer_(&writer), set_(set) {}
    container::Writer* writer_;
    ImageSet set_;
    std::vector<std::byte> directory_;
    uint64_t added_ = 0, offset_ = 0;
};

// What the directory says of an image.
struct Entry {
    uint64_t offset = 0, checksum = 0;  // in WLDS
    uint32_t stored_bytes = 0, raw_bytes = 0, sample_count = 0, colour_count = 0;
    float unseen_share = 0;
};

// The images of a file, read one by one. The file may be hostile and must outlive this; every failure of form is Exit::bad_input
// and names file, rule and place: "field.ovl: L11: tile 2, level 0, direction 5: its pixels have 20 samples, 21 are stated".
// Exit::impossible if there is not so much memory.
class ImageReader {
  public:
    // Checks the directory; none of the images.
    static Result<ImageReader> open(const container::Reader& file);
    const ImageSet& set() const { return set_; }
    std::span<const Entry> entries() const { return entries_; }  // [ldi_count], in the order of index_of
    // Any thread. index < ldi_count.
    Result<Ldi> read(uint64_t index) const;

  private:
    ImageReader() = default;
    friend class DirectoryReader;
    const container::Reader* file_ = nullptr;
    ImageSet set_;
    std::vector<Entry> entries_;
    std::span<const std::byte> stored_;
};

// What each rule of these sections says, as container::rule_text.
std::string_view image_rule_text(int rule);
int image_rule_count();

}  // namespace overlook::wang_ldi
