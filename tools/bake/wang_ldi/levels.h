// How finely tiles are sampled at which distance, and from how many directions.
//
// Based on: J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth Images, 2000, section 4 (a level for each of the first
// seven tiles outwards, such that a splat is a pixel; eight directions).
#pragma once

#include "formats/result.h"
#include "formats/wang_ldi.h"

namespace overlook::wang_ldi {

enum class Constants { chosen, paper };

struct LevelOptions {
    Constants constants = Constants::chosen;
    // Cell, the tile, heights, counts and flags of the set that is asked for; its levels and directions are what is chosen.
    // A cell's distances of 0: chosen, from 2.5 to 40 sides of a tile.
    ImageSet set;
    double level_ratio = 1.5;  // a level's pixels are so much wider than the next finer one's; above 1, up to 4
    // A tile's rim may turn by so many pixels between the middle of a wedge and its edge, fade and all, at the nearest distance.
    double direction_px = 170;
    // Of height in a pixel's width, where 16 bits suffice. Of sunflowers 4 take a sixth more bytes at the same E (300 views: p99
    // 0.807 both, mean 0.4216 for 0.4212).
    double steps_per_pixel = 2;
};

// The least distance from an eye of the cell to anything in a tile whose middle is `distance_m` away on the ground.
double nearest_of_tile_m(const ImageSet& set, double distance_m);

// By how many pixels a point of a tile's rim, a circle of rim_m about its middle, moves at most when an eye that looks at the
// middle, level, from distance_m > rim_m goes round it by turn_rad, 0 .. pi. A bound for points at the eye's height and, but for
// eyes looking down on them, for all others.
double rim_turn_px(double rim_m, double distance_m, double turn_rad, double focal_px);

// The set with its levels and directions. Chosen: a pixel of a level is error_px in the middle of the screen where the level
// begins to be shown, and directions are the fewest that keep direction_px. Paper: 468, 232, 151, 111, 88, 73 and 62 pixels for
// the rings at one to seven tiles, 8 directions, no fades. Fails with Exit::bad_command:
// "tiles 5 m from the eye at most, 7.5 m at least; give --farthest-m 7.5 or more, or --nearest-m",
// "tiles begin at 2 m from the eye, within a tile of 4 m; --nearest-m 3 at least, nearer ones are drawn as geometry", "a pixel
// error of 0.01 px needs 20,000 pixels along a tile, 4,096 are possible; ask for more error or a greater nearest distance", "a
// tile's rim turns by 12.3 px within each of 64 directions, the most that are possible; --direction-px 12.4 at least, or a
// greater
// --nearest-m".
Result<ImageSet> leveled(const LevelOptions& options);

}  // namespace overlook::wang_ldi
