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

// The code of virtual vertex (x, y) of a level; kMustSplit beyond the grid, where nothing is drawn.
uint8_t code_at(const Terrain& terrain, uint32_t level, int64_t x, int64_t y) {
    LevelGrid grid = level_grid(terrain.shape, level);
    int64_t i = x >> level, j = y >> level;
    if (x < 0 || y < 0 || i >= int64_t(grid.columns) || j >= int64_t(grid.rows)) return kMustSplit;
    return terrain.codes[level][size_t(j) * grid.columns + size_t(i)];
}

// The least code of the diamonds whose split vertices are the apexes of this one's triangles.
uint8_t least_parent_code(const Terrain& terrain, uint32_t x, uint32_t y, uint32_t level) {
    Triangle triangles[2];
    int count = triangles_of_diamond(terrain.shape, x, y, level, triangles);
    bool is_square = diamond_kind(x, y, level) == DiamondKind::square;
    uint32_t parent_level = is_square ? level + 1 : level;
    uint8_t least = kMustSplit;
    if (parent_level >= terrain.shape.root_log2) return least;
    for (int i = 0; i < count; ++i) {
        if (is_degenerate(terrain.shape, triangles[i])) continue;
        least = std::min(least, code_at(terrain, parent_level, triangles[i].apex.x, triangles[i].apex.y));
    }
    return least;
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

// The first vertex of a level, row by row, of which is_wrong(x, y) holds.
template <class Test>
std::optional<DiamondPlace> find_first(const Terrain& terrain, uint32_t level, const Test& is_wrong) {
    LevelGrid grid = level_grid(terrain.shape, level);
    std::optional<DiamondPlace> first;
    std::mutex guard;
    parallel_ranges(grid.rows, kRowsAtATime, [&](size_t begin, size_t end) {
        for (uint32_t j = uint32_t(begin); j < end; ++j)
            for (uint32_t i = 0; i < grid.columns; ++i) {
                if (((i | j) & 1) == 0 || !is_wrong(i << level, j << level)) continue;
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
    for (uint32_t level = terrain.shape.root_log2; level-- > 0;) {
        auto place = find_first(terrain, level, [&](uint32_t x, uint32_t y) {
            uint8_t code = code_at(terrain, level, x, y);
            return code != 0 && code > least_parent_code(terrain, x, y, level);
        });
        if (place) return place;
    }
    return std::nullopt;
}

std::optional<DiamondPlace> find_unmarked_void(const Terrain& terrain) {
    if (terrain.shape.root_log2 == 0) return std::nullopt;
    return find_first(terrain, 0, [&](uint32_t x, uint32_t y) {
        bool is_edge = diamond_kind(x, y, 0) != DiamondKind::square;
        return is_edge && code_at(terrain, 0, x, y) != kMustSplit && covers_void(terrain, x, y);
    });
}

float float_at_least(double value) {
    float nearest = float(value);
    return double(nearest) < value ? std::nextafter(nearest, std::numeric_limits<float>::infinity()) : nearest;
}

uint64_t block_checksum(std::span<const std::byte> bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

}  // namespace overlook::terrain
