// How project_samples does it, eight samples at a time: lanes.h says what holds for its compilations.
#pragma once

#include "runtime/wang_ldi/lanes.h"
#include "runtime/wang_ldi/project_samples.h"

namespace overlook::wang_ldi {
namespace {

inline int64_t sum_of(const Ints& lanes) {
    int64_t sum = 0;
    for (uint32_t lane = 0; lane < kLanes; ++lane) sum += lanes[lane];
    return sum;
}

// Of eight samples.
struct Eight {
    Ints is_there, is_drawn, left, top, side, pixels;
    Floats depth_m;
};

inline void project_eight(const SampleFrame& frame, const uint32_t* places, const uint16_t* rows, const uint8_t* splats,
                          Eight& out) {
    Words place;
    Shorts own_row;
    load(place, places), load(own_row, rows);
    Floats x = (__builtin_convertvector((Ints)(place & 0xffffu), Floats) + 0.5f) * frame.pixel_m;
    Floats y = (__builtin_convertvector(__builtin_convertvector(own_row, Ints), Floats) + 0.5f) * frame.pixel_m;
    Floats z = __builtin_convertvector((Ints)(place >> 16), Floats) * frame.step_m;
    auto seen = [&](int k) { return ((frame.corner[k] + y * frame.north[k]) + x * frame.east[k]) + z * frame.up[k]; };
    Floats right = seen(0), up = seen(1), depth = seen(2);
    Floats wide = frame.splat - Floats{};
    if (splats != nullptr) {
        Bytes splat;
        load(splat, splats);
        wide = frame.splat * __builtin_convertvector(__builtin_convertvector(splat, Ints), Floats);
    }
    Ints is_drawn = out.is_there & (depth >= frame.near_m);
    depth = chosen(is_drawn, depth, Floats{} + 1.0f);
    Floats nearness = 1.0f / depth, across = frame.middle_px[0] + right * nearness, down = frame.middle_px[1] - up * nearness;
    is_drawn &= (across < 1e6f) & (across > -1e6f) & (down < 1e6f) & (down > -1e6f);
    across = chosen(is_drawn, across, Floats{}), down = chosen(is_drawn, down, Floats{});
    Floats width = wide * nearness;
    width = chosen(width < 1e4f, width, Floats{} + 1e4f) + 0.5f;
    Ints side = greater(lesser(__builtin_convertvector(width, Ints), Ints{} + frame.most_side), Ints{} + 1);
    Floats half = 0.5f * __builtin_convertvector(side - 1, Floats);
    out.left = floor_of(across - half), out.top = floor_of(down - half), out.side = side;
    is_drawn &= (out.left < frame.width_px) & (out.top < frame.height_px) & (out.left + side > 0) & (out.top + side > 0);
    out.is_drawn = is_drawn, out.depth_m = depth;
    out.pixels = chosen(is_drawn, frame.origin + out.top * frame.stride + out.left, Ints{} + frame.nowhere);
}

// Counts of each lane; flushed before they can overflow.
struct LaneCounts {
    Ints drawn{}, pixels{}, least_side, most_side;

    void flush(ProjectedCounts& counts) {
        counts.drawn += uint64_t(sum_of(drawn)), counts.pixels += uint64_t(sum_of(pixels));
        drawn = pixels = Ints{};
    }
};

inline void count_eight(const SampleFrame& frame, const Eight& eight, const Ints& side, LaneCounts& counts) {
    counts.drawn -= eight.is_drawn;
    counts.least_side = lesser(counts.least_side, chosen(eight.is_drawn, side, counts.least_side));
    counts.most_side = greater(counts.most_side, side & eight.is_drawn);
    Ints wide = lesser(eight.left + eight.side, Ints{} + frame.width_px) - greater(eight.left, Ints{});
    Ints high = lesser(eight.top + eight.side, Ints{} + frame.height_px) - greater(eight.top, Ints{});
    counts.pixels += (wide * high) & eight.is_drawn;
}

inline void project_lanes(const SampleFrame& frame, const SamplesOfRows& samples, const Projected& out, ProjectedCounts& counts) {
    constexpr uint32_t kFlush = 1 << 17;  // samples: a lane counts 2^14 splats of 2^16 pixels
    LaneCounts lanes;
    lanes.least_side = Ints{} + counts.least_side, lanes.most_side = Ints{} + counts.most_side;
    const Ints lane{0, 1, 2, 3, 4, 5, 6, 7};
    uint32_t count = samples.count;
    for (uint32_t s = 0; s < count; s += kLanes) {
        Eight eight;
        eight.is_there = lane < int32_t(count - s);
        project_eight(frame, samples.places + s, samples.rows + s, samples.splats == nullptr ? nullptr : samples.splats + s,
                      eight);
        Ints side = chosen(eight.is_drawn, eight.side, Ints{} + 1);
        store(out.pixels + s, eight.pixels), store(out.sides + s, side), store(out.depths_m + s, eight.depth_m);
        count_eight(frame, eight, side, lanes);
        if (s % kFlush == kFlush - kLanes) lanes.flush(counts);
    }
    lanes.flush(counts);
    for (uint32_t k = 0; k < kLanes; ++k) {
        if (lanes.least_side[k] < counts.least_side) counts.least_side = lanes.least_side[k];
        if (lanes.most_side[k] > counts.most_side) counts.most_side = lanes.most_side[k];
    }
}

}  // namespace
}  // namespace overlook::wang_ldi
