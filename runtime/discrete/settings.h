// What is asked of chains of levels, and by which way they change from level to level.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "formats/setting.h"

namespace overlook::discrete {

// How a level gives way to another.
enum class Variant {
    fsi,        // frame-sequential interpolation as it should be: each frame draws one level, two frames make a picture
    fsi_paper,  // the same as printed in 2008
    hard,       // at once
    blend,      // both levels in one frame, the fading one translucent (Giegl and Wimmer 2007)
    dither,     // both levels in one frame, each on the pixels that the other leaves (screen door)
    late,       // at once, but only where nobody can see it
};
constexpr bool fades(Variant variant) {
    return variant != Variant::hard && variant != Variant::late;
}
constexpr bool draws_by_turns(Variant variant) {
    return variant == Variant::fsi || variant == Variant::fsi_paper;
}

// By what an instance's level is chosen. Each is a strain of every level, over 1 where the level is too coarse.
enum class Criterion : uint32_t {
    error,       // its displacement in pixels, bounded anywhere in the frame (view::SphereErrorBound)
    size,        // the thing's diameter in pixels
    distance,    // metres from the eye to its middle
    importance,  // as error, but allowing more towards the frame's border
};

struct SelectSettings {
    Criterion criterion = Criterion::error;
    double error_px = 1;      // > 0
    double size_px = 256;     // > 0; under it level 1 does, under half of it level 2, ...
    double distance_m = 100;  // > 0; from there on level 1 does, from twice as far on level 2, ...
    double periphery = 2;     // >= 0; of Criterion::importance: error_px is so many times more at the frame's corner, and 1
    double area_weight = 1;   // >= 0; of lost area (LevelFacts::area_error_m) beside displacement
    // A finer level is wanted when the strain of the one in use is over this, 0 < .. <= 1; a coarser one when its strain is no
    // more than coarsen_share of that, 0 < .. < 1. Between the two nothing changes.
    double refine_share = 1;
    double coarsen_share = 0.8;
};

// The remedies of Variant::fsi, each of which may be left out.
struct Remedies {
    bool keeps_hidden = true;     // fragments that are not visible yet keep their colour, depth and id
    bool has_wide_ids = true;     // 32-bit whole numbers; else 16-bit floats
    bool has_wide_depth = true;   // 32-bit floats, near 1; else 16-bit floats, near 0
    bool weighs_by_phase = true;  // the two colours; else half of each
    bool splits_parities = true;  // half of the instances, by triangles, draw their finer level in even frames
    bool splits_things = true;    // with splits_parities: one thing whose change is much of the work is divided (split.h)
    bool moves_instances = true;  // looks instances up where they were themselves; else by the camera alone
    bool searches = true;         // what covers a pixel in the older buffer is found wherever it was there
    // Each level's ramp lasts as long as the change: where both are seen they are mixed, so none need be whole. With keeps_hidden
    // and weighs_by_phase only.
    bool has_long_ramps = true;
    bool eases_ends = true;   // a change sets off and comes to rest slowly; with has_long_ramps only
    bool suits_grain = true;  // the visibility's grain is a pixel at least, as far as the instance is
    // Only squares of the picture in which something may be under way are put together of two frames; the others are the newer
    // one. With has_wide_depth only.
    bool copies_rest = true;
    // Of those squares only blocks in which one of the two frames shows it (draw_sieve.h): the same picture for less work. With
    // copies_rest, searches and has_wide_ids only.
    bool sieves = true;
    // What was out of view, or what the eye came from elsewhere to (a cut, a teleport), has its level at once: there is nothing
    // that could pop, and no older picture of it.
    bool knows_cuts = true;
    double softness = 1;  // >= 0; share of the ramp in which one place appears; 0: at once

    bool operator==(const Remedies&) const = default;
};

struct FrameOptions {
    Variant variant = Variant::fsi;
    SelectSettings select;
    double fade_s = 0.25;          // > 0; how long a change of level takes
    bool foresees = true;          // of those that take time: changes begin so early that they are over when they are due
    bool is_one_by_one = false;    // levels between are shown on the way; else skipped
    bool reprojects = true;        // looks the older buffer up where things were; of both FSI variants
    bool is_half_precise = false;  // of Variant::fsi_paper: ids and depth are 16-bit floats, as the authors had them
    Remedies remedies;
};

// The options that a variant begins with.
FrameOptions defaults_of(Variant variant);

// What people may set of a variant.
std::span<const SettingKind> setting_kinds(Variant variant);
// name and value must be of one of them.
void set(FrameOptions& options, std::string_view name, double value);

}  // namespace overlook::discrete
