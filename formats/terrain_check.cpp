#include "formats/terrain_check.h"

#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "formats/parallel.h"
#include "formats/terrain_diamond.h"
#include "formats/terrain_layout.h"

namespace overlook::terrain {
namespace {

constexpr size_t kRowsAtATime = 32;

// The codes of one level, and what lies well within the raster there: no triangle is squeezed, every apex is in the grid.
struct Level {
    Level(const Terrain& terrain, uint32_t log2)
        : level(log2),
          grid(level_grid(terrain.shape, log2)),
          codes(terrain.codes[log2].data()),
          inner_columns((terrain.shape.width - 1) >> log2),
          inner_rows((terrain.shape.height - 1) >> log2) {}

    uint32_t level;
    LevelGrid grid;
    const uint8_t* codes;
    uint32_t inner_columns, inner_rows;

    bool is_inner(uint32_t i, uint32_t j) const { return i > 0 && j > 0 && i < inner_columns && j < inner_rows; }
    uint8_t at(uint32_t i, uint32_t j) const { return codes[size_t(j) * grid.columns + i]; }
};

// The code of virtual vertex (x, y) of a level; kMustSplit beyond the grid, where nothing is drawn.
uint8_t code_at(const Level& level, uint32_t x, uint32_t y) {
    uint32_t i = x >> level.level, j = y >> level.level;
    return i < level.grid.columns && j < level.grid.rows ? level.at(i, j) : kMustSplit;
}

// The least code of the diamonds whose split vertices are the apexes of this one's triangles: a square's on the next level, an
// edge's on its own.
uint8_t least_parent_code(const Shape& shape, uint32_t x, uint32_t y, uint32_t level, const Level& parents) {
    Triangle triangles[2];
    int count = triangles_of_diamond(shape, x, y, level, triangles);
    uint8_t least = kMustSplit;
    for (int i = 0; i < count; ++i)
        if (!is_degenerate(shape, triangles[i]))
            least = std::min(least, code_at(parents, triangles[i].apex.x, triangles[i].apex.y));
    return least;
}

// The same for a diamond well within the raster.
uint8_t least_parent_of_square(const Level& coarser, uint32_t i, uint32_t j) {
    uint32_t west = i / 2, north = j / 2;
    if (is_main_diagonal(west, north)) return std::min(coarser.at(west + 1, north), coarser.at(west, north + 1));
    return std::min(coarser.at(west, north), coarser.at(west + 1, north + 1));
}
uint8_t least_parent_of_edge(const Level& own, uint32_t i, uint32_t j) {
    return (i & 1) != 0 ? std::min(own.at(i, j - 1), own.at(i, j + 1)) : std::min(own.at(i - 1, j), own.at(i + 1, j));
}

bool covers_void(const Terrain& terrain, uint32_t x, uint32_t y) {
    Triangle triangles[2];
    int count = triangles_of_diamond(terrain.shape, x, y, 0, triangles);
    for (int i = 0; i < count; ++i) {
        if (is_degenerate(terrain.shape, triangles[i])) continue;
        for (GridPoint p : {triangles[i].apex, triangles[i].left, triangles[i].right, GridPoint{x, y}}) {
            GridPoint sample = sample_of(terrain.shape, p);
            if (terrain.is_void(sample.x, sample.y)) return true;
        }
    }
    return false;
}

// The same for an edge well within the raster: a cross of five samples.
bool covers_void_inside(const Terrain& terrain, uint32_t x, uint32_t y) {
    ptrdiff_t down = terrain.shape.width;
    const int32_t* middle = terrain.heights.data() + size_t(y) * terrain.shape.width + x;
    return middle[0] == kVoid || middle[-1] == kVoid || middle[1] == kVoid || middle[-down] == kVoid || middle[down] == kVoid;
}

// The first vertex of a level, row by row, of which is_wrong(i, j) holds.
template <class Test>
std::optional<DiamondPlace> find_first(const Terrain& terrain, uint32_t level, const Test& is_wrong) {
    LevelGrid grid = level_grid(terrain.shape, level);
    std::optional<DiamondPlace> first;
    std::mutex guard;
    parallel_ranges(grid.rows, kRowsAtATime, [&](size_t begin, size_t end) {
        for (uint32_t j = uint32_t(begin); j < end; ++j)
            for (uint32_t i = 1 - (j & 1); i < grid.columns; i += 2 - (j & 1)) {
                if (!is_wrong(i, j)) continue;
                std::lock_guard lock(guard);
                DiamondPlace place{i << level, j << level, level};
                if (!first || std::pair(place.y, place.x) < std::pair(first->y, first->x)) first = place;
                return;
            }
    });
    return first;
}

}  // namespace

std::optional<DiamondPlace> find_code_above_parent(const Terrain& terrain) {
    const Shape& shape = terrain.shape;
    for (uint32_t t = shape.root_log2; t-- > 0;) {
        bool is_coarsest = t + 1 == shape.root_log2;
        Level own(terrain, t), coarser(terrain, is_coarsest ? t : t + 1);
        auto place = find_first(terrain, t, [&](uint32_t i, uint32_t j) {
            uint8_t code = own.at(i, j);
            bool is_square = (i & j & 1) != 0;
            if (code == 0 || (is_square && is_coarsest)) return false;
            if (own.is_inner(i, j))
                return code > (is_square ? least_parent_of_square(coarser, i, j) : least_parent_of_edge(own, i, j));
            return code > least_parent_code(shape, i << t, j << t, t, is_square ? coarser : own);
        });
        if (place) return place;
    }
    return std::nullopt;
}

std::optional<DiamondPlace> find_unmarked_void(const Terrain& terrain) {
    if (terrain.shape.root_log2 == 0) return std::nullopt;
    Level finest(terrain, 0);
    return find_first(terrain, 0, [&](uint32_t x, uint32_t y) {
        if ((x & y & 1) != 0 || finest.at(x, y) == kMustSplit) return false;
        return finest.is_inner(x, y) ? covers_void_inside(terrain, x, y) : covers_void(terrain, x, y);
    });
}

float float_at_least(double value) {
    float nearest = float(value);
    return double(nearest) < value ? std::nextafter(nearest, std::numeric_limits<float>::infinity()) : nearest;
}

uint64_t block_checksum(std::span<const std::byte> bytes) {
    return XXH3_64bits(bytes.data(), bytes.size());
}

}  // namespace overlook::terrain
