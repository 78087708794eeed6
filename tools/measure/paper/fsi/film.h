// One change of level, filmed: things stand on an arc round the eye and all change in the same frame, so that entering and
// leaving the transition are frames that are known.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "formats/image.h"
#include "tools/measure/paper/fsi/cast.h"
#include "tools/measure/run.h"

namespace overlook::measure::paper::fsi {

// Where the things stand: `count` on the arc, and one more behind them, which keep the coarser level.
struct Stand {
    uint32_t change = 0;    // from level change + 1 to level change
    double distance_m = 0;  // of the arc
    uint32_t count = 0;
};

constexpr uint32_t kFilmWidth_px = 320, kFilmHeight_px = 240;
constexpr double kFilmFov_deg = 60;
constexpr double kFilmStep_s = 1.0 / 32;
// Frames before the first in which anything changes; of a change that fades (0.25 s); after it.
constexpr uint32_t kBefore = 8, kFading = 8, kAfter = 6, kFilmFrames = kBefore + kFading + kAfter;

// The change at whose distance the coarser level is off by error_px, the finest of those that are not nearer than the thing's
// size allows (else the nearest that is allowed, of the chain's first). The chain must have two levels.
Stand stand_of(const discrete::Chain& chain, double error_px);

// What a way is asked for, so that the things of the arc change when the eye passes its middle: by distance; `late` by what
// nobody sees, as always.
std::string settings_of(const Stand& stand, const Way& way);

// The same by hard switching, so that the things of the arc keep one of their two levels all the time, those behind them theirs.
std::string settings_of_standing(const Stand& stand, bool is_finer);

// From where on level 1 does, so that level change + 1 gives way to level change on the arc.
double first_distance_m(const Stand& stand);

// What is filmed: what stands about in a scene stands on the arc instead, all else as it is; copied, and uploaded. Fails as
// upload.
Result<World> film_world(const World& scene, const Stand& stand);
// A camera a frame, past the arc's middle. base: of film_world.
std::vector<view::Camera> film_cameras(const Stand& stand, const view::Camera& base);

// A way over the film.
struct Take {
    std::string name;
    RunResult run;  // every frame compared with the reference
};

struct Film {
    std::string name, chain;  // "trees", "by hand"
    Stand stand;
    std::vector<Take> takes;
    RunResult floor;
    std::array<RunResult, 2> standing;  // the arc's things keep the coarser level; the finer one
    std::string label() const { return chain.empty() ? name : name + ", " + chain; }
};

// What is filmed of a chain, and by which ways.
struct Script {
    std::string name, chain;
    Stand stand;
    std::vector<Take> takes;  // without runs but for their specs
};

// Flies past. world: of film_world. Fails as run_course.
Result<Film> shoot(World& world, const Script& script, const gl::Renderer& renderer, const std::function<void(double)>& done);

// What of a change was seen. W is taken over the floor's in the same frame: thousandths of luma.
struct Seen {
    double entering_w = 0, leaving_w = 0, greatest_w = 0;  // of the first frame, of the last, of the worst
    double integrated_w = 0;                               // over all frames of the change
    double median_w = 0;                                   // of the film's frames, as it is
    // W as it is over its median in the time of a change that fades (its first frame to the first after it, of every way): the
    // worse of the change's first frame and of the first after its last, and of all of them.
    double end_ratio = 1, greatest_ratio = 1;
    // W of the film's frames before the change and of those after it, over hard switching's in the same frames, medians both: the
    // worse of the two; and summed over the time of a change that fades, where hard switching has all of its change in one frame.
    double rest_ratio = 1, change_ratio = 1;
    // Pop index of the first two frames, of the last two, over what either level has at rest in the same frame and tile (or the
    // floor, if that is more); of the film, over the floor alone. And the greatest that one level at rest has there, so counted.
    double entering_pop = 1, leaving_pop = 1, pop = 1, standing_pop = 1;
    double triangles = 0;     // a frame of the change, in the mean
    double odd_even = 0;      // greatest difference of consecutive frames in the change, share
    double buffer_bytes = 0;  // beside what `switch` keeps
};
Seen seen_of(const Film& film, const Take& take);

// What the takes show of some frames, side by side: a row a take, a column each of kSequenceFrames, the middle of the picture.
constexpr uint32_t kSequenceFrames[] = {kBefore - 1, kBefore, kBefore + 2, kBefore + 4, kBefore + 6, kBefore + kFading};
Result<ImageRgb8> sequence_of(World& world, const Script& script);

// films.csv: a row a take.
std::string films_csv(const std::vector<Film>& films);

}  // namespace overlook::measure::paper::fsi
