// The surface that a cut draws, by heights at the raster's samples.
#pragma once

#include <span>
#include <vector>

#include "tools/measure/stability/stage.h"

namespace overlook::measure {

// Of a raster of 2^k + 1 samples a side; samples of others whose edges leave the raster have no height here.
class Surface {
  public:
    explicit Surface(const terrain::Terrain& terrain) : terrain_(&terrain), heights_m_(terrain.heights.size(), kNone) {}

    // Replaces what it held. O(vertices).
    void take(const terrain::Cut& cut);

    std::span<const uint32_t> vertices() const { return vertices_; }  // row * width + column, each once
    bool is_vertex(uint32_t sample) const;
    // Metres at a vertex, and between vertices: the middle of the edge which the sample would split, in its turn. NaN where the
    // cut draws nothing of it.
    double height_m(uint32_t sample) const;
    // How far on the screen, pixels, a vertex stands from a point over the same place at other_m; NaN if the vertex is outside
    // the frame.
    double distance_px(uint32_t vertex, double other_m, const view::Camera& camera) const;

  private:
    static constexpr float kNone = -1e30f;

    const terrain::Terrain* terrain_;
    std::vector<float> heights_m_;  // kNone = no vertex
    std::vector<uint32_t> vertices_;
};

}  // namespace overlook::measure
