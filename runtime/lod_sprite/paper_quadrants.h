// The low-resolution quadrants of section 3.2 of Chen, Swan and Kuo, LOD-Sprite Technique for Accelerated Terrain Rendering
// (1999).
//
// "The resolution of each quadrant is determined by the number of levels we traverse down into the quadtree that is created by
// our LOD algorithm." That quadtree is the cut's own: so a low-resolution quadrant is a square of the terrain's quadtree, 2^level
// cells wide, whose diagonal the low cut draws in one piece. The diagonal is the edge AB of the paper's figure 4, and the vertex
// in the square's middle the C that is not drawn. These squares cover what the cut draws exactly once. The number of levels can
// also be stated, the same everywhere (Quadrants::of_level): a reading that the sentence allows and that suits a sweep, but whose
// squares have nothing to do with what is drawn.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "formats/terrain.h"
#include "runtime/lod_sprite/paper_table.h"
#include "runtime/terrain/refine.h"

namespace overlook::lod_sprite::paper {

// By the raster samples of its corners, columns and rows; north-west first. Where the raster's edge squeezes a square it is the
// part that is left, perhaps not a square.
struct Quadrant {
    uint32_t column0 = 0, row0 = 0, column1 = 0, row1 = 0;
    bool is_main_diagonal = true;  // its drawn diagonal runs from the north-west to the south-east corner

    // A side of less than two cells has no vertex in its middle: nothing of the data is missing there.
    bool has_centre() const { return column1 - column0 >= 2 && row1 - row0 >= 2; }
    // Of a squeezed side with an odd number of cells the sample just before the middle.
    uint32_t centre_column() const { return column0 + (column1 - column0) / 2; }
    uint32_t centre_row() const { return row0 + (row1 - row0) / 2; }

    bool operator==(const Quadrant&) const = default;
};

constexpr int kCutLevels = -1;

class Quadrants {
  public:
    // Squares whose diagonal `low` draws, in the order of the cut. None of them holds a void corner or centre: cuts split over
    // voids down to single cells, which have no centre. Cost O(triangles), no memory but the greatest cut's.
    const std::vector<Quadrant>& of_cut(const terrain::Terrain& terrain, const terrain::Cut& low);
    // All squares `levels` below the roots, 0 .. root_log2, row by row, without those whose corners or centre are void. Cost
    // O(squares).
    const std::vector<Quadrant>& of_level(const terrain::Terrain& terrain, uint32_t levels);

  private:
    std::vector<Quadrant> all_;
    TripleTable diagonals_;
};

// The sample of a vertex of a cut, as Cut::indices holds it.
inline uint32_t sample_of_index(const terrain::Terrain& terrain, const terrain::Cut& cut, uint32_t index) {
    return index < terrain.heights.size() ? index : cut.morphs[index - terrain.heights.size()].sample;
}

// Where a sample lies in the terrain's own frame, metres. It must not be void.
glm::dvec3 place_of(const terrain::Terrain& terrain, uint32_t column, uint32_t row);

}  // namespace overlook::lod_sprite::paper
