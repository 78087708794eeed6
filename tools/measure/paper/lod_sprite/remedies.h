// What each remedy of LOD-sprite buys: Overlook's form of the method as it is, and with each remedy alone switched off.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/measure/paper/lod_sprite/fly.h"

namespace overlook::measure::paper::sprite {

struct Remedy {
    std::string_view name;     // "cross-fade"
    std::string_view off;      // the setting of lod-sprite that takes it away: "fade-frames=0"
    std::string_view purpose;  // a sentence
};
std::span<const Remedy> remedies();

// A remedy's row, or one of those that they are held against.
struct RemedyRow {
    std::string name, off, purpose;  // off: empty of what they are held against
    RunResult run;
};

// All rows, of one run in which they took turns.
struct RemedyTable {
    std::vector<RemedyRow> rows;  // the high cut, the paper's form, Overlook's, then each remedy off; empty: not flown
    RunResult floor;
    uint32_t lead_frames = 0, first_frame = 0, forward_frames = 0, back_frames = 0;  // of the flight's kStepFrames
    const RemedyRow& whole() const { return rows[kWhole]; }                          // Overlook's form with all remedies

    static constexpr size_t kWhole = 2;
    static constexpr uint32_t kStepFrames = 600, kLeadFrames = 24;
};

// Two thirds of so many frames (1 .. 540) of the paper's 600, round where the flight has the highest ground below it, and then
// the last half of them backwards: a way to and fro over the range. Up to kLeadFrames before are flown as well, and not counted,
// so that no row begins without a key. Every frame is compared with the reference, E on every tenth; see Compared::steps. Fails
// as run_course.
Result<RemedyTable> fly_remedies(const Flying& flying, const Plan& plan, uint32_t frames,
                                 const std::function<void(double)>& done);

// What a row shows. Shares are means over the frames that used a key, of the surface's pixels.
struct RemedyFigures {
    double mean_ms = 0, p99_ms = 0;
    double triangles = 0, key_pixels = 0;  // a frame, in the mean
    uint32_t keys = 0;
    double e_mean = 0, e_p99 = 0;  // LDR-FLIP: mean of means; 99th percentile over pixels, then over frames
    double w_mean = 0, pop_index = 0;
    double ghost_share = 0, loss_share = 0, hole_px = 0;  // holes: of the worst frame
};
RemedyFigures figures_of(const RunResult& run);

// What changes without a remedy, from its row and the whole method's: "mean time x 1.4, W x 1.2, holes 0 to 35 px"; of the
// mean time what changes by 15 %, of its 99th percentile by half (machines are noisy), of the rest what changes by a twentieth
// and could be seen; "nothing that could be measured here".
std::string change_of(const RemedyFigures& whole, const RemedyFigures& without);

// remedies.csv: a row a row.
std::string remedies_csv(const RemedyTable& table);

}  // namespace overlook::measure::paper::sprite
