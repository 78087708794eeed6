#include "tests/formats/synthetic_terrain.h"

#include <algorithm>
#include <limits>

#include "formats/terrain_check.h"
#include "formats/terrain_diamond.h"

namespace overlook::terrain {
namespace {

class Numbers {
  public:
    uint32_t next() {
        state_ = state_ * 1664525u + 1013904223u;
        return state_ >> 16;
    }

  private:
    uint32_t state_ = 1;
};

bool covers_void(const Terrain& terrain, const Triangle& triangle, GridPoint middle) {
    for (GridPoint p : {triangle.apex, triangle.left, triangle.right, middle}) {
        GridPoint sample = sample_of(terrain.shape, p);
        if (terrain.is_void(sample.x, sample.y)) return true;
    }
    return false;
}

// Raises the diamonds that must be split before those of one kind of a level; their own codes are right by then.
void saturate(Terrain& terrain, uint32_t level, bool of_squares) {
    LevelGrid grid = level_grid(terrain.shape, level);
    for (uint32_t j = 0; j < grid.rows; ++j)
        for (uint32_t i = 0; i < grid.columns; ++i) {
            if (((i | j) & 1) == 0 || ((i & j & 1) != 0) != of_squares) continue;
            uint8_t& code = terrain.codes[level][size_t(j) * grid.columns + i];
            Triangle triangles[2];
            int count = triangles_of_diamond(terrain.shape, i << level, j << level, level, triangles);
            for (int k = 0; k < count; ++k) {
                if (is_degenerate(terrain.shape, triangles[k])) continue;
                if (level == 0 && covers_void(terrain, triangles[k], {i, j})) code = kMustSplit;
            }
            uint32_t parent_level = of_squares ? level + 1 : level;
            if (parent_level == terrain.shape.root_log2) continue;
            for (int k = 0; k < count; ++k) {
                if (is_degenerate(terrain.shape, triangles[k])) continue;
                uint32_t columns = level_grid(terrain.shape, parent_level).columns;
                GridPoint apex = triangles[k].apex;
                uint8_t& parent =
                    terrain.codes[parent_level][size_t(apex.y >> parent_level) * columns + (apex.x >> parent_level)];
                parent = std::max(parent, code);
            }
        }
}

}  // namespace

Terrain synthetic_terrain(uint32_t width, uint32_t height, VoidTest is_void) {
    Terrain terrain;
    terrain.shape = shape_of(width, height);
    terrain.frame = {30, 20, true, 44.5, -71.5, 0.25, 1e-4, "EPSG:32619"};
    terrain.height_step_m = 0.25;
    terrain.height_offset_m = -100;
    terrain.finest_error_m = 0.1;
    terrain.error_m[0] = float_at_least(terrain.finest_error_m);
    for (size_t code = 1; code < kMustSplit; ++code) terrain.error_m[code] = float(code);
    terrain.error_m[kMustSplit] = std::numeric_limits<float>::infinity();

    Numbers numbers;
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x) {
            uint32_t noise = numbers.next();
            int32_t cliff = noise % 997 == 0 ? 1 << 20 : 0;
            terrain.heights.push_back(is_void(x, y) ? kVoid : int32_t(3 * x) - int32_t(5 * y) + int32_t(noise % 16) + cliff);
        }
    for (uint32_t level = 0; level < terrain.shape.root_log2; ++level) {
        LevelGrid grid = level_grid(terrain.shape, level);
        std::vector<uint8_t>& codes = terrain.codes.emplace_back(size_t(grid.columns) * grid.rows, uint8_t(0));
        for (uint32_t j = 0; j < grid.rows; ++j)
            for (uint32_t i = 1 - (j & 1); i < grid.columns; i += 2 - (j & 1))
                codes[size_t(j) * grid.columns + i] = uint8_t(1 + numbers.next() % 8 + 4 * level);
    }
    for (uint32_t level = 0; level < terrain.shape.root_log2; ++level)
        saturate(terrain, level, false), saturate(terrain, level, true);
    return terrain;
}

}  // namespace overlook::terrain
